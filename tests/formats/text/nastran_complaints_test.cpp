// What bulk data of Nastran are refused for, with the line, and what is just allowed; coordinate
// systems by points, by grid points and by other systems (Quick Reference Guide, CORD1x, CORD2x).
#include <cmath>

#include <fmt/format.h>

#include "formats/nastran/bulk_data.hpp"
#include "tests/formats/complaints.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::StartsWith;

const std::string kBulkCorners =
    "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n";
const std::string kBulkTetrahedron = kBulkCorners + "CTETRA,1,1,1,2,3,4\n";

ForeignMesh bulk_mesh(const std::string& text) {
  const ScratchFolder folder;
  return nastran::read_bulk_data(folder.write("a.bdf", text));
}

/// Where the last grid point lies.
void expect_last(const std::string& text, const std::array<double, 3>& expected) {
  const ForeignMesh mesh = bulk_mesh(text);
  ASSERT_GE(mesh.xyz.size(), 3U);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(mesh.xyz[mesh.xyz.size() - 3 + c], expected[c], 1e-14) << c << "\n" << text;
}

TEST(NastranComplaints, FilesIncludeFilesTenDeep) {
  const ScratchFolder folder;
  static_cast<void>(folder.write("f0.bdf", "BEGIN BULK\nINCLUDE 'f1.bdf'\n"));
  for (int file = 1; file < 9; ++file)
    static_cast<void>(folder.write(fmt::format("f{}.bdf", file),
                                   fmt::format("$ {0}\nINCLUDE 'f{0}.bdf'\n", file + 1)));
  const std::string cards = kBulkTetrahedron.substr(kBulkTetrahedron.find('\n') + 1);
  static_cast<void>(folder.write("f9.bdf", cards));
  expect_unit_tetrahedron(read_any(folder.file("f0.bdf")).mesh);
  static_cast<void>(folder.write("f9.bdf", "INCLUDE f10.bdf\n"));
  static_cast<void>(folder.write("f10.bdf", cards));
  const std::string message = refusal(folder.file("f0.bdf"));
  EXPECT_THAT(message, StartsWith(folder.file("f0.bdf") + ":2: in the included file: " +
                                  folder.file("f1.bdf") + ":2: in the included file: "));
  EXPECT_THAT(message, EndsWith(folder.file("f9.bdf") +
                                ":1: in the included file: " + folder.file("f10.bdf") +
                                ": files include files more than 10 deep"));
  std::string many = kBulkTetrahedron;
  for (int i = 0; i < 12; ++i) many += "INCLUDE \"cell.inc\"\n";
  static_cast<void>(folder.write("cell.inc", "CTETRA,9,1,1,2,3,4\n"));
  EXPECT_EQ(read_any(folder.write("many.bdf", many)).mesh.cell_count(), 13U);
}

TEST(NastranComplaints, EntriesAreNamedWithTheirFields) {
  expect_complaints(
      "a.bdf",
      {{kBulkTetrahedron + "=,*1,=,=\n", ":7: replicated entries ('=') are not supported"},
       {kBulkTetrahedron + "$ c\n=\n", ":8: replicated entries ('=') are not supported"},
       {kBulkTetrahedron + "CQUAD4,2,1,1,2,3,4\n=\n",
        ":8: replicated entries ('=') are not supported"},
       {kBulkTetrahedron + "CIHEX2,2,1\n=\n", ":8: replicated entries ('=') are not supported"},
       {kBulkTetrahedron + "GRDSET,,0\n=\n", ":8: replicated entries ('=') are not supported"},
       {kBulkTetrahedron + "CORD,1\n=\nPLOAD,1\n=\n", ""},
       {kBulkCorners + "GRID,x,,1.,0.,0.\n",
        ":6: GRID: an integer in field 2 expected ('x' found)"},
       {kBulkCorners + "GRID,5,y,1.,0.,0.\n",
        ":6: GRID: an integer in field 3 expected ('y' found)"},
       {kBulkCorners + "GRID,5,,1.,0.,z\n", ":6: GRID: a real in field 6 expected ('z' found)"},
       {kBulkCorners + "CTETRA,1,1,1,2,3\n",
        ":6: CTETRA: an integer in field 7 expected ('' found)"},
       {kBulkCorners + "CTETRA,,1,1,2,3,4\n",
        ":6: CTETRA: an integer in field 2 expected ('' found)"},
       {kBulkCorners + "CTETRA,1,p,1,2,3,4\n",
        ":6: CTETRA: an integer in field 3 expected ('p' found)"},
       {kBulkCorners + "CTETRA,1,1,1,2,3,4,5\n+,x\n",
        ":6: CTETRA: an integer in field 10 expected ('x' found)"},
       {kBulkTetrahedron + "CORD2R,7,,0.,0.,0.,0.,0.,a\n",
        ":7: CORD2R: a real in field 9 expected ('a' found)"},
       {kBulkTetrahedron + "CORD1R,7,1,2\n",
        ":7: CORD1R: an integer in field 5 expected ('' found)"}});
}

