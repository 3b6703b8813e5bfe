// Nodes by the file's numbers, and the middles of edges that cells leave out.
#include "formats/common/mesh/node_resolver.hpp"

#include <array>

#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kOut = kLeftOutNode;

/// Points of no matter where, `count` of them.
ForeignMesh points_numbered_from(std::int64_t first, std::size_t count) {
  ForeignMesh mesh;
  for (std::size_t i = 0; i < 3 * count; ++i) mesh.xyz.push_back(static_cast<double>(i));
  mesh.first_node = first;
  return mesh;
}

void add_cell(ForeignMesh& mesh, const std::string& type, const CellConversion& conversion,
              const std::vector<std::int64_t>& nodes) {
  mesh.cell_types.push_back(mesh.type_place(type, nodes.size(), conversion));
  mesh.cell_nodes.insert(mesh.cell_nodes.end(), nodes.begin(), nodes.end());
}

std::string resolver_complaint(const ForeignMesh& mesh) {
  try {
    NodeResolver(mesh, "file").resolve(0, 0);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(NodeResolver, NumbersFromTheFirstOn) {
  const auto said = [](const std::vector<std::int64_t>& nodes) {
    ForeignMesh mesh = points_numbered_from(5, 4);
    add_cell(mesh, "tet", converted_to(CellKind::tetrahedron4), nodes);
    return resolver_complaint(mesh);
  };
  EXPECT_EQ(said({5, 6, 7, 8}), "none");
  EXPECT_EQ(said({4, 6, 7, 8}), "file: cell tet 1: there is no node 4");
  EXPECT_EQ(said({5, 6, 7, 9}), "file: cell tet 1: there is no node 9");
  ForeignMesh mesh = points_numbered_from(-2, 4);
  add_cell(mesh, "tet", converted_to(CellKind::tetrahedron4), {1, -2, 0, -1});
  NodeResolver resolver(mesh, "file");
  EXPECT_THAT(resolver.resolve(0, 0).nodes, ElementsAre(3, 0, 2, 1));
  EXPECT_THAT(resolver.made(), IsEmpty());
}

TEST(NodeResolver, SparseNumbersAndNumbersOfCells) {
  ForeignMesh mesh = points_numbered_from(0, 4);
  mesh.node_numbers = {70, 10, 40, 20};
  mesh.cell_numbers = {300};
  add_cell(mesh, "tet", converted_to(CellKind::tetrahedron4), {10, 20, 40, 70});
  NodeResolver resolver(mesh, "file");
  EXPECT_THAT(resolver.resolve(0, 0).nodes, ElementsAre(1, 3, 2, 0));
  mesh.cell_nodes[2] = 41;
  EXPECT_EQ(resolver_complaint(mesh), "file: cell tet 300: there is no node 41");
  // of surfaces nothing is asked
  mesh.types[0].conversion = kNoVolume;
  EXPECT_EQ(resolver_complaint(mesh), "none");
}

TEST(NodeResolver, NodesThatAreGivenTwice) {
  ForeignMesh mesh = points_numbered_from(0, 5);
  mesh.node_numbers = {1, 2, 3, 4, 2};
  add_cell(mesh, "tet", converted_to(CellKind::tetrahedron4), {1, 2, 3, 4});
  EXPECT_EQ(resolver_complaint(mesh), "file: node 2 is given twice, in two places");
  for (std::size_t c = 0; c < 3; ++c) mesh.xyz[12 + c] = mesh.xyz[3 + c];
  EXPECT_EQ(resolver_complaint(mesh), "none");
  mesh.xyz[14] += 1;
  EXPECT_EQ(resolver_complaint(mesh), "file: node 2 is given twice, in two places");
}

TEST(NodeResolver, MiddlesOfEdgesAreMadeOnce) {
  ForeignMesh mesh = points_numbered_from(0, 10);
  const CellConversion ten = converted_to(CellKind::tetrahedron10);
  add_cell(mesh, "tet10", ten, {0, 1, 2, 3, 4, kOut, 6, 7, 8, 9});
  // the same edge the other way round, and an edge of one point
  add_cell(mesh, "tet10", ten, {2, 1, 0, 0, kOut, 4, 6, kOut, 8, kOut});
  NodeResolver resolver(mesh, "file");
  const auto first = resolver.resolve(0, 0);
  EXPECT_THAT(first.nodes, ElementsAre(0, 1, 2, 3, 4, 10, 6, 7, 8, 9));
  EXPECT_EQ(first.conversion->kind, CellKind::tetrahedron10);
  const auto second = resolver.resolve(1, 10);
  const auto edges = topology_of(CellKind::tetrahedron10).edges;
  std::vector<NodeId> expected{2, 1, 0, 0, 0, 4, 6, 0, 8, 0};
  std::vector<std::pair<NodeId, NodeId>> made{{1, 2}};
  const std::array<NodeId, 4> corners{2, 1, 0, 0};
  for (const std::size_t e : {0, 3, 5}) {
    const NodeId a = corners[edges[e][0]];
    const NodeId b = corners[edges[e][1]];
    if (a == b) {
      expected[4 + e] = a;
    } else if (std::minmax(a, b) == std::minmax(NodeId{1}, NodeId{2})) {
      expected[4 + e] = 10;
    } else {
      expected[4 + e] = static_cast<NodeId>(10 + made.size());
      made.emplace_back(a, b);
    }
  }
  EXPECT_THAT(second.nodes, testing::ElementsAreArray(expected));
  ASSERT_EQ(resolver.made().size(), made.size());
  for (std::size_t m = 0; m < made.size(); ++m)
    EXPECT_EQ(std::minmax(resolver.made()[m].first, resolver.made()[m].second),
              std::minmax(made[m].first, made[m].second));
}

TEST(NodeResolver, CellsWithoutAnyMiddleAreLinear) {
  ForeignMesh mesh = points_numbered_from(0, 4);
  add_cell(mesh, "tet10", converted_to(CellKind::tetrahedron10),
           {3, 2, 1, 0, kOut, kOut, kOut, kOut, kOut, kOut});
  NodeResolver resolver(mesh, "file");
  const auto cell = resolver.resolve(0, 0);
  EXPECT_EQ(cell.conversion->kind, CellKind::tetrahedron4);
  EXPECT_THAT(cell.nodes.first(4), ElementsAre(3, 2, 1, 0));
  EXPECT_THAT(resolver.made(), IsEmpty());
}

TEST(NodeResolver, NodesThatMayNotBeLeftOut) {
  const auto said = [](const CellConversion& conversion, std::vector<std::int64_t> nodes) {
    ForeignMesh mesh = points_numbered_from(0, 20);
    add_cell(mesh, "cell", conversion, nodes);
    return resolver_complaint(mesh);
  };
  const CellConversion ten = converted_to(CellKind::tetrahedron10);
  EXPECT_EQ(said(ten, {0, 1, 2, kOut, 4, 5, 6, 7, 8, 9}),
            "file: cell cell 1: corner 4 is left out (only mid-edge nodes may be)");
  EXPECT_EQ(said(ten, {0, 1, 2, 3, 4, 5, 6, 7, 8, kOut}), "none");
  // where the file's corners stand elsewhere, they are meant
  constexpr std::array<std::uint8_t, 10> kBackwards{9, 8, 7, 6, 5, 4, 3, 2, 1, 0};
  EXPECT_EQ(
      said(converted_to(CellKind::tetrahedron10, kBackwards), {0, 1, 2, 3, 4, 5, 6, 7, 8, kOut}),
      "file: cell cell 1: corner 10 is left out (only mid-edge nodes may be)");
  EXPECT_EQ(
      said(converted_to(CellKind::tetrahedron10, kBackwards), {kOut, 1, 2, 3, 4, 5, 6, 7, 8, 9}),
      "none");
  std::vector<std::int64_t> twenty(20);
  for (std::size_t i = 0; i < 20; ++i) twenty[i] = static_cast<std::int64_t>(i);
  twenty[19] = kOut;
  EXPECT_EQ(said(converted_to(CellKind::tetrahedron20), twenty),
            "file: cell cell 1: nodes are left out (possible in quadratic cells alone)");
  // of a cell that is not converted its corners are needed
  EXPECT_EQ(said(unsupported_with(CellKind::tetrahedron4), {0, 1, 2, 3, kOut}), "none");
  EXPECT_EQ(said(unsupported_with(CellKind::tetrahedron4), {0, kOut, 2, 3, 4}),
            "file: cell cell 1: corner 2 is left out (only mid-edge nodes may be)");
  EXPECT_EQ(said(kUnsupported, {kOut, 1, 2, 3, 4}), "none");
}

TEST(NodeResolver, EndsOfEdgesInTheFilesOrder) {
  const auto edges = topology_of(CellKind::tetrahedron10).edges;
  constexpr std::array<std::uint8_t, 10> kBackwards{9, 8, 7, 6, 5, 4, 3, 2, 1, 0};
  for (std::size_t e = 0; e < 6; ++e) {
    EXPECT_EQ(edge_ends(converted_to(CellKind::tetrahedron10), 4 + e),
              std::pair(std::size_t{edges[e][0]}, std::size_t{edges[e][1]}));
    EXPECT_EQ(edge_ends(converted_to(CellKind::tetrahedron10, kBackwards), 5 - e),
              std::pair(9 - std::size_t{edges[e][0]}, 9 - std::size_t{edges[e][1]}));
  }
}

}  // namespace
}  // namespace hiac::formats
