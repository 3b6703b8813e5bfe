// Cells beyond the zoo: what loses nothing is turned at once, what loses something is refused, and
// with --approximate turned, with the error that a closed form gives.
#include "formats/common/cells/reduce_cells.hpp"

#include <cmath>
#include <functional>
#include <numeric>

#include <fmt/format.h>

#include "formats/common/cells/lattice.hpp"
#include "formats/common/cells/recognized_cells.hpp"
#include "formats/common/io/written_digits.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::HasSubstr;
using Point = std::array<double, 3>;
using Function = std::function<double(const Point&)>;

/// A cell of a shape with nodes at all points of the lattice, the corners first, the others in an
/// order of no format; its image under an affine map. Fields are functions of the position.
ForeignMesh lattice_cell(CellShape shape, std::size_t order, const Function& f) {
  const CellKind linear = kind_of(shape, CellOrder::linear);
  std::vector<Point> points(reference_nodes(linear).begin(), reference_nodes(linear).end());
  std::vector<Point> others = lattice_of(shape, order).points;
  std::reverse(others.begin(), others.end());
  for (const Point& point : others) {
    const bool corner =
        std::any_of(points.begin(), points.begin() + corner_count(linear), [&](const Point& other) {
          return std::abs(other[0] - point[0]) + std::abs(other[1] - point[1]) +
                     std::abs(other[2] - point[2]) <
                 1e-12;
        });
    if (!corner) points.push_back(point);
  }
  ForeignMesh mesh;
  std::vector<double> values;
  for (const Point& p : points) {
    const Point x{2 * p[0] + 0.25 * p[1], p[1] - 0.5 * p[2], 1.5 * p[2] + 0.125 * p[0]};
    mesh.xyz.insert(mesh.xyz.end(), x.begin(), x.end());
    values.push_back(f(x));
  }
  mesh.types.push_back({"RICH", points.size(), unsupported_with(linear)});
  mesh.cell_types = {0};
  mesh.cell_nodes.resize(points.size());
  std::iota(mesh.cell_nodes.begin(), mesh.cell_nodes.end(), 0);
  mesh.fields.push_back(field_of("f", FieldLocation::node, 1, std::move(values)));
  return mesh;
}

ReadOptions approximate() {
  ReadOptions options;
  options.approximate = true;
  return options;
}

