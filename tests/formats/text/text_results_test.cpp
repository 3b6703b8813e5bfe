// Results of text formats at several steps, groups and numbers with gaps, solids that are bricks
// with repeated nodes, and what is refused: files of a few cells whose numbers are known.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/one_cell.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

ReadOptions at_step(std::size_t step) {
  ReadOptions options;
  options.step = step;
  return options;
}

// ---- Gmsh

/// Version 4.1: two volumes of one tetrahedron each with their groups, a surface; numbers with gaps
/// that do not rise; results of two steps on nodes, one of them of one step only, and on elements.
const std::string kMsh41 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 1 \"skin\"\n3 6 \"the core\"\n"
    "3 7 \"all\"\n$EndPhysicalNames\n$Entities\n1 0 1 2\n1 0 0 0 0\n4 0 0 0 1 1 0 1 1 0\n"
    "5 0 0 0 1 1 1 2 6 7 1 4\n8 0 0 0 1 1 1 1 7 1 -4\n$EndEntities\n"
    "$Nodes\n3 6 2 40\n0 1 0 1\n40\n0 0 0\n2 4 1 3\n7\n2\n30\n1 0 0 0.5 0\n0 1 0 0 0.5\n"
    "0 0 1 0.5 0.5\n3 5 0 2\n9\n31\n1 1 1\n7 7 7\n$EndNodes\n"
    "$Elements\n3 3 3 12\n2 4 2 1\n3 7 2 30\n3 5 4 1\n12 40 7 2 30\n3 8 4 1\n5 7 2 30 9\n"
    "$EndElements\n"
    "$NodeData\n1\n\"T\"\n1\n0.25\n3\n0\n1\n5\n40 1\n7 2\n2 3\n30 4\n9 5\n$EndNodeData\n"
    "$NodeData\n1\n\"T\"\n1\n0.75\n3\n1\n1\n5\n9 50\n7 20\n2 30\n30 40\n40 10\n$EndNodeData\n"
    "$NodeData\n1\n\"u\"\n1\n0.25\n3\n0\n3\n1\n2 1 2 3\n$EndNodeData\n"
    "$ElementData\n1\n\"q\"\n1\n0.75\n3\n1\n1\n2\n5 8.5\n12 7.5\n$EndElementData\n";

TEST(GmshResults, StepsGroupsAndNumbersWithGaps) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.msh", kMsh41);
  const Inventory inventory = format_to_read(path).inspect(path);
  EXPECT_THAT(inventory.times, ElementsAre(0.25, 0.75));
  EXPECT_EQ(inventory.points, 6U);
  const Reading last = read_any(path);
  ASSERT_EQ(last.mesh.cell_count(), 2U);
  EXPECT_EQ(last.mesh.node_count(), 5U);
  EXPECT_NEAR(volume_of(last.mesh, 0), 1.0 / 6, 1e-15);
  EXPECT_NEAR(volume_of(last.mesh, 1), 1.0 / 3, 1e-15);
  EXPECT_THAT(field_named(last.mesh, "q").values.view(), ElementsAre(7.5, 8.5));
  // nodes in the file's order: 40 7 2 30 9
  EXPECT_THAT(field_named(last.mesh, "T").values.view(), ElementsAre(10, 20, 30, 40, 50));
  const Field& u = field_named(last.mesh, "u");
  ASSERT_EQ(u.components, 3U);
  EXPECT_TRUE(std::isnan(u.values[0]));
  EXPECT_THAT(u.values.view().subspan(6, 3), ElementsAre(1, 2, 3));
  EXPECT_THAT(last.notes, Contains(HasSubstr("field 'u' is of time 0.25, its last")));
  const ZooMesh first = read_any(path, at_step(0)).mesh;
  EXPECT_THAT(field_named(first, "T").values.view(), ElementsAre(1, 2, 3, 4, 5));
  ReadOptions by_time;
  by_time.time = 0.75;
  EXPECT_EQ(field_named(read_any(path, by_time).mesh, "T").values[0], 10);
  EXPECT_THROW(read_any(path, at_step(2)), UsageError);
  by_time.time = 0.5;
  EXPECT_THROW(read_any(path, by_time), UsageError);
}

