#include "tests/formats/one_cell_files.hpp"

#include <functional>
#include <map>

#include <fmt/format.h>

namespace hiac::formats {
namespace {

using Point = std::array<double, 3>;
/// A node in the middle of two corners, numbered from 1 as manuals do.
using Between = std::pair<int, int>;
using Nodes = std::vector<Between>;

const std::vector<Point>& corners_of(CellShape shape) {
  static const std::map<CellShape, std::vector<Point>> corners{
      {CellShape::tetrahedron, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
      {CellShape::pyramid, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}},
      {CellShape::prism, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
      {CellShape::brick,
       {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}};
  return corners.at(shape);
}

Point mapped(const Point& x) {
  return {2 * x[0] + 0.25 * x[1] + 1, 1.5 * x[1] + 0.5 * x[2] - 2, 0.125 * x[0] + 3 * x[2]};
}

std::vector<Point> points_of(CellShape shape, const Nodes& nodes) {
  const std::vector<Point>& corners = corners_of(shape);
  std::vector<Point> points;
  for (const auto& [a, b] : nodes) {
    Point middle{};
    for (std::size_t c = 0; c < 3; ++c)
      middle[c] = (corners[static_cast<std::size_t>(a) - 1][c] +
                   corners[static_cast<std::size_t>(b) - 1][c]) /
                  2;
    points.push_back(mapped(middle));
  }
  return points;
}

/// 1, 2, ... n as corners.
Nodes corners(int n) {
  Nodes nodes;
  for (int i = 1; i <= n; ++i) nodes.emplace_back(i, i);
  return nodes;
}

Nodes corners_and(int n, const Nodes& middles) {
  Nodes nodes = corners(n);
  nodes.insert(nodes.end(), middles.begin(), middles.end());
  return nodes;
}

// Bottom edges, top edges, vertical edges: Abaqus Elements Guide, "Three-dimensional solid element
// library" (C3D10, C3D15, C3D20); Ansys element reference (SOLID186, SOLID187) likewise.
const Nodes kTet10 = corners_and(4, {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}});
const Nodes kPrism15 =
    corners_and(6, {{1, 2}, {2, 3}, {3, 1}, {4, 5}, {5, 6}, {6, 4}, {1, 4}, {2, 5}, {3, 6}});
const Nodes kBrick20 = corners_and(8, {{1, 2},
                                       {2, 3},
                                       {3, 4},
                                       {4, 1},
                                       {5, 6},
                                       {6, 7},
                                       {7, 8},
                                       {8, 5},
                                       {1, 5},
                                       {2, 6},
                                       {3, 7},
                                       {4, 8}});
// Bottom, vertical, top: CalculiX GraphiX manual, "Element Types" (pe15, he20); Nastran Quick
// Reference Guide (CPENTA, CHEXA; of CPYRAM the base, then the others).
const Nodes kPrism15VerticalFirst =
    corners_and(6, {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 5}, {3, 6}, {4, 5}, {5, 6}, {6, 4}});
const Nodes kBrick20VerticalFirst = corners_and(8, {{1, 2},
                                                    {2, 3},
                                                    {3, 4},
                                                    {4, 1},
                                                    {1, 5},
                                                    {2, 6},
                                                    {3, 7},
                                                    {4, 8},
                                                    {5, 6},
                                                    {6, 7},
                                                    {7, 8},
                                                    {8, 5}});
const Nodes kPyramid13 =
    corners_and(5, {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {1, 5}, {2, 5}, {3, 5}, {4, 5}});

struct Document {
  std::string type;  ///< the format's word or number
  CellKind kind;
  Nodes nodes;
};

using Writer = std::function<std::string(const Document&, const std::vector<Point>&)>;

std::string numbers(std::size_t count, const char* pattern = " {}") {
  std::string text;
  for (std::size_t n = 1; n <= count; ++n) text += fmt::format(fmt::runtime(pattern), n);
  return text;
}

std::string gmsh_text(const Document& document, const std::vector<Point>& points) {
  std::string text =
      fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", points.size());
  std::string data;
  for (std::size_t i = 0; i < points.size(); ++i) {
    text += fmt::format("{} {} {} {}\n", i + 1, points[i][0], points[i][1], points[i][2]);
    data += fmt::format("{} {}\n", i + 1, one_cell_polynomial(points[i]));
  }
  text += fmt::format("$EndNodes\n$Elements\n1\n1 {} 2 7 1{}\n$EndElements\n", document.type,
                      numbers(points.size()));
  return text + fmt::format("$NodeData\n1\n\"f\"\n1\n0.5\n3\n0\n1\n{}\n{}$EndNodeData\n",
                            points.size(), data);
}

std::string abaqus_text(const Document& document, const std::vector<Point>& points) {
  std::string text = "*NODE\n";
  for (std::size_t i = 0; i < points.size(); ++i)
    text += fmt::format("{}, {}, {}, {}\n", i + 1, points[i][0], points[i][1], points[i][2]);
  text += fmt::format("*ELEMENT, TYPE={}, ELSET=All\n7", document.type);
  for (std::size_t n = 1; n <= points.size(); ++n)
    text += fmt::format(",{}{}", n == 12 ? "\n" : " ", n);
  return text + "\n";
}

std::string frd_text(const Document& document, const std::vector<Point>& points) {
  std::string text = "    1C\n    1UPGM test\n";
  text += fmt::format("    2C{:18}{:12}{:37}1\n", "", points.size(), "");
  std::string data;
  for (std::size_t i = 0; i < points.size(); ++i) {
    text += fmt::format(" -1{:10}{:12.5E}{:12.5E}{:12.5E}\n", i + 1, points[i][0], points[i][1],
                        points[i][2]);
    data += fmt::format(" -1{:10}{:12.5E}\n", i + 1, one_cell_polynomial(points[i]));
  }
  text += fmt::format(" -3\n    3C{:18}{:12}{:37}1\n -1{:10}{:5}{:5}{:5}", "", 1, "", 1,
                      document.type, 0, 1);
  for (std::size_t n = 1; n <= points.size(); ++n)
    text += fmt::format("{}{:10}", n % 10 == 1 ? "\n -2" : "", n);
  text += fmt::format("\n -3\n  100CL  101{:12.5E}{:12}{:20} 0{:5}{:10} 1\n", 0.5, points.size(),
                      "", 1, "");
  return text + " -4  f           1    1\n -5  f           1    1    0    0\n" + data +
         " -3\n 9999\n";
}

std::string nastran_text(const Document& document, const std::vector<Point>& points) {
  std::string text = "BEGIN BULK\n";
  for (std::size_t i = 0; i < points.size(); ++i)
    text += fmt::format("GRID*   {:16}{:16}{:<16}{:<16}\n*       {:<16}\n", i + 1, "", points[i][0],
                        points[i][1], points[i][2]);
  text += fmt::format("{:<8}{:8}{:8}", document.type, 1, 5);
  for (std::size_t n = 1; n <= points.size(); ++n)
    text += fmt::format("{}{:8}", n > 1 && (n + 1) % 8 == 0 ? "+\n+       " : "", n);
  return text + "\nENDDATA\n";
}

std::string ansys_text(const Document& document, const std::vector<Point>& points) {
  std::string text = fmt::format("/PREP7\nET,1,{}\nNBLOCK,6,SOLID\n(3i9,6e21.13)\n", document.type);
  for (std::size_t i = 0; i < points.size(); ++i)
    text += fmt::format("{:9}{:9}{:9}{:21.13E}{:21.13E}{:21.13E}\n", i + 1, 0, 0, points[i][0],
                        points[i][1], points[i][2]);
  text += fmt::format(
      "N,R5.3,LOC,       -1,\nEBLOCK,19,SOLID\n(19i9)\n{:9}{:9}{:9}{:9}{:9}{:9}"
      "{:9}{:9}{:9}{:9}{:9}",
      1, 1, 1, 1, 0, 0, 0, 0, points.size(), 0, 1);
  for (std::size_t n = 1; n <= points.size(); ++n)
    text += fmt::format("{}{:9}", n == 9 ? "\n" : "", n);
  return text + "\n       -1\nCMBLOCK,ALL     ,ELEM,       1\n(8i10)\n         1\n";
}

std::string unv_text(const Document& document, const std::vector<Point>& points) {
  std::string text = "    -1\n  2411\n";
  std::string data;
  for (std::size_t i = 0; i < points.size(); ++i) {
    text += fmt::format("{:10}{:10}{:10}{:10}\n{:25.16E}{:25.16E}{:25.16E}\n", i + 1, 1, 1, 11,
                        points[i][0], points[i][1], points[i][2]);
    data += fmt::format("{:10}\n{:13.5E}\n", i + 1, one_cell_polynomial(points[i]));
  }
  text += fmt::format("    -1\n    -1\n  2412\n{:10}{:10}{:10}{:10}{:10}{:10}", 1, document.type, 1,
                      1, 7, points.size());
  for (std::size_t n = 1; n <= points.size(); ++n)
    text += fmt::format("{}{:10}", n % 8 == 1 ? "\n" : "", n);
  text += "\n    -1\n    -1\n  2414\n         1\nf\n         1\nA\nB\nC\nD\nE\n";
  text += fmt::format("{:10}{:10}{:10}{:10}{:10}{:10}\n", 1, 4, 1, 94, 2, 1);
  text += fmt::format("{:10}{:10}{:10}{:10}{:10}{:10}{:10}{:10}\n", 0, 0, 0, 0, 0, 0, 3, 0);
  text += fmt::format("{:10}{:10}\n", 0, 0);
  for (int line = 0; line < 2; ++line) {
    for (int i = 0; i < 6; ++i) text += fmt::format("{:13.5E}", line == 0 && i == 0 ? 0.5 : 0.0);
    text += "\n";
  }
  return text + data + "    -1\n";
}

std::string ucd_text(const Document& document, const std::vector<Point>& points) {
  std::string text = fmt::format("# AVS\n{} 1 1 0 0\n", points.size());
  std::string data = "1 1\nf, K\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    text += fmt::format("{} {} {} {}\n", i + 1, points[i][0], points[i][1], points[i][2]);
    data += fmt::format("{} {}\n", i + 1, one_cell_polynomial(points[i]));
  }
  return text + fmt::format("1 3 {}{}\n", document.type, numbers(points.size())) + data;
}

std::string plain_points(const std::vector<Point>& points, std::string_view behind) {
  std::string text;
  for (const Point& point : points)
    text += fmt::format("{} {} {}{}\n", point[0], point[1], point[2], behind);
  return text;
}

std::string medit_text(const Document& document, const std::vector<Point>& points) {
  return fmt::format("MeshVersionFormatted 2\nDimension 3\nVertices\n{}\n{}{}\n1\n{} 5\nEnd\n",
                     points.size(), plain_points(points, " 4"), document.type,
                     numbers(points.size()));
}

std::string ugrid_text(const Document& document, const std::vector<Point>& points) {
  return fmt::format("{} 0 0 {}\n{}{}\n", points.size(), document.type, plain_points(points, ""),
                     numbers(points.size()));
}

std::string su2_text(const Document& document, const std::vector<Point>& points) {
  std::string nodes;
  for (std::size_t n = 0; n < points.size(); ++n) nodes += fmt::format(" {}", n);
  return fmt::format("% one cell\nNDIME= 3\nNELEM= 1\n{}{} 0\nNPOIN= {}\n{}NMARK= 0\n",
                     document.type, nodes, points.size(), plain_points(points, " 0"));
}

std::string netgen_text(const Document& document, const std::vector<Point>& points) {
  return fmt::format(
      "mesh3d\ndimension\n3\ngeomtype\n0\nvolumeelements\n1\n 2 {}{}\npoints\n{}\n{}"
      "materials\n1\n2 steel\nendmesh\n",
      document.type, numbers(points.size()), points.size(), plain_points(points, ""));
}

std::string gambit_text(const Document& document, const std::vector<Point>& points) {
  std::string text = fmt::format(
      "        CONTROL INFO 1.2.1\n** GAMBIT NEUTRAL FILE\none\nPROGRAM: Gambit VERSION: 1\n now\n"
      " NUMNP NELEM NGRPS NBSETS NDFCD NDFVL\n {} 1 1 0 3 3\nENDOFSECTION\n   NODAL COORDINATES "
      "1.2.1\n",
      points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    text += fmt::format("{} {} {} {}\n", i + 1, points[i][0], points[i][1], points[i][2]);
  return text + fmt::format(
                    "ENDOFSECTION\n      ELEMENTS/CELLS 1.2.1\n 1 {} {}{}\nENDOFSECTION\n"
                    "       ELEMENT GROUP 1.2.1\nGROUP: 1 ELEMENTS: 1 MATERIAL: 2 NFLAGS: "
                    "1\n fluid\n 0\n 1\nENDOFSECTION\n",
                    document.type, points.size(), numbers(points.size()));
}

std::string tecplot_text(const Document& document, const std::vector<Point>& points) {
  std::string text = fmt::format(
      "TITLE = \"one\"\nVARIABLES = \"X\", \"Y\", \"Z\", \"f\"\nZONE T=\"all\", N={}, E=1, ET={}, "
      "F=FEPOINT\n",
      points.size(), document.type);
  for (const Point& x : points)
    text += fmt::format("{} {} {} {}\n", x[0], x[1], x[2], one_cell_polynomial(x));
  return text + numbers(points.size()) + "\n";
}

/// A format: how its files are written, and its documented cells.
struct Described {
  std::string format;
  std::string extension;
  Writer write;
  std::vector<Document> documents;
};

// Gmsh reference manual, "Node ordering": the figures' numbers are one less than these.
const Nodes kGmshBrick20 = corners_and(8, {{1, 2},
                                           {1, 4},
                                           {1, 5},
                                           {2, 3},
                                           {2, 6},
                                           {3, 4},
                                           {3, 7},
                                           {4, 8},
                                           {5, 6},
                                           {5, 8},
                                           {6, 7},
                                           {7, 8}});
const Nodes kGmshTet10 = corners_and(4, {{1, 2}, {2, 3}, {1, 3}, {1, 4}, {3, 4}, {2, 4}});
const Nodes kGmshPrism15 =
    corners_and(6, {{1, 2}, {1, 3}, {1, 4}, {2, 3}, {2, 5}, {3, 6}, {4, 5}, {4, 6}, {5, 6}});
const Nodes kGmshPyramid13 =
    corners_and(5, {{1, 2}, {1, 4}, {1, 5}, {2, 3}, {2, 5}, {3, 4}, {3, 5}, {4, 5}});

// Universal file datasets: parabolic solids go round the bottom, corner and middle in turn.
const Nodes kUnvTet10{{1, 1}, {1, 2}, {2, 2}, {2, 3}, {3, 3},
                      {3, 1}, {1, 4}, {2, 4}, {3, 4}, {4, 4}};
const Nodes kUnvPrism15{{1, 1}, {1, 2}, {2, 2}, {2, 3}, {3, 3}, {3, 1}, {1, 4}, {2, 5},
                        {3, 6}, {4, 4}, {4, 5}, {5, 5}, {5, 6}, {6, 6}, {6, 4}};
const Nodes kUnvBrick20{{1, 1}, {1, 2}, {2, 2}, {2, 3}, {3, 3}, {3, 4}, {4, 4},
                        {4, 1}, {1, 5}, {2, 6}, {3, 7}, {4, 8}, {5, 5}, {5, 6},
                        {6, 6}, {6, 7}, {7, 7}, {7, 8}, {8, 8}, {8, 5}};

// AVS user's guide: the top first; the apex first.
const Nodes kUcdBrick{{5, 5}, {6, 6}, {7, 7}, {8, 8}, {1, 1}, {2, 2}, {3, 3}, {4, 4}};
const Nodes kUcdPrism{{4, 4}, {5, 5}, {6, 6}, {1, 1}, {2, 2}, {3, 3}};
const Nodes kUcdPyramid{{5, 5}, {1, 1}, {2, 2}, {3, 3}, {4, 4}};

// AFLR3: the base of a pyramid is 1 4 5 2, its apex 3.
const Nodes kUgridPyramid{{1, 1}, {4, 4}, {5, 5}, {2, 2}, {3, 3}};

// Netgen's cells are left-handed; edges as its Refinement::MakeSecondOrder has them.
const Nodes kNetgenTet4{{1, 1}, {3, 3}, {2, 2}, {4, 4}};
const Nodes kNetgenTet10{{1, 1}, {3, 3}, {2, 2}, {4, 4}, {1, 3},
                         {1, 2}, {1, 4}, {3, 2}, {3, 4}, {2, 4}};
const Nodes kNetgenPyramid{{1, 1}, {4, 4}, {3, 3}, {2, 2}, {5, 5}};
const Nodes kNetgenPrism{{1, 1}, {3, 3}, {2, 2}, {4, 4}, {6, 6}, {5, 5}};
const Nodes kNetgenBrick{{1, 1}, {4, 4}, {3, 3}, {2, 2}, {5, 5}, {8, 8}, {7, 7}, {6, 6}};
const Nodes kNetgenPyramid13{{1, 1}, {4, 4}, {3, 3}, {2, 2}, {5, 5}, {1, 4}, {2, 3},
                             {2, 1}, {4, 3}, {1, 5}, {4, 5}, {3, 5}, {2, 5}};
const Nodes kNetgenPrism15{{1, 1}, {3, 3}, {2, 2}, {4, 4}, {6, 6}, {5, 5}, {1, 3}, {1, 2},
                           {3, 2}, {1, 4}, {3, 6}, {2, 5}, {4, 6}, {4, 5}, {6, 5}};
const Nodes kNetgenBrick20{{1, 1}, {4, 4}, {3, 3}, {2, 2}, {5, 5}, {8, 8}, {7, 7},
                           {6, 6}, {1, 4}, {3, 2}, {2, 1}, {4, 3}, {5, 8}, {7, 6},
                           {6, 5}, {8, 7}, {1, 5}, {4, 8}, {3, 7}, {2, 6}};

// Gambit's user guide: nodes row by row, middles among them.
const Nodes kGambitBrick8{{1, 1}, {2, 2}, {4, 4}, {3, 3}, {5, 5}, {6, 6}, {8, 8}, {7, 7}};
const Nodes kGambitBrick20{{1, 1}, {1, 2}, {2, 2}, {1, 4}, {2, 3}, {4, 4}, {3, 4},
                           {3, 3}, {1, 5}, {2, 6}, {4, 8}, {3, 7}, {5, 5}, {5, 6},
                           {6, 6}, {5, 8}, {6, 7}, {8, 8}, {7, 8}, {7, 7}};
const Nodes kGambitPrism15{{1, 1}, {1, 2}, {2, 2}, {1, 3}, {2, 3}, {3, 3}, {1, 4}, {2, 5},
                           {3, 6}, {4, 4}, {4, 5}, {5, 5}, {4, 6}, {5, 6}, {6, 6}};
const Nodes kGambitTet10{{1, 1}, {1, 2}, {2, 2}, {1, 3}, {2, 3},
                         {3, 3}, {1, 4}, {2, 4}, {3, 4}, {4, 4}};
const Nodes kGambitPyramid{{1, 1}, {2, 2}, {4, 4}, {3, 3}, {5, 5}};

std::vector<Described> descriptions() {
  using K = CellKind;
  return {
      {"gmsh",
       ".msh",
       gmsh_text,
       {{"4", K::tetrahedron4, corners(4)},
        {"5", K::brick8, corners(8)},
        {"6", K::prism6, corners(6)},
        {"7", K::pyramid5, corners(5)},
        {"11", K::tetrahedron10, kGmshTet10},
        {"17", K::brick20, kGmshBrick20},
        {"18", K::prism15, kGmshPrism15},
        {"19", K::pyramid13, kGmshPyramid13}}},
      {"abaqus",
       ".inp",
       abaqus_text,
       {{"C3D4", K::tetrahedron4, corners(4)},
        {"C3D5", K::pyramid5, corners(5)},
        {"C3D6", K::prism6, corners(6)},
        {"C3D8R", K::brick8, corners(8)},
        {"C3D10M", K::tetrahedron10, kTet10},
        {"C3D15", K::prism15, kPrism15},
        {"C3D20R", K::brick20, kBrick20}}},
      {"frd",
       ".frd",
       frd_text,
       {{"1", K::brick8, corners(8)},
        {"2", K::prism6, corners(6)},
        {"3", K::tetrahedron4, corners(4)},
        {"4", K::brick20, kBrick20VerticalFirst},
        {"5", K::prism15, kPrism15VerticalFirst},
        {"6", K::tetrahedron10, kTet10}}},
      {"nastran",
       ".bdf",
       nastran_text,
       {{"CTETRA", K::tetrahedron4, corners(4)},
        {"CTETRA", K::tetrahedron10, kTet10},
        {"CPYRAM", K::pyramid5, corners(5)},
        {"CPYRAM", K::pyramid13, kPyramid13},
        {"CPENTA", K::prism6, corners(6)},
        {"CPENTA", K::prism15, kPrism15VerticalFirst},
        {"CHEXA", K::brick8, corners(8)},
        {"CHEXA", K::brick20, kBrick20VerticalFirst}}},
      {"ansys",
       ".cdb",
       ansys_text,
       {{"185", K::brick8, corners(8)},
        {"186", K::brick20, kBrick20},
        {"187", K::tetrahedron10, kTet10},
        {"285", K::tetrahedron4, corners(4)}}},
      {"unv",
       ".unv",
       unv_text,
       {{"111", K::tetrahedron4, corners(4)},
        {"112", K::prism6, corners(6)},
        {"113", K::prism15, kUnvPrism15},
        {"115", K::brick8, corners(8)},
        {"116", K::brick20, kUnvBrick20},
        {"118", K::tetrahedron10, kUnvTet10}}},
      {"ucd",
       ".ucd",
       ucd_text,
       {{"tet", K::tetrahedron4, corners(4)},
        {"pyr", K::pyramid5, kUcdPyramid},
        {"prism", K::prism6, kUcdPrism},
        {"hex", K::brick8, kUcdBrick}}},
      {"medit",
       ".mesh",
       medit_text,
       {{"Tetrahedra", K::tetrahedron4, corners(4)},
        {"Pyramids", K::pyramid5, corners(5)},
        {"Prisms", K::prism6, corners(6)},
        {"Hexahedra", K::brick8, corners(8)},
        {"TetrahedraP2", K::tetrahedron10, kTet10}}},
      {"ugrid",
       ".ugrid",
       ugrid_text,
       {{"1 0 0 0", K::tetrahedron4, corners(4)},
        {"0 1 0 0", K::pyramid5, kUgridPyramid},
        {"0 0 1 0", K::prism6, corners(6)},
        {"0 0 0 1", K::brick8, corners(8)}}},
      {"su2",
       ".su2",
       su2_text,
       {{"10", K::tetrahedron4, corners(4)},
        {"12", K::brick8, corners(8)},
        {"13", K::prism6, corners(6)},
        {"14", K::pyramid5, corners(5)}}},
      {"netgen",
       ".vol",
       netgen_text,
       {{"4", K::tetrahedron4, kNetgenTet4},
        {"5", K::pyramid5, kNetgenPyramid},
        {"6", K::prism6, kNetgenPrism},
        {"8", K::brick8, kNetgenBrick},
        {"10", K::tetrahedron10, kNetgenTet10},
        {"13", K::pyramid13, kNetgenPyramid13},
        {"15", K::prism15, kNetgenPrism15},
        {"20", K::brick20, kNetgenBrick20}}},
      {"gambit",
       ".neu",
       gambit_text,
       {{"4", K::brick8, kGambitBrick8},
        {"4", K::brick20, kGambitBrick20},
        {"5", K::prism6, corners(6)},
        {"5", K::prism15, kGambitPrism15},
        {"6", K::tetrahedron4, corners(4)},
        {"6", K::tetrahedron10, kGambitTet10},
        {"7", K::pyramid5, kGambitPyramid}}},
      {"tecplot",
       ".dat",
       tecplot_text,
       {{"BRICK", K::brick8, corners(8)}, {"TETRAHEDRON", K::tetrahedron4, corners(4)}}},
  };
}

}  // namespace

double one_cell_polynomial(const std::array<double, 3>& x) {
  return 1 + 0.5 * x[0] - x[1] + 0.25 * x[2];
}

std::vector<OneCellFile> one_cell_files() {
  std::vector<OneCellFile> files;
  for (const Described& format : descriptions())
    for (const Document& document : format.documents)
      files.push_back({format.format, std::string(kind_name(document.kind)) + format.extension,
                       document.kind,
                       format.write(document, points_of(shape_of(document.kind), document.nodes))});
  return files;
}

}  // namespace hiac::formats
