// The node order of every element that is read from MED files, and fields on nodes, cells and
// cells' nodes, by files of one cell written through MED-fichier. The elements as in its
// documentation, "Elements de reference": the normal of the first face points out of the cell.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <med.h>

#include "formats/med/element_types.hpp"
#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/damage.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/one_cell.hpp"

namespace hiac::formats {
namespace {

struct Element {
  med_geometry_type type;
  DocumentedElement documented;
};

const std::vector<Vector> kTetra{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
const std::vector<Vector> kPyramid{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 1}};
const std::vector<Vector> kPrism{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}};
const std::vector<Vector> kHexa{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0},
                                {0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};

const std::vector<Element> kElements{
    {MED_TETRA4, {"TE4", CellKind::tetrahedron4, kTetra, {}}},
    {MED_TETRA10,
     {"T10", CellKind::tetrahedron10, kTetra, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}, 1}},
    {MED_PYRA5, {"PY5", CellKind::pyramid5, kPyramid, {}}},
    {MED_PYRA13,
     {"P13",
      CellKind::pyramid13,
      kPyramid,
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
      1}},
    {MED_PENTA6, {"PE6", CellKind::prism6, kPrism, {}}},
    {MED_PENTA15,
     {"P15",
      CellKind::prism15,
      kPrism,
      {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
      1}},
    {MED_HEXA8, {"HE8", CellKind::brick8, kHexa, {}}},
    {MED_HEXA20,
     {"H20",
      CellKind::brick20,
      kHexa,
      {{0, 1},
       {1, 2},
       {2, 3},
       {3, 0},
       {4, 5},
       {5, 6},
       {6, 7},
       {7, 4},
       {0, 4},
       {1, 5},
       {2, 6},
       {3, 7}},
      1}},
};

void check(med_err status) { ASSERT_GE(status, 0); }

constexpr const char* kAxes = "x               y               z               ";
constexpr const char* kUnits = "mm              mm              mm              ";
constexpr const char* kOne = "p               ";

/// Which field the file has: on nodes, on cells' nodes, or on cells.
enum class Support { nodes, corners, cells };

void write_cell(const std::string& path, const Element& element, Support support) {
  const std::vector<Vector> points = placed_points(element.documented);
  const auto count = static_cast<med_int>(points.size());
  const med_idt file = MEDfileOpen(path.c_str(), MED_ACC_CREAT);
  ASSERT_GE(file, 0);
  check(MEDmeshCr(file, "mesh", 3, 3, MED_UNSTRUCTURED_MESH, "one cell", "s", MED_SORT_DTIT,
                  MED_CARTESIAN, kAxes, kUnits));
  std::vector<double> values;
  std::vector<med_int> nodes;
  for (const Vector& p : points) {
    nodes.push_back(static_cast<med_int>(nodes.size() + 1));
    values.push_back(polynomial(element.documented.kind, p));
  }
  check(MEDmeshNodeCoordinateWr(file, "mesh", MED_NO_DT, MED_NO_IT, 0, MED_FULL_INTERLACE, count,
                                points.front().data()));
  check(MEDmeshElementConnectivityWr(file, "mesh", MED_NO_DT, MED_NO_IT, 0, MED_CELL, element.type,
                                     MED_NODAL, MED_FULL_INTERLACE, 1, nodes.data()));
  check(
      MEDfieldCr(file, "p", MED_FLOAT64, 1, kOne, "Pa              ", "s               ", "mesh"));
  const med_entity_type entity = support == Support::nodes     ? MED_NODE
                                 : support == Support::corners ? MED_NODE_ELEMENT
                                                               : MED_CELL;
  check(MEDfieldValueWr(file, "p", 1, MED_NO_IT, 0.5, entity,
                        support == Support::nodes ? MED_NONE : element.type, MED_FULL_INTERLACE,
                        MED_ALL_CONSTITUENT, support == Support::nodes ? count : 1,
                        reinterpret_cast<const unsigned char*>(values.data())));
  check(MEDfileClose(file));
}

TEST(MedOrders, OneCellFilesHavePositiveJacobiansAndTheirField) {
  const ScratchFolder folder;
  for (const Element& element : kElements)
    for (const Support support : {Support::nodes, Support::corners}) {
      const std::string path = folder.file("cell.med");
      std::filesystem::remove(path);
      write_cell(path, element, support);
      ASSERT_EQ(format_to_read(path).name, "med");
      const ZooMesh mesh = read_any(path).mesh;
      expect_one_cell(mesh, element.documented);
      EXPECT_EQ(mesh.fields[0].unit, "Pa");
      EXPECT_EQ(mesh.fields[0].location,
                support == Support::nodes ? FieldLocation::node : FieldLocation::corner);
    }
}

TEST(MedOrders, FieldsOnCellsAndStepsAreRead) {
  const ScratchFolder folder;
  const std::string path = folder.file("cell.med");
  write_cell(path, kElements.front(), Support::cells);
  const Reading reading = read_any(path);
  ASSERT_EQ(reading.mesh.fields.size(), 1U);
  EXPECT_EQ(reading.mesh.fields[0].location, FieldLocation::cell);
  EXPECT_EQ(reading.mesh.fields[0].values[0],
            polynomial(CellKind::tetrahedron4, placed(kTetra[0])));
  EXPECT_EQ(format_to_read(path).inspect(path).times, std::vector<double>{0.5});
}

/// Values of a field at a step, on a type's cells or, of type MED_NONE, on nodes; of a profile's
/// items alone where one is named.
void put_values(med_idt file, const char* field, med_int step, med_geometry_type type,
                const std::vector<double>& values, med_int count, const char* profile = "") {
  check(MEDfieldValueWithProfileWr(file, field, step, MED_NO_IT, 0.5 * static_cast<double>(step),
                                   type == MED_NONE ? MED_NODE : MED_CELL, type, MED_GLOBAL_STMODE,
                                   profile, "", MED_FULL_INTERLACE, MED_ALL_CONSTITUENT, count,
                                   reinterpret_cast<const unsigned char*>(values.data())));
}

constexpr const char* kThree = "x               y               z               ";
constexpr const char* kThreeUnits = "m/s             m/s             m/s             ";

/// Two tetrahedra over one face and a pyramid apart, families of cells, and fields of two steps.
void write_three_cells(const std::string& path) {
  const med_idt file = MEDfileOpen(path.c_str(), MED_ACC_CREAT);
  ASSERT_GE(file, 0);
  check(MEDmeshCr(file, "mesh", 3, 3, MED_UNSTRUCTURED_MESH, "three", "s", MED_SORT_DTIT,
                  MED_CARTESIAN, kAxes, kUnits));
  const std::array<double, 30> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1,
                                      5, 0, 0, 5, 1, 0, 6, 1, 0, 6, 0, 0, 5, 0, 2};
  check(MEDmeshNodeCoordinateWr(file, "mesh", MED_NO_DT, MED_NO_IT, 0, MED_FULL_INTERLACE, 10,
                                points.data()));
  const std::array<med_int, 8> tetrahedra{1, 3, 2, 4, 2, 4, 3, 5};
  const std::array<med_int, 5> pyramid{6, 7, 8, 9, 10};
  const std::array<med_int, 3> triangle{1, 2, 3};
  const auto put = [&](med_geometry_type type, med_int count, const med_int* nodes,
                       const std::vector<med_int>& families) {
    check(MEDmeshElementConnectivityWr(file, "mesh", MED_NO_DT, MED_NO_IT, 0, MED_CELL, type,
                                       MED_NODAL, MED_FULL_INTERLACE, count, nodes));
    check(MEDmeshEntityFamilyNumberWr(file, "mesh", MED_NO_DT, MED_NO_IT, MED_CELL, type, count,
                                      families.data()));
  };
  put(MED_TETRA4, 2, tetrahedra.data(), {-1, -2});
  put(MED_PYRA5, 1, pyramid.data(), {-2});
  put(MED_TRIA3, 1, triangle.data(), {-1});
  std::string groups = "steel";
  groups.resize(MED_LNAME_SIZE);
  check(MEDfamilyCr(file, "mesh", "one", -1, 1, groups.c_str()));
  std::string both = "upper";
  both.resize(MED_LNAME_SIZE);
  groups.resize(MED_LNAME_SIZE);
  check(MEDfamilyCr(file, "mesh", "two", -2, 2, (groups + both).c_str()));
  check(MEDfieldCr(file, "v", MED_FLOAT64, 3, kThree, kThreeUnits, "s               ", "mesh"));
  check(
      MEDfieldCr(file, "c", MED_FLOAT64, 1, kOne, "Pa              ", "s               ", "mesh"));
  check(MEDprofileWr(file, "some", 2, std::array<med_int, 2>{2, 5}.data()));
  for (const med_int step : {1, 2}) {
    std::vector<double> v;
    for (int i = 0; i < 30; ++i) v.push_back(100 * static_cast<double>(step) + i);
    put_values(file, "v", step, MED_NONE, v, 10);
    put_values(file, "c", step, MED_TETRA4, {10. * double(step), 10. * double(step) + 1}, 2);
    if (step == 2) put_values(file, "c", step, MED_PYRA5, {77}, 1);
  }
  check(
      MEDfieldCr(file, "p", MED_FLOAT64, 1, kOne, "Pa              ", "s               ", "mesh"));
  put_values(file, "p", 2, MED_NONE, {0, 20, 0, 0, 50, 0, 0, 0, 0, 0}, 10, "some");
  check(MEDfileClose(file));
}

