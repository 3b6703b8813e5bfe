// Polyhedra, structured meshes and variables over blocks in Silo files.
#include <array>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <silo.h>

#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;

struct BlockFileClosed {
  void operator()(DBfile* file) const { DBClose(file); }
};
using BlockFile = std::unique_ptr<DBfile, BlockFileClosed>;

BlockFile new_block_file(const std::string& path) {
  DBShowErrors(DB_NONE, nullptr);
  return BlockFile(DBCreate(path.c_str(), DB_CLOBBER, DB_LOCAL, "", DB_HDF5));
}

template <typename Write>
std::string block_refusal(const Write& write) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.silo");
  write(new_block_file(path).get());
  const std::string message = refusal(path);
  return message.empty() ? message : message.substr(path.size() + 2);
}

template <typename Write>
Reading block_reading(const Write& write) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.silo");
  write(new_block_file(path).get());
  return read_any(path);
}

/// Two tetrahedra over a face as polyhedra: faces 0 to 3 and 4 to 6, the first shared.
struct Polyhedra {
  std::vector<int> corner_counts{3, 3, 3, 3, 3, 3, 3};
  std::vector<int> corners{0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0, 0, 1, 4, 1, 2, 4, 2, 0, 4};
  std::vector<int> face_counts{4, 4};
  std::vector<int> faces{0, 1, 2, 3, ~0, 4, 5, 6};
  int first = 0;
  int last = 1;
};

void put_polyhedra(DBfile* file, const Polyhedra& made) {
  std::array<double, 5> x{0, 1, 0, 0, 0};
  std::array<double, 5> y{0, 0, 1, 0, 0};
  std::array<double, 5> z{0, 0, 0, 1, -2};
  const std::array<double*, 3> axes{x.data(), y.data(), z.data()};
  const auto count = [](const std::vector<int>& list) { return static_cast<int>(list.size()); };
  DBPutPHZonelist(file, "zones", count(made.corner_counts), made.corner_counts.data(),
                  count(made.corners), made.corners.data(), nullptr, count(made.face_counts),
                  made.face_counts.data(), count(made.faces), made.faces.data(), 0, made.first,
                  made.last, nullptr);
  char list[] = "zones";
  DBoptlist* options = DBMakeOptlist(1);
  DBAddOption(options, DBOPT_PHZONELIST, list);
  DBPutUcdmesh(file, "mesh", 3, nullptr, axes.data(), 5, count(made.face_counts), nullptr, nullptr,
               DB_DOUBLE, options);
  DBFreeOptlist(options);
}

std::string polyhedra_refusal(const Polyhedra& made) {
  return block_refusal([&](DBfile* file) { put_polyhedra(file, made); });
}

TEST(SiloBlocks, PolyhedraAreToldByTheirFaces) {
  const ZooMesh mesh = block_reading([](DBfile* file) { put_polyhedra(file, {}); }).mesh;
  ASSERT_EQ(mesh.cell_count(), 2U);
  EXPECT_NEAR(volume_of(mesh, 0), 1.0 / 6, 1e-15);
  EXPECT_NEAR(volume_of(mesh, 1), 2.0 / 6, 1e-15);
  Polyhedra first;
  first.last = 0;
  EXPECT_EQ(block_reading([&](DBfile* file) { put_polyhedra(file, first); }).mesh.cell_count(), 1U);
  Polyhedra second;
  second.first = 1;
  const ZooMesh one = block_reading([&](DBfile* file) { put_polyhedra(file, second); }).mesh;
  ASSERT_EQ(one.cell_count(), 1U);
  EXPECT_NEAR(volume_of(one, 0), 2.0 / 6, 1e-15);
}

