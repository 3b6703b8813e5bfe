// Cases of EnSight, OpenFOAM and MFEM of a few cells: every kind of variable, units, steps, curved
// cells of every order, functions beside meshes, refined cells.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
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

// ---- EnSight

/// Numbers first, first + 1, ..., one a line.
std::string column(double first, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += fmt::format("{:12.5e}\n", first + i);
  return text;
}

constexpr const char* kHead = "FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: c.geo\nVARIABLE\n";

/// Part 3: a triangle and two tetrahedra on five points; part 7: a tetrahedron.
std::string gold_geometry() {
  return "a\nb\nnode id given\nelement id given\nextents\n 0 1\n 0 1\n 0 1\npart\n         3\n"
         "first\ncoordinates\n         5\n11\n12\n13\n14\n15\n" +
         column(0, 2) +
         "0\n0\n1\n0\n0\n1\n0\n1\n0\n0\n0\n1\n1\ntria3\n         1\n9\n1 2 3\n"
         "tetra4\n         2\n31\n32\n1 2 3 4\n2 3 4 5\npart\n         7\nsecond\ncoordinates\n"
         "         4\n1\n2\n3\n4\n5\n6\n5\n5\n0\n0\n1\n0\n0\n0\n0\n1\ntetra4\n         1\n5\n"
         "1 2 3 4\n";
}

TEST(EnSightCases, VariablesOfEveryKindOnPartsOfEveryKind) {
  const ScratchFolder folder;
  static_cast<void>(folder.write("c.geo", gold_geometry()));
  const auto nodes = [](int width) {
    std::string text = "d\npart\n         3\ncoordinates\n";
    for (int c = 0; c < width; ++c) text += column(100 * c, 5);
    text += "part\n         7\ncoordinates\n";
    for (int c = 0; c < width; ++c) text += column(100 * c + 5, 4);
    return text;
  };
  // of the first part alone; the triangle's values stand before the tetrahedra's
  const auto cells = [](int width) {
    std::string text = "d\npart\n         3\ntria3\n";
    for (int c = 0; c < width; ++c) text += column(-1, 1);
    text += "tetra4\n";
    for (int c = 0; c < width; ++c) text += column(100 * c, 2);
    return text;
  };
  std::string variables;
  const std::vector<std::pair<std::string, int>> kinds{
      {"scalar", 1}, {"vector", 3}, {"tensor symm", 6}, {"tensor asym", 9}};
  for (const auto& [kind, width] : kinds) {
    variables += fmt::format("{0} per node: n{1} n{1}\n{0} per element: e{1} e{1}\n", kind, width);
    static_cast<void>(folder.write(fmt::format("n{}", width), nodes(width)));
    static_cast<void>(folder.write(fmt::format("e{}", width), cells(width)));
  }
  static_cast<void>(folder.write("i1", "d\npart\n         3\ncoordinates\n" + column(-50, 5)));
  variables += "complex scalar per node: z n1 i1 2.\n";
  const std::string path = folder.write("c.case", kHead + variables);
  const ZooMesh mesh = read_any(path).mesh;
  ASSERT_EQ(mesh.cell_count(), 3U);
  ASSERT_EQ(mesh.node_count(), 9U);
  EXPECT_NEAR(volume_of(mesh, 0), 1.0 / 6, 1e-15);
  EXPECT_NEAR(volume_of(mesh, 1), 1.0 / 3, 1e-15);
  for (const auto& [kind, width] : kinds) {
    SCOPED_TRACE(kind);
    const Field& on_nodes = field_named(mesh, fmt::format("n{}", width));
    const Field& on_cells = field_named(mesh, fmt::format("e{}", width));
    const auto places = static_cast<std::size_t>(width);
    ASSERT_EQ(on_nodes.components, places);
    ASSERT_EQ(on_cells.location, FieldLocation::cell);
    for (std::size_t c = 0; c < places; ++c) {
      // EnSight lists a symmetric tensor's 11 22 33 12 13 23; fields have xx yy zz xy yz xz
      std::size_t place = c;
      if (width == 6 && c >= 4) place = c == 4 ? 5 : 4;
      for (std::size_t n = 0; n < 9; ++n)
        EXPECT_EQ(on_nodes.values[n * places + place], 100. * double(c) + double(n));
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_EQ(on_cells.values[i * places + place], 100. * double(c) + double(i));
      EXPECT_TRUE(std::isnan(on_cells.values[2 * places + c]));
    }
  }
  const Field& z = field_named(mesh, "z");
  ASSERT_EQ(z.components, 2U);
  EXPECT_THAT(z.values.view().subspan(6, 4), ElementsAre(3, -47, 4, -46));
  EXPECT_TRUE(std::isnan(z.values[11]));
  ReadOptions options;
  options.block = "second";
  EXPECT_EQ(field_named(read_any(path, options).mesh, "n1").values[0], 5);
}

