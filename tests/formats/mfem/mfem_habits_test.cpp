// Habits of files by MFEM: attribute sets, boxes, curved cells and the spaces of their nodes.
#include <array>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::Each;
using testing::HasSubstr;

const std::string kMfemTetrahedron =
    "dimension\n3\nelements\n1\n7 4 0 1 2 3\n\nattribute_sets\n2\n\"the core\" 1 7\nall 2\n7\n8\n"
    "\nboundary\n0\n\nbdr_attribute_sets\n0\n\nvertices\n4\n3\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";

TEST(MfemHabits, AttributeSetsPartsOfParallelMeshesAndOtherKinds) {
  const ScratchFolder folder;
  for (const char* end : {"mfem_mesh_end\n", "\nmfem_serial_mesh_end\n\ncommunication_groups\n"})
    expect_unit_tetrahedron(
        read_any(folder.write("a.mesh", "MFEM mesh v1.3\n\n# c\n" + kMfemTetrahedron + end)).mesh);
  EXPECT_THAT(refusal(folder.write("n.mesh", "MFEM NURBS mesh v1.0\n\ndimension\n3\n")),
              HasSubstr("expected ('MFEM NURBS mesh v1.0' found)"));
}

TEST(MfemHabits, BoxesAreDividedIntoCells) {
  const ScratchFolder folder;
  const std::vector<std::pair<std::string, std::size_t>> types{
      {"hex", 1}, {"tet", 6}, {"wedge", 2}, {"pyramid", 6}};
  for (const auto& [type, cells] : types) {
    const ZooMesh mesh =
        read_any(folder.write("i.mesh", "MFEM INLINE mesh v1.0\n\ntype = " + type +
                                            "\nnx = 2\nny=3\nnz = 1\nsx = 2\nsy = 1.5\nsz = 1\n"))
            .mesh;
    ASSERT_EQ(mesh.cell_count(), 6 * cells) << type;
    double volume = 0;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
      EXPECT_GT(volume_of(mesh, cell), 0) << type;
      volume += volume_of(mesh, cell);
    }
    EXPECT_NEAR(volume, 3, 1e-12) << type;
  }
  EXPECT_THAT(refusal(folder.write("j.mesh", "MFEM INLINE mesh v1.0\ntype = quad\nnx = 2\n")),
              HasSubstr("type hex, tet, wedge or pyramid expected ('quad' found)"));
}

