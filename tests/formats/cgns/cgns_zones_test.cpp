// Zones, sections, solutions and steps of CGNS files, written through the CGNS library. The layout
// is that of the Standard Interface Data Structures, sections 6.3, 7.3, 7.7 and 11.1.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <cgnslib.h>

#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/damage.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

void check(int status) { ASSERT_EQ(status, CG_OK) << cg_get_error(); }

/// A file with a base, to which zones are written.
class CgnsFileInMaking {
 public:
  explicit CgnsFileInMaking(const std::string& path, int sort = CG_FILE_HDF5) {
    check(cg_set_file_type(sort));
    check(cg_open(path.c_str(), CG_MODE_WRITE, &file));
    check(cg_base_write(file, "base", 3, 3, &base));
  }
  ~CgnsFileInMaking() { check(cg_close(file)); }
  CgnsFileInMaking(const CgnsFileInMaking&) = delete;
  CgnsFileInMaking& operator=(const CgnsFileInMaking&) = delete;

  void zone_of(const std::string& name, const std::vector<cgsize_t>& size,
               CGNS_ENUMT(ZoneType_t) type) {
    check(cg_zone_write(file, base, name.c_str(), size.data(), type, &zone));
  }
  void points(const std::array<std::vector<double>, 3>& axes) {
    constexpr std::array<const char*, 3> kNames{"CoordinateX", "CoordinateY", "CoordinateZ"};
    int id = 0;
    for (std::size_t d = 0; d < 3; ++d)
      check(
          cg_coord_write(file, base, zone, CGNS_ENUMV(RealDouble), kNames[d], axes[d].data(), &id));
  }
  void section(const std::string& name, CGNS_ENUMT(ElementType_t) type, cgsize_t first,
               cgsize_t last, const std::vector<cgsize_t>& nodes) {
    int id = 0;
    check(
        cg_section_write(file, base, zone, name.c_str(), type, first, last, 0, nodes.data(), &id));
  }
  int solution(const std::string& name, CGNS_ENUMT(GridLocation_t) location) {
    int id = 0;
    check(cg_sol_write(file, base, zone, name.c_str(), location, &id));
    return id;
  }
  void field(int of, const std::string& name, const std::vector<double>& values) {
    int id = 0;
    check(cg_field_write(file, base, zone, of, CGNS_ENUMV(RealDouble), name.c_str(), values.data(),
                         &id));
  }

  int file = 0;
  int base = 0;
  int zone = 0;
};

const Field& field_named(const ZooMesh& mesh, const std::string& name, FieldLocation location) {
  const auto found = std::find_if(mesh.fields.begin(), mesh.fields.end(), [&](const Field& field) {
    return field.name == name && field.location == location;
  });
  if (found == mesh.fields.end()) throw std::runtime_error("no field " + name);
  return *found;
}

std::vector<double> numbers_from(double first, std::size_t count) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(first + static_cast<double>(i));
  return numbers;
}

/// A block of ni x nj x nk points from x = x0 on, points (i, 2 j, 3 k).
std::array<std::vector<double>, 3> lattice(double x0, int ni, int nj, int nk) {
  std::array<std::vector<double>, 3> axes;
  for (int k = 0; k < nk; ++k)
    for (int j = 0; j < nj; ++j)
      for (int i = 0; i < ni; ++i) {
        axes[0].push_back(x0 + i);
        axes[1].push_back(2 * j);
        axes[2].push_back(3 * k);
      }
  return axes;
}

