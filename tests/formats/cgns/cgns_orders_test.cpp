// The node order of every element that is read from CGNS files, by files of one cell written
// through the CGNS library. The elements as in the Standard Interface Data Structures, section 3.3.
#include <cgns_io.h>
#include <cgnslib.h>

#include "formats/cgns/element_types.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/one_cell.hpp"

namespace hiac::formats {
namespace {

const std::vector<std::pair<int, int>> kTetra{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
const std::vector<std::pair<int, int>> kPyramid{{0, 1}, {1, 2}, {2, 3}, {3, 0},
                                                {0, 4}, {1, 4}, {2, 4}, {3, 4}};
const std::vector<std::pair<int, int>> kPrism{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4},
                                              {2, 5}, {3, 4}, {4, 5}, {5, 3}};
const std::vector<std::pair<int, int>> kBrick{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 5},
                                              {2, 6}, {3, 7}, {4, 5}, {5, 6}, {6, 7}, {7, 4}};

struct Element {
  CGNS_ENUMT(ElementType_t) type;
  DocumentedElement documented;
};

const std::vector<Element> kElements{
    {CGNS_ENUMV(TETRA_4), {"TETRA_4", CellKind::tetrahedron4, kTetraCorners, {}}},
    {CGNS_ENUMV(TETRA_10), {"TETRA_10", CellKind::tetrahedron10, kTetraCorners, kTetra, 1}},
    {CGNS_ENUMV(TETRA_20),
     {"TETRA_20",
      CellKind::tetrahedron20,
      kTetraCorners,
      kTetra,
      2,
      {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}}},
    {CGNS_ENUMV(PYRA_5), {"PYRA_5", CellKind::pyramid5, kPyramidCorners, {}}},
    {CGNS_ENUMV(PYRA_13), {"PYRA_13", CellKind::pyramid13, kPyramidCorners, kPyramid, 1}},
    {CGNS_ENUMV(PYRA_21), {"PYRA_21", CellKind::pyramid21, kPyramidCorners, kPyramid, 2}},
    {CGNS_ENUMV(PENTA_6), {"PENTA_6", CellKind::prism6, kPrismCorners, {}}},
    {CGNS_ENUMV(PENTA_15), {"PENTA_15", CellKind::prism15, kPrismCorners, kPrism, 1}},
    {CGNS_ENUMV(PENTA_24), {"PENTA_24", CellKind::prism24, kPrismCorners, kPrism, 2}},
    {CGNS_ENUMV(HEXA_8), {"HEXA_8", CellKind::brick8, kBrickCorners, {}}},
    {CGNS_ENUMV(HEXA_20), {"HEXA_20", CellKind::brick20, kBrickCorners, kBrick, 1}},
    {CGNS_ENUMV(HEXA_32), {"HEXA_32", CellKind::brick32, kBrickCorners, kBrick, 2}},
};

void check(int status) { ASSERT_EQ(status, CG_OK) << cg_get_error(); }

void write_cell(const std::string& path, const Element& element, int sort) {
  const std::vector<Vector> points = placed_points(element.documented);
  int file = 0;
  int base = 0;
  int zone = 0;
  int id = 0;
  int solution = 0;
  check(cg_set_file_type(sort));
  check(cg_open(path.c_str(), CG_MODE_WRITE, &file));
  check(cg_base_write(file, "base", 3, 3, &base));
  const std::array<cgsize_t, 3> size{static_cast<cgsize_t>(points.size()), 1, 0};
  check(cg_zone_write(file, base, "zone", size.data(), CGNS_ENUMV(Unstructured), &zone));
  constexpr std::array<const char*, 3> kNames{"CoordinateX", "CoordinateY", "CoordinateZ"};
  for (std::size_t d = 0; d < 3; ++d) {
    std::vector<double> axis;
    for (const Vector& p : points) axis.push_back(p[d]);
    check(cg_coord_write(file, base, zone, CGNS_ENUMV(RealDouble), kNames[d], axis.data(), &id));
  }
  std::vector<cgsize_t> nodes;
  std::vector<double> values;
  for (std::size_t i = 0; i < points.size(); ++i) {
    nodes.push_back(static_cast<cgsize_t>(i + 1));
    values.push_back(polynomial(element.documented.kind, points[i]));
  }
  check(cg_section_write(file, base, zone, "cells", element.type, 1, 1, 0, nodes.data(), &id));
  check(cg_sol_write(file, base, zone, "solution", CGNS_ENUMV(Vertex), &solution));
  check(
      cg_field_write(file, base, zone, solution, CGNS_ENUMV(RealDouble), "p", values.data(), &id));
  check(cg_close(file));
}

TEST(CgnsOrders, OneCellFilesHavePositiveJacobiansAndTheirField) {
  const ScratchFolder folder;
  for (const Element& element : kElements)
    for (const int sort : {CG_FILE_HDF5, CG_FILE_ADF}) {
      const std::string path = folder.file("cell.cgns");
      std::filesystem::remove(path);
      write_cell(path, element, sort);
      ASSERT_EQ(format_to_read(path).name, "cgns");
      expect_one_cell(read_any(path).mesh, element.documented);
    }
}

/// Before CGNS 4 every list came behind its length, and there were no offsets.
void put_counts_inline(const std::string& path, const std::string& section,
                       const std::vector<cgsize_t>& lists, const std::vector<cgsize_t>& starts) {
  std::vector<std::int32_t> numbers;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
    numbers.push_back(static_cast<std::int32_t>(starts[i + 1] - starts[i]));
    for (cgsize_t at = starts[i]; at < starts[i + 1]; ++at)
      numbers.push_back(static_cast<std::int32_t>(lists[static_cast<std::size_t>(at)]));
  }
  int file = 0;
  double root = 0;
  double parent = 0;
  double node = 0;
  check(cgio_open_file(path.c_str(), 'm', CGIO_FILE_NONE, &file));
  check(cgio_get_root_id(file, &root));
  check(cgio_get_node_id(file, root, ("/base/zone/" + section).c_str(), &parent));
  check(cgio_get_node_id(file, parent, "ElementStartOffset", &node));
  check(cgio_delete_node(file, parent, node));
  check(cgio_get_node_id(file, parent, "ElementConnectivity", &node));
  const auto size = static_cast<cgsize_t>(numbers.size());
  check(cgio_set_dimensions(file, node, "I4", 1, &size));
  check(cgio_write_all_data(file, node, numbers.data()));
  check(cgio_close_file(file));
}

