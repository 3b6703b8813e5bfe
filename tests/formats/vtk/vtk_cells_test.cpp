// The node order of every kind that is read from VTK's cells, proven against VTK's own parametric
// coordinates, and by files of one cell with a polynomial field.
#include <cmath>

#include <fmt/format.h>
#include <vtkCell.h>
#include <vtkCellType.h>
#include <vtkGenericCell.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>

#include "formats/vtk/cell_types.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using Vector = std::array<double, 3>;

struct Type {
  int vtk;
  std::size_t nodes;
  CellKind kind;
};

const std::vector<Type> kTypes{
    {VTK_TETRA, 4, CellKind::tetrahedron4},
    {VTK_VOXEL, 8, CellKind::brick8},
    {VTK_HEXAHEDRON, 8, CellKind::brick8},
    {VTK_WEDGE, 6, CellKind::prism6},
    {VTK_PYRAMID, 5, CellKind::pyramid5},
    {VTK_QUADRATIC_TETRA, 10, CellKind::tetrahedron10},
    {VTK_QUADRATIC_HEXAHEDRON, 20, CellKind::brick20},
    {VTK_QUADRATIC_WEDGE, 15, CellKind::prism15},
    {VTK_QUADRATIC_PYRAMID, 13, CellKind::pyramid13},
    {VTK_LAGRANGE_TETRAHEDRON, 4, CellKind::tetrahedron4},
    {VTK_LAGRANGE_TETRAHEDRON, 10, CellKind::tetrahedron10},
    {VTK_LAGRANGE_TETRAHEDRON, 20, CellKind::tetrahedron20},
    {VTK_LAGRANGE_HEXAHEDRON, 8, CellKind::brick8},
    {VTK_LAGRANGE_WEDGE, 6, CellKind::prism6},
    {VTK_BEZIER_TETRAHEDRON, 4, CellKind::tetrahedron4},
    {VTK_BEZIER_HEXAHEDRON, 8, CellKind::brick8},
    {VTK_BEZIER_WEDGE, 6, CellKind::prism6},
};

std::vector<Vector> vtk_coordinates(const Type& type) {
  const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type.vtk));
  const auto nodes = static_cast<vtkIdType>(type.nodes);
  cell->GetPointIds()->SetNumberOfIds(nodes);
  cell->GetPoints()->SetNumberOfPoints(nodes);
  cell->Initialize();
  const double* coordinates = cell->GetParametricCoords();
  std::vector<Vector> result(type.nodes);
  for (std::size_t i = 0; i < type.nodes; ++i)
    result[i] = {coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]};
  return result;
}

/// VTK's parametric coordinates in those of the zoo's reference cell. VTK's prism coordinates are
/// left-handed for a prism as VTK documents it; its pyramid's are a brick's with a collapsed face.
Vector to_reference(CellShape shape, const Vector& p) {
  if (shape == CellShape::prism) return {p[1], p[0], p[2]};
  if (shape == CellShape::pyramid) return {p[0] * (1 - p[2]), p[1] * (1 - p[2]), p[2]};
  return p;
}

TEST(VtkCells, ParametricCoordinatesAreTheReferenceNodes) {
  for (const Type& type : kTypes) {
    const CellConversion conversion = vtk::conversion_of(type.vtk, type.nodes);
    ASSERT_EQ(conversion.fate, CellFate::converted) << type.vtk;
    ASSERT_EQ(conversion.kind, type.kind) << type.vtk;
    const auto coordinates = vtk_coordinates(type);
    const auto reference = reference_nodes(type.kind);
    for (std::size_t i = 0; i < type.nodes; ++i) {
      const std::size_t source = conversion.permutation.empty() ? i : conversion.permutation[i];
      const Vector p = to_reference(shape_of(type.kind), coordinates[source]);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(p[c], reference[i][c], 1e-15)
            << vtk::cell_type_name(type.vtk) << " of " << type.nodes << ", node " << i;
    }
  }
}

TEST(VtkCells, ZooKindsNameTheirVtkTypes) {
  for (const Type& type : kTypes) {
    const auto named = vtk_cell_type(type.kind);
    if (named && type.vtk == *named) {
      EXPECT_TRUE(vtk::conversion_of(type.vtk, type.nodes).permutation.empty());
    }
  }
}

/// A right-handed affine map.
Vector affine(const Vector& p) {
  return {2 + 1.5 * p[0] + 0.25 * p[1], -1 + p[1] + 0.5 * p[2], 0.5 + 0.125 * p[0] + 2 * p[2]};
}

double polynomial(const Vector& x) { return 1 + x[0] - 2 * x[1] * x[2] + x[0] * x[0] * x[2]; }

double smallest_jacobian(const ZooMesh& mesh) {
  const CellKind kind = mesh.kinds[0];
  const auto nodes = mesh.cell_nodes(0);
  std::vector<Vector> gradients(nodes.size());
  double smallest = 1e300;
  // inside the cell: at a pyramid's apex the gradients have no single value
  for (const Vector& at : reference_nodes(kind)) {
    Vector xi{};
    for (std::size_t c = 0; c < 3; ++c) xi[c] = 0.25 + 0.1 * (at[c] - 0.25);
    shape_gradients<double>(kind, xi, gradients);
    std::array<Vector, 3> j{};
    for (std::size_t n = 0; n < nodes.size(); ++n)
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) j[r][c] += mesh.position(nodes[n])[r] * gradients[n][c];
    smallest = std::min(smallest, j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
                                      j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
                                      j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]));
  }
  return smallest;
}

