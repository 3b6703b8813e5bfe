#include "hiac/preview/drawing_order.hpp"

#include <gtest/gtest.h>

#include "tests/preview/preview_support.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

TEST(DrawingOrder, GroupsComeByTheirCentroidsAndTheRestIsReversed) {
  const ZooMesh mesh = test::lattice_with_fields(2);
  const Scene scene = test::benchmark_scene(Projection::perspective, 40, 30);
  const Projector projector(scene.camera, scene.image);
  VisibilityOrder order = test::exact_order_of(mesh, scene);
  const std::vector<CellId> plain = preview::back_to_front(mesh, order, projector);
  ASSERT_EQ(plain.size(), mesh.cell_count());
  EXPECT_TRUE(
      std::equal(plain.begin(), plain.end(), std::make_reverse_iterator(order.cells.end())));
  order.groups = std::vector<CellGroup>{{4, 20}};
  const std::vector<CellId> grouped = preview::back_to_front(mesh, order, projector);
  const std::size_t n = grouped.size();
  EXPECT_TRUE(std::equal(grouped.begin(), grouped.end() - 24, plain.begin()));
  EXPECT_TRUE(std::equal(grouped.end() - 4, grouped.end(), plain.end() - 4));
  const auto depth = [&](CellId cell) {
    double sum = 0;
    for (const NodeId node : mesh.cell_nodes(cell)) sum += projector.parameter(mesh.position(node));
    return sum;
  };
  for (std::size_t k = n - 24; k + 1 < n - 4; ++k)
    EXPECT_GE(depth(grouped[k]), depth(grouped[k + 1]) - 1e-12);
}

}  // namespace
}  // namespace hiac