/// A C binary file: texts of 80 bytes, integers and floats of 4.
class Binary {
 public:
  explicit Binary(std::endian order) : swapped_(order != std::endian::native) {}
  Binary& text(std::string line) {
    line.resize(80);
    bytes_ += line;
    return *this;
  }
  template <typename Number>
  Binary& numbers(std::initializer_list<Number> list) {
    for (const Number number : list) {
      std::array<char, sizeof(Number)> raw;
      std::memcpy(raw.data(), &number, sizeof(Number));
      if (swapped_) std::reverse(raw.begin(), raw.end());
      bytes_.append(raw.data(), raw.size());
    }
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  bool swapped_;
  std::string bytes_;
};

TEST(EnSightCases, BinaryFilesOfBothByteOrders) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "c.case", std::string(kHead) + "vector per node: v c.v\nscalar per element: e c.e\n");
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    Binary geometry(order);
    for (const char* line : {"C Binary", "a", "b", "node id given", "element id off", "part"})
      geometry.text(line);
    geometry.numbers({3}).text("one").text("coordinates").numbers({4}).numbers({7, 8, 9, 10});
    geometry.numbers<float>({0, 1, 0, 0}).numbers<float>({0, 0, 1, 0});
    geometry.numbers<float>({0, 0, 0, 1}).text("tetra4").numbers({1}).numbers({1, 2, 3, 4});
    static_cast<void>(folder.write("c.geo", geometry.bytes()));
    Binary vectors(order);
    vectors.text("v").text("part").numbers({3}).text("coordinates");
    vectors.numbers<float>({1, 2, 3, 4, 11, 12, 13, 14, 21, 22, 23, 24});
    static_cast<void>(folder.write("c.v", vectors.bytes()));
    Binary scalars(order);
    scalars.text("e").text("part").numbers({3}).text("tetra4").numbers<float>({0.5F});
    static_cast<void>(folder.write("c.e", scalars.bytes()));
    const ZooMesh mesh = read_any(path).mesh;
    ASSERT_EQ(mesh.cell_count(), 1U);
    EXPECT_NEAR(volume_of(mesh), 1.0 / 6, 1e-15);
    EXPECT_THAT(field_named(mesh, "v").values.view().subspan(3, 6),
                ElementsAre(2, 12, 22, 3, 13, 23));
    EXPECT_EQ(field_named(mesh, "e").values[0], 0.5);
    static_cast<void>(folder.write("c.v", vectors.bytes().substr(0, vectors.bytes().size() - 4)));
    EXPECT_NE(refusal(path), "");
  }
}

// ---- OpenFOAM

std::string foam_file_text(const std::string& type, const std::string& body) {
  return "FoamFile\n{\n    version 2.0;\n    format ascii;\n    class " + type + ";\n}\n" + body;
}

/// Two bricks side by side along x, the face between them first, as OpenFOAM lists it.
void write_two_bricks(const ScratchFolder& folder) {
  std::filesystem::create_directories(folder.file("constant/polyMesh"));
  std::string points = "12(";
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 3; ++i) points += fmt::format("({} {} {})", i, j, k);
  const std::string mesh = "constant/polyMesh/";
  static_cast<void>(folder.write(mesh + "points", foam_file_text("vectorField", points + ")\n")));
  static_cast<void>(folder.write(
      mesh + "faces",
      foam_file_text(
          "faceList",
          "11(4(1 4 10 7)4(0 6 9 3)4(2 5 11 8)4(0 1 7 6)4(1 2 8 7)4(3 9 10 4)4(4 10 11 5)"
          "4(0 3 4 1)4(1 4 5 2)4(6 7 10 9)4(7 8 11 10))\n")));
  static_cast<void>(
      folder.write(mesh + "owner", foam_file_text("labelList", "11(0 0 1 0 1 0 1 0 1 0 1)\n")));
  static_cast<void>(folder.write(mesh + "neighbour", foam_file_text("labelList", "1(1)\n")));
}