TEST(MedFields, StepsKindsAndProfiles) {
  const ScratchFolder folder;
  const std::string path = folder.file("three.med");
  write_three_cells(path);
  EXPECT_THAT(format_to_read(path).inspect(path).times, testing::ElementsAre(0.5, 1));
  for (const std::size_t step : {0, 1}) {
    ReadOptions options;
    options.step = step;
    const ZooMesh mesh = read_any(path, options).mesh;
    ASSERT_EQ(mesh.cell_count(), 3U);
    ASSERT_EQ(mesh.node_count(), 10U);
    const Field& v = field_named(mesh, "v");
    ASSERT_EQ(v.components, 3U);
    EXPECT_EQ(v.unit, "m/s");
    for (std::size_t i = 0; i < 30; ++i)
      EXPECT_EQ(v.values[i], 100. * double(step + 1) + double(i));
    const Field& c = field_named(mesh, "c");
    for (CellId cell = 0; cell < 3; ++cell) {
      const double volume = std::abs(volume_of(mesh, cell));
      if (mesh.kinds[cell] == CellKind::pyramid5) {
        EXPECT_NEAR(volume, 2.0 / 3, 1e-15);
        EXPECT_EQ(std::isnan(c.values[cell]), step == 0);
        if (step == 1) {
          EXPECT_EQ(c.values[cell], 77);
        }
      } else {
        EXPECT_EQ(c.values[cell], 10. * double(step + 1) + (volume > 0.2 ? 1 : 0));
      }
    }
    if (step == 0) continue;
    const Field& p = field_named(mesh, "p");
    for (NodeId node = 0; node < 10; ++node) {
      const bool listed = node == 1 || node == 4;
      EXPECT_EQ(std::isnan(p.values[node]), !listed) << node;
      if (listed) {
        EXPECT_EQ(p.values[node], 10. * double(node + 1));
      }
    }
  }
}