TEST(GmshResults, PhysicalGroupsOfEntitiesAreBlocks) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.msh", kMsh41);
  for (const auto& [block, cells] :
       std::vector<std::pair<std::string, std::size_t>>{{"the core", 1}, {"all", 2}}) {
    ReadOptions options;
    options.block = block;
    const ZooMesh mesh = read_any(path, options).mesh;
    ASSERT_EQ(mesh.cell_count(), cells) << block;
    EXPECT_NEAR(volume_of(mesh, 0), 1.0 / 6, 1e-15);
    EXPECT_EQ(field_named(mesh, "q").values[0], 7.5);
  }
}

TEST(GmshResults, WhatIsNoVolumeOrTooRichIsRefusedByName) {
  const ScratchFolder folder;
  const std::string head =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n"
      "3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n1\n";
  EXPECT_THAT(refusal(folder.write("a.msh", head + "1 2 2 1 1 1 2 3\n$EndElements\n")),
              HasSubstr("holds no volume cells (dropped cells without volume: 1 Triangle 3;"));
  EXPECT_THAT(refusal(folder.write("b.msh", head + "1 3 2 1 1 1 2 3 4\n$EndElements\n")),
              HasSubstr("1 Quadrilateral 4"));
  std::string nodes = "$Nodes\n64\n";
  std::string cell = "1 92 2 1 1";
  for (int i = 0; i < 64; ++i) {
    nodes += fmt::format("{} {} {} {}\n", i + 1, i % 4, i / 4 % 4, i / 16);
    cell += fmt::format(" {}", i + 1);
  }
  EXPECT_THAT(
      refusal(folder.write("c.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + nodes +
                                        "$EndNodes\n$Elements\n1\n" + cell + "\n$EndElements\n")),
      HasSubstr("1 Hexahedron of 64 nodes"));
}

/// Where the reference point p lies in a curved cell: a quadratic map, so that the serendipity
/// kinds hold it.
Vector bent(const Vector& p) {
  return {p[0] + 0.125 * p[1] * p[1], p[1] - 0.0625 * p[2] * p[0], p[2] + 0.25 * p[0] * p[1]};
}

/// The only cell's nodes lie where the map takes the kind's own nodes.
void expect_bent(const ZooMesh& mesh, CellKind kind) {
  ASSERT_EQ(mesh.cell_count(), 1U);
  ASSERT_EQ(mesh.kinds[0], kind);
  EXPECT_EQ(mesh.node_count(), node_count(kind));
  const auto nodes = mesh.cell_nodes(0);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Vector expected = bent(reference_nodes(kind)[n]);
    const auto found = mesh.position(nodes[n]);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-15) << n << " " << c;
  }
}

// Gmsh's Hexahedron27: edges, then faces 0321 0154 0374 1265 2376 4567, then the middle.
TEST(GmshResults, CurvedBricksOf27NodesLoseTheirCentres) {
  const ScratchFolder folder;
  std::vector<Vector> points = kBrickCorners;
  const auto add_mean = [&](std::initializer_list<std::size_t> corners) {
    Vector mean{};
    for (const std::size_t corner : corners)
      for (std::size_t c = 0; c < 3; ++c)
        mean[c] += kBrickCorners[corner][c] / static_cast<double>(corners.size());
    points.push_back(mean);
  };
  for (const auto& [a, b] : std::vector<std::pair<std::size_t, std::size_t>>{{0, 1},
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
                                                                             {6, 7}})
    add_mean({a, b});
  for (const auto& f : std::vector<std::array<std::size_t, 4>>{
           {0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}})
    add_mean({f[0], f[1], f[2], f[3]});
  add_mean({0, 1, 2, 3, 4, 5, 6, 7});
  std::string nodes = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n27\n";
  std::string cell = "1 12 2 1 1";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector x = bent(points[i]);
    nodes += fmt::format("{} {} {} {}\n", i + 1, x[0], x[1], x[2]);
    cell += fmt::format(" {}", i + 1);
  }
  const std::string path =
      folder.write("a.msh", nodes + "$EndNodes\n$Elements\n1\n" + cell + "\n$EndElements\n");
  expect_bent(read_any(path).mesh, CellKind::brick20);
  ReadOptions corners;
  corners.corners_of_unsupported = true;
  EXPECT_EQ(read_any(path, corners).mesh.kinds[0], CellKind::brick8);
}