void write_field(const ScratchFolder& folder, const std::string& time, const std::string& name,
                 const std::string& type, const std::string& dimensions,
                 const std::string& values) {
  std::filesystem::create_directories(folder.file(time));
  static_cast<void>(folder.write(
      time + "/" + name,
      foam_file_text(type, "dimensions [" + dimensions + "];\ninternalField " + values + ";\n")));
}

TEST(OpenFoamCases, WhatFollowsAListOfTheMeshIsTold) {
  const ScratchFolder folder;
  write_two_bricks(folder);
  const std::string path = folder.write("case.foam", "");
  const auto behind = HasSubstr("behind the end of");
  const std::string owner =
      foam_file_text("labelList", "11(0 0 1 0 1 0 1 0 1 0 1)\n// ****** //\n");
  static_cast<void>(folder.write("constant/polyMesh/owner", owner));
  EXPECT_THAT(read_any(path).notes, testing::Not(Contains(behind)));
  static_cast<void>(folder.write("constant/polyMesh/owner", owner + "11(0"));
  const Reading reading = read_any(path);
  EXPECT_EQ(reading.mesh.cell_count(), 2U);
  EXPECT_THAT(reading.notes,
              Contains("4 bytes behind the end of the list in 'owner' are not read"));
}

TEST(OpenFoamCases, FieldsOfEveryKindHaveTheirUnitsAndTimes) {
  const ScratchFolder folder;
  write_two_bricks(folder);
  write_field(folder, "0", "p", "volScalarField", "0 2 -2 0 0 0 0", "uniform 0");
  write_field(folder, "0.5", "p", "volScalarField", "0 2 -2 0 0 0 0",
              "nonuniform List<scalar> 2(3 4)");
  write_field(folder, "10", "p", "volScalarField", "0 2 -2 0 0 0 0",
              "nonuniform List<scalar> 2(5 6)");
  write_field(folder, "10", "U", "volVectorField", "0 1 -1 0 0 0 0",
              "nonuniform List<vector> 2((1 2 3)(4 5 6))");
  write_field(folder, "10", "S", "volSymmTensorField", "1 -1 -2 0 0 0 0",
              "nonuniform List<symmTensor> 2((1 2 3 4 5 6)(7 8 9 10 11 12))");
  write_field(folder, "10", "G", "volTensorField", "0 0 -1 1 0 0 0", "uniform (1 2 3 4 5 6 7 8 9)");
  write_field(folder, "10", "T", "pointScalarField", "0 0 0 1 0 0 0",
              "nonuniform List<scalar> 12(0 1 2 3 4 5 6 7 8 9 10 11)");
  write_field(folder, "10", "phi", "surfaceScalarField", "0 3 -1 0 0 0 0", "uniform 1");
  const std::string path = folder.write("case.foam", "");
  EXPECT_THAT(format_to_read(path).inspect(path).times, ElementsAre(0, 0.5, 10));
  const Reading last = read_any(path);
  const ZooMesh& mesh = last.mesh;
  ASSERT_EQ(mesh.cell_count(), 2U);
  for (CellId cell = 0; cell < 2; ++cell) {
    EXPECT_EQ(mesh.kinds[cell], CellKind::brick8);
    EXPECT_NEAR(volume_of(mesh, cell), 1, 1e-15);
    double middle = 0;
    for (const NodeId node : mesh.cell_nodes(cell)) middle += mesh.position(node)[0] / 8;
    EXPECT_EQ(middle, cell == 0 ? 0.5 : 1.5);
  }
  const std::vector<std::tuple<std::string, std::string, std::uint32_t>> kinds{
      {"p", "m^2 s^-2", 1},
      {"U", "m s^-1", 3},
      {"S", "kg m^-1 s^-2", 6},
      {"G", "s^-1 K", 9},
      {"T", "K", 1}};
  for (const auto& [name, unit, components] : kinds) {
    EXPECT_EQ(field_named(mesh, name).unit, unit);
    EXPECT_EQ(field_named(mesh, name).components, components) << name;
  }
  EXPECT_THAT(field_named(mesh, "p").values.view(), ElementsAre(5, 6));
  EXPECT_THAT(field_named(mesh, "U").values.view(), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(field_named(mesh, "G").values[17], 9);
  for (NodeId node = 0; node < 12; ++node) {
    const auto x = mesh.position(node);
    EXPECT_EQ(field_named(mesh, "T").values[node], x[0] + 3 * x[1] + 6 * x[2]);
  }
  EXPECT_EQ(mesh.fields.size(), 5U);
  EXPECT_THAT(last.notes, Contains(HasSubstr("left out 'phi', a surfaceScalarField")));
  ReadOptions options;
  options.time = 0.5;
  const ZooMesh middle = read_any(path, options).mesh;
  EXPECT_THAT(field_named(middle, "p").values.view(), ElementsAre(3, 4));
  EXPECT_EQ(middle.fields.size(), 1U);
  options.time = 0.25;
  EXPECT_THROW(read_any(path, options), UsageError);
}

// ---- MFEM

/// The degrees of freedom of an H1 space on elements, as MFEM numbers them: vertices; edges by
/// first appearance, from the lower vertex to the higher; faces by first appearance.
class H1 {
 public:
  struct Shape {
    int geometry;
    std::vector<Vector> corners;
    std::vector<std::pair<std::size_t, std::size_t>> edges;
    std::vector<std::vector<std::size_t>> faces;
  };

  H1(const Shape& shape, std::vector<Vector> vertices, std::vector<std::vector<std::size_t>> cells)
      : shape_(shape), vertices_(std::move(vertices)), cells_(std::move(cells)) {}

  /// The places of the degrees of freedom where an edge's inner ones are at `inside`, and a face's
  /// one, if it has one, in its middle.
  [[nodiscard]] std::vector<Vector> places(const std::vector<double>& inside,
                                           std::size_t least_corners) const {
    std::vector<Vector> all = vertices_;
    std::map<std::vector<std::size_t>, bool> seen;
    for (const auto& cell : cells_)
      for (const auto& edge : shape_.edges) {
        const auto [a, b] = std::minmax(cell[edge.first], cell[edge.second]);
        if (std::exchange(seen[{a, b}], true)) continue;
        for (const double t : inside) {
          Vector p{};
          for (std::size_t c = 0; c < 3; ++c)
            p[c] = (1 - t) * vertices_[a][c] + t * vertices_[b][c];
          all.push_back(p);
        }
      }
    for (const auto& cell : cells_)
      for (const auto& face : shape_.faces) {
        std::vector<std::size_t> corners;
        for (const std::size_t corner : face) corners.push_back(cell[corner]);
        Vector p{};
        for (const std::size_t vertex : corners)
          for (std::size_t c = 0; c < 3; ++c)
            p[c] += vertices_[vertex][c] / static_cast<double>(corners.size());
        std::sort(corners.begin(), corners.end());
        if (face.size() < least_corners || std::exchange(seen[corners], true)) continue;
        all.push_back(p);
      }
    return all;
  }

  [[nodiscard]] std::string elements() const {
    std::string text =
        fmt::format("MFEM mesh v1.0\n\ndimension\n3\n\nelements\n{}\n", cells_.size());
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      text += fmt::format("{} {}", 3 + 2 * i, shape_.geometry);
      for (const std::size_t vertex : cells_[i]) text += fmt::format(" {}", vertex);
      text += "\n";
    }
    return text + fmt::format("\nboundary\n0\n\nvertices\n{}\n\n", vertices_.size());
  }

 private:
  Shape shape_;
  std::vector<Vector> vertices_;
  std::vector<std::vector<std::size_t>> cells_;
};

