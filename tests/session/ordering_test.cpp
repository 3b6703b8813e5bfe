#include "hiac/session/ordering.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/mesh_hash.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::test {
namespace {

using testing::HasSubstr;

template <typename Work>
std::string error_of(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Ordering, AnotherMeshOrViewIsRefused) {
  const ZooMesh mesh = structured(1, Cut::tetrahedra);
  const Scene scene;
  OrderRecord record{geometry_hash(mesh), view_hash(scene), {}};
  record.order.cells = std::vector<CellId>{0, 1, 2, 3, 4, 5};
  const auto fit = [&](const ZooMesh& m, const Scene& s, const OrderRecord& r) {
    return error_of([&] { fitting_order({"x.order", {encode_order(r)}}, geometry_hash(m), m, s); });
  };
  EXPECT_EQ(fit(mesh, scene, record), "no error");
  Scene other_scene = scene;
  other_scene.camera.eye[0] += 1e-12;
  EXPECT_THAT(fit(mesh, other_scene, record), HasSubstr("another view"));
  other_scene = scene;
  other_scene.render.planarity = 1e-6;
  EXPECT_THAT(fit(mesh, other_scene, record), HasSubstr("another view"));
  const ZooMesh other_mesh = moved(mesh, [](const Position& p) -> Position {
    return {p[0], p[1], p[2] == 1 ? 1 + 1e-15 : p[2]};
  });
  EXPECT_THAT(fit(other_mesh, scene, record), HasSubstr("another mesh"));
  record.order.cells = std::vector<CellId>{0, 1, 2};
  EXPECT_THAT(fit(mesh, scene, record), HasSubstr("6 cells expected, 3 found"));
}

TEST(Ordering, TheOrderThatFitsIsFoundAmongSeveral) {
  const ZooMesh mesh = structured(1, Cut::tetrahedra);
  const std::string hash = geometry_hash(mesh);
  GivenOrders orders{"x.order", {}};
  Scene scene;
  for (CellId first = 0; first < 4; ++first) {
    scene.camera.eye[0] = first;
    OrderRecord record{hash, view_hash(scene), {}};
    record.order.cells =
        std::vector<CellId>{first, (first + 1) % 4, (first + 2) % 4, (first + 3) % 4, 4, 5};
    orders.chunks.push_back(encode_order(record));
  }
  for (CellId first = 0; first < 4; ++first) {
    scene.camera.eye[0] = first;
    EXPECT_EQ(fitting_order(orders, hash, mesh, scene).order.cells[0], first);
  }
  scene.camera.eye[0] = 4;
  EXPECT_THAT(error_of([&] { fitting_order(orders, hash, mesh, scene); }),
              HasSubstr("x.order: the orders all belong to other views"));
  EXPECT_THAT(error_of([&] { fitting_order(orders, "0", mesh, scene); }),
              HasSubstr("another mesh"));
}

TEST(Ordering, AnOrderServesEveryTimeStepOfOneGeometry) {
  ZooMesh mesh = structured(2, Cut::tetrahedra);
  add_node_field(mesh, "f", [](const Position& p) { return p[0]; });
  const Scene scene;
  const OrderRecord record = Ordering(mesh, {}).exact(scene).record;
  ZooMesh later = mesh;
  later.fields.clear();
  add_node_field(later, "f", [](const Position& p) { return 7 - p[1]; });
  const GivenOrders given{"x.order", {encode_order(record)}};
  EXPECT_EQ(
      fitting_order(given, Ordering(later, {}).mesh_hash(), later, scene).order.cells.view()[0],
      record.order.cells.view()[0]);
  later.nodes = [&] {
    std::vector<NodeId> nodes(later.nodes.begin(), later.nodes.end());
    std::swap(nodes[0], nodes[1]);
    return nodes;
  }();
  EXPECT_NE(Ordering(later, {}).mesh_hash(), record.mesh_hash);
}

// The checksum of an adjacency says nothing of its truth.
TEST(Ordering, AnAdjacencyThatLeavesFacesOutIsComputedAnew) {
  ZooMesh mesh = structured(20, Cut::tetrahedra);
  const FaceAdjacency whole = build_face_adjacency(mesh);
  std::vector<std::string> notes;
  Monitor monitor;
  monitor.note = [&](const std::string& line) { notes.push_back(line); };
  mesh.adjacency = whole;
  EXPECT_TRUE(std::ranges::equal(Ordering(mesh, monitor).basis().adjacency.neighbors.view(),
                                 whole.neighbors.view()));
  EXPECT_TRUE(notes.empty());
  mesh.adjacency->neighbors = std::vector<CellId>(whole.neighbors.size(), kNoCell);
  EXPECT_TRUE(std::ranges::equal(Ordering(mesh, monitor).basis().adjacency.neighbors.view(),
                                 whole.neighbors.view()));
  EXPECT_THAT(notes, testing::ElementsAre(HasSubstr("is not that of the mesh")));
}

}  // namespace
}  // namespace hiac::test
