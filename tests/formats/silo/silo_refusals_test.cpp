// Silo files that lack a part or whose parts do not fit one another: the whole complaint, and the
// nearest file that is read.
#include <array>
#include <memory>

#include <fmt/format.h>
#include <silo.h>

#include "formats/silo/silo_file.hpp"
#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

struct SiloClosed {
  void operator()(DBfile* file) const { DBClose(file); }
};

/// Zones of one shape each; what a test does not set is that of a tetrahedron.
struct SiloMesh {
  std::vector<double> x{0, 1, 0, 0};
  std::vector<double> y{0, 0, 1, 0};
  std::vector<double> z{0, 0, 0, 1};
  std::vector<int> nodes{0, 1, 2, 3};
  int origin = 0;
  std::vector<int> types{DB_ZONETYPE_TET};
  std::vector<int> sizes{4};
  std::vector<int> counts{1};
  int ghosts_before = 0;
  int ghosts_behind = 0;
  int dimensions = 3;
  bool with_zones = true;
};

std::unique_ptr<DBfile, SiloClosed> new_silo(const std::string& path) {
  DBShowErrors(DB_NONE, nullptr);
  return std::unique_ptr<DBfile, SiloClosed>(
      DBCreate(path.c_str(), DB_CLOBBER, DB_LOCAL, "", DB_HDF5));
}

void put_silo_mesh(DBfile* file, SiloMesh mesh, const char* name = "mesh") {
  const std::array<double*, 3> axes{mesh.x.data(), mesh.y.data(), mesh.z.data()};
  int zones = 0;
  for (const int count : mesh.counts) zones += count;
  const std::string list = std::string(name) + "_zones";
  if (mesh.with_zones)
    DBPutZonelist2(file, list.c_str(), zones, mesh.dimensions, mesh.nodes.data(),
                   static_cast<int>(mesh.nodes.size()), mesh.origin, mesh.ghosts_before,
                   mesh.ghosts_behind, mesh.types.data(), mesh.sizes.data(), mesh.counts.data(),
                   static_cast<int>(mesh.types.size()), nullptr);
  DBPutUcdmesh(file, name, mesh.dimensions, nullptr, axes.data(), static_cast<int>(mesh.x.size()),
               zones, mesh.with_zones ? list.c_str() : "nothing", nullptr, DB_DOUBLE, nullptr);
}

template <typename Write>
std::string silo_refusal(const Write& write) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.silo");
  write(new_silo(path).get());
  const std::string message = refusal(path);
  return message.empty() ? message : message.substr(path.size() + 2);
}
std::string silo_refusal(const SiloMesh& mesh) {
  return silo_refusal([&](DBfile* file) { put_silo_mesh(file, mesh); });
}

template <typename Write>
Reading silo_reading(const Write& write) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.silo");
  write(new_silo(path).get());
  return read_any(path);
}

TEST(SiloRefusals, FilesWithoutMeshes) {
  EXPECT_EQ(silo_refusal([](DBfile* file) {
              const std::array<double, 2> curve{0, 1};
              DBPutCurve(file, "curve", curve.data(), curve.data(), DB_DOUBLE, 2, nullptr);
            }),
            "holds no mesh at its root");
  EXPECT_EQ(silo_refusal({.with_zones = false}), "mesh 'mesh' is damaged");
  const Reading reading = silo_reading([](DBfile* file) {
    put_silo_mesh(file, {});
    put_silo_mesh(
        file, {.nodes = {0, 1, 2}, .types = {DB_ZONETYPE_TRIANGLE}, .sizes = {3}, .dimensions = 2},
        "plane");
  });
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_THAT(reading.notes, Contains("left out 'plane', a mesh of 2 dimensions"));
}