TEST(NastranSolids, ElementsOfEveryNameHaveTheirKinds) {
  const std::vector<std::tuple<std::string, std::size_t, CellKind, std::size_t, CellKind>> rows{
      {"CIHEX1", 8, CellKind::brick8, 0, CellKind::brick8},
      {"CHEXA1", 8, CellKind::brick8, 0, CellKind::brick8},
      {"CHEXA2", 8, CellKind::brick8, 0, CellKind::brick8},
      {"CWEDGE", 6, CellKind::prism6, 0, CellKind::prism6},
      {"CHEXA", 8, CellKind::brick8, 20, CellKind::brick20},
      {"CPENTA", 6, CellKind::prism6, 15, CellKind::prism15},
      {"CPYRAM", 5, CellKind::pyramid5, 13, CellKind::pyramid13},
      {"CPYRA", 5, CellKind::pyramid5, 13, CellKind::pyramid13},
      {"CTETRA", 4, CellKind::tetrahedron4, 10, CellKind::tetrahedron10}};
  const auto card = [](const std::string& name, std::size_t nodes) {
    std::string text = name + ",3,9";
    for (std::size_t n = 0; n < nodes; ++n)
      text += fmt::format("{}{}", n == 6 || n == 14 ? "\n," : ",", n + 1);
    return text + "\n";
  };
  for (const auto& [name, corners, linear, most, quadratic] : rows) {
    const ForeignMesh few = bulk_mesh(card(name, corners));
    ASSERT_EQ(few.cell_count(), 1U) << name;
    EXPECT_EQ(few.types[0].conversion.kind, linear) << name;
    EXPECT_EQ(few.cell_nodes.size(), corners) << name;
    EXPECT_EQ(few.blocks.at(0).name, "9");
    // zeros are no nodes
    const ForeignMesh zeros = bulk_mesh(card(name, corners) + ",,0\n");
    EXPECT_EQ(zeros.cell_nodes.size(), corners) << name;
    if (most == 0) continue;
    const ForeignMesh all = bulk_mesh(card(name, most));
    EXPECT_EQ(all.types[0].conversion.kind, quadratic) << name;
    ASSERT_EQ(all.cell_nodes.size(), most) << name;
    for (std::size_t n = 0; n < most; ++n)
      EXPECT_EQ(all.cell_nodes[n], static_cast<std::int64_t>(n + 1)) << name;
    EXPECT_EQ(all.types[0].name, fmt::format("{}({} nodes)", name, most));
    // one node of an edge makes the kind
    const ForeignMesh one = bulk_mesh(card(name, corners + 1));
    ASSERT_EQ(one.cell_nodes.size(), most) << name;
    EXPECT_EQ(one.cell_nodes[corners], static_cast<std::int64_t>(corners + 1));
    EXPECT_EQ(one.cell_nodes[corners + 1], kLeftOutNode);
    EXPECT_EQ(one.cell_nodes[most - 1], kLeftOutNode);
  }
}

TEST(NastranSolids, PropertiesAreBlocks) {
  const ForeignMesh mesh = bulk_mesh(
      "CTETRA,1,5,1,2,3,4\nCTETRA,2,5,1,2,3,4\nCQUAD4,3,5,1,2,3,4\nCTETRA,4,5,1,2,3,4\n"
      "CTETRA,6,,1,2,3,4\nCBAR,7\n");
  EXPECT_THAT(mesh.cell_numbers, ElementsAre(1, 2, 3, 4, 6, 7));
  ASSERT_EQ(mesh.blocks.size(), 2U);
  EXPECT_EQ(mesh.blocks[0].name, "5");
  ASSERT_EQ(mesh.blocks[0].cells.size(), 2U);
  EXPECT_EQ(mesh.blocks[0].cells[0].begin, 0U);
  EXPECT_EQ(mesh.blocks[0].cells[0].end, 2U);
  EXPECT_EQ(mesh.blocks[0].cells[1].begin, 3U);
  EXPECT_EQ(mesh.blocks[0].cells[1].end, 4U);
  EXPECT_EQ(mesh.blocks[1].name, "6");  // without a property, the element's own number
  EXPECT_EQ(mesh.blocks[1].cells.at(0).begin, 4U);
}

