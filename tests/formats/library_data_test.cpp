// Real files of binary formats: each holds what the table of the data folder says, read by others'
// programs; and files of one mesh in two formats agree.
#include <cmath>

#include "formats/common/cells/keep_corners.hpp"
#include "formats/common/io/named_file.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/file_rows.hpp"

namespace hiac::formats {
namespace {

using testing::HasSubstr;

constexpr auto tet4 = CellKind::tetrahedron4;
constexpr auto tet10 = CellKind::tetrahedron10;
constexpr auto pyramid5 = CellKind::pyramid5;
constexpr auto pyramid13 = CellKind::pyramid13;
constexpr auto prism6 = CellKind::prism6;
constexpr auto prism15 = CellKind::prism15;
constexpr auto brick8 = CellKind::brick8;
constexpr auto brick20 = CellKind::brick20;

FileRow corners_of(FileRow row, std::size_t nodes) {
  row.corners = true;
  row.nodes = nodes;
  return row;
}

FileRow with_nodes(FileRow row, std::size_t nodes) {
  row.nodes = nodes;
  return row;
}

const std::vector<FileRow> kRows{
    {"cgns/BC_without_parents.cgns", 4505, {{brick8, 3840}}, {}},
    {"cgns/cgnslib_vers-3210.cgns",
     3213,
     {{brick8, 2560}},
     {{"Density", "node", 1, 0, 20}, {"Pressure", "node", 1, 0, 16}}},
    {"cgns/sqnz_s.adf.cgns",
     15228,
     {{brick8, 7168 + 4096}},
     {{"Density", "cell", 1, 0.16009, 0.97355},
      {"Momentum", "cell", 3, -0.10859, 0.58097},
      {"EnergyStagnationDensity", "cell", 1, 0.34146, 1.7674}}},
    with_nodes({"ensight/elements/elements.case",
                112,
                {{tet4, 1},
                 {brick8, 1},
                 {prism6, 1},
                 {pyramid5, 1},
                 {tet10, 1},
                 {brick20, 1},
                 {prism15, 1},
                 {pyramid13, 1}},
                {{"pointScalars", "node", 1, 1, 112},
                 {"pointVectors", "node", 3, 1.1, 112.3},
                 {"pointTensors", "node", 6, 1.1, 112.6},
                 {"pointCScalars", "node", 2, 1.1, 112.2},
                 {"pointCVectors_r", "node", 3, 1.1, 112.3},
                 {"pointCVectors_i", "node", 3, 1.1, 112.3},
                 {"cellScalars", "cell", 1, 1, 15},
                 {"cellVectors", "cell", 3, 1.1, 15.3},
                 {"cellTensors", "cell", 6, 1.1, 15.6},
                 {"cellCScalars", "cell", 2, 1.1, 15.2}}},
               4 + 8 + 6 + 5 + 10 + 20 + 15 + 13),
    {"ensight/office_ascii/office_ascii.case",
     343,
     {{brick8, 216}},
     {{"scalars", "node", 1, -3.8661, 0.61301}, {"vectors", "node", 3, -0.44661, 0.19526}}},
    {"exodus/elements/read_exodus_HEX20.e", 81, {{brick20, 8}}, {}},
    {"exodus/elements/read_exodus_HEX8.e", 27, {{brick8, 8}}, {}},
    {"exodus/elements/read_exodus_PRISM15.e", 93, {{prism15, 16}}, {}},
    {"exodus/elements/read_exodus_PRISM6.e", 27, {{prism6, 16}}, {}},
    {"exodus/elements/read_exodus_PYRAMID13.e", 153, {{pyramid13, 48}}, {}},
    {"exodus/elements/read_exodus_PYRAMID5.e", 35, {{pyramid5, 48}}, {}},
    {"exodus/elements/read_exodus_TET10.e", 381, {{tet10, 192}}, {}},
    {"exodus/elements/read_exodus_TET4.e", 71, {{tet4, 192}}, {}},
    {"exodus/linear/mesh_fs8.exo", 1000, {{prism6, 1344}}, {}},
    corners_of({"exodus/mfem_cube/simple-cube-hex27.e", 343, {{brick8, 27}}, {}}, 64),
    {"exodus/mfem_cube/simple-cube-pyramid5.e", 341, {{pyramid5, 750}}, {}},
    {"exodus/mfem_cube/simple-cube-tet10.e", 568, {{tet10, 295}}, {}},
    with_nodes({"exodus/mfem_cube/simple-cube-hex27.e", 343, {{brick20, 27}}, {}}, 343 - 135),
    with_nodes({"exodus/mfem_cube/simple-cube-wedge18.e", 1331, {{prism15, 250}}, {}}, 1331 - 425),
    with_nodes({"exodus/curved/cylinder-hex-q2.gen", 2443, {{brick20, 252}}, {}}, 2443 - 1110),
    corners_of({"exodus/mfem_cube/simple-cube-wedge18.e", 1331, {{prism6, 250}}, {}}, 216),
    {"exodus/mixed/edgeFaceElem.exii",
     12,
     {{brick8, 2}, {tet4, 1}},
     {{"RHO", "node", 1, 0, 0.9}, {"EPSTRN", "cell", 1, -8, 0}},
     2},
    {"exodus/mixed/four-p.e", 29, {{brick20, 1}, {pyramid13, 1}, {tet4, 1}, {prism6, 1}}, {}},
    with_nodes({"exodus/results/block_crush_1.ex2",
                242,
                {{brick8, 131}},
                {{"displ_x", "node", 1, 0, 0.10164},
                 {"displ_y", "node", 1, -0.020206, 0.020206},
                 {"displ_z", "node", 1, -0.033669, 0.033669},
                 {"carea", "node", 1, 0, 0.56817},
                 {"cdirnor_x", "node", 1, -0.99322, 1},
                 {"cdirtan_z", "node", 1, -1, 1}},
                11},
               241),
    {"exodus/results/mug.e",
     3774,
     {{brick8, 2476}},
     {{"convected", "node", 1, 0, 1},
      {"diffused", "node", 1, 0, 2},
      {"aux_elem", "cell", 1, 0.0090182, 9.9917}},
     21},
    {"med/mesh002e.med", 450, {{tet4, 1764}, {pyramid5, 154}}, {}},
    {"med/xxModalMechanics001a.med", 557, {{brick20, 80}}, {}},
    {"mfem/amr-hex.mesh", 223, {{brick8, 120}}, {{"attribute", "cell", 1, 1, 1}}},
    {"mfem/beam-hex.mesh", 36, {{brick8, 8}}, {{"attribute", "cell", 1, 1, 2}}},
    {"mfem/beam-tet.mesh", 36, {{tet4, 48}}, {}},
    {"mfem/beam-wedge.mesh", 27, {{prism6, 8}}, {{"attribute", "cell", 1, 1, 2}}},
    {"mfem/escher-p2.mesh", 117, {{tet10, 42}}, {}},
    {"mfem/escher-p3.mesh", 26 + 2 * 91 + 108, {{CellKind::tetrahedron20, 42}}, {}},
    {"mfem/escher.mesh", 26, {{tet4, 42}}, {}},
    {"mfem/fichera-mixed.mesh", 26, {{tet4, 5}, {brick8, 3}, {prism6, 6}}, {}},
    {"mfem/ref-pyramid.mesh", 5, {{pyramid5, 1}}, {}},
    {"mfem/tinyzoo-3d.mesh",
     12,
     {{brick8, 1}, {prism6, 1}, {pyramid5, 1}, {tet4, 1}},
     {{"attribute", "cell", 1, 1, 1}}},
    {"openfoam/cavity/case.foam", 882, {{brick8, 400}}, {}, 6},
    {"plot3d/bluntfin/bluntfinxyz.bin",
     40960,
     {{brick8, 37479}},
     {{"Density", "node", 1, 0.1926, 4.9775},
      {"Momentum", "node", 3, -3.7339, 5.7903},
      {"StagnationEnergy", "node", 1, 0.76896, 25.161}}},
    {"plot3d/multiblock/multi.p3d",
     2304,
     {{brick8, 1694}},
     {{"Density", "node", 1, 0.19896, 4.8283},
      {"Momentum", "node", 3, -3.7236, 5.6949},
      {"StagnationEnergy", "node", 1, 0.78864, 24.078}}},
    {"plot3d/multiblock/multi-bin.xyz",
     2304,
     {{brick8, 1694}},
     {{"Density", "node", 1, 0.19896, 4.8283}}},
    {"plot3d/tiny/tiny.xyz",
     40,
     {{brick8, 5}},
     {{"Density", "node", 1, 0.9, 0.9},
      {"Momentum", "node", 3, 0.99, 1.17},
      {"StagnationEnergy", "node", 1, 7.703, 7.703}}},
    {"vtkhdf/can-vtu.hdf",
     6724,
     {{brick8, 4800}},
     {{"DISPL", "node", 3, -17.81, 1.1782},
      {"VEL", "node", 3, -4560.6, 2941.1},
      {"ACCL", "node", 3, -1.3516e+08, 1.8601e+08},
      {"EQPS", "cell", 1, 0.021583, 2.8939}}},
    {"xdmf/no_checkpoint.xdmf", 729, {{tet4, 3072}}, {{"f_5", "node", 1, 4, 5}}, 5},
};

class LibraryFile : public testing::TestWithParam<FileRow> {};

TEST_P(LibraryFile, HoldsWhatTheTableSays) {
  const std::string path = data_dir() + "/" + GetParam().path;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  expect_row(GetParam(), path);
}

INSTANTIATE_TEST_SUITE_P(Table, LibraryFile, testing::ValuesIn(kRows), row_name);

TEST(LibraryFiles, WhatCannotBeHeldIsRefusedByName) {
  const std::vector<std::pair<std::string, std::string>> rows{
      {"mfem/ball-pert.mesh", "448 cube of order 4 of 125 nodes are of order 4"},
      {"mfem/fichera-mixed-p2.mesh", "3 cube of order 2"},
      {"mfem/toroid-hex.mesh", "order 3"},
      {"nasty/malformed/bad_64bit_elem_integers.e", "no volume cells"},
  };
  for (const auto& [name, reason] : rows) {
    const std::string path = data_dir() + "/" + name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    EXPECT_THAT(refusal(path), HasSubstr(reason));
    EXPECT_THAT(refusal(path), HasSubstr(path));
  }
}

// MFEM wrote both files of one mesh
TEST(LibraryFiles, QuadraticCellsOfMfemAgreeWithTheirVtkTwins) {
  const std::string path = data_dir() + "/mfem/fichera-mixed-p2";
  if (!std::filesystem::exists(path + ".mesh")) GTEST_SKIP() << path << " is not there";
  ReadOptions options;
  options.approximate = true;
  const ZooMesh mesh = read_any(path + ".mesh", options).mesh;
  const ZooMesh twin = read_any(path + ".vtk", options).mesh;
  ASSERT_EQ(mesh.cell_count(), twin.cell_count());
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    ASSERT_EQ(mesh.kinds[cell], twin.kinds[cell]) << cell;
    // the corners may begin elsewhere
    for (const NodeId node : mesh.cell_nodes(cell)) {
      double nearest = HUGE_VAL;
      for (const NodeId other : twin.cell_nodes(cell)) {
        double distance = 0;
        for (std::size_t c = 0; c < 3; ++c)
          distance += std::abs(mesh.position(node)[c] - twin.position(other)[c]);
        nearest = std::min(nearest, distance);
      }
      EXPECT_LT(nearest, 1e-6) << cell;
    }
  }
}

TEST(LibraryFiles, StepsAreChosenByNumberAndTime) {
  const std::string path = data_dir() + "/exodus/results/mug.e";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  ReadOptions first;
  first.step = 0;
  const ZooMesh mesh = read_any(path, first).mesh;
  const Field convected = scalar_field(mesh, "convected");
  EXPECT_TRUE(std::all_of(convected.values.begin(), convected.values.end(),
                          [](double value) { return value == 0; }));
  ReadOptions missing;
  missing.step = 21;
  EXPECT_THROW(read_any(path, missing), UsageError);
}

// The table's ranges are those of the first step
TEST(LibraryFiles, OpenFoamFieldsHaveTheirUnits) {
  const std::string path = data_dir() + "/openfoam/cavity/case.foam";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  ReadOptions first;
  first.time = 0;
  const ZooMesh mesh = read_any(path, first).mesh;
  ASSERT_EQ(mesh.fields.size(), 2U);
  EXPECT_EQ(mesh.fields[0].name, "U");
  EXPECT_EQ(mesh.fields[0].unit, "m s^-1");
  EXPECT_EQ(mesh.fields[0].components, 3U);
  EXPECT_EQ(mesh.fields[1].unit, "m^2 s^-2");
  for (const Field& field : mesh.fields)
    EXPECT_TRUE(std::all_of(field.values.begin(), field.values.end(),
                            [](double value) { return value == 0; }));
}

TEST(LibraryFiles, BlocksAreChosenByName) {
  const std::string path = data_dir() + "/plot3d/multiblock/multi.p3d";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  ReadOptions options;
  options.block = "block 2";
  EXPECT_EQ(read_any(path, options).mesh.cell_count(), 1694U / 2);
}

// OVERFLOW's Q file has further numbers before the data
TEST(LibraryFiles, OverflowsQFileIsRead) {
  const std::string q = data_dir() + "/plot3d/multiblock_oflow/multi-bin-oflow.q";
  if (!std::filesystem::exists(q)) GTEST_SKIP() << q << " is not there";
  const ScratchFolder folder;
  set_named_files({"", true});  // the index lies elsewhere
  const std::string index = folder.write(
      "overflow.p3d", R"({"filenames": [{"time": 0, "xyz": ")" + data_dir() +
                          R"(/plot3d/multiblock/multi-bin.xyz", "q": ")" + q + R"("}]})");
  expect_row({index,
              2304,
              {{brick8, 1694}},
              {{"Density", "node", 1, 0.19896, 4.8283},
               {"Momentum", "node", 3, -3.7236, 5.6949},
               {"StagnationEnergy", "node", 1, 0.78864, 24.078}}},
             index);
  set_named_files({});
}