/// A function of a space, its components together or one after the other.
std::string function_text(const std::string& space, bool together,
                          const std::vector<std::vector<double>>& values) {
  const std::size_t width = values.front().size();
  std::string text = fmt::format(
      "FiniteElementSpace\nFiniteElementCollection: {}\nVDim: {}\n"
      "Ordering: {}\n\n",
      space, width, together ? 1 : 0);
  for (std::size_t i = 0; i < values.size() * width; ++i)
    text += fmt::format("{:.17g}\n", together ? values[i / width][i % width]
                                              : values[i % values.size()][i / values.size()]);
  return text;
}

const H1::Shape kTetrahedron{4,
                             kTetraCorners,
                             {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}},
                             {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
const H1::Shape kPrism{6,
                       kPrismCorners,
                       {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
                       {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};

/// A quadratic map.
std::vector<double> bent_place(const Vector& p) {
  return {p[0] + 0.125 * p[1] * p[1], p[1] - 0.0625 * p[2] * p[0], p[2] + 0.25 * p[0] * p[1]};
}
/// A polynomial of degree 2 or 3.
double function_at(int order, const Vector& p) {
  return 1 + p[0] - p[1] * p[2] + (order == 3 ? p[0] * p[1] * p[1] - p[2] * p[2] * p[2] : 0);
}

// Two tetrahedra whose common vertices come in another order: edges and faces are met from either
// side. The cells' nodes lie where the map takes them, and the function has its values there.
TEST(MfemCases, CurvedTetrahedraOfOrdersTwoAndThreeShareTheirEdges) {
  const ScratchFolder folder;
  const H1 cells(kTetrahedron, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}},
                 {{0, 1, 2, 3}, {4, 3, 2, 1}});
  const double g = (1 - 1 / std::sqrt(5.0)) / 2;
  const std::vector<std::tuple<std::string, int, std::vector<double>>> spaces{
      {"Quadratic", 2, {0.5}},
      {"H1_3D_P2", 2, {0.5}},
      {"Cubic", 3, {1.0 / 3, 2.0 / 3}},
      {"H1_3D_P3", 3, {g, 1 - g}}};
  for (const auto& [space, order, inside] : spaces)
    for (const bool together : {false, true}) {
      SCOPED_TRACE(space);
      std::vector<std::vector<double>> nodes;
      std::vector<std::vector<double>> values;
      for (const Vector& p : cells.places(inside, order == 3 ? 3 : 9)) {
        nodes.push_back(bent_place(p));
        values.push_back({function_at(order, p)});
      }
      static_cast<void>(folder.write("m.gf", function_text(space, together, values)));
      const std::string path = folder.write(
          "m.mesh", cells.elements() + "nodes\n" + function_text(space, together, nodes));
      const ZooMesh mesh = read_any(path).mesh;
      ASSERT_EQ(mesh.cell_count(), 2U);
      const CellKind kind = order == 2 ? CellKind::tetrahedron10 : CellKind::tetrahedron20;
      EXPECT_EQ(mesh.node_count(), order == 2 ? 14U : 30U);
      const Field& f = field_named(mesh, "m");
      const std::vector<std::vector<Vector>> corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                                     {{1, 1, 1}, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}}};
      for (CellId cell = 0; cell < 2; ++cell) {
        ASSERT_EQ(mesh.kinds[cell], kind);
        const auto own = mesh.cell_nodes(cell);
        // the corners as they are listed, turned the right way or not
        for (std::size_t n = 0; n < own.size(); ++n) {
          const Vector& xi = reference_nodes(kind)[n];
          Vector p{};
          for (std::size_t c = 0; c < 3; ++c)
            p[c] = (1 - xi[0] - xi[1] - xi[2]) * corners[cell][0][c] + xi[0] * corners[cell][1][c] +
                   xi[1] * corners[cell][2][c] + xi[2] * corners[cell][3][c];
          const auto found = mesh.position(own[n]);
          for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], bent_place(p)[c], 1e-14) << n;
          EXPECT_NEAR(f.values[own[n]], function_at(order, p), 1e-14) << n;
        }
      }
      EXPECT_THAT(field_named(mesh, "attribute").values.view(), ElementsAre(3, 5));
    }
}