TEST(SiloRefusals, ZonesThatDoNotFit) {
  EXPECT_EQ(silo_refusal(SiloMesh()), "");
  EXPECT_EQ(silo_refusal({.nodes = {0, 1, 2, 4}}),
            "mesh 'mesh': there is no node 4 (4 nodes found)");
  EXPECT_EQ(silo_refusal({.nodes = {0, 1, 2, -1}}),
            "mesh 'mesh': there is no node -1 (4 nodes found)");
  EXPECT_EQ(silo_refusal({.nodes = {1, 2, 3, 4}, .origin = 1}), "");
  EXPECT_EQ(silo_refusal({.nodes = {0, 2, 3, 4}, .origin = 1}),
            "mesh 'mesh': there is no node 0 (4 nodes found)");
  const std::string fit = "mesh 'mesh': its zones do not fit their list of nodes";
  EXPECT_EQ(silo_refusal({.nodes = {0, 1, 2}}), fit);
  EXPECT_EQ(silo_refusal({.nodes = {0, 1, 2, 3, 0, 1, 2}, .counts = {2}}), fit);
  EXPECT_EQ(silo_refusal({.nodes = {0, 1, 2, 3, 0, 1, 2, 3}, .counts = {2}}), "");
  EXPECT_EQ(silo_refusal({.nodes = {0, 1, 2, 3, 0}, .sizes = {5}}), fit);
  EXPECT_EQ(silo_refusal({.sizes = {0}}), fit);
}

TEST(SiloRefusals, ZonesOfOtherTypes) {
  EXPECT_THAT(silo_refusal({.types = {DB_ZONETYPE_POLYGON}}), HasSubstr("1 zone of another type"));
  // files without types: the size tells
  for (const auto& [size, kind] : {std::pair{4, CellKind::tetrahedron4},
                                   {5, CellKind::pyramid5},
                                   {6, CellKind::prism6},
                                   {8, CellKind::brick8}}) {
    SiloMesh mesh{.x = {0, 1, 1, 0, 0, 1, 1, 0},
                  .y = {0, 0, 1, 1, 0, 0, 1, 1},
                  .z = {0, 0, 0, 0, 1, 1, 1, 1},
                  .nodes = {0, 1, 2, 3, 4, 5, 6, 7},
                  .types = {0},
                  .sizes = {size}};
    if (size == 4) mesh.nodes = {0, 1, 3, 4};
    if (size == 6) mesh.nodes = {0, 1, 2, 3, 4, 7};
    mesh.nodes.resize(static_cast<std::size_t>(size));
    const Reading reading = silo_reading([&](DBfile* file) { put_silo_mesh(file, mesh); });
    ASSERT_EQ(reading.mesh.cell_count(), 1U);
    EXPECT_EQ(reading.mesh.kinds[0], kind);
    EXPECT_GT(volume_of(reading.mesh, 0), 0);
  }
}

TEST(SiloRefusals, ZonesThatAreTurned) {
  const Reading reading = silo_reading([](DBfile* file) {
    put_silo_mesh(file, {.nodes = {0, 2, 1, 3, 0, 2, 1, 3, 0, 1, 2, 3}, .counts = {3}});
  });
  EXPECT_THAT(reading.notes, Contains("mesh 'mesh': its zones of the type tetrahedron are inside "
                                      "out and were turned"));
  EXPECT_NEAR(volume_of(reading.mesh, 0), 1.0 / 6, 1e-15);
}

TEST(SiloRefusals, GhostZonesAreThoseOutsideTheRealOnes) {
  const auto values = [](int before, int behind) {
    const ZooMesh mesh =
        silo_reading([&](DBfile* file) {
          put_silo_mesh(file, {.nodes = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3},
                               .counts = {3},
                               .ghosts_before = before,
                               .ghosts_behind = behind});
          const std::array<double, 3> p{5, 6, 7};
          DBPutUcdvar1(file, "p", "mesh", p.data(), 3, nullptr, 0, DB_DOUBLE, DB_ZONECENT, nullptr);
        }).mesh;
    const auto all = field_named(mesh, "p").values.view();
    return std::vector<double>(all.begin(), all.end());
  };
  EXPECT_THAT(values(0, 0), ElementsAre(5, 6, 7));
  EXPECT_THAT(values(1, 0), ElementsAre(6, 7));
  EXPECT_THAT(values(0, 1), ElementsAre(5, 6));
  EXPECT_THAT(values(1, 1), ElementsAre(6));
}