TEST(SiloBlocks, PolyhedraThatDoNotFit) {
  const std::string fit = "mesh 'mesh': its zones do not fit their faces";
  Polyhedra made;
  made.faces[1] = 7;
  EXPECT_EQ(polyhedra_refusal(made), fit);
  made.faces[1] = ~7;
  EXPECT_EQ(polyhedra_refusal(made), fit);
  made = {};
  made.faces[7] = 0;
  EXPECT_EQ(polyhedra_refusal(made), fit);
  made = {};
  made.face_counts = {4, 5};
  EXPECT_EQ(polyhedra_refusal(made), fit);
  made.face_counts = {4, -1};
  EXPECT_EQ(polyhedra_refusal(made), fit);
  made = {};
  made.corner_counts[6] = 4;
  EXPECT_EQ(polyhedra_refusal(made), fit);
  made = {};
  made.corners[20] = 5;
  EXPECT_EQ(polyhedra_refusal(made), "mesh 'mesh': there is no node 5 (5 nodes found)");
}

/// A row of bricks from x = x0 on, with a value on each of them.
void put_row(DBfile* file, const std::string& name, double x0, int bricks, int variables = 1) {
  std::vector<double> x;
  for (int i = 0; i <= bricks; ++i) x.push_back(x0 + i);
  std::array<double, 2> y{0, 1};
  std::array<double, 2> z{0, 1};
  const std::array<double*, 3> axes{x.data(), y.data(), z.data()};
  const std::array<int, 3> dimensions{bricks + 1, 2, 2};
  DBPutQuadmesh(file, name.c_str(), nullptr, axes.data(), dimensions.data(), 3, DB_DOUBLE,
                DB_COLLINEAR, nullptr);
  const std::array<int, 3> zones{bricks, 1, 1};
  std::vector<double> values(x.begin(), x.end() - 1);
  const std::array<const double*, 2> both{values.data(), values.data()};
  const std::array<const char*, 2> names{"u", "v"};
  DBPutQuadvar(file, (name + "_p").c_str(), name.c_str(), variables, names.data(), both.data(),
               zones.data(), 3, nullptr, 0, DB_DOUBLE, DB_ZONECENT, nullptr);
}

void put_blocks(DBfile* file, const std::vector<const char*>& meshes,
                const std::vector<const char*>& variables) {
  const std::vector<int> mesh_types(meshes.size(), DB_QUADMESH);
  const std::vector<int> variable_types(variables.size(), DB_QUADVAR);
  DBPutMultimesh(file, "all", static_cast<int>(meshes.size()), meshes.data(), mesh_types.data(),
                 nullptr);
  DBPutMultivar(file, "p", static_cast<int>(variables.size()), variables.data(),
                variable_types.data(), nullptr);
}

TEST(SiloBlocks, VariablesOverBlocks) {
  const ZooMesh mesh = block_reading([](DBfile* file) {
                         put_row(file, "a", 0, 2);
                         put_row(file, "b", 10, 3);
                         put_blocks(file, {"a", "EMPTY", "b"}, {"a_p", "EMPTY", "b_p"});
                       }).mesh;
  EXPECT_THAT(field_named(mesh, "p").values.view(), ElementsAre(0, 1, 10, 11, 12));
  const ZooMesh part = block_reading([](DBfile* file) {
                         put_row(file, "a", 0, 2);
                         put_row(file, "b", 10, 1);
                         put_blocks(file, {"a", "b"}, {"a_p"});
                       }).mesh;
  EXPECT_EQ(field_named(part, "p").values[1], 1);
  EXPECT_TRUE(std::isnan(field_named(part, "p").values[2]));
}

TEST(SiloBlocks, VariablesOfBlocksThatDoNotFit) {
  EXPECT_EQ(block_refusal([](DBfile* file) {
              put_row(file, "a", 0, 2);
              put_row(file, "b", 10, 3, 2);
              put_blocks(file, {"a", "b"}, {"a_p", "b_p"});
            }),
            "variable 'b_p' is of another kind than in other blocks");
  EXPECT_EQ(block_refusal([](DBfile* file) {
              put_row(file, "a", 0, 2);
              put_row(file, "b", 10, 3);
              put_blocks(file, {"a", "b"}, {"b_p", "a_p"});
            }),
            "variable 'b_p': does not fit its mesh (2 values expected, 3 found)");
  EXPECT_EQ(block_refusal([](DBfile* file) {
              put_row(file, "a", 0, 2);
              put_blocks(file, {"a"}, {"nothing"});
            }),
            "variable 'nothing': cannot be read");
}