TEST(CgnsZones, StructuredZonesWithVectorsAndLayersRoundThem) {
  const ScratchFolder folder;
  for (const int sort : {CG_FILE_HDF5, CG_FILE_ADF}) {
    const std::string path = folder.file(sort == CG_FILE_ADF ? "adf.cgns" : "hdf.cgns");
    {
      CgnsFileInMaking file(path, sort);
      file.zone_of("left", {3, 2, 2, 2, 1, 1, 0, 0, 0}, CGNS_ENUMV(Structured));
      file.points(lattice(0, 3, 2, 2));
      const int nodes = file.solution("nodes", CGNS_ENUMV(Vertex));
      file.field(nodes, "Density", numbers_from(100, 12));
      for (const auto& [name, first] : {std::pair("MomentumZ", 300.), std::pair("MomentumX", 400.),
                                        std::pair("MomentumY", 500.)})
        file.field(nodes, name, numbers_from(first, 12));
      // one layer below i, two above k: 3 x 1 x 3 values round 2 x 1 x 1
      int cells = 0;
      const std::array<int, 6> rind{1, 0, 0, 0, 0, 2};
      check(cg_sol_write(file.file, file.base, file.zone, "cells", CGNS_ENUMV(CellCenter), &cells));
      check(cg_goto(file.file, file.base, "Zone_t", file.zone, "FlowSolution_t", cells, "end"));
      check(cg_rind_write(rind.data()));
      file.field(cells, "Pressure", numbers_from(0, 9));
      file.zone_of("right", {2, 3, 2, 1, 2, 1, 0, 0, 0}, CGNS_ENUMV(Structured));
      file.points(lattice(10, 2, 3, 2));
      file.field(file.solution("cells", CGNS_ENUMV(CellCenter)), "Pressure", {70, 71});
    }
    const Reading reading = read_any(path);
    const ZooMesh& mesh = reading.mesh;
    ASSERT_EQ(mesh.cell_count(), 4U);
    ASSERT_EQ(mesh.node_count(), 24U);
    for (CellId cell = 0; cell < 4; ++cell) {
      EXPECT_EQ(mesh.kinds[cell], CellKind::brick8);
      EXPECT_NEAR(volume_of(mesh, cell), 6, 1e-12);
    }
    // in the left zone the values behind the layer at i = 0, before those above k
    EXPECT_THAT(field_named(mesh, "Pressure", FieldLocation::cell).values.view(),
                ElementsAre(1, 2, 70, 71));
    const Field& momentum = field_named(mesh, "Momentum", FieldLocation::node);
    ASSERT_EQ(momentum.components, 3U);
    EXPECT_THAT(momentum.values.view().subspan(15, 3), ElementsAre(405, 505, 305));
    EXPECT_TRUE(std::isnan(momentum.values[36]));
    const Field& density = field_named(mesh, "Density", FieldLocation::node);
    for (NodeId node = 0; node < 12; ++node) {
      const auto x = mesh.position(node);
      EXPECT_EQ(density.values[node], 100 + x[0] + 3 * x[1] / 2 + 6 * x[2] / 3);
    }
    ReadOptions options;
    options.block = "right";
    EXPECT_THAT(
        field_named(read_any(path, options).mesh, "Pressure", FieldLocation::cell).values.view(),
        ElementsAre(70, 71));
  }
}

/// The unit tetrahedron and one over its slanted face, of points 1 to 5.
const std::array<std::vector<double>, 3> kTwo{{{0, 1, 0, 0, 1}, {0, 0, 1, 0, 1}, {0, 0, 0, 1, 1}}};

TEST(CgnsZones, SurfacesStandBeforeOrBehindTheCells) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.cgns");
  for (const bool before : {false, true}) {
    SCOPED_TRACE(before);
    std::filesystem::remove(path);
    {
      CgnsFileInMaking file(path);
      file.zone_of("zone", {5, 2, 0}, CGNS_ENUMV(Unstructured));
      file.points(kTwo);
      const cgsize_t wall = before ? 1 : 3;
      const cgsize_t cells = before ? 3 : 1;
      file.section("wall", CGNS_ENUMV(TRI_3), wall, wall + 1, {1, 3, 2, 1, 2, 4});
      file.section("cells", CGNS_ENUMV(TETRA_4), cells, cells + 1, {1, 2, 3, 4, 2, 3, 4, 5});
      file.field(file.solution("s", CGNS_ENUMV(CellCenter)), "p", {7, 8});
    }
    const Reading reading = read_any(path);
    ASSERT_EQ(reading.mesh.cell_count(), 2U);
    EXPECT_NEAR(volume_of(reading.mesh, 0), 1.0 / 6, 1e-15);
    EXPECT_NEAR(volume_of(reading.mesh, 1), 1.0 / 3, 1e-15);
    // a value a cell of the zone, in the order of their numbers: the walls have none
    EXPECT_THAT(field_named(reading.mesh, "p", FieldLocation::cell).values.view(),
                ElementsAre(7, 8));
    EXPECT_THAT(reading.notes, Contains(HasSubstr("2 TRI_3")));
    EXPECT_THAT(format_to_read(path).inspect(path).blocks,
                testing::UnorderedElementsAre("zone", "wall", "cells"));
  }
}

TEST(CgnsZones, SectionsOfSeveralKindsAndMixedOnes) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.cgns");
  {
    CgnsFileInMaking file(path);
    // a brick, a pyramid on its top, a prism beside it, with a triangle between them
    file.zone_of("zone", {11, 3, 0}, CGNS_ENUMV(Unstructured));
    file.points({{{0, 1, 1, 0, 0, 1, 1, 0, 0.5, 2, 2},
                  {0, 0, 1, 1, 0, 0, 1, 1, 0.5, 0, 0},
                  {0, 0, 0, 0, 1, 1, 1, 1, 2, 0, 1}}});
    const std::vector<cgsize_t> mixed{
        CGNS_ENUMV(HEXA_8),  1, 2,  3, 4, 5,  6, 7, 8, CGNS_ENUMV(PYRA_5), 5, 6, 7, 8, 9,
        CGNS_ENUMV(PENTA_6), 2, 10, 3, 6, 11, 7};
    const std::vector<cgsize_t> starts{0, 9, 15, 22};
    int id = 0;
    check(cg_poly_section_write(file.file, file.base, file.zone, "cells", CGNS_ENUMV(MIXED), 1, 3,
                                0, mixed.data(), starts.data(), &id));
    file.section("skin", CGNS_ENUMV(QUAD_4), 4, 4, {1, 4, 3, 2});
    file.field(file.solution("s", CGNS_ENUMV(CellCenter)), "p", {7, 8, 9});
  }
  const Reading reading = read_any(path);
  const ZooMesh& mesh = reading.mesh;
  EXPECT_THAT(std::vector<CellKind>(mesh.kinds.begin(), mesh.kinds.end()),
              ElementsAre(CellKind::brick8, CellKind::pyramid5, CellKind::prism6));
  EXPECT_NEAR(volume_of(mesh, 0), 1, 1e-15);
  EXPECT_NEAR(volume_of(mesh, 1), 1.0 / 3, 1e-15);
  EXPECT_NEAR(volume_of(mesh, 2), 0.5, 1e-15);
  EXPECT_THAT(field_named(mesh, "p", FieldLocation::cell).values.view(), ElementsAre(7, 8, 9));
}

