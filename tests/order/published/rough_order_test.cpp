#include "hiac/order/published/rough_order.hpp"

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

}  // namespace
}  // namespace hiac::test