TEST(MfemCases, CurvedPrismsLoseTheNodesInTheirFaces) {
  const ScratchFolder folder;
  const H1 cells(kPrism, kPrismCorners, {{0, 1, 2, 3, 4, 5}});
  std::vector<std::vector<double>> nodes;
  for (const Vector& p : cells.places({0.5}, 4)) nodes.push_back(bent_place(p));
  const std::string path =
      folder.write("m.mesh", cells.elements() + "nodes\n" + function_text("H1_3D_P2", true, nodes));
  const ZooMesh mesh = read_any(path).mesh;
  ASSERT_EQ(mesh.cell_count(), 1U);
  ASSERT_EQ(mesh.kinds[0], CellKind::prism15);
  EXPECT_EQ(mesh.node_count(), 15U);
  for (std::size_t n = 0; n < 15; ++n) {
    const std::vector<double> expected = bent_place(reference_nodes(CellKind::prism15)[n]);
    const auto found = mesh.position(mesh.cell_nodes(0)[n]);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-15) << n;
  }
}

TEST(MfemCases, LinearCellsOfEveryKindWithTheirAttributesAndFunctions) {
  const ScratchFolder folder;
  // a brick, a pyramid on its top, a prism beside it, a tetrahedron beside that
  const std::string path = folder.write(
      "m.mesh",
      "MFEM mesh v1.0\n\n# c\ndimension\n3\n\nelements\n4\n7 5 0 1 2 3 4 5 6 7\n2 7 4 5 6 7 8\n"
      "7 6 1 9 2 5 10 6\n2 4 9 11 2 10\n\nboundary\n1\n1 3 0 3 2 1\n\nvertices\n12\n3\n0 0 0\n"
      "1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n.5 .5 2\n2 0 0\n2 0 1\n2 1 0\n");
  static_cast<void>(
      folder.write("m.gf", function_text("L2_3D_P0", false, {{1, 10}, {2, 20}, {3, 30}, {4, 40}})));
  const Reading reading = read_any(path);
  const ZooMesh& mesh = reading.mesh;
  EXPECT_THAT(
      std::vector<CellKind>(mesh.kinds.begin(), mesh.kinds.end()),
      ElementsAre(CellKind::brick8, CellKind::pyramid5, CellKind::prism6, CellKind::tetrahedron4));
  const std::array<double, 4> volumes{1, 1.0 / 3, 0.5, 1.0 / 6};
  for (CellId cell = 0; cell < 4; ++cell)
    EXPECT_NEAR(volume_of(mesh, cell), volumes[cell], 1e-15) << cell;
  EXPECT_THAT(field_named(mesh, "attribute").values.view(), ElementsAre(7, 2, 7, 2));
  const Field& f = field_named(mesh, "m");
  ASSERT_EQ(f.components, 2U);
  EXPECT_THAT(f.values.view(), ElementsAre(1, 10, 2, 20, 3, 30, 4, 40));
  ReadOptions options;
  options.block = "2";
  const ZooMesh part = read_any(path, options).mesh;
  ASSERT_EQ(part.cell_count(), 2U);
  EXPECT_THAT(field_named(part, "m").values.view(), ElementsAre(2, 20, 4, 40));
}

