// Files written by Silo itself: every kind of zone in both orientations, blocks in several files,
// structured meshes, polyhedra.
#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <silo.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Closed {
  void operator()(DBfile* file) const { DBClose(file); }
};
using File = std::unique_ptr<DBfile, Closed>;

File create(const std::string& path, int driver = DB_HDF5) {
  DBShowErrors(DB_NONE, nullptr);
  return File(DBCreate(path.c_str(), DB_CLOBBER, DB_LOCAL, "", driver));
}

struct Zones {
  std::vector<int> nodes;
  std::vector<int> types;
  std::vector<int> sizes;
  std::vector<int> counts;
};

/// A brick, a pyramid on its top, a prism at its side x = 1 (quadrilateral 1 2 6 5, edge 9 10) and
/// a tetrahedron on the prism's triangle; the last three turned over when asked for.
Zones all_kinds(bool turned) {
  Zones zones;
  const auto add = [&](int type, std::vector<int> nodes) {
    zones.types.push_back(type);
    zones.sizes.push_back(static_cast<int>(nodes.size()));
    zones.counts.push_back(1);
    zones.nodes.insert(zones.nodes.end(), nodes.begin(), nodes.end());
  };
  add(DB_ZONETYPE_HEX, {0, 1, 2, 3, 4, 5, 6, 7});
  if (turned) {
    add(DB_ZONETYPE_PYRAMID, {4, 7, 6, 5, 8});
    add(DB_ZONETYPE_PRISM, {5, 6, 2, 1, 9, 10});
    add(DB_ZONETYPE_TET, {2, 10, 6, 11});
  } else {
    add(DB_ZONETYPE_PYRAMID, {4, 5, 6, 7, 8});
    add(DB_ZONETYPE_PRISM, {1, 2, 6, 5, 9, 10});
    add(DB_ZONETYPE_TET, {2, 6, 10, 11});
  }
  return zones;
}

constexpr std::array<double, 12> kX{0, 1, 1, 0, 0, 1, 1, 0, 0.5, 2, 2, 1.5};
constexpr std::array<double, 12> kY{0, 0, 1, 1, 0, 0, 1, 1, 0.5, 0, 1, 2};
constexpr std::array<double, 12> kZ{0, 0, 0, 0, 1, 1, 1, 1, 2, 0.5, 0.5, 0.5};

void put_mesh(DBfile* file, const Zones& zones, double shift) {
  std::array<double, 12> x = kX;
  for (double& value : x) value += shift;
  std::array<double, 12> y = kY;
  std::array<double, 12> z = kZ;
  const std::array<double*, 3> coordinates{x.data(), y.data(), z.data()};
  double time = 0.5;
  DBoptlist* options = DBMakeOptlist(1);
  DBAddOption(options, DBOPT_DTIME, &time);
  DBPutZonelist2(file, "zones", static_cast<int>(zones.types.size()), 3, zones.nodes.data(),
                 static_cast<int>(zones.nodes.size()), 0, 0, 0, zones.types.data(),
                 zones.sizes.data(), zones.counts.data(), static_cast<int>(zones.types.size()),
                 nullptr);
  DBPutUcdmesh(file, "mesh", 3, nullptr, coordinates.data(), 12,
               static_cast<int>(zones.types.size()), "zones", nullptr, DB_DOUBLE, options);
  const std::array<float, 4> pressure{10, 11, 12, 13};
  DBPutUcdvar1(file, "p", "mesh", pressure.data(), 4, nullptr, 0, DB_FLOAT, DB_ZONECENT, nullptr);
  const std::array<const char*, 3> names{"u", "v", "w"};
  DBPutUcdvar(file, "position", "mesh", 3, names.data(), coordinates.data(), 12, nullptr, 0,
              DB_DOUBLE, DB_NODECENT, nullptr);
  DBFreeOptlist(options);
}

TEST(Silo, EveryKindOfZoneIsReadInEitherOrientation) {
  for (const auto& [driver, turned] : std::vector<std::pair<int, bool>>{
           {DB_HDF5, false}, {DB_HDF5, true}, {DB_PDB, false}, {DB_PDB, true}}) {
    const ScratchFolder folder;
    const std::string path = folder.file("kinds.silo");
    put_mesh(create(path, driver).get(), all_kinds(turned), 0);
    ASSERT_EQ(format_to_read(path).name, "silo");
    const ZooMesh mesh = read_any(path).mesh;
    ASSERT_EQ(mesh.cell_count(), 4U);
    EXPECT_THAT(std::vector(mesh.kinds.begin(), mesh.kinds.end()),
                ElementsAre(CellKind::brick8, CellKind::pyramid5, CellKind::prism6,
                            CellKind::tetrahedron4));
    EXPECT_NEAR(volume_of(mesh, 0), 1, 1e-12);
    EXPECT_NEAR(volume_of(mesh, 1), 1.0 / 3, 1e-12);
    EXPECT_NEAR(volume_of(mesh, 2), 0.5, 1e-12);
    EXPECT_NEAR(volume_of(mesh, 3), 1.0 / 6, 1e-12);
    // pyramid and prism share a face with the brick, the tetrahedron one with the prism
    const FaceAdjacency adjacency = build_face_adjacency(mesh);
    EXPECT_EQ(std::count(adjacency.neighbors.begin(), adjacency.neighbors.end(), kNoCell),
              6 + 5 + 5 + 4 - 6);
    ASSERT_EQ(mesh.fields.size(), 2U);
    const Field& p = mesh.fields[mesh.fields[0].name == "p" ? 0 : 1];
    const Field& x = mesh.fields[mesh.fields[0].name == "p" ? 1 : 0];
    EXPECT_THAT(p.values.view(), ElementsAre(10, 11, 12, 13));
    EXPECT_EQ(x.components, 3U);
    for (NodeId node = 0; node < mesh.node_count(); ++node)
      EXPECT_EQ(x.values[3 * node + 1], mesh.position(node)[1]);
    EXPECT_THAT(mesh.metadata,
                testing::Contains(std::pair<std::string, std::string>("time", "0.5")));
  }
}

