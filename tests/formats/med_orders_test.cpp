// The node order of every element that is read from MED files, and fields on nodes, cells and
// cells' nodes, by files of one cell written through MED-fichier. The elements as in its
// documentation, "Elements de reference": the normal of the first face points out of the cell.
#include <cstring>

#include <med.h>

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

}  // namespace
}  // namespace hiac::formats