void expect_same_values(const SharedArray<double>& a, const SharedArray<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin()));
}

TEST(LibraryFiles, TwinsAgreeExactly) {
  const std::string hdf = data_dir() + "/vtkhdf/can-vtu.hdf";
  const std::string vtu = data_dir() + "/vtk_xml/fe_results/can.vtu";
  if (!std::filesystem::exists(hdf)) GTEST_SKIP() << hdf << " is not there";
  const ZooMesh a = read_any(hdf).mesh;
  const ZooMesh b = read_any(vtu).mesh;
  expect_same_values(a.xyz, b.xyz);
  EXPECT_TRUE(std::equal(a.kinds.begin(), a.kinds.end(), b.kinds.begin(), b.kinds.end()));
  EXPECT_TRUE(std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end()));
  for (const char* name : {"DISPL", "VEL", "ACCL", "EQPS"}) {
    const auto named = [name](const Field& field) { return field.name == name; };
    const auto of_a = std::find_if(a.fields.begin(), a.fields.end(), named);
    const auto of_b = std::find_if(b.fields.begin(), b.fields.end(), named);
    ASSERT_NE(of_a, a.fields.end()) << name;
    ASSERT_NE(of_b, b.fields.end()) << name;
    expect_same_values(of_a->values, of_b->values);
  }
}

