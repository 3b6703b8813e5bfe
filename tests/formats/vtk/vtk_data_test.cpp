// Real files: each holds what the table of the data folder says, read by others' programs.
#include <algorithm>
#include <cmath>

#include "formats/common/cells/keep_corners.hpp"
#include "tests/formats/file_rows.hpp"

namespace hiac::formats {
namespace {

using testing::HasSubstr;

constexpr auto tet4 = CellKind::tetrahedron4;
constexpr auto tet10 = CellKind::tetrahedron10;
constexpr auto brick8 = CellKind::brick8;
constexpr auto brick20 = CellKind::brick20;
const FieldRow kFixed{"fixed", "node", 1, 0, 1};
const FieldRow kDistance{"DistanceToCenter", "node", 1, 0, 1.7321};
const FieldRow kPolynomial{"Polynomial", "node", 1, 1, 7};

const std::vector<FileRow> kRows{
    {"large/cub_wedge_like.vtk", 21156, {{tet4, 112393}}, {kFixed}},
    {"mfem/beam-wedge.vtk", 27, {{CellKind::prism6, 8}}, {{"material", "cell", 1, 1, 2}}},
    {"mfem/escher-p2.vtk", 117, {{tet10, 42}}, {{"material", "cell", 1, 1, 1}}},
    {"nasty/curved/6x6x6-hex20.vtk", 1225, {{brick20, 216}}, {kFixed}},
    {"nasty/curved/sphereCube.vtk",
     474,
     {{tet10, 265}},
     {kFixed, {"GLOBAL_ID", "cell", 1, 1, 265}}},
    {"nasty/curved/sphereCylinder_22492_inv.vtk",
     22492,
     {{tet10, 15033}},
     {kFixed, {"GLOBAL_ID", "cell", 1, 1, 15033}}},
    {"nasty/nan/notch_stress.vtk",
     12717,
     {{brick8, 2188}, {CellKind::prism6, 4}},
     {{"Nodal Stress-0", "node", 1, -1.4536e+05, 8.1078e+06},
      {"Nodal Stress", "node", 6, -3.0226e+06, 8.1078e+06},
      {"Nodal Stress-normed", "node", 1, 3206.6, 8.1098e+06}},
     0,
     12717 - 9180},
    {"nasty/nonconforming/manifoldCheck0.vtu", 29, {{brick8, 4}}, {}},
    {"nasty/nonconforming/manifoldCheck1.vtu", 24, {{brick8, 4}}, {}},
    {"nasty/scale/small_box_hex_1000.vtk", 1331, {{brick8, 1000}}, {kFixed}},
    {"nasty/tangled/hex_5_tangled.vtk", 216, {{brick8, 125}}, {kFixed}},
    {"nasty/tangled/mixed-hex-pyr-tet.vtk",
     683,
     {{tet4, 445}, {brick8, 305}, {CellKind::pyramid5, 190}},
     {kFixed}},
    {"nasty/tangled/par_untangle_original_hex_mesh.1.0.vtk",
     216,
     {{brick8, 125}},
     {kFixed, {"GLOBAL_ID", "node", 1, 1, 216}, {"PROCESSOR_ID", "node", 1, 0, 0}}},
    {"nasty/tangled/pave2.e.vtk",
     3408,
     {{brick8, 2704}},
     {kFixed, {"GLOBAL_ID", "cell", 1, 1, 2704}}},
    {"nasty/tangled/tet_4_tangled.vtk", 129, {{tet4, 408}}, {kFixed}},
    {"vtk_legacy/cells/Hexahedron.vtk", 8, {{brick8, 1}}, {}},
    {"vtk_legacy/cells/Pyramid.vtk", 5, {{CellKind::pyramid5, 1}}, {}},
    {"vtk_legacy/cells/Tetra.vtk", 4, {{tet4, 1}}, {}},
    {"vtk_legacy/cells/Voxel.vtk", 8, {{brick8, 1}}, {}},
    {"vtk_legacy/cells/Wedge.vtk", 6, {{CellKind::prism6, 1}}, {}},
    {"vtk_legacy/classic/spx.vtk", 2896, {{tet4, 12936}}, {{"scalars", "node", 1, 0, 2.254}}},
    {"vtk_legacy/linear/AngularSector.vtk",
     10141,
     {{brick8, 7632}, {CellKind::pyramid5, 144}},
     {{"PointId", "node", 1, 0, 9126}, {"CellId", "cell", 1, 0, 7775}}},
    {"vtk_legacy/linear/hexa.vtk",
     12167,
     {{brick8, 10648}},
     {{"scalars", "node", 1, 0.75306, 17.321}}},
    {"vtk_legacy/linear/tetraMesh.vtk", 55, {{tet4, 160}}, {{"scalars", "node", 1, 0, 4}}},
    {"vtk_legacy/structured/SampleStructGrid.vtk",
     24000,
     {{brick8, 21489}},
     {{"scalars", "node", 1, 0, 1.3046}, {"scalars", "cell", 1, -0.26293, 1}}},
    {"vtk_legacy/tets/flat-tet-sphere.vtk",
     4793,
     {{tet4, 23636}},
     {{"GLOBAL_ID", "node", 1, 1, 4793}, kFixed, {"GLOBAL_ID", "cell", 1, 1, 23636}}},
    {"vtk_legacy/versions/data_3_3_tets.vtk",
     27,
     {{tet4, 40}},
     {{"x", "node", 1, 0, 1},
      {"xyz", "node", 3, 0, 1},
      {"center_x", "cell", 1, 0.125, 0.875},
      {"center_xyz", "cell", 3, 0.125, 0.875}}},
    {"vtk_legacy/versions/mesh_vtk51.vtk",
     1331,
     {{brick8, 1000}},
     {{"MaterialID", "cell", 1, 1, 60}}},
    {"vtk_legacy/zoo/qualityEx.vtk", 16, {{tet4, 3}, {brick8, 2}}, {}},
    {"vtk_legacy/zoo/uGridEx.vtk",
     27,
     {{tet4, 2}, {brick8, 2}},
     {{"scalars", "node", 1, 0, 26}, {"vectors", "node", 3, 0, 2}},
     0,
     14},
    {"vtk_xml/analytic/Hexahedron.vtu", 26, {{brick8, 7}}, {{"material", "cell", 1, 1, 1}}},
    {"vtk_xml/analytic/QuadraticPyramid.vtu",
     153,
     {{CellKind::pyramid13, 48}},
     {kDistance, kPolynomial}},
    {"vtk_xml/analytic/QuadraticTetra.vtu", 189, {{tet10, 96}}, {kDistance, kPolynomial}},
    {"vtk_xml/analytic/Tetrahedron.vtu", 35, {{tet4, 96}}, {kDistance, kPolynomial}},
    {"vtk_xml/analytic/Wedge.vtu", 27, {{CellKind::prism6, 16}}, {kDistance, kPolynomial}},
    {"vtk_xml/fe_results/bracket_appended_compressed.vtu",
     50000,
     {{tet4, 206208}},
     {{"xdsp", "node", 1, -9.5362e-09, 3.2377e-07},
      {"ydsp", "node", 1, -1.8458e-08, 3.6171e-08},
      {"zdsp", "node", 1, -4.5761e-08, 7.6603e-08},
      {"Material #", "cell", 1, 1, 1},
      {"sj2p", "cell", 1, 216.08, 1.1944e+05}},
     0,
     50000 - 10577},
    {"vtk_xml/fe_results/can.vtu",
     6724,
     {{brick8, 4800}},
     {{"DISPL", "node", 3, -17.81, 1.1782},
      {"VEL", "node", 3, -4560.6, 2941.1},
      {"ACCL", "node", 3, -1.3516e+08, 1.8601e+08},
      {"EQPS", "cell", 1, 0.021583, 2.8939}}},
    {"vtk_xml/fe_results/dataset.vtu",
     102578,
     {{tet10, 56786}},
     {{"Equivalent (von-Mises) Stress (psi)", "cell", 1, 0.014035, 23.269}}},
    {"vtk_xml/fe_results/elmer_2241-results0001.vtu",
     2828,
     {{tet4, 14729}},
     {{"alpha", "node", 1, -2.2939e-27, 1},
      {"beta", "node", 1, 0, 1},
      {"w", "node", 1, 0, 1},
      {"x", "node", 1, 0, 0},
      {"a re", "node", 1, -1.0528e-22, -1.0528e-22},
      {"a im", "node", 1, -4.6792e-24, -4.6792e-24},
      {"magnetic flux density re", "node", 3, -0.074709, 0.19673},
      {"magnetic flux density im", "node", 3, -0.0097428, 0.0053111},
      {"current density re", "node", 3, -1.5027e+06, 1.53e+06},
      {"current density im", "node", 3, -3.9995e-09, 3.9279e-09}}},
    {"vtk_xml/fe_results/notch_disp.vtu",
     12717,
     {{brick20, 2188}, {CellKind::prism15, 4}},
     {{"Nodal Displacement", "node", 3, -1.0375e-07, 2.7927e-06}}},
    {"vtk_xml/structured/multicomb_1.vts",
     864,
     {{brick8, 616}},
     {{"Density", "node", 1, 0.199, 0.63864},
      {"Momentum", "node", 3, -362.03, 332.25},
      {"StagnationEnergy", "node", 1, 0, 0}}},
};

class RealFile : public testing::TestWithParam<FileRow> {};

TEST_P(RealFile, HoldsWhatTheTableSays) {
  const std::string path = data_dir() + "/" + GetParam().path;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  expect_row(GetParam(), path);
}

INSTANTIATE_TEST_SUITE_P(Table, RealFile, testing::ValuesIn(kRows), row_name);

struct Refused {
  std::string path;
  std::string reason;
};

TEST(RealFiles, WhatCannotBeHeldIsRefusedByName) {
  const std::vector<Refused> rows{
      {"mfem/fichera-mixed-p2.vtk", "3 TriQuadraticHexahedron of 27 nodes"},
      {"nasty/curved/hex3Dpart.vtk", "174 TriQuadraticHexahedron of 27 nodes"},
      {"vtk_xml/cells/HexagonalPrism.vtu", "1 HexagonalPrism"},
      {"vtk_xml/cells/PentagonalPrism.vtu", "1 PentagonalPrism"},
      {"vtk_xml/encodings/quad_append_b64_compress.vtu", "9 Quad"},
      {"vtk_xml/encodings/quad_append_raw.vtu", "9 Quad"},
      {"vtk_xml/encodings/quad_ascii.vtu", "9 Quad"},
      {"vtk_xml/encodings/quad_binary.vtu", "9 Quad"},
      {"vtk_xml/lagrange/LagrangeHexWedge.vtk", "the data do not fit the cells"},
      {"vtk_xml/lagrange/tets_in_1x1x1_block_o6.vtk", "5 LagrangeTetra of 84 nodes"},
  };
  for (const Refused& row : rows) {
    const std::string path = data_dir() + "/" + row.path;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    EXPECT_THAT(refusal(path), HasSubstr(row.reason));
    EXPECT_THAT(refusal(path), HasSubstr(path));
  }
}

TEST(RealFiles, UnsupportedCellsAreSkippedOrReducedOnDemand) {
  const std::string mixed = data_dir() + "/mfem/fichera-mixed-p2.vtk";
  if (!std::filesystem::exists(mixed)) GTEST_SKIP() << mixed << " is not there";
  ReadOptions skip;
  skip.skip_unsupported = true;
  EXPECT_GT(read_any(mixed, skip).mesh.cell_count(), 0U);
  ReadOptions approximate;
  approximate.approximate = true;
  const ZooMesh all = read_any(mixed, approximate).mesh;
  EXPECT_EQ(std::count(all.kinds.begin(), all.kinds.end(), brick20), 3);
  EXPECT_EQ(std::count(all.kinds.begin(), all.kinds.end(), CellKind::prism15), 6);
  ReadOptions corners;
  corners.corners_of_unsupported = true;
  const Reading bricks = read_any(data_dir() + "/nasty/curved/hex3Dpart.vtk", corners);
  EXPECT_EQ(bricks.mesh.cell_count(), 174U);
  EXPECT_EQ(bricks.mesh.kinds[0], CellKind::brick8);
  const Reading tets =
      read_any(data_dir() + "/vtk_xml/lagrange/tets_in_1x1x1_block_o6.vtk", corners);
  EXPECT_EQ(tets.mesh.kinds[4], CellKind::tetrahedron4);
}

// The fields are functions of the position: a wrong node order would show
TEST(RealFiles, AnalyticFieldsFitTheirNodes) {
  for (const std::string name : {"QuadraticPyramid", "QuadraticTetra", "Tetrahedron", "Wedge"}) {
    const std::string path = data_dir() + "/vtk_xml/analytic/" + name + ".vtu";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const ZooMesh mesh = read_any(path).mesh;
    const Field distance = scalar_field(mesh, "DistanceToCenter");
    for (NodeId node = 0; node < mesh.node_count(); ++node) {
      const auto x = mesh.position(node);
      EXPECT_NEAR(distance.values[node], std::hypot(x[0] - 1, x[1] - 1, x[2] - 1), 1e-6);
    }
  }
  const ZooMesh tets = read_any(data_dir() + "/vtk_legacy/versions/data_3_3_tets.vtk").mesh;
  const Field x = scalar_field(tets, "x");
  const Field center = scalar_field(tets, "center_xyz:y");
  for (NodeId node = 0; node < tets.node_count(); ++node)
    EXPECT_EQ(x.values[node], tets.position(node)[0]);
  for (CellId cell = 0; cell < tets.cell_count(); ++cell) {
    double mean = 0;
    for (const NodeId node : tets.cell_nodes(cell)) mean += tets.position(node)[1] / 4;
    EXPECT_NEAR(center.values[cell], mean, 1e-6);
  }
}

// Two results of one run, displacement on quadratic cells and stress on the same cells' corners
TEST(RealFiles, TwinsAgree) {
  const std::string quadratic = data_dir() + "/vtk_xml/fe_results/notch_disp.vtu";
  const std::string linear = data_dir() + "/nasty/nan/notch_stress.vtk";
  if (!std::filesystem::exists(quadratic)) GTEST_SKIP() << quadratic << " is not there";
  Reading a = read_any(quadratic);
  const Reading b = read_any(linear);
  keep_corners(a.mesh, a.notes);
  EXPECT_TRUE(std::equal(a.mesh.kinds.begin(), a.mesh.kinds.end(), b.mesh.kinds.begin(),
                         b.mesh.kinds.end()));
  EXPECT_TRUE(std::equal(a.mesh.nodes.begin(), a.mesh.nodes.end(), b.mesh.nodes.begin(),
                         b.mesh.nodes.end()));
  ASSERT_EQ(a.mesh.node_count(), b.mesh.node_count());
  for (std::size_t i = 0; i < a.mesh.xyz.size(); ++i)
    ASSERT_NEAR(a.mesh.xyz[i], b.mesh.xyz[i], 1e-6 * (1 + std::abs(b.mesh.xyz[i])));
}

}  // namespace
}  // namespace hiac::formats
