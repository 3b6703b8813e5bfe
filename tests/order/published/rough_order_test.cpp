#include "hiac/order/published/rough_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "hiac/order/published/depth.hpp"
#include "tests/order/order_meshes.hpp"

namespace hiac::test {
namespace {

// Back to front by the rearmost depth, and no point of a cell is nearer than its frontmost one.
TEST(RoughOrder, BoundsTheDepthsOfPoints) {
  std::mt19937_64 random(1);
  std::exponential_distribution<double> weight;
  for (const ZooMesh& mesh : {random_delaunay(20, 1), structured(2, Cut::prisms)})
    for (const auto& [name, view] : many_views()) {
      SCOPED_TRACE(name);
      const RoughOrder order = rough_order(mesh, view);
      const Depth depth(view);
      for (std::size_t rank = 0; rank < order.cells.size(); ++rank) {
        if (rank > 0) {
          ASSERT_GE(order.rearmost[rank - 1], order.rearmost[rank]);
        }
        for (int i = 0; i < 20; ++i) {
          Position point{};
          double sum = 0;
          for (const NodeId node : mesh.cell_nodes(order.cells[rank])) {
            const double w = weight(random);
            sum += w;
            for (std::size_t c = 0; c < 3; ++c) point[c] += w * mesh.position(node)[c];
          }
          for (double& x : point) x /= sum;
          ASSERT_GE(depth(point), order.frontmost[rank]);
          ASSERT_LE(depth(point), order.rearmost[rank] + 1e-9);
        }
      }
    }
}

// Half of the distance, or of the coordinate along the view's direction.
long double half_depth(const ZooMesh& mesh, NodeId node, const View& view) {
  const auto p = mesh.position(node);
  if (view.perspective)
    return std::hypot(static_cast<long double>(p[0]) - view.eye[0],
                      static_cast<long double>(p[1]) - view.eye[1],
                      static_cast<long double>(p[2]) - view.eye[2]) /
           2;
  long double along = 0, square = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    along += static_cast<long double>(p[c]) * view.direction[c];
    square += static_cast<long double>(view.direction[c]) * view.direction[c];
  }
  return along / std::sqrt(square) / 2;
}

// The depth of the nearest corner along the line from the eye to the cell's centroid.
long double half_depth_of_plane(const ZooMesh& mesh, CellId cell, const View& view) {
  const auto nodes = mesh.cell_nodes(cell);
  long double nearest = HUGE_VAL, length = 0;
  std::array<long double, 3> towards{};
  for (std::size_t c = 0; c < 3; ++c) {
    for (const NodeId node : nodes)
      towards[c] += (static_cast<long double>(mesh.position(node)[c]) - view.eye[c]) /
                    static_cast<long double>(nodes.size());
    length = std::hypot(length, towards[c]);
  }
  for (const NodeId node : nodes) {
    long double along = 0;
    for (std::size_t c = 0; c < 3; ++c)
      along += (static_cast<long double>(mesh.position(node)[c]) - view.eye[c]) * towards[c];
    nearest =
        std::min(nearest, view.perspective ? along / length / 2 : half_depth(mesh, node, view));
  }
  return nearest;
}

TEST(RoughOrder, IsByTheFarthestCornerThenByNumber) {
  for (const ZooMesh& mesh : {random_delaunay(20, 1), structured(2, Cut::prisms)})
    for (const auto& [name, view] : many_views()) {
      SCOPED_TRACE(name);
      const RoughOrder order = rough_order(mesh, view);
      double size = 1;
      for (const double x : view.eye) size = std::max(size, std::abs(x));
      ASSERT_EQ(order.cells.size(), mesh.cell_count());
      ASSERT_EQ(order.rearmost.size(), mesh.cell_count());
      ASSERT_EQ(order.frontmost.size(), mesh.cell_count());
      for (std::size_t rank = 0; rank < order.cells.size(); ++rank) {
        long double farthest = -HUGE_VAL;
        for (const NodeId node : mesh.cell_nodes(order.cells[rank]))
          farthest = std::max(farthest, half_depth(mesh, node, view));
        EXPECT_NEAR(order.rearmost[rank], static_cast<double>(farthest), 1e-15 * size);
        if (rank > 0 && order.rearmost[rank] == order.rearmost[rank - 1]) {
          EXPECT_LT(order.cells[rank - 1], order.cells[rank]);
        }
      }
    }
}

// Lower than that by 1e-13 of the largest coordinate, and by rounding.
TEST(RoughOrder, TheFrontmostDepthIsThatOfAPlaneAcrossTheLineOfSight) {
  for (const ZooMesh& mesh : {random_delaunay(20, 1), structured(2, Cut::prisms)})
    for (const auto& [name, view] : many_views()) {
      SCOPED_TRACE(name);
      double size = 1;
      for (const double x : view.eye) size = std::max(size, std::abs(x));
      const RoughOrder order = rough_order(mesh, view);
      for (std::size_t rank = 0; rank < order.cells.size(); ++rank) {
        const auto expected =
            static_cast<double>(half_depth_of_plane(mesh, order.cells[rank], view));
        if (!std::isfinite(expected)) continue;  // the eye is the centroid
        EXPECT_LT(order.frontmost[rank], expected);
        EXPECT_GT(order.frontmost[rank], expected - 1.1e-13 * size);
      }
    }
}

TEST(RoughOrder, OfACellAroundTheEyeNothingIsKnown) {
  const ZooMesh mesh = structured(1, Cut::bricks);
  const RoughOrder order = rough_order(mesh, from_eye("middle", {0.5, 0.5, 0.5}).view);
  EXPECT_EQ(order.frontmost[0], -HUGE_VAL);
}

}  // namespace
}  // namespace hiac::test