// MFEM's quadratic mesh beside the VTK file that it wrote of it: the same cells in the same places
TEST(LibraryFiles, QuadraticTwinsAgree) {
  const std::string mesh = data_dir() + "/mfem/escher-p2.mesh";
  const std::string vtk = data_dir() + "/mfem/escher-p2.vtk";
  if (!std::filesystem::exists(mesh)) GTEST_SKIP() << mesh << " is not there";
  const ZooMesh a = read_any(mesh).mesh;
  const ZooMesh b = read_any(vtk).mesh;
  ASSERT_EQ(a.cell_count(), b.cell_count());
  for (CellId cell = 0; cell < a.cell_count(); ++cell)
    for (std::size_t n = 0; n < 10; ++n)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(a.position(a.cell_nodes(cell)[n])[c], b.position(b.cell_nodes(cell)[n])[c])
            << cell << " " << n;
}

/// The Jacobian's determinant in the middle of a cell.
double middle_jacobian(const ZooMesh& mesh, CellId cell) {
  const CellKind kind = mesh.kinds[cell];
  const auto nodes = mesh.cell_nodes(cell);
  std::array<double, 3> middle{};
  const std::size_t corners = corner_count(kind);
  for (std::size_t i = 0; i < corners; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      middle[c] += reference_nodes(kind)[i][c] / static_cast<double>(corners);
  std::vector<std::array<double, 3>> gradients(nodes.size());
  shape_gradients<double>(kind, middle, gradients);
  std::array<std::array<double, 3>, 3> j{};
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) j[r][c] += mesh.position(nodes[n])[r] * gradients[n][c];
  return j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
         j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
         j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
}

