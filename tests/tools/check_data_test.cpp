// hiac-check on real files: each that is invalid for its reason, and no valid one called invalid.
// Skipped where the folder of data is not there (HIAC_DATA_DIR, or beside the source folder).

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/instrumented.hpp"
#include "tests/tools/tool_folder.hpp"
#include "tests/tools/valid_files.hpp"

namespace hiac::test {
namespace {

std::string data_folder() {
  const char* const given = std::getenv("HIAC_DATA_DIR");
  return given != nullptr ? given : HIAC_DEFAULT_DATA_DIR;
}

struct Verdict {
  std::string file;
  std::vector<std::string> invalid;  ///< the defects that make it so; none: it is valid
  std::vector<std::string> others;   ///< warnings and notes that it has to have, among others
};

// Files that come to no judgement, since hiac-convert refuses them, and what it says.
const std::vector<std::pair<std::string, std::string>> kRefused{
    {"nasty/curved/hex3Dpart.vtk", "27 nodes need their nodes in faces or inside"},
    {"nasty/malformed/bad_64bit_elem_integers.e", "no volume cells"},
    {"nasty/malformed/cells_no_points.unv", "no nodes found"},
    {"nasty/malformed/non_matching_num_nodes.unv", "surface3 has 3 nodes (2 found)"},
    {"nasty/malformed/unknown_units.unv", "unknown units"}};

// What the files' own descriptions, and VTK's view of their corners, say is wrong with them.
const std::vector<Verdict> kVerdicts{
    {"nasty/curved/6x6x6-hex20.vtk", {}, {}},
    // 4 quadratic tetrahedra with a Jacobian at or under zero at a node
    {"nasty/curved/sphereCube.vtk", {"jacobian"}, {"nonplanar_face"}},
    // 36 quadratic tetrahedra with a Jacobian at or under zero at a node
    {"nasty/curved/sphereCylinder_22492_inv.vtk", {"jacobian", "overlap"}, {"nonplanar_face"}},
    {"nasty/nan/notch_stress.vtk", {}, {}},
    {"nasty/polyhedra/polyhedron2pieces.vtu", {}, {}},
    // ids with gaps, and in either order
    {"nasty/sparse_ids/grid_in_msh_01.3d_neg.msh", {}, {}},
    {"nasty/sparse_ids/grid_in_msh_01.3d_neg.v41.msh", {}, {}},
    // joined along edges and at corners alone; numbered left-handed throughout
    {"nasty/nonconforming/manifoldCheck0.vtu", {}, {"left_handed"}},
    {"nasty/nonconforming/manifoldCheck1.vtu", {}, {"left_handed"}},
    // a box of 1e-5
    {"nasty/scale/small_box_hex_1000.vtk", {}, {"nonplanar_face"}},
    // 36 hexahedra with some corner inverted, all with faces that are not planar
    {"nasty/tangled/hex_5_tangled.vtk",
     {"jacobian", "overlap"},
     {"nonplanar_face", "nonconvex_cell"}},
    // 3 pyramids with some corner inverted
    {"nasty/tangled/mixed-hex-pyr-tet.vtk", {"jacobian", "overlap"}, {"nonplanar_face"}},
    // 9 inverted hexahedra, 16 with some corner inverted
    {"nasty/tangled/par_untangle_original_hex_mesh.1.0.vtk",
     {"inverted", "jacobian", "folded_face", "overlap"},
     {"nonplanar_face"}},
    // 4 hexahedra with some corner inverted
    {"nasty/tangled/pave2.e.vtk", {"jacobian", "overlap"}, {"nonplanar_face", "nonconvex_cell"}},
    // 9 inverted tetrahedra
    {"nasty/tangled/tet_4_tangled.vtk", {"inverted", "folded_face", "overlap"}, {}},
    // valid ones of all kinds
    {"vtk_xml/analytic/Tetrahedron.vtu", {}, {}},
    {"vtk_xml/analytic/Wedge.vtu", {}, {}},
    {"vtk_xml/fe_results/elmer_2241-results0001.vtu", {}, {}},
    {"vtk_xml/fe_results/notch_disp.vtu", {}, {}},
    {"vtk_xml/structured/multicomb_1.vts", {}, {"nonplanar_face"}},
    // half of the tetrahedra in the other half's mirror
    {"vtk_legacy/linear/tetraMesh.vtk", {"inverted"}, {}},
    // two shells of bricks with nodes of their own between them
    {"vtk_legacy/linear/AngularSector.vtk", {}, {"duplicate_node", "torn_interface"}},
    // diagonals that cross
    {"vtk_legacy/versions/data_3_3_tets.vtk", {}, {"sliding_interface"}},
    {"vtk_legacy/zoo/uGridEx.vtk", {}, {"hanging_interface"}},
    // a crushed can: 51 hexahedra with some corner inverted
    {"vtk_xml/fe_results/can.vtu", {"jacobian", "overlap"}, {"nonplanar_face"}},
    {"vtkhdf/can-vtu.hdf", {"jacobian", "overlap"}, {"nonplanar_face"}},
    // an inverted tetrahedron, a hexahedron with an inverted corner
    {"vtk_legacy/zoo/qualityEx.vtk", {"inverted", "jacobian"}, {}},
    // curved before its cells were smoothed: at a corner of two of them the Jacobian is -0.4 times
    // its largest value
    {"abaqus/segmentunsmooth.inp", {"jacobian"}, {"nonplanar_face"}},
    // the Jacobian is -1e-7 times its largest value at a corner of one curved tetrahedron
    {"large/part_quad.mesh", {"jacobian"}, {"nonplanar_face"}},
    {"nasty/nonconforming/beamptied6.inp", {}, {"duplicate_node", "torn_interface"}}};

constexpr std::uintmax_t kSmall = 200'000;

using CheckRefused = ToolFolder;

TEST_F(CheckRefused, FilesThatCannotBeReadSayWhy) {
  for (const auto& [name, why] : kRefused) {
    const std::string path = data_folder() + "/" + name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
    EXPECT_EQ(run("$CONVERT -q '" + path + "' -o m.zoo"), 3) << name;
    EXPECT_THAT(complaint(), testing::HasSubstr(why)) << name;
    EXPECT_FALSE(std::filesystem::exists(file("m.zoo"))) << name;
  }
}

class CheckData : public ToolFolder, public testing::WithParamInterface<Verdict> {};

INSTANTIATE_TEST_SUITE_P(Files, CheckData, testing::ValuesIn(kVerdicts), [](const auto& param) {
  std::string name = std::filesystem::path(param.param.file).filename().string();
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
});

// Every cell counts once in each figure of its kind, and every number is one.
void expect_figures_of_all_cells(const nlohmann::json& facts) {
  std::uint64_t cells = 0;
  for (const auto& kind : facts["quality"]["kinds"]) {
    const std::uint64_t of_kind = kind["cells"];
    cells += of_kind;
    EXPECT_GE(kind["figures"].size(), 7U);
    for (const auto& figure : kind["figures"]) {
      EXPECT_EQ(figure["count"].get<std::uint64_t>() + figure["undefined"].get<std::uint64_t>(),
                of_kind);
      if (figure["count"] == 0) continue;
      EXPECT_TRUE(figure["least"].is_number() && figure["largest"].is_number()) << figure;
      EXPECT_LE(figure["least"], figure["percentiles"]["50"]) << figure;
      EXPECT_LE(figure["percentiles"]["50"], figure["largest"]) << figure;
    }
  }
  EXPECT_EQ(cells, facts["cells"].get<std::uint64_t>());
  EXPECT_GE(facts["quality"]["components"], 1);
}

TEST_P(CheckData, HasTheRightVerdict) {
  const Verdict& verdict = GetParam();
  const std::string path = data_folder() + "/" + verdict.file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  ASSERT_EQ(run("$CONVERT -q '" + path + "' -o m.zoo"), 0) << complaint();
  const int code =
      run("'" HIAC_CHECK "' m.zoo --overlap --quality --json facts.json -o passed.zoo");
  EXPECT_EQ(code, verdict.invalid.empty() ? 0 : 1) << complaint();
  EXPECT_EQ(std::filesystem::exists(file("passed.zoo")), verdict.invalid.empty());
  const auto facts = nlohmann::json::parse(bytes_of(file("facts.json")));
  std::vector<std::string> invalid, others;
  for (const auto& finding : facts["findings"])
    (finding["severity"] == "invalid" ? invalid : others).push_back(finding["defect"]);
  EXPECT_EQ(invalid, verdict.invalid);
  for (const std::string& other : verdict.others)
    EXPECT_TRUE(std::ranges::count(others, other)) << other;
  expect_figures_of_all_cells(facts);
}

using CheckPipe = ToolFolder;

// From a foreign file to the picture: two tetrahedra, the second as `nodes` says.
TEST_F(CheckPipe, StopsWithoutAPictureWhereTheMeshIsInvalid) {
  std::ofstream(file("view.toml")) << R"([image]
width = 8
height = 6
[camera]
eye = [3.0, 2.0, 1.5]
look_at = [0.5, 0.5, 0.5]
up = [0.0, 0.0, 1.0]
fov = 35.0
[volume.extinction]
field = "f"
points = [[0.0, 0.1], [4.0, 3.0]]
)";
  const auto pipe = [&](const std::string& nodes) {
    std::ofstream(file("m.vtk")) << "# vtk DataFile Version 3.0\nm\nASCII\nDATASET "
                                    "UNSTRUCTURED_GRID\nPOINTS 5 double\n0 0 0 1 0 0 0 1 0 0 0 1 "
                                    "1 1 1\nCELLS 2 10\n4 0 1 2 3\n4 " +
                                        nodes +
                                        "\nCELL_TYPES 2\n10\n10\nPOINT_DATA 5\nSCALARS f double "
                                        "1\nLOOKUP_TABLE default\n0 1 2 3 4\n";
    return run("$CONVERT -q m.vtk | '" HIAC_CHECK
               "' | $SORT --view view.toml | $RENDER --view view.toml -o p.npy");
  };
  EXPECT_EQ(pipe("1 3 2 4"), 3);
  EXPECT_THAT(complaint(), testing::HasSubstr("the mesh is invalid (1 inverted cells)"));
  EXPECT_FALSE(std::filesystem::exists(file("p.npy")));
  EXPECT_EQ(pipe("1 2 3 4"), 0) << complaint();
  EXPECT_TRUE(std::filesystem::exists(file("p.npy")));
}

using CheckAllData = ToolFolder;

// In whatever format. By default small files are judged; HIAC_ALL_DATA=1 takes all of them.
TEST_F(CheckAllData, NoValidFileIsCalledInvalid) {
  const bool all = std::getenv("HIAC_ALL_DATA") != nullptr;
  std::size_t judged = 0, number = 0;
  for (const std::string& name : kValidFiles) {
    const std::string path = data_folder() + "/" + name;
    if (!std::filesystem::exists(path)) continue;
    if (!all && (std::filesystem::file_size(path) > kSmall || number++ % (4 / tried(4)) != 0))
      continue;
    ASSERT_EQ(run("$CONVERT -q '" + path + "' -o m.zoo"), 0) << complaint();
    EXPECT_EQ(run("'" HIAC_CHECK "' -q m.zoo -o passed.zoo"), 0) << name << ": " << complaint();
    ++judged;
  }
  if (judged == 0) GTEST_SKIP() << "no data in " << data_folder();
}

}  // namespace
}  // namespace hiac::test
