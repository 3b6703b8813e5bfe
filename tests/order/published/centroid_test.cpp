#include "hiac/order/published/centroid.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/parallel.hpp"
#include "tests/order/brute_force_order.hpp"
#include "tests/order/order_meshes.hpp"

namespace hiac::test {
namespace {

long double depth_of(const ZooMesh& mesh, CellId cell, const View& view) {
  long double depth = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    long double mean = 0;
    for (const NodeId node : mesh.cell_nodes(cell))
      mean += static_cast<long double>(mesh.position(node)[c]) /
              static_cast<long double>(mesh.cell_nodes(cell).size());
    depth +=
        view.perspective ? (mean - view.eye[c]) * (mean - view.eye[c]) : mean * view.direction[c];
  }
  return depth;
}

TEST(Centroid, IsSorted) {
  for (const ZooMesh& mesh : {random_delaunay(40, 1), structured(3, Cut::prisms)})
    for (const auto& [name, view] : many_views()) {
      SCOPED_TRACE(name);
      const VisibilityOrder order = centroid_order(mesh, view);
      EXPECT_EQ(order.algorithm, "centroid");
      ASSERT_TRUE(is_sequence_of_groups(order, mesh.cell_count()));
      ASSERT_TRUE(order.groups.empty());
      for (std::size_t i = 1; i < order.cells.size(); ++i) {
        const long double before = depth_of(mesh, order.cells[i - 1], view);
        const long double after = depth_of(mesh, order.cells[i], view);
        ASSERT_LE(before, after + 1e-12L * std::abs(after));
      }
    }
}

TEST(Centroid, CellsOfOneDepthComeByNumber) {
  const VisibilityOrder order =
      centroid_order(structured(2, Cut::bricks), along("z", {0, 0, 3}).view);
  EXPECT_THAT(std::vector(order.cells.begin(), order.cells.end()),
              testing::ElementsAre(0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U));
}

TEST(Centroid, HugeCoordinatesStaySorted) {
  const ZooMesh mesh = moved(structured(2, Cut::bricks), [](const Position& p) {
    constexpr double kHuge = 1.7e308;
    return Position{(2 * p[0] - 1) * kHuge, (2 * p[1] - 1) * kHuge, (2 * p[2] - 1) * kHuge};
  });
  for (const View& view : {along("x", {1, 1, 1e-300}).view, from_eye("eye", {-1e308, 0, 0}).view})
    EXPECT_TRUE(is_sequence_of_groups(centroid_order(mesh, view), mesh.cell_count()));
}

TEST(Centroid, ThreadsChangeNothing) {
  const ZooMesh mesh = random_delaunay(3000, 2);
  const View view = from_eye("eye", {2, 3, 4}).view;
  const VisibilityOrder many = centroid_order(mesh, view);
  const ThreadLimit limit(1);
  EXPECT_TRUE(std::ranges::equal(many.cells, centroid_order(mesh, view).cells));
}

}  // namespace
}  // namespace hiac::test