TEST(MedFields, GroupsAreUnionsOfFamilies) {
  const ScratchFolder folder;
  const std::string path = folder.file("three.med");
  write_three_cells(path);
  for (const auto& [block, cells] :
       std::vector<std::pair<std::string, std::size_t>>{{"steel", 3}, {"upper", 2}}) {
    ReadOptions options;
    options.block = block;
    const ZooMesh mesh = read_any(path, options).mesh;
    ASSERT_EQ(mesh.cell_count(), cells) << block;
    const Field& c = field_named(mesh, "c");
    std::vector<double> values(c.values.begin(), c.values.end());
    std::sort(values.begin(), values.end());
    EXPECT_EQ(values,
              cells == 3 ? std::vector<double>({20, 21, 77}) : std::vector<double>({21, 77}));
  }
}

TEST(MedFields, DamagedFilesAreRefusedOrValid) {
  const ScratchFolder folder;
  const std::string path = folder.file("three.med");
  write_three_cells(path);
  EXPECT_GE(expect_cuts_survived(path, 12), 6U);
  expect_changes_survived(path, 24);
}

TEST(MedOrders, PolyhedraAreToldByTheirFaces) {
  const ScratchFolder folder;
  const std::string path = folder.file("poly.med");
  const med_idt file = MEDfileOpen(path.c_str(), MED_ACC_CREAT);
  ASSERT_GE(file, 0);
  check(MEDmeshCr(file, "mesh", 3, 3, MED_UNSTRUCTURED_MESH, "two", "s", MED_SORT_DTIT,
                  MED_CARTESIAN, kAxes, kUnits));
  // two tetrahedra over one face
  const std::array<double, 15> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1};
  check(MEDmeshNodeCoordinateWr(file, "mesh", MED_NO_DT, MED_NO_IT, 0, MED_FULL_INTERLACE, 5,
                                points.data()));
  const std::array<med_int, 3> faces_at{1, 5, 9};
  const std::array<med_int, 9> nodes_at{1, 4, 7, 10, 13, 16, 19, 22, 25};
  const std::array<med_int, 24> nodes{1, 2, 3, 1, 4, 2, 2, 4, 3, 3, 4, 1,
                                      1, 3, 2, 1, 2, 5, 2, 3, 5, 3, 1, 5};
  check(MEDmeshPolyhedronWr(file, "mesh", MED_NO_DT, MED_NO_IT, 0, MED_CELL, MED_NODAL, 3,
                            faces_at.data(), 9, nodes_at.data(), nodes.data()));
  check(MEDfileClose(file));
  const Reading reading = read_any(path);
  EXPECT_EQ(reading.mesh.cell_count(), 2U);
  EXPECT_EQ(reading.mesh.kinds[1], CellKind::tetrahedron4);
}