std::string refusal_of(ForeignMesh mesh, const ReadOptions& options = {}) {
  try {
    assemble(std::move(mesh), options, "m");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

void expect_function(const ZooMesh& mesh, const Function& f, double tolerance) {
  for (NodeId node = 0; node < mesh.node_count(); ++node) {
    const auto x = mesh.position(node);
    EXPECT_NEAR(mesh.fields[0].values[node], f({x[0], x[1], x[2]}), tolerance);
  }
}

constexpr std::array<CellShape, 4> kShapes{CellShape::tetrahedron, CellShape::pyramid,
                                           CellShape::prism, CellShape::brick};

TEST(ReduceCells, QuadraticFieldsLoseNothingInCellsOfOrderTwo) {
  // the serendipity kinds have all polynomials of degree 2
  const Function f = [](const Point& x) { return x[0] * x[1] - 2 * x[2] * x[2] + x[0] - 3; };
  for (const CellShape shape : kShapes) {
    const Reading reading = assemble(lattice_cell(shape, 2, f), {}, "m");
    ASSERT_EQ(reading.mesh.kinds[0], kind_of(shape, CellOrder::quadratic));
    EXPECT_THAT(reading.notes, Contains(HasSubstr("loses nothing")));
    expect_function(reading.mesh, f, 0);
  }
}

// Values on the corners of cells, beside a cell that stays as it is: of made nodes they are means,
// of all others the value itself, a negative zero too.
TEST(ReduceCells, FieldsOnCornersFollowTheCells) {
  const Function f = [](const Point& x) { return 3 * x[0] - x[1] + x[2] - 0.5; };
  for (const CellShape shape : kShapes)
    for (const std::size_t order : {2, 5}) {
      ForeignMesh mesh = lattice_cell(shape, order, f);
      mesh.types.push_back({"TETRA", 4, converted_to(CellKind::tetrahedron4)});
      mesh.cell_types.push_back(1);
      const auto first = static_cast<std::int64_t>(mesh.point_count());
      mesh.xyz.insert(mesh.xyz.end(), {9, 0, 0, 10, 0, 0, 9, 1, 0, 9, 0, 1});
      mesh.cell_nodes.insert(mesh.cell_nodes.end(), {first, first + 1, first + 2, first + 3});
      std::vector<double> values;
      for (std::int64_t p = 0; p < first; ++p) {
        const double* x = &mesh.xyz[3 * static_cast<std::size_t>(p)];
        values.push_back(f({x[0], x[1], x[2]}));
      }
      values.insert(values.end(), {7, -0.0, 9, 10});
      mesh.fields = {field_of("c", FieldLocation::corner, 1, std::move(values))};
      const ZooMesh zoo = assemble(std::move(mesh), approximate(), "m").mesh;
      ASSERT_EQ(zoo.cell_count(), 2U);
      ASSERT_EQ(zoo.fields[0].values.size(), zoo.nodes.size());
      const std::size_t kept = zoo.nodes.size() - 4;
      for (std::size_t e = 0; e < kept; ++e) {
        const auto x = zoo.position(zoo.nodes[e]);
        EXPECT_NEAR(zoo.fields[0].values[e], f({x[0], x[1], x[2]}), 1e-13);
      }
      EXPECT_THAT(zoo.fields[0].values.view().subspan(kept), testing::ElementsAre(7, 0, 9, 10));
      EXPECT_TRUE(std::signbit(zoo.fields[0].values[kept + 1]));
    }
}

TEST(ReduceCells, WhatOnlyCentresTellIsRefusedWithTheError) {
  // at the centre of [0, 1]^3 the field's serendipity interpolant is 0, and the field 1
  const Function bubble = [](const Point& x) {
    return x[0] == 1.125 && x[1] == 0.25 && x[2] == 0.8125 ? 1.0 : 0.0;
  };
  const ForeignMesh mesh = lattice_cell(CellShape::brick, 2, bubble);
  EXPECT_THAT(refusal_of(mesh), HasSubstr("1 RICH of 27 nodes"));
  EXPECT_THAT(refusal_of(mesh), HasSubstr("field 'f' errs by up to 1 "));
  const Reading reading = assemble(ForeignMesh(mesh), approximate(), "m");
  EXPECT_EQ(reading.mesh.kinds[0], CellKind::brick20);
  EXPECT_THAT(reading.notes, Contains(HasSubstr("field 'f' errs by up to 1 at nodes")));
}

TEST(ReduceCells, ACentreThatIsMovedIsNotLeftOutSilently) {
  ForeignMesh mesh = lattice_cell(CellShape::brick, 2, [](const Point&) { return 0.0; });
  for (std::size_t p = 8; p < 27; ++p)
    if (mesh.xyz[3 * p] == 1.125 && mesh.xyz[3 * p + 2] == 0.8125) mesh.xyz[3 * p] += 0.0625;
  EXPECT_THAT(refusal_of(mesh), HasSubstr("nodes move by up to 0.0625"));
}

/// A unit tetrahedron's corners and the middles of its edges, which are moved away
/// from its centre.
NodePositions moved_middles(double by) {
  constexpr Point kCentre{0.25, 0.25, 0.25};
  NodePositions cell{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = a + 1; b < 4; ++b) {
      Point middle{};
      for (std::size_t c = 0; c < 3; ++c) {
        const double half = (cell[a][c] + cell[b][c]) / 2;
        middle[c] = half + by / std::sqrt(3.0 / 16) * (half - kCentre[c]);
      }
      cell.push_back(middle);
    }
  return cell;
}

// The root mean square of all ten distances is 2 sqrt(6 / 10) by, in units of half an edge.
TEST(RecognizedCells, HaveNodesWithinAThirdOfTheSpacing) {
  const CellConversion conversion = unsupported_with(CellKind::tetrahedron4);
  const double limit = 1 / (6 * std::sqrt(0.6));
  const auto recognized = [&](double by) {
    const std::vector<NodePositions> cells{moved_middles(by)};
    return recognized_cell(conversion, cells);
  };
  for (const double by : {0.0, 0.5 * limit, 0.999 * limit}) {
    const auto cell = recognized(by);
    ASSERT_TRUE(cell.has_value()) << by;
    EXPECT_EQ(cell->kind, CellKind::tetrahedron10);
    EXPECT_EQ(cell->order, 2U);
    EXPECT_TRUE(cell->left_out.empty());
  }
  EXPECT_FALSE(recognized(1.001 * limit).has_value());
  EXPECT_FALSE(recognized(1.1 * limit).has_value());
}

// coordinates and fields written with 7 digits: nodes in faces are off by their rounding
TEST(ReduceCells, RoundedDigitsAreAllowedAndStated) {
  const auto rounded = [](double value) { return std::stod(fmt::format("{:.6e}", value)); };
  const auto mesh_of = [&](double off) {
    ForeignMesh mesh = lattice_cell(CellShape::brick, 2, [](const Point&) { return 0.0; });
    std::vector<double> values;
    for (std::size_t p = 0; p < 27; ++p) {
      double* x = &mesh.xyz[3 * p];
      const bool centre = x[0] == 1.125 && x[2] == 0.8125;
      for (std::size_t c = 0; c < 3; ++c) x[c] = rounded(x[c] * 3.7 / 3 + 0.1);
      values.push_back(rounded(1e5 * x[0] - 7e4 * x[1] * x[2]));
      if (centre) x[0] = rounded(x[0] + off);
    }
    mesh.fields = {field_of("f", FieldLocation::node, 1, std::move(values))};
    return mesh;
  };
  const Reading reading = assemble(mesh_of(0), {}, "m");
  EXPECT_EQ(reading.mesh.kinds[0], CellKind::brick20);
  EXPECT_THAT(reading.notes, Contains(HasSubstr("but what the digits of the file round: nodes move "
                                                "by up to")));
  // at the centre 8 weights of 1/4 and 12 of 1/4: (1 + 5) / 2 units of 1e-6
  EXPECT_THAT(reading.notes, Contains(HasSubstr("(3 units in the last digit are allowed: 3e-06")));
  EXPECT_EQ(assemble(mesh_of(2e-6), {}, "m").mesh.kinds[0], CellKind::brick20);
  EXPECT_THAT(refusal_of(mesh_of(8e-6)), HasSubstr("need their nodes in faces or inside"));
}

TEST(WrittenDigits, AreThoseOfTheValueWithMost) {
  const auto unit = [](std::vector<double> values) { return unit_of_last_digit(values); };
  EXPECT_DOUBLE_EQ(unit({0.123456, 12.3457, 0.5, 0}), 1e-4);
  EXPECT_DOUBLE_EQ(unit({-987654.321, 1.1}), 1e-3);
  EXPECT_DOUBLE_EQ(unit({1.2345e-7}), 1e-11);
  EXPECT_DOUBLE_EQ(unit({1.2345678901234}), 1e-13);
  EXPECT_EQ(unit({1.23456789012345}), 0);             // fifteen digits: a double's
  EXPECT_EQ(unit({0.1 + 0.2, 0.12345}), 0);           // one of them suffices
  EXPECT_EQ(unit({0.1234, 7.3, 1e6}), 0);             // may be exact
  EXPECT_EQ(unit({0.015625, 0.984375, 1.03125}), 0);  // multiples of 1/64
  EXPECT_EQ(unit({}), 0);
  EXPECT_DOUBLE_EQ(unit({0.15625, 0.12345, std::nan("")}), 1e-5);
}

TEST(ReduceCells, HighOrdersBecomeCubicOnDemand) {
  const Function quadratic = [](const Point& x) { return x[0] * x[1] - x[2] * x[2] + 2 * x[1]; };
  const Function cubic = [](const Point& x) {
    return x[0] * x[0] * x[1] - x[2] * x[2] * x[2] + x[0] * x[1] * x[2];
  };
  for (const CellShape shape : kShapes)
    for (const std::size_t order : {4, 5, 6}) {
      // all of degree 3: the tetrahedron and the brick
      const bool whole = shape == CellShape::tetrahedron || shape == CellShape::brick;
      const Function& f = whole ? cubic : quadratic;
      const ForeignMesh mesh = lattice_cell(shape, order, f);
      EXPECT_THAT(refusal_of(mesh), HasSubstr(fmt::format("of order {}", order)));
      const Reading reading = assemble(ForeignMesh(mesh), approximate(), "m");
      ASSERT_EQ(reading.mesh.kinds[0], kind_of(shape, CellOrder::cubic));
      expect_function(reading.mesh, f, 1e-12);
      EXPECT_THAT(reading.notes, Contains(HasSubstr("loses nothing")));
    }
}

TEST(ReduceCells, NeighboursShareTheNodesThatAreMade) {
  // two tetrahedra of order 4 over one face, the second turned
  const Function f = [](const Point& x) { return x[0] * x[0] * x[0] + x[1] * x[2]; };
  ForeignMesh mesh = lattice_cell(CellShape::tetrahedron, 4, f);
  const std::size_t count = mesh.point_count();
  std::vector<double> values = mesh.fields[0].values();
  // corners 0 1 2 span the lattice's points with no part of corner 3: those are shared
  std::vector<std::int64_t> second(count);
  const double c0[3] = {mesh.xyz[0], mesh.xyz[1], mesh.xyz[2]};
  double normal[3];
  const auto edge = [&](std::size_t p, std::size_t c) { return mesh.xyz[3 * p + c] - c0[c]; };
  for (std::size_t c = 0; c < 3; ++c)
    normal[c] =
        edge(1, (c + 1) % 3) * edge(2, (c + 2) % 3) - edge(1, (c + 2) % 3) * edge(2, (c + 1) % 3);
  const double square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
  for (std::size_t p = 0; p < count; ++p) {
    double height = 0;
    for (std::size_t c = 0; c < 3; ++c) height += normal[c] * edge(p, c);
    second[p] = static_cast<std::int64_t>(p);
    if (std::abs(height) < 1e-12 * square) continue;
    second[p] = static_cast<std::int64_t>(mesh.point_count());
    Point x{};
    for (std::size_t c = 0; c < 3; ++c)
      x[c] = mesh.xyz[3 * p + c] - 2 * height / square * normal[c];
    mesh.xyz.insert(mesh.xyz.end(), x.begin(), x.end());
    values.push_back(f(x));
  }
  // corners 1 and 2 change places: the further nodes are recognized by where they lie
  std::swap(second[1], second[2]);
  mesh.cell_types = {0, 1};
  mesh.types.push_back({"OTHER", count, mesh.types[0].conversion});
  mesh.cell_nodes.insert(mesh.cell_nodes.end(), second.begin(), second.end());
  mesh.fields.clear();
  mesh.fields.push_back(field_of("f", FieldLocation::node, 1, std::move(values)));
  const ZooMesh zoo = assemble(std::move(mesh), approximate(), "m").mesh;
  EXPECT_EQ(zoo.node_count(), 20U + 10U);
  expect_function(zoo, f, 1e-12);
  const FaceAdjacency adjacency = build_face_adjacency(zoo);
  EXPECT_EQ(std::count(adjacency.neighbors.begin(), adjacency.neighbors.end(), kNoCell), 6);
}

/// Prisms over a hexagon, one on the other, told by their faces.
ForeignMesh hexagonal_columns() {
  ForeignMesh mesh;
  std::vector<double> values;
  for (int layer = 0; layer < 3; ++layer)
    for (int i = 0; i < 6; ++i) {
      const double angle = i * std::acos(-1.0) / 3;
      for (const double v : {std::cos(angle), std::sin(angle), 1.0 * layer}) mesh.xyz.push_back(v);
      values.push_back(layer + 0.5 * i);
    }
  for (std::int64_t layer = 0; layer < 2; ++layer) {
    std::vector<std::vector<std::int64_t>> faces(2);
    for (std::int64_t i = 0; i < 6; ++i) {
      const std::int64_t a = 6 * layer + i;
      const std::int64_t b = 6 * layer + (i + 1) % 6;
      faces[0].push_back(a);  // not all turned the same way: that is found out
      faces[1].push_back(a + 6);
      faces.push_back({a, b, b + 6, a + 6});
    }
    mesh.add_polyhedron("hexagonal", faces);
  }
  mesh.fields.push_back(field_of("c", FieldLocation::cell, 1, {3, 4}));
  mesh.fields.push_back(field_of("n", FieldLocation::node, 1, std::move(values)));
  mesh.blocks = {{"upper", {{1, 2}}}};
  return mesh;
}

TEST(ReduceCells, PolyhedraAreDividedConformingly) {
  EXPECT_THAT(refusal_of(hexagonal_columns()), HasSubstr("2 hexagonal"));
  EXPECT_THAT(refusal_of(hexagonal_columns()), HasSubstr("(ReadOptions::approximate divides"));
  const Reading reading = assemble(hexagonal_columns(), approximate(), "m");
  // each: six pyramids, and six tetrahedra over both hexagons
  EXPECT_EQ(reading.mesh.cell_count(), 2U * 18U);
  EXPECT_NEAR(volume_of(reading.mesh), 2 * 1.5 * std::sqrt(3.0), 1e-12);
  const FaceAdjacency adjacency = build_face_adjacency(reading.mesh);
  EXPECT_EQ(std::count(adjacency.neighbors.begin(), adjacency.neighbors.end(), kNoCell), 24);
  EXPECT_EQ(reading.mesh.fields[0].values[0], 3);
  EXPECT_EQ(reading.mesh.fields[0].values[35], 4);
  EXPECT_THAT(reading.notes, Contains(HasSubstr("field 'n' differs by up to 3.5 over")));
  ReadOptions upper = approximate();
  upper.block = "upper";
  EXPECT_EQ(assemble(hexagonal_columns(), upper, "m").mesh.cell_count(), 18U);
}

TEST(ReduceCells, PolyhedraWithTheFacesOfAKindAreThatKind) {
  for (const CellShape shape : {CellShape::tetrahedron, CellShape::pyramid, CellShape::prism,
                                CellShape::wedge, CellShape::brick}) {
    ForeignMesh mesh;
    for (const Point& p : reference_nodes(kind_of(shape, CellOrder::linear)))
      mesh.xyz.insert(mesh.xyz.end(), p.begin(), p.end());
    std::vector<std::vector<std::int64_t>> faces;
    for (const ShapeFace& face : topology_of(shape).faces) {
      faces.emplace_back(face.corners.begin(), face.corners.begin() + face.corner_count);
      if (faces.size() % 2 == 0) std::reverse(faces.back().begin(), faces.back().end());
    }
    mesh.add_polyhedron("poly", faces);
    const ZooMesh zoo = assemble(std::move(mesh), {}, "m").mesh;
    ASSERT_EQ(zoo.cell_count(), 1U);
    EXPECT_EQ(shape_of(zoo.kinds[0]), shape);
    EXPECT_GT(volume_of(zoo), 0);
  }
}

TEST(ReduceCells, OpenPolyhedraAreRefused) {
  ForeignMesh mesh = hexagonal_columns();
  mesh.polyhedra.faces.resize(mesh.polyhedra.faces.size() - 5);
  mesh.polyhedra.ends.back() -= 5;
  EXPECT_THAT(refusal_of(mesh, approximate()), HasSubstr("do not close"));
  mesh = hexagonal_columns();
  std::replace(mesh.polyhedra.faces.begin(), mesh.polyhedra.faces.end(), std::int64_t{17},
               std::int64_t{99});
  EXPECT_THAT(refusal_of(mesh, approximate()), HasSubstr("there is no node 99"));
}

TEST(ReduceCells, EnSightAndXdmfTellPolyhedraByTheirFaces) {
  const ScratchFolder folder;
  // a tetrahedron
  EXPECT_NE(folder.write("t.geo",
                         "a\nb\nnode id off\nelement id off\npart\n1\nt\ncoordinates\n4\n"
                         "0\n1\n0\n0\n0\n0\n1\n0\n0\n0\n0\n1\n"
                         "nfaced\n1\n4\n3\n3\n3\n3\n1 2 3\n1 2 4\n2 3 4\n3 1 4\n"),
            "");
  const ZooMesh ensight = read_any(folder.write("t.case",
                                                "FORMAT\ntype: ensight gold\nGEOMETRY\n"
                                                "model: t.geo\n"))
                              .mesh;
  ASSERT_EQ(ensight.cell_count(), 1U);
  EXPECT_NEAR(volume_of(ensight), 1.0 / 6, 1e-12);
  const ZooMesh xdmf =
      read_any(
          folder.write("t.xdmf",
                       "<Xdmf Version=\"3.0\"><Domain><Grid><Topology TopologyType=\"Mixed\" "
                       "NumberOfElements=\"1\"><DataItem Format=\"XML\" Dimensions=\"18\">16 4 "
                       "3 0 1 2 3 0 1 3 3 1 2 3 3 2 0 3</DataItem></Topology><Geometry "
                       "GeometryType=\"XYZ\"><DataItem Format=\"XML\" Dimensions=\"4 3\">0 0 0 "
                       "1 0 0 0 1 0 0 0 1</DataItem></Geometry></Grid></Domain></Xdmf>"))
          .mesh;
  ASSERT_EQ(xdmf.cell_count(), 1U);
  EXPECT_NEAR(volume_of(xdmf), 1.0 / 6, 1e-12);
}

// ---- cells with repeated nodes

/// The volume inside faces, each the mean of its divisions into triangles.
double volume_within(const ZooMesh& mesh, CellId cell) {
  double six = 0;
  for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces)
    for (std::size_t k = 0; k < face.corner_count; ++k) {
      const auto at = [&](std::size_t i) {
        return mesh.position(mesh.cell_nodes(cell)[face.corners[(k + i) % face.corner_count]]);
      };
      const auto a = at(0), b = at(1), c = at(2);
      // a triangle is met three times, each triangle of a quadrilateral's two divisions once
      six += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
              a[2] * (b[0] * c[1] - b[1] * c[0])) /
             (face.corner_count == 3 ? 3 : 2);
    }
  return six / 6;
}