/// The linear kind of an element whose name begins so; nothing for points, lines and surfaces.
std::optional<CellKind> corners_by_name(const std::string& name) {
  if (name.starts_with("TETRA_")) return CellKind::tetrahedron4;
  if (name.starts_with("PYRA_")) return CellKind::pyramid5;
  if (name.starts_with("PENTA_")) return CellKind::prism6;
  if (name.starts_with("HEXA_")) return CellKind::brick8;
  return std::nullopt;
}

TEST(CgnsTypes, HaveTheNamesAndNodesOfTheLibrary) {
  EXPECT_EQ(cgns::kMixed, CGNS_ENUMV(MIXED));
  EXPECT_EQ(cgns::kPolygons, CGNS_ENUMV(NGON_n));
  EXPECT_EQ(cgns::kPolyhedra, CGNS_ENUMV(NFACE_n));
  for (int number = -1; number < NofValidElementTypes + 60; ++number) {
    const auto type = cgns::element_numbered(number);
    const bool single = number >= CGNS_ENUMV(NODE) && number < NofValidElementTypes &&
                        number != cgns::kMixed && number != cgns::kPolygons &&
                        number != cgns::kPolyhedra;
    ASSERT_EQ(type.has_value(), single) << number;
    if (!single) continue;
    const std::string name = ElementTypeName[number];
    int nodes = 0;
    check(cg_npe(static_cast<CGNS_ENUMT(ElementType_t)>(number), &nodes));
    EXPECT_EQ(type->name, name);
    EXPECT_EQ(type->nodes, static_cast<std::size_t>(nodes)) << name;
    const CellConversion& conversion = type->conversion;
    const auto corners = corners_by_name(name);
    if (!corners) {
      EXPECT_EQ(conversion.fate, CellFate::no_volume) << name;
    } else if (conversion.fate == CellFate::converted) {
      EXPECT_EQ(shape_of(conversion.kind), shape_of(*corners)) << name;
      EXPECT_EQ(node_count(conversion.kind), type->nodes) << name;
    } else {
      EXPECT_EQ(conversion.fate, CellFate::unsupported) << name;
      EXPECT_EQ(conversion.corners, corners) << name;
      EXPECT_EQ(conversion.permutation.empty(), *corners != CellKind::prism6) << name;
    }
  }
}

