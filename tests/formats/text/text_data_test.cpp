// Real files of the text formats: each holds what the table of the data folder says, counted by
// others' programs.
#include "tests/formats/file_rows.hpp"

namespace hiac::formats {
namespace {

using testing::HasSubstr;

constexpr auto tet4 = CellKind::tetrahedron4;
constexpr auto tet10 = CellKind::tetrahedron10;
constexpr auto pyr5 = CellKind::pyramid5;
constexpr auto prism6 = CellKind::prism6;
constexpr auto prism15 = CellKind::prism15;
constexpr auto brick8 = CellKind::brick8;
constexpr auto brick20 = CellKind::brick20;

const std::vector<FileRow> kRows{
    {"abaqus/beam10p.inp", 90, {{tet10, 31}}, {}},
    {"abaqus/c3d15.inp", 127, {{prism15, 24}}, {}},
    {"abaqus/c3d6.inp", 16, {{prism6, 6}}, {}},
    {"abaqus/induction3.inp", 3199, {{brick8, 1200}}, {}, 0, 1647},
    {"abaqus/piston_1.inp", 3994, {{brick8, 2676}}, {}},
    {"abaqus/poly_sample_test2.inp.gz", 1625, {{brick8, 1280}}, {}},
    {"abaqus/segmentunsmooth.inp", 2756, {{tet10, 1489}}, {}},
    {"abaqus/test_bracket.inp", 306, {{tet4, 793}}, {}},
    {"nasty/nonconforming/beamptied6.inp", 282, {{brick20, 30}}, {}, 0, 274},
    {"ansys_cdb/HexBeam.cdb", 321, {{brick20, 40}}, {}},
    {"ansys_cdb/all_solid_cells.cdb",
     52,
     {{brick20, 1}, {prism15, 1}, {CellKind::pyramid13, 1}, {tet10, 1}},
     {}},
    {"ansys_cdb/sector.cdb", 655, {{brick8, 101}, {prism6, 4}}, {}, 0, 230},
    {"avs_ucd/3d_CC_cubit_new.ucd", 54, {{brick8, 16}}, {{"Material Id", "cell", 1, 1, 101}}},
    {"avs_ucd/gerold_1.inp", 2156, {{brick8, 1512}}, {{"Material Id", "cell", 1, 0, 0}}},
    {"calculix_frd/C3D15.frd",
     15,
     {{prism15, 1}},
     {{"DISP", "node", 3, -10760, 9685.5},
      {"STRESS", "node", 6, -2.3623e+06, 2.2864e+06},
      {"TOSTRAIN", "node", 6, -10.51, 8.9609},
      {"FORC", "node", 3, -4.2452e+05, 7.7229e+05},
      {"ERROR", "node", 1, 45.372, 45.372}},
     1},
    {"calculix_frd/John_Mannisto_blade_sector.frd",
     1720,
     {{brick8, 832}},
     {{"DISP", "node", 3, -0.040286, 0.040286}, {"DISPI", "node", 3, -0.049096, 0.049096}},
     15},
    {"calculix_frd/furnace.frd", 1800, {{prism15, 300}}, {}, 0, 1668},
    {"calculix_frd/greencyc1.frd",
     7932,
     {{brick20, 1152}},
     {{"STRESS", "node", 6, -870.5, 870.5}, {"STRESSI", "node", 6, -753.88, 753.88}},
     1},
    {"calculix_frd/masterIIa.frd",
     10017,
     {{brick20, 2048}},
     {{"DISP", "node", 3, -0.015645, 0.10003},
      {"STRESS", "node", 6, -5973.4, 6214.8},
      {"ERROR", "node", 1, 0.54123, 20.676}},
     1},
    {"calculix_frd/mesh.frd",
     190,
     {{prism6, 2}, {prism15, 2}, {brick8, 1}, {brick20, 1}, {tet4, 23}, {tet10, 23}},
     {{"DISP", "node", 3, -0.0024977, 0.005953},
      {"NDTEMP", "node", 1, 50, 50},
      {"STRESS", "node", 6, -151.14, 112.95},
      {"TOSTRAIN", "node", 6, -0.0007031, 0.00098355},
      {"FORC", "node", 3, -1890, 1890},
      {"ERROR", "node", 1, 0, 83.465}},
     2,
     158},
    {"calculix_frd/static_cantilever_calculix.frd",
     682,
     {{prism6, 480}},
     {{"DISP", "node", 3, -0.010709, 0.00089111},
      {"STRESS", "node", 6, -1.9256e+08, 1.9872e+08},
      {"FORC", "node", 3, -1.4604e+05, 1.4626e+05},
      {"PE", "node", 1, 0, 0},
      {"ERROR", "node", 1, 0, 0}},
     2},
    {"calculix_frd/stepsuperwedge.frd",
     5974,
     {{prism6, 5626}, {brick8, 32}},
     {{"V3DF", "node", 3, -1.2203, 3.0339},
      {"PS3DF", "node", 1, 0.80788, 12.477},
      {"TS3DF", "node", 1, 0.8619, 2.7896},
      {"M3DF", "node", 1, 0.033543, 3.053},
      {"TT3DF", "node", 1, 1.2594, 2.9229}},
     1},
    {"calculix_frd/thermomech.frd",
     522,
     {{brick20, 64}},
     {{"DISP", "node", 3, -0.00063603, 0.17342},
      {"NDTEMP", "node", 1, 0, 600},
      {"STRESS", "node", 6, -5.7924, 5.3674},
      {"FLUX", "node", 3, -592.92, 10250},
      {"RFL", "node", 1, -3357.1, 3393.2}},
     3},
    {"gambit/prism.neu",
     10,
     {{prism6, 4}},
     {{"Boundary Condition", "node", 1, 0, 1}, {"Material Type", "cell", 1, 2, 4}}},
    {"gmsh/homology.asc.v41.msh", 2209, {{tet4, 8202}}, {}},
    {"gmsh/piece.asc.v22.msh", 3939, {{tet4, 13179}}, {}, 0, 3915},
    {"gmsh/piece.asc.v41.msh", 4094, {{tet4, 13370}}, {}, 0, 4067},
    {"gmsh/unstructured_hex.v22.msh", 573, {{brick8, 400}}, {}},
    {"gmsh/large/anu.msh", 16675, {{tet4, 92172}}, {}},
    {"gmsh/mixed/example.msh", 8239, {{brick8, 6018}}, {}},
    {"gmsh/mixed/ssnv199b.msh", 1147, {{tet4, 3481}, {prism6, 462}}, {}},
    {"gmsh/quadratic/quadraticsphere.msh", 1204, {{tet10, 640}}, {}},
    {"gmsh/quadratic/wheel.msh", 1822, {{tet10, 895}}, {}},
    {"gmsh/with_data/adaptive_tet10.msh",
     27,
     {{tet10, 6}},
     {{"2nd order view", "node", 1, 1, 12}},
     2},
    {"nasty/sparse_ids/grid_in_msh_01.3d_neg.msh", 8, {{brick8, 1}}, {}},
    {"nasty/sparse_ids/grid_in_msh_01.3d_neg.v41.msh", 8, {{brick8, 1}}, {}},
    {"medit/cube-cylinder.mesh",
     286,
     {{tet4, 952}},
     {{"ref", "node", 1, 0, 0}, {"ref", "cell", 1, 0, 7}}},
    {"medit/ega.meshb", 421, {{tet4, 2122}}, {{"ref", "node", 1, 0, 0}, {"ref", "cell", 1, 0, 15}}},
    {"nastran/chexa.bdf", 8, {{brick8, 1}}, {}},
    {"nastran/cpenta.bdf", 6, {{prism6, 1}}, {}},
    {"nastran/ctetra10.bdf", 10, {{tet10, 1}}, {}},
    {"nastran/model1_sim1-solution_1.bdf",
     2363,
     {{brick8, 64},
      {tet4, 436},
      {pyr5, 16},
      {tet10, 854 + 36},
      {CellKind::pyramid13, 16 + 16},
      {brick20, 64}},
     {},
     0,
     2403},
    {"nastran/solid_bending.bdf", 72, {{tet4, 186}}, {}},
    {"netgen/hinge.vol", 822, {{tet4, 2413}}, {{"index", "cell", 1, 1, 1}}},
    {"gmsh/quadratic/hex27_8ele_v2.msh", 125, {{brick20, 8}}, {}, 0, 81},
    {"tecplot/3d_2x3x4.plt", 26691, {{brick8, 19684}}, {{"A", "node", 1, -1, 1}}},
    {"tecplot/tecplot_ascii.dat",
     180,
     {{brick8, 64}, {prism6, 56}},
     {{"X Velocity", "node", 1, 0, 1.1}}},
    {"tetgen/tetgen_test.1.node", 147, {{tet4, 288}}, {{"ref", "cell", 1, 1, 1}}},
    {"tetgen/tetgen_test.1.ele", 147, {{tet4, 288}}, {{"ref", "cell", 1, 1, 1}}},
    {"ugrid/cube-cylinder.ugrid", 395, {{tet4, 1937}}, {}},
    {"unv/3D.unv", 216, {{brick8, 125}}, {}},
    {"unv/coarse_cylinder.unv", 72, {{tet4, 203}}, {}},
    {"unv/simple_cube.unv", 12, {{prism6, 2}, {tet4, 6}}, {}},
};

class RealTextFile : public testing::TestWithParam<FileRow> {};

TEST_P(RealTextFile, HoldsWhatTheTableSays) {
  const std::string path = data_dir() + "/" + GetParam().path;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  expect_row(GetParam(), path);
  EXPECT_EQ(format_to_read(path).inspect(path).fields.size(), GetParam().fields.size());
}

INSTANTIATE_TEST_SUITE_P(Table, RealTextFile, testing::ValuesIn(kRows), row_name);

struct Refused {
  std::string path;
  std::string reason;
};

TEST(RealTextFiles, WhatCannotBeReadIsRefusedWithItsReason) {
  const std::vector<Refused> rows{
      {"gmsh/cubic/periodic-torus-sector.msh", "36 Hexahedron of 64 nodes"},
      {"gmsh/surfaces_in_3d.bin.v22.msh", "204 Triangle 3"},
      {"gmsh/with_data/interpolation_scheme1.msh", "2 Quadrilateral 4"},
      {"gmsh/with_data/multimodel23.msh", "2 Quadrilateral 4"},
      {"avs_ucd/cellsnd.ascii.inp", "holds no volume cells"},
      {"nasty/malformed/cells_no_points.unv", "no nodes found"},
      {"nasty/malformed/non_matching_num_nodes.unv", ":101: element 19: a surface3 has 3 nodes"},
      {"nasty/malformed/unknown_units.unv", ":3: unknown units (a code from 1 to 10 expected"},
  };
  for (const Refused& row : rows) {
    const std::string path = data_dir() + "/" + row.path;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    EXPECT_THAT(refusal(path), HasSubstr(row.reason));
    EXPECT_THAT(refusal(path), HasSubstr(path));
  }
  ReadOptions corners;
  corners.corners_of_unsupported = true;
  const Reading bricks = read_any(data_dir() + "/gmsh/quadratic/hex27_8ele_v2.msh", corners);
  EXPECT_EQ(bricks.mesh.cell_count(), 8U);
  EXPECT_EQ(bricks.mesh.kinds[0], brick8);
}

// Two versions of the format written from one mesh
TEST(RealTextFiles, TwinsAgree) {
  const std::string folder = data_dir() + "/nasty/sparse_ids/grid_in_msh_01.3d_neg";
  if (!std::filesystem::exists(folder + ".msh")) GTEST_SKIP() << folder << " is not there";
  const ZooMesh a = read_any(folder + ".msh").mesh;
  const ZooMesh b = read_any(folder + ".v41.msh").mesh;
  ASSERT_EQ(a.cell_count(), b.cell_count());
  for (std::size_t n = 0; n < a.nodes.size(); ++n)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(a.position(a.nodes[n])[c], b.position(b.nodes[n])[c]);
}

TEST(RealTextFiles, StepsAreTakenByNumberAndByTime) {
  const std::string path = data_dir() + "/gmsh/with_data/adaptive_tet10.msh";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  ReadOptions first;
  first.step = 0;
  ReadOptions by_time;
  by_time.time = 1.0;
  const ZooMesh last = read_any(path).mesh;
  EXPECT_NE(content_hash(read_any(path, first).mesh), content_hash(last));
  EXPECT_EQ(content_hash(read_any(path, by_time).mesh), content_hash(last));
  first.step = 2;
  EXPECT_THROW(read_any(path, first), UsageError);
}

TEST(RealTextFiles, BlocksAreTakenByName) {
  const std::string path = data_dir() + "/abaqus/piston_1.inp";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  ReadOptions options;
  options.block = "EB5";
  EXPECT_EQ(read_any(path, options).mesh.cell_count(), 5994U - 5953U);
}

}  // namespace
}  // namespace hiac::formats