TEST(Silo, BlocksOfSeveralFilesAreOneMesh) {
  const ScratchFolder folder;
  put_mesh(create(folder.file("a.silo")).get(), all_kinds(false), 0);
  put_mesh(create(folder.file("b.silo")).get(), all_kinds(false), 5);
  const std::string path = folder.file("all.silo");
  {
    const File file = create(path);
    const std::array<const char*, 2> meshes{"a.silo:/mesh", "b.silo:/mesh"};
    const std::array<const char*, 2> variables{"a.silo:/p", "b.silo:/p"};
    const std::array<int, 2> mesh_types{DB_UCDMESH, DB_UCDMESH};
    const std::array<int, 2> variable_types{DB_UCDVAR, DB_UCDVAR};
    DBPutMultimesh(file.get(), "all", 2, meshes.data(), mesh_types.data(), nullptr);
    DBPutMultivar(file.get(), "p", 2, variables.data(), variable_types.data(), nullptr);
  }
  const ZooMesh mesh = read_any(path).mesh;
  EXPECT_EQ(mesh.cell_count(), 8U);
  EXPECT_THAT(mesh.fields.at(0).values.view(), ElementsAre(10, 11, 12, 13, 10, 11, 12, 13));
  ReadOptions options;
  options.block = "b.silo:/mesh";
  EXPECT_EQ(read_any(path, options).mesh.cell_count(), 4U);
  std::filesystem::remove(folder.file("b.silo"));
  EXPECT_THAT(refusal(path), HasSubstr("b.silo"));
}

TEST(Silo, StructuredMeshesAreBricks) {
  const ScratchFolder folder;
  const std::string path = folder.file("grid.silo");
  {
    const File file = create(path);
    std::array<double, 3> x{0, 1, 3};
    std::array<double, 2> y{0, 1};
    std::array<double, 2> z{0, 2};
    const std::array<double*, 3> axes{x.data(), y.data(), z.data()};
    const std::array<int, 3> dimensions{3, 2, 2};
    DBPutQuadmesh(file.get(), "grid", nullptr, axes.data(), dimensions.data(), 3, DB_DOUBLE,
                  DB_COLLINEAR, nullptr);
    std::array<double, 12> values{};
    for (int n = 0; n < 12; ++n)
      values[static_cast<std::size_t>(n)] = x[static_cast<std::size_t>(n % 3)];
    DBPutQuadvar1(file.get(), "f", "grid", values.data(), dimensions.data(), 3, nullptr, 0,
                  DB_DOUBLE, DB_NODECENT, nullptr);
    const std::array<int, 3> zones{2, 1, 1};
    const std::array<double, 2> cells{7, 8};
    DBPutQuadvar1(file.get(), "c", "grid", cells.data(), zones.data(), 3, nullptr, 0, DB_DOUBLE,
                  DB_ZONECENT, nullptr);
  }
  const ZooMesh mesh = read_any(path).mesh;
  EXPECT_EQ(mesh.cell_count(), 2U);
  ASSERT_EQ(mesh.fields.size(), 2U);
  const Field& f = mesh.fields[mesh.fields[0].name == "f" ? 0 : 1];
  const Field& c = mesh.fields[mesh.fields[0].name == "f" ? 1 : 0];
  for (NodeId node = 0; node < 12; ++node) EXPECT_EQ(f.values[node], mesh.position(node)[0]);
  EXPECT_THAT(c.values.view(), ElementsAre(7, 8));
}

TEST(Silo, DamagedFilesAreRefusedOrRead) {
  for (const int driver : {DB_HDF5, DB_PDB}) {
    const ScratchFolder folder;
    const std::string path = folder.file("whole.silo");
    put_mesh(create(path, driver).get(), all_kinds(false), 0);
    const std::string whole = text_of(path);
    EXPECT_NE(refusal(folder.write("cut.silo", whole.substr(0, whole.size() / 2))), "");
    for (std::size_t at = 2048; at < whole.size(); at += whole.size() / 12) {
      std::string changed = whole;
      changed[at] = static_cast<char>(changed[at] ^ 0x55);
      static_cast<void>(refusal(folder.write("changed.silo", changed)));
    }
  }
}

}  // namespace
}  // namespace hiac::formats