// Every format's own orientation was turned into the zoo's
TEST(LibraryFiles, CellsArePositivelyOriented) {
  for (const std::string name :
       {"cgns/BC_without_parents.cgns", "cgns/cgnslib_vers-3210.cgns",
        "exodus/elements/read_exodus_HEX20.e", "exodus/elements/read_exodus_PRISM15.e",
        "exodus/elements/read_exodus_PRISM6.e", "exodus/elements/read_exodus_PYRAMID13.e",
        "exodus/elements/read_exodus_TET10.e", "exodus/linear/mesh_fs8.exo",
        "exodus/mixed/four-p.e", "exodus/results/mug.e", "med/mesh002e.med", "mfem/amr-hex.mesh",
        "mfem/beam-tet.mesh", "mfem/beam-wedge.mesh", "mfem/escher-p3.mesh", "mfem/tinyzoo-3d.mesh",
        "openfoam/cavity/case.foam"}) {
    const std::string path = data_dir() + "/" + name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const ZooMesh mesh = read_any(path).mesh;
    std::size_t inverted = 0;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
      inverted += middle_jacobian(mesh, cell) <= 0 ? 1 : 0;
    EXPECT_EQ(inverted, 0U) << name;
  }
}

}  // namespace
}  // namespace hiac::formats
