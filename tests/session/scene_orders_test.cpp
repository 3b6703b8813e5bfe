#include "hiac/session/scene_orders.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/mesh_hash.hpp"
#include "hiac/order/published/centroid.hpp"
#include "hiac/scene/view_of.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::test {
namespace {

using testing::ElementsAreArray;
using testing::HasSubstr;

Scene some_scene() {
  Scene scene;
  scene.camera.eye = {3.1, 2.3, 2.7};
  scene.camera.look_at = {0.5, 0.5, 0.5};
  return scene;
}

TEST(SceneOrders, AreMadeByTheAlgorithmThatIsAskedFor) {
  const ZooMesh mesh = structured(2, Cut::tetrahedra);
  const Scene scene = some_scene();
  SceneOrders orders(mesh, {});
  EXPECT_EQ(orders.of(scene).record.order.algorithm, "exact");
  EXPECT_TRUE(orders.of(scene).statistics.has_value());
  for (const OrderAlgorithm algorithm : kOrderAlgorithms) {
    orders.sort_by({.algorithm = algorithm, .tiling = {}});
    const MeshOrder made = orders.of(scene);
    EXPECT_EQ(made.record.order.algorithm, algorithm_name(algorithm));
    EXPECT_EQ(made.record.order.cells.size(), mesh.cell_count());
    EXPECT_EQ(made.record.mesh_hash, geometry_hash(mesh));
    EXPECT_EQ(made.record.view_hash, view_hash(scene));
  }
  const auto centroids = centroid_order(mesh, view_of(scene.camera));
  EXPECT_THAT(std::vector<CellId>(centroids.cells.begin(), centroids.cells.end()),
              ElementsAreArray(orders.of(scene).record.order.cells.view()));
}

TEST(SceneOrders, LeaveCellsOut) {
  const ZooMesh mesh = structured(2, Cut::tetrahedra);
  SceneOrders orders(mesh, {});
  orders.leave_out({3, 17});
  const MeshOrder made = orders.of(some_scene());
  EXPECT_EQ(made.record.order.cells.size(), mesh.cell_count() - 2);
  EXPECT_EQ(std::ranges::count(made.record.order.cells.view(), CellId{17}), 0);
}

TEST(SceneOrders, ThatAreGivenAreUsedAndNamedWhereTheyAreNotExact) {
  const ZooMesh mesh = structured(2, Cut::tetrahedra);
  const Scene scene = some_scene();
  SceneOrders making(mesh, {});
  making.sort_by({.algorithm = OrderAlgorithm::centroid, .tiling = {}});
  std::vector<std::string> notes;
  SceneOrders orders(mesh, {.note = [&](const std::string& line) { notes.push_back(line); }});
  orders.use({"x.order", {encode_order(making.of(scene).record)}});
  orders.require(scene);
  EXPECT_EQ(orders.of(scene).record.order.algorithm, "centroid");
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes[0], HasSubstr("x.order: the order is by centroid"));
  Scene other = scene;
  other.camera.eye[0] += 1;
  EXPECT_THROW(orders.require(other), InputError);
  EXPECT_THROW(orders.of(other), InputError);
  EXPECT_THROW(orders.look_for_overlaps(1e-10), UsageError);
}

}  // namespace
}  // namespace hiac::test
