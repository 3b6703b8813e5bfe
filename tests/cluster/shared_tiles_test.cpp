#include "hiac/cluster/shared_tiles.hpp"

#include <array>
#include <cstring>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace hiac