/// The cube [0, 1]^3 as a brick with these nodes, x + 2 y + 4 z its field.
ForeignMesh cube_of(const std::vector<std::int64_t>& nodes) {
  ForeignMesh mesh;
  std::vector<double> values;
  for (const auto& x : reference_nodes(CellKind::brick8)) {
    mesh.xyz.insert(mesh.xyz.end(), x.begin(), x.end());
    values.push_back(x[0] + 2 * x[1] + 4 * x[2]);
  }
  mesh.types.push_back({"HEX", 8, converted_to(CellKind::brick8)});
  mesh.cell_types = {0};
  mesh.cell_nodes = nodes;
  mesh.fields.push_back(field_of("f", FieldLocation::node, 1, std::move(values)));
  return mesh;
}

TEST(CollapsedCells, OfNoKindAreDividedOnDemand) {
  for (const std::vector<std::int64_t>& nodes : {std::vector<std::int64_t>{0, 1, 0, 3, 4, 5, 6, 7},
                                                 {0, 0, 0, 3, 4, 5, 6, 7},
                                                 {0, 0, 2, 3, 4, 5, 6, 6}}) {
    EXPECT_THAT(refusal_of(cube_of(nodes)),
                HasSubstr("ReadOptions::approximate converts those with repeated nodes"));
    const Reading reading = assemble(cube_of(nodes), approximate(), "m");
    EXPECT_THAT(reading.notes, Contains(HasSubstr("divided 1 cells with repeated nodes")));
    // the volume of the brick whose corners lie there
    ForeignMesh moved = cube_of({0, 1, 2, 3, 4, 5, 6, 7});
    for (std::size_t n = 0; n < 8; ++n)
      for (std::size_t c = 0; c < 3; ++c)
        moved.xyz[3 * n + c] = cube_of(nodes).xyz[3 * static_cast<std::size_t>(nodes[n]) + c];
    const double whole = volume_within(assemble(std::move(moved), {}, "m").mesh, 0);
    double sum = 0;
    for (CellId cell = 0; cell < reading.mesh.cell_count(); ++cell)
      sum += volume_within(reading.mesh, cell);
    EXPECT_NEAR(sum, whole, 1e-15);
    EXPECT_GT(whole, 0.1);
    expect_function(
        reading.mesh, [](const Point& x) { return x[0] + 2 * x[1] + 4 * x[2]; }, 1e-14);
  }
}