/// A mesh of the blocks `names` of the file itself, of which "mesh" is one.
std::string blocks_refusal(const std::vector<const char*>& names) {
  return silo_refusal([&](DBfile* file) {
    put_silo_mesh(file, {});
    const std::vector<int> types(names.size(), DB_UCDMESH);
    DBPutMultimesh(file, "all", static_cast<int>(names.size()), names.data(), types.data(),
                   nullptr);
  });
}

TEST(SiloRefusals, BlocksThatAreNotThere) {
  EXPECT_EQ(blocks_refusal({"mesh"}), "");
  EXPECT_EQ(blocks_refusal({"EMPTY", "mesh", "EMPTY"}), "");
  EXPECT_EQ(blocks_refusal({"EMPTY"}), "holds no mesh at its root");
  EXPECT_EQ(blocks_refusal({"mesh", "nothing"}),
            "mesh 'nothing' is not there, or not one of zones");
  EXPECT_EQ(blocks_refusal({"mesh_zones"}), "mesh 'mesh_zones' is not there, or not one of zones");
}

TEST(SiloRefusals, FurtherMultiBlockMeshesAreLeftOut) {
  const Reading reading = silo_reading([](DBfile* file) {
    put_silo_mesh(file, {});
    const char* name = "mesh";
    const int type = DB_UCDMESH;
    DBPutMultimesh(file, "first", 1, &name, &type, nullptr);
    DBPutMultimesh(file, "second", 1, &name, &type, nullptr);
  });
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_THAT(reading.notes, Contains("left out the further multi-block mesh 'second'"));
}

TEST(SiloRefusals, VariablesThatDoNotFit) {
  const auto variable = [](int count, int centering) {
    return silo_refusal([&](DBfile* file) {
      put_silo_mesh(file, {});
      const std::vector<double> values(10, 1);
      DBPutUcdvar1(file, "p", "mesh", values.data(), count, nullptr, 0, DB_DOUBLE, centering,
                   nullptr);
    });
  };
  EXPECT_EQ(variable(4, DB_NODECENT), "");
  EXPECT_EQ(variable(1, DB_ZONECENT), "");
  EXPECT_EQ(variable(3, DB_NODECENT),
            "variable 'p': does not fit its mesh (4 values expected, 3 found)");
  EXPECT_EQ(variable(5, DB_NODECENT),
            "variable 'p': does not fit its mesh (4 values expected, 5 found)");
  EXPECT_EQ(variable(4, DB_ZONECENT),
            "variable 'p': does not fit its mesh (1 values expected, 4 found)");
}

TEST(SiloRefusals, NumbersOfEveryType) {
  const std::array<float, 2> floats{0.5F, -1};
  const std::array<double, 2> doubles{0.5, -1};
  const std::array<int, 2> ints{70000, -1};
  const std::array<short, 2> shorts{300, -1};
  const std::array<long, 2> longs{5'000'000'000, -1};
  const std::array<long long, 2> more{6'000'000'000, -1};
  const std::array<signed char, 2> chars{7, -1};
  EXPECT_THAT(silo::numbers(floats.data(), DB_FLOAT, 2, "s"), ElementsAre(0.5, -1));
  EXPECT_THAT(silo::numbers(doubles.data(), DB_DOUBLE, 2, "s"), ElementsAre(0.5, -1));
  EXPECT_THAT(silo::numbers(ints.data(), DB_INT, 2, "s"), ElementsAre(70000, -1));
  EXPECT_THAT(silo::numbers(shorts.data(), DB_SHORT, 2, "s"), ElementsAre(300, -1));
  EXPECT_THAT(silo::numbers(longs.data(), DB_LONG, 2, "s"), ElementsAre(5e9, -1));
  EXPECT_THAT(silo::numbers(more.data(), DB_LONG_LONG, 2, "s"), ElementsAre(6e9, -1));
  EXPECT_THAT(silo::numbers(chars.data(), DB_CHAR, 1, "s"), ElementsAre(7));
  const auto complaint = [](const void* data, int type) -> std::string {
    try {
      silo::numbers(data, type, 1, "s");
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(complaint(nullptr, DB_INT), "s: has no values where there should be some");
  EXPECT_EQ(complaint(ints.data(), DB_NOTYPE),
            fmt::format("s: values of Silo's type {} (numbers expected)", DB_NOTYPE));
}

}  // namespace
}  // namespace hiac::formats