TEST(VtkCells, OneCellFilesHavePositiveJacobiansAndTheirField) {
  const ScratchFolder folder;
  for (const Type& type : kTypes) {
    std::string points;
    std::string ids;
    std::string values;
    std::size_t next = 0;
    for (const Vector& p : vtk_coordinates(type)) {
      const Vector x = affine(to_reference(shape_of(type.kind), p));
      points += fmt::format("{} {} {}\n", x[0], x[1], x[2]);
      values += fmt::format("{}\n", polynomial(x));
      ids += fmt::format("{} ", next++);
    }
    const std::string path = folder.write(
        "cell.vtk", one_cell_file(points, type.nodes, ids, type.nodes, type.vtk) +
                        fmt::format("POINT_DATA {}\nSCALARS p double\nLOOKUP_TABLE default\n{}",
                                    type.nodes, values));
    const ZooMesh mesh = read_any(path).mesh;
    ASSERT_EQ(mesh.cell_count(), 1U);
    EXPECT_EQ(mesh.kinds[0], type.kind);
    EXPECT_GT(smallest_jacobian(mesh), 0) << vtk::cell_type_name(type.vtk);
    ASSERT_EQ(mesh.fields.size(), 1U);
    const auto reference = reference_nodes(type.kind);
    const auto nodes = mesh.cell_nodes(0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Vector x = affine(reference[i]);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(mesh.position(nodes[i])[c], x[c], 1e-14);
      EXPECT_NEAR(mesh.fields[0].values[nodes[i]], polynomial(x), 1e-13);
    }
  }
}

TEST(VtkCells, CornersOfUnsupportedOrdersAreKnown) {
  const CellConversion conversion = vtk::conversion_of(VTK_TRIQUADRATIC_HEXAHEDRON, 27);
  EXPECT_EQ(conversion.fate, CellFate::unsupported);
  EXPECT_EQ(conversion.corners, CellKind::brick8);
  EXPECT_EQ(vtk::conversion_of(VTK_LAGRANGE_TETRAHEDRON, 35).corners, CellKind::tetrahedron4);
  EXPECT_EQ(vtk::conversion_of(VTK_TETRA, 3).fate, CellFate::wrong);
  EXPECT_EQ(vtk::conversion_of(VTK_QUAD, 4).fate, CellFate::no_volume);
  EXPECT_EQ(vtk::conversion_of(VTK_POLYHEDRON, 0).fate, CellFate::unsupported);
  EXPECT_EQ(vtk::conversion_of(200, 4).fate, CellFate::unsupported);
}

/// A legacy file of several cells: their points one after the other.
std::string cells_file(const std::vector<std::pair<int, std::vector<Vector>>>& cells) {
  std::string points;
  std::string lists;
  std::string types;
  std::size_t next = 0;
  std::size_t size = 0;
  for (const auto& [type, own] : cells) {
    lists += fmt::format("{}", own.size());
    for (const Vector& p : own) {
      points += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
      lists += fmt::format(" {}", next++);
    }
    lists += "\n";
    types += fmt::format("{}\n", type);
    size += own.size() + 1;
  }
  return fmt::format(
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} "
      "double\n{}CELLS {} {}\n{}CELL_TYPES {}\n{}",
      next, points, cells.size(), size, lists, cells.size(), types);
}

TEST(VtkCells, UnsupportedCellsAreRefusedSkippedOrReducedOnDemand) {
  const ScratchFolder folder;
  const std::vector<Vector> tetrahedron{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<Vector> hexagonal;
  for (int i = 0; i < 12; ++i)
    hexagonal.push_back({5 + std::cos(i % 6 * std::acos(0.5)), std::sin(i % 6 * std::acos(0.5)),
                         static_cast<double>(i / 6)});
  Type rich{VTK_TRIQUADRATIC_HEXAHEDRON, 27, CellKind::brick20};
  std::vector<Vector> brick = vtk_coordinates(rich);
  for (Vector& p : brick) p = {9 + p[0] + 0.125 * p[1] * p[1], p[1], p[2] + 0.25 * p[0] * p[1]};
  const std::string with_prism =
      folder.write("p.vtk", cells_file({{VTK_TETRA, tetrahedron},
                                        {VTK_HEXAGONAL_PRISM, hexagonal},
                                        {VTK_TRIQUADRATIC_HEXAHEDRON, brick}}));
  EXPECT_THAT(refusal(with_prism), testing::HasSubstr("1 HexagonalPrism"));
  EXPECT_THAT(refusal(with_prism), testing::HasSubstr(with_prism));
  ReadOptions options;
  options.skip_unsupported = true;
  const Reading skipped = read_any(with_prism, options);
  ASSERT_EQ(skipped.mesh.cell_count(), 2U);
  EXPECT_EQ(skipped.mesh.kinds[1], CellKind::brick20);
  EXPECT_EQ(skipped.mesh.node_count(), 24U);
  const auto nodes = skipped.mesh.cell_nodes(1);
  for (std::size_t n = 0; n < 20; ++n) {
    const auto& p = reference_nodes(CellKind::brick20)[n];
    const auto x = skipped.mesh.position(nodes[n]);
    EXPECT_NEAR(x[0], 9 + p[0] + 0.125 * p[1] * p[1], 1e-14) << n;
    EXPECT_NEAR(x[2], p[2] + 0.25 * p[0] * p[1], 1e-14) << n;
  }
  options.corners_of_unsupported = true;
  EXPECT_EQ(read_any(with_prism, options).mesh.kinds[1], CellKind::brick8);
  const std::vector<Vector> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_THAT(refusal(folder.write("q.vtk", cells_file({{VTK_QUAD, square}, {VTK_QUAD, square}}))),
              testing::HasSubstr("2 Quad"));
}

}  // namespace
}  // namespace hiac::formats