TEST(CollapsedCells, WithoutVolumeAreLeftOutOnDemand) {
  ForeignMesh mesh = cube_of({0, 1, 2, 3, 4, 5, 6, 7});
  mesh.cell_types = {0, 0};
  mesh.cell_nodes.insert(mesh.cell_nodes.end(), {0, 1, 2, 3, 0, 1, 2, 3});
  EXPECT_THAT(refusal_of(mesh), HasSubstr("cell 1 with nodes 0 1 2 3 0 1 2 3"));
  const Reading reading = assemble(ForeignMesh(mesh), approximate(), "m");
  EXPECT_EQ(reading.mesh.cell_count(), 1U);
  EXPECT_THAT(reading.notes, Contains("left out 1 cells whose repeated nodes leave no volume"));
}

/// A prism of 15 nodes that is collapsed to an apex: its top is one corner, and each edge of the
/// top has a node of its own, `off` away from the apex.
ForeignMesh collapsed_prism(double off) {
  ForeignMesh mesh;
  std::vector<double> values;
  const auto reference = reference_nodes(CellKind::prism15);
  for (std::size_t n = 0; n < 15; ++n) {
    const Point& x = reference[n];
    const double taper = 1 - x[2];
    mesh.xyz.insert(mesh.xyz.end(), {x[0] * taper, x[1] * taper, x[2]});
    if (n >= 9 && n < 12) mesh.xyz[3 * n] += off;
    values.push_back(n >= 9 && n < 12 ? 2 : 1);
  }
  mesh.types.push_back({"PENTA", 15, converted_to(CellKind::prism15)});
  mesh.cell_types = {0};
  mesh.cell_nodes = {0, 1, 2, 3, 3, 3, 6, 7, 8, 9, 10, 11, 12, 13, 14};
  mesh.fields.push_back(field_of("f", FieldLocation::node, 1, std::move(values)));
  return mesh;
}

TEST(CollapsedCells, WithTheirMidEdgeNodesInPlaceAreTheirTrueKind) {
  const Reading reading = assemble(collapsed_prism(0), {}, "m");
  ASSERT_EQ(reading.mesh.kinds[0], CellKind::tetrahedron10);
  EXPECT_EQ(reading.mesh.node_count(), 10U);
  EXPECT_THAT(reading.notes,
              Contains("3 mid-edge nodes of cells with repeated corners do not follow the corners "
                       "and were left out: nodes move by up to 0, field 'f' errs by up to 1"));
  EXPECT_THAT(reading.notes, Contains(HasSubstr("1 prism15 to tetrahedron10")));
  EXPECT_THAT(refusal_of(collapsed_prism(0.125)), HasSubstr("mid-edge nodes that do not follow"));
  const Reading near = assemble(collapsed_prism(0.125), approximate(), "m");
  EXPECT_EQ(near.mesh.kinds[0], CellKind::tetrahedron10);
  EXPECT_THAT(near.notes,
              Contains(HasSubstr("nodes move by up to 0.125, field 'f' errs by up to 1")));
}

}  // namespace
}  // namespace hiac::formats