/// The cube [0, 1]^3, its nodes in the space: MFEM lists vertices, edges from the lower vertex to
/// the higher, faces row by row from their first vertex (H1_HexahedronElement), inside i fastest.
/// `places`, `squares`: the degrees of freedom of t and t^2 along a line.
std::string mfem_cube(const std::string& space, const std::vector<double>& places,
                      const std::vector<double>& squares) {
  using P = std::array<int, 3>;
  const int order = static_cast<int>(places.size()) - 1;
  const std::vector<P> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                               {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const std::vector<std::array<std::size_t, 2>> edges{{0, 1}, {1, 2}, {2, 3}, {0, 3},
                                                      {4, 5}, {5, 6}, {6, 7}, {4, 7},
                                                      {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  const std::vector<std::array<std::size_t, 3>> faces{{3, 2, 0}, {0, 1, 4}, {1, 2, 5},
                                                      {2, 3, 6}, {3, 0, 7}, {4, 5, 7}};
  std::string text =
      "MFEM mesh v1.0\n\ndimension\n3\nelements\n1\n1 5 0 1 2 3 4 5 6 7\nboundary\n0\n"
      "vertices\n8\n\nnodes\nFiniteElementSpace\nFiniteElementCollection: " +
      space + "\nVDim: 3\nOrdering: 1\n\n";
  const auto add = [&](const P& at) {
    std::array<double, 3> x{};
    for (std::size_t c = 0; c < 3; ++c) x[c] = places[static_cast<std::size_t>(at[c])];
    // every edge is bent, as a brick of serendipity kind can be
    text += fmt::format("{} {} {}\n", x[0] + 0.1 * squares[static_cast<std::size_t>(at[1])], x[1],
                        x[2] + 0.2 * x[0] * x[1]);
  };
  const auto at = [&](std::size_t corner, std::size_t a, int s, std::size_t b, int t) {
    P place{};
    for (std::size_t c = 0; c < 3; ++c)
      place[c] = order * corners[corner][c] + s * (corners[a][c] - corners[corner][c]) +
                 t * (corners[b][c] - corners[corner][c]);
    return place;
  };
  for (std::size_t v = 0; v < 8; ++v) add(at(v, v, 0, v, 0));
  for (const auto& [a, b] : edges)
    for (int s = 1; s < order; ++s) add(at(a, b, s, a, 0));
  for (const auto& [corner, a, b] : faces)
    for (int t = 1; t < order; ++t)
      for (int s = 1; s < order; ++s) add(at(corner, a, s, b, t));
  for (int k = 1; k < order; ++k)
    for (int j = 1; j < order; ++j)
      for (int i = 1; i < order; ++i) add({i, j, k});
  return text;
}

TEST(MfemHabits, CurvedCubesBecomeBricks) {
  const ScratchFolder folder;
  const double g = (1 - 1 / std::sqrt(5.0)) / 2;
  const std::vector<std::tuple<std::string, std::vector<double>, CellKind>> rows{
      {"H1_3D_P2", {0, 0.5, 1}, CellKind::brick20},
      {"Quadratic", {0, 0.5, 1}, CellKind::brick20},
      {"H1_3D_P3", {0, g, 1 - g, 1}, CellKind::brick32},
      {"H1@G_3D_P3", {0, g, 1 - g, 1}, CellKind::brick32},
      {"H1@U_3D_P3", {0, 1.0 / 3, 2.0 / 3, 1}, CellKind::brick32},
      {"H1Pos_3D_P2", {0, 0.5, 1}, CellKind::brick20},
      {"H1Pos_3D_P3", {0, 1.0 / 3, 2.0 / 3, 1}, CellKind::brick32}};
  for (const auto& [space, places, kind] : rows) {
    std::vector<double> squares;
    const auto last = static_cast<double>(places.size() - 1);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto at = static_cast<double>(i);
      // t^2 is the sum of i (i - 1) / (n (n - 1)) times Bernstein's polynomials of degree n
      squares.push_back(space.starts_with("H1Pos") ? at * (at - 1) / (last * (last - 1))
                                                   : places[i] * places[i]);
    }
    const Reading reading = read_any(folder.write("c.mesh", mfem_cube(space, places, squares)));
    ASSERT_EQ(reading.mesh.cell_count(), 1U) << space;
    ASSERT_EQ(reading.mesh.kinds[0], kind) << space;
    const auto nodes = reading.mesh.cell_nodes(0);
    const auto reference = reference_nodes(kind);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto& [x, y, z] = reference[n];
      const auto found = reading.mesh.position(nodes[n]);
      EXPECT_NEAR(found[0], x + 0.1 * y * y, 1e-14) << space << n;
      EXPECT_NEAR(found[1], y, 1e-14) << space << n;
      EXPECT_NEAR(found[2], z + 0.2 * x * y, 1e-14) << space << n;
    }
  }
}

// The barycentric Bernstein form of y^2 / 2 and of x y / 4 on one tetrahedron, and on a prism.
TEST(MfemHabits, BernsteinNodesOfTetrahedraAndPrisms) {
  const ScratchFolder folder;
  const auto mesh = [](const std::string& element, int vertices, const std::string& nodes) {
    return fmt::format(
        "MFEM mesh v1.0\n\ndimension\n3\nelements\n1\n{}\nboundary\n0\nvertices\n{}\n\nnodes\n"
        "FiniteElementSpace\nFiniteElementCollection: H1Pos_3D_P2\nVDim: 3\nOrdering: 1\n\n{}",
        element, vertices, nodes);
  };
  const auto expect = [](const ZooMesh& found, CellKind kind) {
    ASSERT_EQ(found.kinds[0], kind);
    const auto reference = reference_nodes(kind);
    for (std::size_t n = 0; n < reference.size(); ++n) {
      const auto& [x, y, z] = reference[n];
      const auto at = found.position(found.cell_nodes(0)[n]);
      EXPECT_NEAR(at[0], x + 0.5 * y * y, 1e-15) << n;
      EXPECT_NEAR(at[1], y, 1e-15) << n;
      EXPECT_NEAR(at[2], z + 0.25 * x * y, 1e-15) << n;
    }
  };
  // vertices; edges 01 02 03 12 13 23
  expect(read_any(folder.write("t.mesh", mesh("1 4 0 1 2 3", 4,
                                              "0 0 0  1 0 0  0.5 1 0  0 0 1\n"
                                              "0.5 0 0  0 0.5 0  0 0 0.5\n"
                                              "0.5 0.5 0.125  0.5 0 0.5  0 0.5 0.5\n")))
             .mesh,
         CellKind::tetrahedron10);
  // vertices; edges 01 12 02 34 45 35 03 14 25; the sides' centres
  expect(read_any(folder.write("w.mesh", mesh("1 6 0 1 2 3 4 5", 6,
                                              "0 0 0  1 0 0  0.5 1 0  0 0 1  1 0 1  0.5 1 1\n"
                                              "0.5 0 0  0.5 0.5 0.125  0 0.5 0\n"
                                              "0.5 0 1  0.5 0.5 1.125  0 0.5 1\n"
                                              "0 0 0.5  1 0 0.5  0.5 1 0.5\n"
                                              "0.5 0 0.5  0.5 0.5 0.625  0 0.5 0.5\n")))
             .mesh,
         CellKind::prism15);
  EXPECT_THAT(refusal(folder.write("p.mesh", mesh("1 7 0 1 2 3 4", 5, "0 0 0\n"))),
              HasSubstr("has nodes of order 2 on pyramids, which are not read"));
}

/// A pyramid whose edges are bent. `inside`: the points of its interior in the reference cell.
std::string mfem_pyramid(const std::vector<std::array<double, 3>>& inside, double off = 0) {
  const std::vector<std::array<double, 3>> corners{
      {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<std::array<double, 3>> places = corners;
  for (const auto& [a, b] : std::vector<std::array<std::size_t, 2>>{
           {0, 1}, {1, 2}, {3, 2}, {0, 3}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}) {
    places.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) places.back()[c] = (corners[a][c] + corners[b][c]) / 2;
  }
  places.push_back({0.5, 0.5, 0});
  places.insert(places.end(), inside.begin(), inside.end());
  std::string text =
      "MFEM mesh v1.0\n\ndimension\n3\nelements\n1\n1 7 0 1 2 3 4\nboundary\n0\nvertices\n5\n\n"
      "nodes\nFiniteElementSpace\nFiniteElementCollection: H1_3D_P2\nVDim: 3\nOrdering: 1\n\n";
  for (const auto& [x, y, z] : places)
    text += fmt::format("{} {} {}\n", x + 0.125 * y * y, y,
                        z + 0.25 * x * y + (&places.back()[0] == &x ? off : 0));
  return text;
}

// Bergot's pyramid of order 2 has no node inside, that of Fuentes one between base and apex
TEST(MfemHabits, CurvedPyramidsHaveANodeInsideOrNone) {
  const ScratchFolder folder;
  const std::vector<std::array<double, 3>> inside{{0.25, 0.25, 0.5}};
  for (const auto& nodes : {std::vector<std::array<double, 3>>{}, inside}) {
    SCOPED_TRACE(nodes.size());
    std::string values;
    for (std::size_t i = 0; i < 14 + nodes.size(); ++i) values += "7\n";
    static_cast<void>(folder.write(
        "p.gf", "FiniteElementSpace\nFiniteElementCollection: H1_3D_P2\nVDim: 1\nOrdering: 0\n\n" +
                    values));
    const Reading reading = read_any(folder.write("p.mesh", mfem_pyramid(nodes)));
    ASSERT_EQ(reading.mesh.kinds[0], CellKind::pyramid13);
    EXPECT_THAT(reading.notes, Contains(HasSubstr("loses nothing")));
    const auto reference = reference_nodes(CellKind::pyramid13);
    for (std::size_t n = 0; n < reference.size(); ++n) {
      const auto& [x, y, z] = reference[n];
      const auto found = reading.mesh.position(reading.mesh.cell_nodes(0)[n]);
      EXPECT_NEAR(found[0], x + 0.125 * y * y, 1e-15);
      EXPECT_NEAR(found[1], y, 1e-15);
      EXPECT_NEAR(found[2], z + 0.25 * x * y, 1e-15);
    }
    ASSERT_EQ(reading.mesh.fields.size(), 2U);
    EXPECT_THAT(reading.mesh.fields[1].values.view(), Each(7));
  }
  EXPECT_THAT(refusal(folder.write("q.mesh", mfem_pyramid(inside, 0.0625))),
              HasSubstr("nodes move by up to 0.0625"));
}

TEST(MfemHabits, FunctionsOnPyramidsThatHaveANodeInside) {
  const ScratchFolder folder;
  const std::string mesh = mfem_pyramid({{0.25, 0.25, 0.5}});
  const auto read = [&](const std::string& space, int count) {
    std::string text =
        "FiniteElementSpace\nFiniteElementCollection: " + space + "\nVDim: 1\nOrdering: 0\n\n";
    // x + 2 z of the corners; the others are not asked for
    for (const double value : {0, 1, 1, 0, 2}) text += fmt::format("{}\n", value);
    for (int i = 5; i < count; ++i) text += "0\n";
    static_cast<void>(folder.write("p.gf", text));
    return read_any(folder.write("p.mesh", mesh));
  };
  const Reading linear = read("H1_3D_P1", 5);
  ASSERT_EQ(linear.mesh.fields.size(), 2U);
  EXPECT_THAT(linear.notes, Contains(HasSubstr("loses nothing")));
  const auto reference = reference_nodes(CellKind::pyramid13);
  for (std::size_t n = 0; n < reference.size(); ++n)
    EXPECT_NEAR(linear.mesh.fields[1].values[linear.mesh.cell_nodes(0)[n]],
                reference[n][0] + 2 * reference[n][2], 1e-15);
  const Reading other = read("H1_3D_P2", 14);
  EXPECT_EQ(other.mesh.fields.size(), 1U);
  EXPECT_THAT(other.notes, Contains(HasSubstr("left out 'p', whose pyramids")));
}

// a function of a space that is not read does not stand in the mesh's way
TEST(MfemHabits, FunctionsOfOtherSpacesAreLeftOut) {
  const ScratchFolder folder;
  static_cast<void>(folder.write("a.gf",
                                 "FiniteElementSpace\nFiniteElementCollection: ND_3D_P1\n"
                                 "VDim: 1\nOrdering: 0\n\n1\n2\n3\n4\n5\n6\n"));
  const Reading reading = read_any(folder.write("a.mesh", "MFEM mesh v1.0\n" + kMfemTetrahedron));
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_THAT(reading.notes, Contains(HasSubstr("left out 'a' of the space 'ND_3D_P1'")));
}

}  // namespace
}  // namespace hiac::formats