TEST(SiloBlocks, StructuredMeshesOfPointsAndWithGhosts) {
  const auto values = [](int low, int high) {
    const ZooMesh mesh = block_reading([&](DBfile* file) {
                           std::vector<double> x, y, z;
                           for (int k = 0; k < 2; ++k)
                             for (int j = 0; j < 3; ++j)
                               for (int i = 0; i < 4; ++i) {
                                 x.push_back(i);
                                 y.push_back(2 * j);
                                 z.push_back(3 * k);
                               }
                           const std::array<double*, 3> axes{x.data(), y.data(), z.data()};
                           const std::array<int, 3> dimensions{4, 3, 2};
                           std::array<int, 3> below{low, 0, 0};
                           std::array<int, 3> above{high, 1, 0};
                           DBoptlist* options = DBMakeOptlist(2);
                           DBAddOption(options, DBOPT_LO_OFFSET, below.data());
                           DBAddOption(options, DBOPT_HI_OFFSET, above.data());
                           DBPutQuadmesh(file, "grid", nullptr, axes.data(), dimensions.data(), 3,
                                         DB_DOUBLE, DB_NONCOLLINEAR, options);
                           DBFreeOptlist(options);
                           const std::array<int, 3> zones{3, 2, 1};
                           const std::array<double, 6> c{1, 2, 3, 4, 5, 6};
                           DBPutQuadvar1(file, "c", "grid", c.data(), zones.data(), 3, nullptr, 0,
                                         DB_DOUBLE, DB_ZONECENT, nullptr);
                         }).mesh;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
      EXPECT_NEAR(volume_of(mesh, cell), 6, 1e-12);
    const auto all = field_named(mesh, "c").values.view();
    return std::vector<double>(all.begin(), all.end());
  };
  // the second row along y is one of ghosts
  EXPECT_THAT(values(0, 0), ElementsAre(1, 2, 3));
  EXPECT_THAT(values(1, 0), ElementsAre(2, 3));
  EXPECT_THAT(values(0, 1), ElementsAre(1, 2));
  EXPECT_THAT(values(1, 1), ElementsAre(2));
}

TEST(SiloBlocks, MeshesOfOtherDimensionsAreLeftOut) {
  const Reading reading = block_reading([](DBfile* file) {
    put_row(file, "a", 0, 2);
    std::array<double, 2> x{0, 1};
    const std::array<double*, 2> axes{x.data(), x.data()};
    const std::array<int, 2> dimensions{2, 2};
    DBPutQuadmesh(file, "plane", nullptr, axes.data(), dimensions.data(), 2, DB_DOUBLE,
                  DB_COLLINEAR, nullptr);
  });
  EXPECT_EQ(reading.mesh.cell_count(), 2U);
  EXPECT_THAT(reading.notes, Contains("left out 'plane', a mesh of 2 dimensions"));
}

TEST(SiloBlocks, TimesOfStructuredMeshesAreTold) {
  const ZooMesh mesh = block_reading([](DBfile* file) {
                         std::array<double, 2> axis{0, 1};
                         const std::array<double*, 3> axes{axis.data(), axis.data(), axis.data()};
                         const std::array<int, 3> dimensions{2, 2, 2};
                         double time = 0.25;
                         DBoptlist* options = DBMakeOptlist(1);
                         DBAddOption(options, DBOPT_DTIME, &time);
                         DBPutQuadmesh(file, "mesh", nullptr, axes.data(), dimensions.data(), 3,
                                       DB_DOUBLE, DB_COLLINEAR, options);
                         DBFreeOptlist(options);
                       }).mesh;
  EXPECT_EQ(mesh.cell_count(), 1U);
  EXPECT_THAT(mesh.metadata, testing::Contains(testing::Pair("time", "0.25")));
}

}  // namespace
}  // namespace hiac::formats