// MED numbers its types by their dimension and, in the last two digits, their nodes.
TEST(MedTypes, HaveTheNodesThatTheirNumbersTell) {
  const std::vector<std::pair<std::string, med_geometry_type>> rows{
      {"PO1", MED_POINT1}, {"SE2", MED_SEG2},    {"SE3", MED_SEG3},    {"SE4", MED_SEG4},
      {"TR3", MED_TRIA3},  {"QU4", MED_QUAD4},   {"TR6", MED_TRIA6},   {"TR7", MED_TRIA7},
      {"QU8", MED_QUAD8},  {"QU9", MED_QUAD9},   {"TE4", MED_TETRA4},  {"PY5", MED_PYRA5},
      {"PE6", MED_PENTA6}, {"HE8", MED_HEXA8},   {"T10", MED_TETRA10}, {"O12", MED_OCTA12},
      {"P13", MED_PYRA13}, {"P15", MED_PENTA15}, {"P18", MED_PENTA18}, {"H20", MED_HEXA20},
      {"H27", MED_HEXA27}};
  for (const auto& [name, number] : rows) {
    const auto element = med::element_named(name);
    ASSERT_TRUE(element) << name;
    EXPECT_EQ(element->name, name);
    EXPECT_EQ(element->nodes, static_cast<std::size_t>(number % 100)) << name;
    const CellConversion& conversion = element->conversion;
    EXPECT_EQ(conversion.fate == CellFate::no_volume, number / 100 < 3) << name;
    if (conversion.fate == CellFate::converted) {
      EXPECT_EQ(node_count(conversion.kind), element->nodes) << name;
    }
  }
  const auto corners = [](const char* name) {
    return med::element_named(name)->conversion.corners;
  };
  EXPECT_EQ(corners("P18"), CellKind::prism6);
  EXPECT_EQ(corners("H27"), CellKind::brick8);
  EXPECT_EQ(corners("O12"), std::nullopt);
  for (const char* other : {"POG", "POE", "PG2", "TE5", ""})
    EXPECT_FALSE(med::element_named(other)) << other;
}

}  // namespace
}  // namespace hiac::formats