// ---- Ansys

/// A SOLID186 whose nodes I J K L M N O P are the corners given, its mid-edge nodes where the bent
/// corners' edges are bent to: Ansys element reference, SOLID186, prism, pyramid and tetrahedral
/// options, repeat nodes so.
std::string collapsed_186(const std::vector<Vector>& corners,
                          const std::array<std::size_t, 8>& nodes) {
  const std::vector<std::pair<std::size_t, std::size_t>> edges{{0, 1}, {1, 2}, {2, 3}, {3, 0},
                                                               {4, 5}, {5, 6}, {6, 7}, {7, 4},
                                                               {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  std::vector<Vector> points = corners;
  std::vector<std::size_t> cell;
  for (const std::size_t node : nodes) cell.push_back(node + 1);
  for (const auto& [from, to] : edges) {
    const auto [a, b] = std::minmax(nodes[from], nodes[to]);
    if (a == b) {
      cell.push_back(a + 1);
      continue;
    }
    Vector middle{};
    for (std::size_t c = 0; c < 3; ++c) middle[c] = (corners[a][c] + corners[b][c]) / 2;
    const auto known = std::find(points.begin(), points.end(), middle);
    cell.push_back(static_cast<std::size_t>(known - points.begin()) + 1);
    if (known == points.end()) points.push_back(middle);
  }
  std::string text = "/PREP7\nET,1,186\nNBLOCK,6,SOLID\n(3i9,6e21.13)\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector x = bent(points[i]);
    text += fmt::format("{:9}{:9}{:9}{:21.13E}{:21.13E}{:21.13E}\n", i + 1, 0, 0, x[0], x[1], x[2]);
  }
  text += "N,R5.3,LOC,       -1,\nEBLOCK,19,SOLID\n(19i9)\n";
  for (const int field : {1, 1, 1, 1, 0, 0, 0, 0, 20, 0, 1}) text += fmt::format("{:9}", field);
  for (std::size_t n = 0; n < cell.size(); ++n)
    text += fmt::format("{}{:9}", n == 8 ? "\n" : "", cell[n]);
  return text + "\n       -1\n";
}

TEST(AnsysResults, CollapsedQuadraticBricksAreTheirTrueKindsWithTheirCurvedEdges) {
  const ScratchFolder folder;
  const std::vector<std::tuple<CellKind, std::vector<Vector>, std::array<std::size_t, 8>>> rows{
      {CellKind::brick20, kBrickCorners, {0, 1, 2, 3, 4, 5, 6, 7}},
      {CellKind::prism15, kPrismCorners, {0, 1, 2, 2, 3, 4, 5, 5}},
      {CellKind::pyramid13, kPyramidCorners, {0, 1, 2, 3, 4, 4, 4, 4}},
      {CellKind::tetrahedron10, kTetraCorners, {0, 1, 2, 2, 3, 3, 3, 3}}};
  for (const auto& [kind, corners, nodes] : rows) {
    SCOPED_TRACE(kind_name(kind));
    const ZooMesh mesh = read_any(folder.write("a.cdb", collapsed_186(corners, nodes))).mesh;
    ASSERT_EQ(mesh.cell_count(), 1U);
    ASSERT_EQ(mesh.kinds[0], kind);
    // the cell may be turned: the positions of its nodes make one map of the reference cell
    const auto own = mesh.cell_nodes(0);
    const auto reference = reference_nodes(kind);
    std::vector<Vector> straight(own.size());
    for (std::size_t n = 0; n < own.size(); ++n) {
      const auto x = mesh.position(own[n]);
      for (const Vector& p : reference) {
        const Vector at = bent(p);
        if (std::hypot(at[0] - x[0], at[1] - x[1], at[2] - x[2]) < 1e-12) straight[n] = p;
      }
    }
    for (std::size_t n = corner_count(kind); n < own.size(); ++n) {
      const auto& edge = topology_of(shape_of(kind)).edges[n - corner_count(kind)];
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(straight[n][c], (straight[edge[0]][c] + straight[edge[1]][c]) / 2) << n;
    }
    EXPECT_EQ(mesh.node_count(), node_count(kind));
    EXPECT_GT(volume_of(mesh, 0), 0);
  }
}

// ---- CalculiX

std::string frd_result(const std::string& name, const std::vector<std::string>& components,
                       double time, int step, const std::vector<std::vector<double>>& rows) {
  std::string text = fmt::format(
      "    1PSTEP{:26}{:12}{:12}\n  100CL  101{:12.5E}{:12}{:20} 0{:5}"
      "{:10} 1\n -4  {:8}{:5}{:5}\n",
      step, 1, 1, time, rows.size(), "", step, "", name, components.size(), 1);
  for (std::size_t c = 0; c < components.size(); ++c)
    text += fmt::format(" -5  {:8}{:5}{:5}{:5}{:5}{}\n", components[c], 1, 2, c + 1, 0,
                        components[c] == "ALL" ? "    1ALL" : "");
  for (const std::vector<double>& row : rows) {
    text += fmt::format(" -1{:10}", static_cast<int>(row[0]));
    for (std::size_t c = 1; c < row.size(); ++c) text += fmt::format("{:12.5E}", row[c]);
    text += "\n";
  }
  return text + " -3\n";
}

TEST(FrdResults, StepsComponentsAndNodesWithoutValues) {
  const ScratchFolder folder;
  std::string text =
      "    1C\n    1UPGM test\n" + fmt::format("    2C{:18}{:12}{:37}1\n", "", 5, "");
  const std::vector<std::array<double, 3>> points{
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {9, 9, 9}};
  for (std::size_t i = 0; i < points.size(); ++i)
    text += fmt::format(" -1{:10}{:12.5E}{:12.5E}{:12.5E}\n", 10 * (i + 1), points[i][0],
                        points[i][1], points[i][2]);
  text += " -3\n" + fmt::format("    3C{:18}{:12}{:37}1\n", "", 1, "");
  text += fmt::format(" -1{:10}{:5}{:5}{:5}\n -2{:10}{:10}{:10}{:10}\n -3\n", 4, 3, 0, 1, 10, 20,
                      30, 40);
  const std::vector<std::string> displacement{"D1", "D2", "D3", "ALL"};
  const std::vector<std::string> stress{"SXX", "SYY", "SZZ", "SXY", "SYZ", "SZX"};
  for (const int step : {1, 2}) {
    text += frd_result("DISP", displacement, 0.5 * step, step,
                       {{10, 1.0 * step, 2, 3}, {40, -4.0 * step, 5, 6}, {50, 7, 8, 9}});
    text += frd_result("STRESS", stress, 0.5 * step, step, {{20, 1, 2, 3, 4, 5, 6.0 * step}});
  }
  // three mode shapes of one frequency
  for (const int mode : {3, 4, 5})
    text += frd_result("MODE", {"M"}, 2.5, mode, {{30, 100.0 + mode}});
  const std::string path = folder.write("a.frd", text + " 9999\n");
  EXPECT_THAT(format_to_read(path).inspect(path).times, ElementsAre(0.5, 1, 2.5, 2.5, 2.5));
  for (const std::size_t step : {0, 1}) {
    const ZooMesh mesh = read_any(path, at_step(step)).mesh;
    ASSERT_EQ(mesh.fields.size(), 2U);
    ASSERT_EQ(mesh.node_count(), 4U);
    const double factor = static_cast<double>(step) + 1;
    const Field& u = field_named(mesh, "DISP");
    ASSERT_EQ(u.components, 3U) << "what is computed of others is no component";
    EXPECT_THAT(u.values.view().first(3), ElementsAre(factor, 2, 3));
    EXPECT_TRUE(std::isnan(u.values[3]));
    EXPECT_THAT(u.values.view().subspan(9, 3), ElementsAre(-4 * factor, 5, 6));
    const Field& s = field_named(mesh, "STRESS");
    ASSERT_EQ(s.components, 6U);
    EXPECT_THAT(s.values.view().subspan(6, 6), ElementsAre(1, 2, 3, 4, 5, 6 * factor));
  }
  for (const std::size_t step : {2, 3, 4})
    EXPECT_EQ(field_named(read_any(path, at_step(step)).mesh, "MODE").values[2],
              101.0 + static_cast<double>(step));
}

// ---- Tecplot

TEST(TecplotResults, BricksWithRepeatedNodesAreTheirTrueKinds) {
  const ScratchFolder folder;
  // a brick, a prism on its side x = 1, a pyramid on its top, a tetrahedron
  const std::string path = folder.write(
      "a.dat",
      "VARIABLES = X Y Z \"X Velocity\"\nZONE N=12, E=4, F=FEPOINT, ET=BRICK\n"
      "0 0 0 1\n1 0 0 2\n1 1 0 3\n0 1 0 4\n0 0 1 5\n1 0 1 6\n1 1 1 7\n0 1 1 8\n2 0 0 9\n2 0 1 10\n"
      "0.5 0.5 2 11\n3 3 3 12\n1 2 3 4 5 6 7 8\n2 9 3 3 6 10 7 7\n5 6 7 8 11 11 11 11\n"
      "9 12 3 3 10 10 10 10\n");
  const ZooMesh mesh = read_any(path).mesh;
  EXPECT_THAT(
      std::vector<CellKind>(mesh.kinds.begin(), mesh.kinds.end()),
      ElementsAre(CellKind::brick8, CellKind::prism6, CellKind::pyramid5, CellKind::tetrahedron4));
  EXPECT_NEAR(volume_of(mesh, 0), 1, 1e-15);
  EXPECT_NEAR(volume_of(mesh, 1), 0.5, 1e-15);
  EXPECT_NEAR(volume_of(mesh, 2), 1.0 / 3, 1e-15);
  EXPECT_THAT(field_named(mesh, "X Velocity").values.view(),
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12));
}

