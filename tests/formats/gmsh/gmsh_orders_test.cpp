// Gmsh's cubic elements by files made from the reference manual ("Node ordering", and for what it
// does not draw MElement.h and its like in Gmsh), not by what hiac itself writes.
#include <fmt/format.h>

#include "tests/formats/files.hpp"
#include "tests/formats/one_cell.hpp"

namespace hiac::formats {
namespace {

std::string file_of(const std::string& type, CellKind kind, const std::vector<Vector>& points) {
  std::string nodes;
  std::string values;
  std::string numbers;
  for (std::size_t n = 0; n < points.size(); ++n) {
    nodes += fmt::format("{} {} {} {}\n", n + 1, points[n][0], points[n][1], points[n][2]);
    values += fmt::format("{} {}\n", n + 1, polynomial(kind, points[n]));
    numbers += fmt::format(" {}", n + 1);
  }
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{0}\n{1}$EndNodes\n$Elements\n1\n"
      "1 {2} 2 7 1{3}\n$EndElements\n$NodeData\n1\n\"p\"\n1\n0\n3\n0\n1\n{0}\n{4}$EndNodeData\n",
      points.size(), nodes, type, numbers, values);
}

// Type 29, written down node by node, three units a side: corners; two nodes on each of the edges
// 1-2, 2-3, 3-1, 4-1, 4-3 and 4-2, in this direction; the middles of the faces 1 3 2, 1 2 4, 1 4 3
// and 4 2 3.
TEST(GmshOrders, TetrahedronOfTwentyNodes) {
  const std::vector<Vector> written{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}, {1, 0, 0},
                                    {2, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0},
                                    {0, 0, 2}, {0, 0, 1}, {0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                    {2, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  std::vector<Vector> points;
  for (const Vector& p : written) points.push_back(placed({p[0] / 3, p[1] / 3, p[2] / 3}));
  const CellKind kind = CellKind::tetrahedron20;
  const ScratchFolder folder;
  const ZooMesh mesh = read_any(folder.write("t.msh", file_of("29", kind, points))).mesh;
  expect_one_cell(mesh, {"29", kind, {}, {}});
}

// Types 99, 125 and 111, two nodes on each edge, which are in the order of the quadratic elements.
TEST(GmshOrders, OtherCubicElements) {
  const std::vector<DocumentedElement> elements{
      {"99",
       CellKind::brick32,
       kBrickCorners,
       {{0, 1},
        {0, 3},
        {0, 4},
        {1, 2},
        {1, 5},
        {2, 3},
        {2, 6},
        {3, 7},
        {4, 5},
        {4, 7},
        {5, 6},
        {6, 7}},
       2},
      {"125",
       CellKind::pyramid21,
       kPyramidCorners,
       {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}},
       2},
      {"111",
       CellKind::prism24,
       kPrismCorners,
       {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}},
       2}};
  const ScratchFolder folder;
  for (const DocumentedElement& element : elements)
    expect_one_cell(
        read_any(folder.write("c.msh", file_of(element.name, element.kind, placed_points(element))))
            .mesh,
        element);
}

}  // namespace
}  // namespace hiac::formats