TEST(NastranSystems, PointsAreCartesianCylindricalOrSpherical) {
  const double h = std::sqrt(0.5);
  // origin 1 2 3, z along y, x along z: y along x
  const std::string points = ",7,,1.,2.,3.,1.,9.,3.\n,1.,2.,5.\n";
  expect_last("CORD2R" + points + "GRID,1,7,10.,20.,30.\n", {21, 32, 13});
  expect_last("CORD2C" + points + "GRID,1,7,2.,90.,4.\n", {3, 6, 3});
  expect_last("CORD2C" + points + "GRID,1,7,2.,45.,4.\n", {1 + 2 * h, 6, 3 + 2 * h});
  expect_last("CORD2S" + points + "GRID,1,7,2.,90.,0.\n", {1, 2, 5});
  expect_last("CORD2S" + points + "GRID,1,7,2.,90.,90.\n", {3, 2, 3});
  expect_last("CORD2S" + points + "GRID,1,7,2.,45.,90.\n", {1 + 2 * h, 2 + 2 * h, 3});
}

TEST(NastranSystems, GridPointsMakeTwoSystemsAnEntry) {
  const std::string grids =
      "GRID,1,0,1.,2.,3.\nGRID,2,0,1.,9.,3.\nGRID,3,0,1.,2.,5.\nGRID,4,0,0.,0.,0.\n"
      "GRID,5,0,0.,0.,1.\nGRID,6,0,1.,0.,0.\nCORD1R,7,1,2,3,8,4,5,6\nCORD1C,9,1,2,3\n";
  expect_last(grids + "GRID,10,7,10.,20.,30.\n", {21, 32, 13});
  expect_last(grids + "GRID,10,8,10.,20.,30.\n", {10, 20, 30});
  expect_last(grids + "GRID,10,9,2.,90.,4.\n", {3, 6, 3});
  // GRDSET is of grid points that name no system
  expect_last(grids + "GRDSET,,7\nGRID,10,,10.,20.,30.\n", {21, 32, 13});
  expect_last(grids + "GRDSET,,7\nGRID,10,0,10.,20.,30.\n", {10, 20, 30});
  expect_last(grids + "GRID,10,,10.,20.,30.\nGRDSET,,\n", {10, 20, 30});
}

TEST(NastranSystems, SystemsReferToOthers) {
  // the first is turned by 90 degrees about z and moved; the second lies in it, cylindrical in it
  const std::string first = "CORD2C,1,,5.,0.,0.,5.,0.,1.\n,5.,1.,0.\n";
  expect_last(first + "CORD2R,2,1,2.,90.,1.,2.,90.,2.\n,3.,90.,1.\nGRID,1,2,1.,2.,3.\n",
              {2, -2, 4});
  std::string chain = "CORD2R,1,,1.,0.,0.,1.,0.,1.\n,2.,0.,0.\n";
  // systems may refer to later ones, and as deeply as they like
  constexpr int kDeep = 100'000;
  for (int system = kDeep; system >= 2; --system)
    chain += fmt::format("CORD2R,{},{},1.,0.,0.,1.,0.,1.\n,2.,0.,0.\n", system, system - 1);
  expect_last(chain + "GRID,1,101,0.,2.,3.\n", {101, 2, 3});
  expect_last(chain + fmt::format("GRID,1,{},0.,2.,3.\n", kDeep), {kDeep, 2, 3});
}

TEST(NastranComplaints, SystemsReferToThemselvesInNoWay) {
  const auto chain = [](const std::vector<std::pair<int, int>>& references) {
    std::string text = "BEGIN BULK\n";
    for (const auto& [system, reference] : references)
      text += fmt::format("CORD2R,{},{},0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n", system, reference);
    return text + "GRID,1,4\n";
  };
  expect_complaints(
      "a.bdf", {{chain({{4, 4}}), ": coordinate system 4 refers to itself"},
                {chain({{4, 5}, {5, 4}}), ": coordinate system 4 refers to itself"},
                {chain({{4, 5}, {5, 6}, {6, 7}, {7, 5}}), ": coordinate system 5 refers to itself"},
                {chain({{4, 5}, {5, 8}}), ": there is no coordinate system 8"}});
}

TEST(NastranComplaints, SystemsThatDoNotPlacePoints) {
  const std::string grids = "BEGIN BULK\nGRID,1\nGRID,2,,0.,0.,1.\nGRID,3,,0.,0.,3.\n";
  const std::string cell = "CTETRA,1,1,1,2,3,9\n";
  expect_complaints("a.bdf",
                    {{grids + cell + "GRID,9,5\n", ": there is no coordinate system 5"},
                     {grids + cell + "GRID,9,5\nCORD1R,5,1,2,8\n",
                      ": a coordinate system names grid point 8, which there is not"},
                     {grids + cell + "GRID,9,5\nCORD1R,5,1,2,9\n",
                      ": a coordinate system names grid point 9, which is in a system of its own"},
                     {grids + cell + "GRID,9,5\nCORD1R,5,1,2,3\n",
                      ": the points of coordinate system 5 lie on a line"},
                     {grids + cell + "GRID,9,5\nCORD1R,5,1,1,3\n",
                      ": the points of coordinate system 5 lie on a line"}});
}

}  // namespace
}  // namespace hiac::formats
