#include "hiac/cluster/shared_tiles.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/order/order_basis.hpp"
#include "hiac/render/supersampling.hpp"
#include "tests/cluster/parts_of.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac {
namespace {

class SharedTilesTest : public testing::Test {
 protected:
  SharedTilesTest() : mesh_(test::random_delaunay(80, 4)) {
    test::add_node_field(mesh_, "f", test::smooth_field);
    scene_ = test::cube_scene(Projection::perspective, 200, 150);
    order_ = test::sorted(mesh_, scene_);
  }

  // The pictures of all ranks, of which `render` makes one for a crew.
  template <typename Render>
  static std::vector<RenderResult> of_ranks(std::uint32_t ranks, const Render& render) {
    std::vector<RenderResult> results(ranks);
    test::run_ranks(ranks, [&](Communicator& all) {
      const SharedTiles crew(all);
      results[all.rank()] = render(&crew);
    });
    return results;
  }

  template <typename Render>
  static void expect_alone(const Render& render) {
    const RenderResult alone = render(nullptr);
    for (const std::uint32_t ranks : test::tried(std::vector{5U, 1U, 2U})) {
      const auto results = of_ranks(ranks, render);
      const auto values = results[0].image.values(), expected = alone.image.values();
      ASSERT_EQ(values.size(), expected.size());
      EXPECT_EQ(std::memcmp(values.data(), expected.data(), values.size_bytes()), 0) << ranks;
      for (const RenderResult& result : results) {
        EXPECT_EQ(result.statistics.segments, alone.statistics.segments);
        EXPECT_EQ(result.statistics.covered_pixels, alone.statistics.covered_pixels);
        EXPECT_EQ(result.statistics.mean_optical_depth, alone.statistics.mean_optical_depth);
      }
    }
  }

  ZooMesh mesh_;
  Scene scene_;
  VisibilityOrder order_;
  static constexpr std::array kChannels{Channel::depth, Channel::cells, Channel::error};
};

TEST_F(SharedTilesTest, AnyRanksMakeThePictureOfOneProcess) {
  for (const PixelRect& part : {whole_picture(scene_.image), PixelRect{70, 20, 90, 77}})
    expect_alone([&](const TileCrew* crew) {
      return PartRenderer(mesh_, order_, scene_, kChannels, crew).render(part, true);
    });
}

TEST_F(SharedTilesTest, SamplesToo) {
  expect_alone([&](const TileCrew* crew) {
    return render_supersampled(mesh_, order_, scene_, {10, 20, 90, 60}, {3, SampleFilter::bspline},
                               true, nullptr, kChannels, crew);
  });
}

std::string facts_of(const OrderBasis& basis) {
  std::string facts = fmt::format("{} {}\n", basis.shared_faces, basis.convex);
  for (const CellSides& s : basis.sides)
    facts += fmt::format("{} {} {} {}\n", s.positive, s.negative, s.unsettled, s.plane_start);
  for (const UnsettledFace& f : basis.unsettled) facts += fmt::format("{} {}\n", f.cell, f.face);
  for (const UnmatchedFace& f : basis.unmatched)
    facts += fmt::format("{} {} {} {} {} {}\n", f.cell, f.face, fmt::join(f.nodes, " "),
                         f.corner_count, f.side, f.deviation);
  return facts;
}

TEST(SharedBasis, IsThatOfOneProcess) {
  const auto folded = [](const test::Position& p) {
    return test::Position{std::abs(p[0] - 0.5), p[1], p[2]};
  };
  const ZooMesh tetrahedra = test::random_delaunay(300, 8);
  std::size_t unsettled = 0;
  for (const ZooMesh& mesh :
       {tetrahedra, test::moved(tetrahedra, folded), test::mixed_columns(2), test::two_wedges(),
        test::keep_cells(tetrahedra,
                         [](const test::Position&, CellId cell) { return cell == 5; })}) {
    const FaceAdjacency adjacency = build_face_adjacency(mesh);
    const OrderBasis basis = order_basis(mesh, adjacency);
    const std::string alone = facts_of(basis);
    unsettled += basis.unsettled.size();
    for (const std::uint32_t ranks : {1U, 2U, 5U}) {
      std::vector<std::string> found(ranks);
      test::run_ranks(ranks, [&](Communicator& all) {
        const SharedTiles crew(all);
        found[all.rank()] = facts_of(order_basis(mesh, adjacency, &crew));
      });
      for (const std::string& of_rank : found) EXPECT_EQ(of_rank, alone) << ranks;
    }
  }
  EXPECT_GT(unsettled, 50U);
}

}  // namespace
}  // namespace hiac