TEST(CgnsZones, SolutionsOfStepsAreThoseThatThePointersName) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.cgns");
  {
    CgnsFileInMaking file(path);
    file.zone_of("zone", {5, 2, 0}, CGNS_ENUMV(Unstructured));
    file.points(kTwo);
    file.section("cells", CGNS_ENUMV(TETRA_4), 1, 2, {1, 2, 3, 4, 2, 3, 4, 5});
    // out of order, and one that no step names
    file.field(file.solution("late", CGNS_ENUMV(Vertex)), "T", numbers_from(20, 5));
    file.field(file.solution("early", CGNS_ENUMV(Vertex)), "T", numbers_from(10, 5));
    file.field(file.solution("mean", CGNS_ENUMV(Vertex)), "T", numbers_from(90, 5));
    check(cg_biter_write(file.file, file.base, "steps", 2));
    check(cg_goto(file.file, file.base, "BaseIterativeData_t", 1, "end"));
    const cgsize_t two = 2;
    const std::array<double, 2> times{0.25, 4};
    check(cg_array_write("TimeValues", CGNS_ENUMV(RealDouble), 1, &two, times.data()));
    check(cg_ziter_write(file.file, file.base, file.zone, "pointers"));
    check(cg_goto(file.file, file.base, "Zone_t", file.zone, "ZoneIterativeData_t", 1, "end"));
    std::string names = "early";
    names.resize(32, ' ');
    names += "late";
    names.resize(64, ' ');
    const std::array<cgsize_t, 2> shape{32, 2};
    check(cg_array_write("FlowSolutionPointers", CGNS_ENUMV(Character), 2, shape.data(),
                         names.data()));
  }
  EXPECT_THAT(format_to_read(path).inspect(path).times, ElementsAre(0.25, 4));
  for (const auto& [time, first] : {std::pair(0.25, 10.), std::pair(4., 20.)}) {
    ReadOptions options;
    options.time = time;
    const ZooMesh mesh = read_any(path, options).mesh;
    ASSERT_EQ(mesh.fields.size(), 1U);
    EXPECT_THAT(mesh.fields[0].values.view(),
                ElementsAre(first, first + 1, first + 2, first + 3, first + 4));
  }
}

TEST(CgnsZones, LinksLeadToFilesOfTheFolder) {
  const ScratchFolder outside;
  const ScratchFolder folder;
  const auto write = [](const std::string& path, const std::string& linked) {
    CgnsFileInMaking file(path, CG_FILE_ADF);
    file.zone_of("zone", {5, 2, 0}, CGNS_ENUMV(Unstructured));
    if (linked.empty()) {
      file.points(kTwo);
    } else {
      check(cg_goto(file.file, file.base, "Zone_t", file.zone, "end"));
      check(cg_link_write("GridCoordinates", linked.c_str(), "/base/zone/GridCoordinates"));
    }
    file.section("cells", CGNS_ENUMV(TETRA_4), 1, 2, {1, 2, 3, 4, 2, 3, 4, 5});
  };
  write(folder.file("points.cgns"), "");
  write(outside.file("points.cgns"), "");
  const std::string path = folder.file("a.cgns");
  write(path, folder.file("points.cgns"));
  EXPECT_NEAR(volume_of(read_any(path).mesh), 1.0 / 6 + 1.0 / 3, 1e-15);
  std::filesystem::remove(path);
  write(path, outside.file("points.cgns"));
  EXPECT_THAT(refusal(path), HasSubstr("outside the input's folder"));
}

TEST(CgnsZones, DamagedFilesAreRefusedOrValid) {
  const ScratchFolder folder;
  for (const int sort : {CG_FILE_HDF5, CG_FILE_ADF}) {
    const std::string path = folder.file(sort == CG_FILE_ADF ? "adf.cgns" : "hdf.cgns");
    {
      CgnsFileInMaking file(path, sort);
      file.zone_of("zone", {5, 2, 0}, CGNS_ENUMV(Unstructured));
      file.points(kTwo);
      file.section("cells", CGNS_ENUMV(TETRA_4), 1, 2, {1, 2, 3, 4, 2, 3, 4, 5});
      file.field(file.solution("s", CGNS_ENUMV(CellCenter)), "p", {7, 8});
    }
    EXPECT_GE(expect_cuts_survived(path, 12), 6U);
    expect_changes_survived(path, 24);
  }
}

}  // namespace
}  // namespace hiac::formats