// Two bricks side by side, told by their faces: the shared one is entered from its back.
TEST(CgnsPolyhedra, FacesMakeTheirCells) {
  const ScratchFolder folder;
  const std::string path = folder.file("poly.cgns");
  int file = 0;
  int base = 0;
  int zone = 0;
  int id = 0;
  check(cg_set_file_type(CG_FILE_HDF5));
  check(cg_open(path.c_str(), CG_MODE_WRITE, &file));
  check(cg_base_write(file, "base", 3, 3, &base));
  const std::array<cgsize_t, 3> size{12, 2, 0};
  check(cg_zone_write(file, base, "zone", size.data(), CGNS_ENUMV(Unstructured), &zone));
  constexpr std::array<const char*, 3> kNames{"CoordinateX", "CoordinateY", "CoordinateZ"};
  for (int d = 0; d < 3; ++d) {
    std::vector<double> axis;
    for (int n = 0; n < 12; ++n) axis.push_back(d == 0 ? n % 3 : d == 1 ? n / 3 % 2 : n / 6);
    check(cg_coord_write(file, base, zone, CGNS_ENUMV(RealDouble), kNames[d], axis.data(), &id));
  }
  // faces 1 to 11 by their nodes; 4 lies between the bricks
  const std::vector<std::array<cgsize_t, 4>> faces{
      {1, 4, 5, 2},   {2, 5, 6, 3}, {1, 7, 10, 4}, {2, 5, 11, 8},  {3, 6, 12, 9}, {7, 8, 11, 10},
      {8, 9, 12, 11}, {1, 2, 8, 7}, {2, 3, 9, 8},  {4, 10, 11, 5}, {5, 11, 12, 6}};
  std::vector<cgsize_t> polygons;
  std::vector<cgsize_t> starts{0};
  for (const auto& face : faces) {
    polygons.insert(polygons.end(), face.begin(), face.end());
    starts.push_back(static_cast<cgsize_t>(polygons.size()));
  }
  check(cg_poly_section_write(file, base, zone, "faces", CGNS_ENUMV(NGON_n), 1, 11, 0,
                              polygons.data(), starts.data(), &id));
  const std::vector<cgsize_t> cells{1, 3, 4, 6, 8, 10, 2, -4, 5, 7, 9, 11};
  const std::array<cgsize_t, 3> cell_starts{0, 6, 12};
  check(cg_poly_section_write(file, base, zone, "cells", CGNS_ENUMV(NFACE_n), 12, 13, 0,
                              cells.data(), cell_starts.data(), &id));
  check(cg_close(file));
  for (const bool inlined : {false, true}) {
    if (inlined) {
      put_counts_inline(path, "faces", polygons, {starts.begin(), starts.end()});
      put_counts_inline(path, "cells", cells, {cell_starts.begin(), cell_starts.end()});
    }
    const Reading reading = read_any(path);
    EXPECT_EQ(reading.mesh.cell_count(), 2U);
    EXPECT_EQ(reading.mesh.kinds[1], CellKind::brick8);
    EXPECT_THAT(reading.notes, testing::Contains(testing::HasSubstr("2 polyhedra have the faces")));
  }
}

}  // namespace
}  // namespace hiac::formats