// A brick divided along x: the parent is no cell, and the new vertices lie between their parents.
TEST(MfemCases, RefinedCellsAreTheLeaves) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "m.mesh",
      "MFEM NC mesh v1.0\n\ndimension\n3\n\nelements\n3\n0 4 5 1 1 2\n0 4 5 0 0 8 9 3 4 10 11 7\n"
      "0 6 5 0 8 1 2 9 10 5 6 11\n\nboundary\n0\n\nvertex_parents\n4\n8 0 1\n9 2 3\n10 4 5\n11 6 "
      "7\n"
      "\nroot_state\n1\n0\n\ncoordinates\n8\n3\n0 0 0\n2 0 0\n2 1 0\n0 1 0\n0 0 1\n2 0 1\n2 1 1\n"
      "0 1 1\n");
  const ZooMesh mesh = read_any(path).mesh;
  ASSERT_EQ(mesh.cell_count(), 2U);
  EXPECT_EQ(mesh.node_count(), 12U);
  for (CellId cell = 0; cell < 2; ++cell) {
    EXPECT_NEAR(volume_of(mesh, cell), 1, 1e-15);
    double middle = 0;
    for (const NodeId node : mesh.cell_nodes(cell)) middle += mesh.position(node)[0] / 8;
    EXPECT_EQ(middle, cell == 0 ? 0.5 : 1.5);
  }
  EXPECT_THAT(field_named(mesh, "attribute").values.view(), ElementsAre(4, 6));
}

}  // namespace
}  // namespace hiac::formats
