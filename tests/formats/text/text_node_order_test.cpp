// Every format and kind by a one-cell file made from the format's documentation: the cell is
// positively oriented, and the interpolant reproduces polynomials of its order, which it does only
// with every node in its place.
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/one_cell.hpp"
#include "tests/formats/one_cell_files.hpp"

namespace hiac::formats {
namespace {

using Point = std::array<double, 3>;

double quadratic(const Point& x) {
  return 1 + x[0] - 2 * x[1] + 0.5 * x[2] + 0.25 * x[0] * x[0] - 0.5 * x[0] * x[1] +
         0.75 * x[1] * x[2] - 0.125 * x[2] * x[2];
}

Point node_of(const ZooMesh& mesh, std::size_t n) {
  const auto x = mesh.position(mesh.nodes[n]);
  return {x[0], x[1], x[2]};
}

double jacobian(const ZooMesh& mesh, const Point& xi) {
  std::array<std::array<double, 3>, kMaxNodesPerCell> gradients{};
  shape_gradients<double>(mesh.kinds[0], xi, gradients);
  std::array<std::array<double, 3>, 3> j{};
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) j[r][c] += gradients[n][r] * node_of(mesh, n)[c];
  return j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
         j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
         j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
}

class OneCell : public testing::TestWithParam<OneCellFile> {};

TEST_P(OneCell, ReproducesPolynomialsOfItsOrder) {
  const OneCellFile& file = GetParam();
  const ScratchFolder folder;
  const std::string path = folder.write(file.name, file.text);
  EXPECT_EQ(format_to_read(path).name, file.format);
  const Reading reading = format_named(file.format).read(path, {});
  const ZooMesh& mesh = reading.mesh;
  ASSERT_EQ(mesh.cell_count(), 1U);
  ASSERT_EQ(mesh.kinds[0], file.kind);
  const bool linear = order_of(file.kind) == CellOrder::linear;
  const auto f = [&](const Point& x) { return linear ? one_cell_polynomial(x) : quadratic(x); };
  for (const Point& xi : {Point{0.2, 0.3, 0.25}, Point{0.1, 0.15, 0.6}, Point{0.5, 0.05, 0.1}}) {
    EXPECT_GT(jacobian(mesh, xi), 0);
    std::array<double, kMaxNodesPerCell> shape{};
    shape_functions<double>(file.kind, xi, shape);
    Point x{};
    double interpolated = 0;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      const Point node = node_of(mesh, n);
      for (std::size_t c = 0; c < 3; ++c) x[c] += shape[n] * node[c];
      interpolated += shape[n] * f(node);
    }
    // frd files have six digits
    EXPECT_NEAR(interpolated, f(x), file.format == "frd" ? 1e-4 : 1e-12);
  }
  for (const Field& field : mesh.fields) {
    if (field.name != "f") continue;
    for (NodeId n = 0; n < mesh.node_count(); ++n) {
      const auto x = mesh.position(n);
      EXPECT_NEAR(field.values[n], one_cell_polynomial({x[0], x[1], x[2]}), 1e-4);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, OneCell, testing::ValuesIn(one_cell_files()),
                         [](const auto& row) {
                           std::string name = row.param.format + "_" + row.param.name;
                           for (char& c : name)
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           return name;
                         });

TEST(OneCellFiles, FieldsStepsAndUnitsAreRead) {
  const ScratchFolder folder;
  for (const OneCellFile& file : one_cell_files()) {
    if (file.kind != CellKind::tetrahedron4) continue;
    const std::string path = folder.write(file.name, file.text);
    const Inventory inventory = format_named(file.format).inspect(path);
    EXPECT_EQ(inventory.format, file.format);
    const bool has_time = file.format == "gmsh" || file.format == "frd" || file.format == "unv";
    EXPECT_EQ(inventory.times, has_time ? std::vector<double>{0.5} : std::vector<double>{})
        << file.format;
    ReadOptions wrong;
    wrong.time = 7.0;
    EXPECT_THROW(format_named(file.format).read(path, wrong), UsageError) << file.format;
    wrong = {};
    wrong.block = "there is none";
    EXPECT_THROW(format_named(file.format).read(path, wrong), UsageError) << file.format;
  }
}

// ---- results with their mesh in files beside or in one document

/// Bottom edges, top edges, upright edges: EnSight User Manual, section 9.1 (tetra10 ... hexa20);
/// and the XDMF Model and Format, whose cells are VTK's.
const std::vector<std::pair<int, int>> kTetraEdges{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
const std::vector<std::pair<int, int>> kPyramidEdges{{0, 1}, {1, 2}, {2, 3}, {3, 0},
                                                     {0, 4}, {1, 4}, {2, 4}, {3, 4}};
const std::vector<std::pair<int, int>> kPrismEdges{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5},
                                                   {5, 3}, {0, 3}, {1, 4}, {2, 5}};
const std::vector<std::pair<int, int>> kBrickEdges{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                                   {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

std::vector<DocumentedElement> all_elements(const std::vector<std::string>& names) {
  using K = CellKind;
  return {{names[0], K::tetrahedron4, kTetraCorners, {}},
          {names[1], K::tetrahedron10, kTetraCorners, kTetraEdges, 1},
          {names[2], K::pyramid5, kPyramidCorners, {}},
          {names[3], K::pyramid13, kPyramidCorners, kPyramidEdges, 1},
          {names[4], K::prism6, kPrismCorners, {}},
          {names[5], K::prism15, kPrismCorners, kPrismEdges, 1},
          {names[6], K::brick8, kBrickCorners, {}},
          {names[7], K::brick20, kBrickCorners, kBrickEdges, 1}};
}

TEST(OneCellResults, EnSight) {
  for (const DocumentedElement& element :
       all_elements({"tetra4", "tetra10", "pyramid5", "pyramid13", "penta6", "penta15", "hexa8",
                     "hexa20"})) {
    const std::vector<Vector> points = placed_points(element);
    std::string geometry = fmt::format(
        "one\ncell\nnode id off\nelement id off\npart\n{:10}\none\ncoordinates\n{:10}\n", 1,
        points.size());
    for (std::size_t c = 0; c < 3; ++c)
      for (const Vector& point : points) geometry += fmt::format("{:12.5e}\n", point[c]);
    geometry += fmt::format("{}\n{:10}\n", element.name, 1);
    for (std::size_t n = 1; n <= points.size(); ++n) geometry += fmt::format("{:10}", n);
    std::string values = fmt::format("p\npart\n{:10}\ncoordinates\n", 1);
    for (const Vector& point : points)
      values += fmt::format("{:.16e}\n", polynomial(element.kind, point));
    const ScratchFolder folder;
    EXPECT_NE(folder.write("c.geo", geometry + "\n"), "");
    EXPECT_NE(folder.write("c.p", values), "");
    const std::string path = folder.write(
        "c.case",
        "FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: c.geo\nVARIABLE\nscalar per node: p c.p\n");
    expect_one_cell(read_any(path).mesh, element);
  }
}

TEST(OneCellResults, Xdmf) {
  for (DocumentedElement element :
       all_elements({"Tetrahedron", "Tetrahedron_10", "Pyramid", "Pyramid_13", "Wedge", "Wedge_15",
                     "Hexahedron", "Hexahedron_20"})) {
    // vtkWedge.h: the normal of the first triangle points outward, away from the other
    if (shape_of(element.kind) == CellShape::prism) {
      std::swap(element.corners[1], element.corners[2]);
      std::swap(element.corners[4], element.corners[5]);
    }
    const std::vector<Vector> points = placed_points(element);
    std::string xyz;
    std::string nodes;
    std::string values;
    for (std::size_t n = 0; n < points.size(); ++n) {
      xyz += fmt::format("{} {} {}\n", points[n][0], points[n][1], points[n][2]);
      nodes += fmt::format("{} ", n);
      values += fmt::format("{} ", polynomial(element.kind, points[n]));
    }
    const ScratchFolder folder;
    const std::string path = folder.write(
        "c.xdmf",
        fmt::format("<Xdmf Version=\"3.0\"><Domain><Grid Name=\"g\"><Topology TopologyType=\"{0}\" "
                    "NumberOfElements=\"1\"><DataItem Dimensions=\"1 {1}\" NumberType=\"Int\">{2}"
                    "</DataItem></Topology><Geometry GeometryType=\"XYZ\"><DataItem Dimensions=\""
                    "{1} 3\">{3}</DataItem></Geometry><Attribute Name=\"p\" Center=\"Node\">"
                    "<DataItem Dimensions=\"{1}\">{4}</DataItem></Attribute></Grid></Domain>"
                    "</Xdmf>",
                    element.name, points.size(), nodes, xyz, values));
    expect_one_cell(read_any(path).mesh, element);
  }
}

}  // namespace
}  // namespace hiac::formats