// ---- universal files

TEST(UnvResults, WhatIsIncompleteIsRefusedWithItsLine) {
  const ScratchFolder folder;
  const auto row = [](std::initializer_list<int> fields) {
    std::string text;
    for (const int field : fields) text += fmt::format("{:10}", field);
    return text + "\n";
  };
  std::string nodes = "    -1\n  2411\n";
  for (int i = 0; i < 4; ++i)
    nodes +=
        row({i + 1, 1, 1, 11}) + fmt::format("{:25.16E}{:25.16E}{:25.16E}\n", i == 1 ? 1.0 : 0.0,
                                             i == 2 ? 1.0 : 0.0, i == 3 ? 1.0 : 0.0);
  nodes += "    -1\n";
  const std::string cells =
      "    -1\n  2412\n" + row({19, 111, 1, 1, 7, 4}) + row({1, 2, 3, 4}) + "    -1\n";
  EXPECT_EQ(read_any(folder.write("a.unv", nodes + cells)).mesh.cell_count(), 1U);
  EXPECT_THAT(refusal(folder.write("b.unv", cells)), HasSubstr("no nodes found"));
  EXPECT_THAT(refusal(folder.write("c.unv", nodes + "    -1\n  2412\n" + row({19, 91, 1, 1, 7, 2}) +
                                                row({1, 2}) + "    -1\n")),
              HasSubstr("c.unv:14: element 19: a surface3 has 3 nodes"));
  EXPECT_THAT(refusal(folder.write("d.unv", "    -1\n   164\n         0Other\n" + nodes + cells)),
              HasSubstr("d.unv:3: unknown units (a code from 1 to 10 expected"));
}

}  // namespace
}  // namespace hiac::formats
