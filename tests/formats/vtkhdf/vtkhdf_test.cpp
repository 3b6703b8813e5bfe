// VTKHDF files written through HDF5 after "VTK File Formats", section "VTKHDF": parts, ghosts,
// steps and images.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "formats/hdf5/hdf5_file.hpp"
#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/hdf5_output.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Integers = std::vector<std::int64_t>;
using Reals = std::vector<double>;

void begin(Hdf5Output& file, const std::string& type) {
  file.group("/VTKHDF");
  file.attribute("/VTKHDF", "Version", Integers{2, 0});
  file.attribute("/VTKHDF", "Type", type);
}

// A brick in one part; in the other the pyramid on its top, with nodes of its own, and the brick
// again, as a ghost.
TEST(VtkHdf, PartsShareTheirFacesAndGhostsAreLeftOut) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  {
    Hdf5Output file(path);
    begin(file, "UnstructuredGrid");
    const Reals brick{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    Reals points = brick;
    points.insert(points.end(), brick.begin(), brick.end());
    points.insert(points.end(), {0.5, 0.5, 2});
    file.put("/VTKHDF/NumberOfPoints", Integers{8, 9});
    file.put("/VTKHDF/NumberOfCells", Integers{1, 2});
    file.put("/VTKHDF/NumberOfConnectivityIds", Integers{8, 13});
    file.put("/VTKHDF/Points", points, {17, 3});
    file.put("/VTKHDF/Types", std::vector<std::uint8_t>{12, 14, 12});
    file.put("/VTKHDF/Offsets", Integers{0, 8, 0, 5, 13});
    file.put("/VTKHDF/Connectivity",
             Integers{0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8, 0, 1, 2, 3, 4, 5, 6, 7});
    Reals s;
    std::vector<float> v;
    for (std::size_t p = 0; p < 17; ++p) {
      s.push_back(points[3 * p] + 2 * points[3 * p + 1] + 4 * points[3 * p + 2]);
      for (std::size_t c = 0; c < 3; ++c) v.push_back(static_cast<float>(points[3 * p + c] + 1));
    }
    file.put("/VTKHDF/PointData/s", s);
    file.put("/VTKHDF/PointData/v", v, {17, 3});
    file.put("/VTKHDF/CellData/c", Integers{5, -6, 7});
    file.put("/VTKHDF/CellData/vtkGhostType", std::vector<std::uint8_t>{0, 0, 1});
  }
  const ZooMesh mesh = read_any(path).mesh;
  EXPECT_THAT(std::vector<CellKind>(mesh.kinds.begin(), mesh.kinds.end()),
              ElementsAre(CellKind::brick8, CellKind::pyramid5));
  ASSERT_EQ(mesh.node_count(), 9U);
  EXPECT_NEAR(volume_of(mesh, 0), 1, 1e-15);
  EXPECT_NEAR(volume_of(mesh, 1), 1.0 / 3, 1e-15);
  EXPECT_THAT(field_named(mesh, "c").values.view(), ElementsAre(5, -6));
  ASSERT_EQ(field_named(mesh, "v").components, 3U);
  for (NodeId node = 0; node < mesh.node_count(); ++node) {
    const auto x = mesh.position(node);
    EXPECT_EQ(field_named(mesh, "s").values[node], x[0] + 2 * x[1] + 4 * x[2]);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(field_named(mesh, "v").values[3 * node + c], x[c] + 1);
  }
  const Inventory inventory = format_to_read(path).inspect(path);
  EXPECT_EQ(inventory.format, "vtkhdf");
  EXPECT_EQ(inventory.points, 17U);
}

/// A tetrahedron as version 1.0 writes it. `grid`: with the arrays of an unstructured grid.
void write_without_type(const std::string& path, bool grid) {
  Hdf5Output file(path);
  file.group("/VTKHDF");
  file.attribute("/VTKHDF", "Version", Integers{1, 0});
  file.put("/VTKHDF/NumberOfPoints", Integers{4});
  file.put("/VTKHDF/NumberOfCells", Integers{1});
  file.put("/VTKHDF/Points", Reals{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {4, 3});
  if (!grid) return;
  file.put("/VTKHDF/NumberOfConnectivityIds", Integers{4});
  file.put("/VTKHDF/Types", std::vector<std::uint8_t>{10});
  file.put("/VTKHDF/Offsets", Integers{0, 4});
  file.put("/VTKHDF/Connectivity", Integers{0, 1, 2, 3});
  file.put("/VTKHDF/PointData/s", Reals{5, 6, 7, 8});
}

TEST(VtkHdf, FilesWithoutATypeAreGridsIfTheyHaveTheArraysOfOne) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  write_without_type(path, true);
  const ZooMesh mesh = read_any(path).mesh;
  expect_unit_tetrahedron(mesh);
  for (NodeId node = 0; node < 4; ++node)
    EXPECT_EQ(field_named(mesh, "s").values[mesh.nodes[node]], 5 + node);
  EXPECT_EQ(format_to_read(path).inspect(path).points, 4U);
  write_without_type(path, false);
  EXPECT_THAT(refusal(path), HasSubstr("is of type '' (UnstructuredGrid or ImageData expected)"));
}

TEST(VtkHdf, BytesBehindTheContainerAreTold) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  write_without_type(path, true);
  EXPECT_THAT(read_any(path).notes, testing::Not(testing::Contains(HasSubstr("behind"))));
  std::ofstream(path, std::ios::binary | std::ios::app) << "stray";
  const Reading reading = read_any(path);
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_EQ(std::count(reading.notes.begin(), reading.notes.end(),
                       "5 bytes behind the end of the HDF5 container are not read"),
            1);
}

/// A tetrahedron at two times. `moving`: at each time its own points and cells; else a field alone.
void write_steps(const std::string& path, bool moving) {
  Hdf5Output file(path);
  begin(file, "UnstructuredGrid");
  Reals points{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  if (moving) {
    const Reals later{0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2};
    points.insert(points.end(), later.begin(), later.end());
  }
  const auto twice = [moving](const Integers& once) {
    Integers all = once;
    if (moving) all.insert(all.end(), once.begin(), once.end());
    return all;
  };
  file.put("/VTKHDF/NumberOfPoints", twice({4}));
  file.put("/VTKHDF/NumberOfCells", twice({1}));
  file.put("/VTKHDF/NumberOfConnectivityIds", twice({4}));
  file.put("/VTKHDF/Points", points, {points.size() / 3, 3});
  file.put("/VTKHDF/Types", std::vector<std::uint8_t>(moving ? std::vector<std::uint8_t>{10, 10}
                                                             : std::vector<std::uint8_t>{10}));
  file.put("/VTKHDF/Offsets", twice({0, 4}));
  file.put("/VTKHDF/Connectivity", twice({0, 1, 2, 3}));
  file.put("/VTKHDF/PointData/s", Reals{1, 2, 3, 4, 11, 12, 13, 14});
  file.put("/VTKHDF/CellData/c", Reals{5, 15});
  file.put("/VTKHDF/Steps/Values", Reals{0.5, 2});
  file.attribute("/VTKHDF/Steps", "NSteps", Integers{2});
  const std::int64_t later = moving ? 1 : 0;
  file.put("/VTKHDF/Steps/PartOffsets", Integers{0, later});
  file.put("/VTKHDF/Steps/NumberOfParts", Integers{1, 1});
  file.put("/VTKHDF/Steps/PointOffsets", Integers{0, 4 * later});
  file.put("/VTKHDF/Steps/CellOffsets", Integers{0, later}, {2, 1});
  file.put("/VTKHDF/Steps/ConnectivityIdOffsets", Integers{0, 4 * later}, {2, 1});
  file.put("/VTKHDF/Steps/PointDataOffsets/s", Integers{0, 4});
  file.put("/VTKHDF/Steps/CellDataOffsets/c", Integers{0, 1});
}

TEST(VtkHdf, StepsHaveTheirFieldsAndTheirPoints) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  for (const bool moving : {false, true}) {
    SCOPED_TRACE(moving);
    write_steps(path, moving);
    EXPECT_THAT(format_to_read(path).inspect(path).times, ElementsAre(0.5, 2));
    for (const std::size_t step : {0, 1}) {
      ReadOptions options;
      options.step = step;
      const ZooMesh mesh = read_any(path, options).mesh;
      const double size = moving && step == 1 ? 2 : 1;
      EXPECT_NEAR(volume_of(mesh), size * size * size / 6, 1e-15);
      const double first = step == 0 ? 1 : 11;
      EXPECT_THAT(field_named(mesh, "s").values.view(),
                  ElementsAre(first, first + 1, first + 2, first + 3));
      EXPECT_EQ(field_named(mesh, "c").values[0], step == 0 ? 5 : 15);
    }
    EXPECT_EQ(field_named(read_any(path).mesh, "c").values[0], 15);
    ReadOptions missing;
    missing.time = 1;
    EXPECT_THROW(read_any(path, missing), UsageError);
  }
}

// One tetrahedron at first, then two of other points: every list goes on where the step begins.
TEST(VtkHdf, StepsMayHaveOtherNumbersOfCells) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  {
    Hdf5Output file(path);
    begin(file, "UnstructuredGrid");
    file.put("/VTKHDF/NumberOfPoints", Integers{4, 5});
    file.put("/VTKHDF/NumberOfCells", Integers{1, 2});
    file.put("/VTKHDF/NumberOfConnectivityIds", Integers{4, 8});
    file.put("/VTKHDF/Points",
             Reals{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2, 2, 2, 2},
             {9, 3});
    file.put("/VTKHDF/Types", std::vector<std::uint8_t>{10, 10, 10});
    file.put("/VTKHDF/Offsets", Integers{0, 4, 0, 4, 8});
    file.put("/VTKHDF/Connectivity", Integers{0, 1, 2, 3, 0, 1, 2, 3, 1, 2, 3, 4});
    file.put("/VTKHDF/CellData/c", Integers{5, 6, 7});
    file.put("/VTKHDF/Steps/Values", Reals{0.5, 2});
    file.put("/VTKHDF/Steps/PartOffsets", Integers{0, 1});
    file.put("/VTKHDF/Steps/PointOffsets", Integers{0, 4});
    file.put("/VTKHDF/Steps/CellOffsets", Integers{0, 1}, {2, 1});
    file.put("/VTKHDF/Steps/ConnectivityIdOffsets", Integers{0, 4}, {2, 1});
  }
  ReadOptions options;
  options.step = 0;
  expect_unit_tetrahedron(read_any(path, options).mesh);
  const ZooMesh last = read_any(path).mesh;
  ASSERT_EQ(last.cell_count(), 2U);
  EXPECT_NEAR(volume_of(last, 0), 8.0 / 6, 1e-14);
  EXPECT_NEAR(volume_of(last, 1), 8.0 / 3, 1e-14);
  EXPECT_THAT(field_named(last, "c").values.view(), ElementsAre(6, 7));
}

TEST(VtkHdf, ImagesAreBricksInTheirDirections) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  const auto write = [&](std::uint64_t nx) {
    Hdf5Output file(path);
    begin(file, "ImageData");
    file.attribute("/VTKHDF", "WholeExtent", Integers{1, 3, 0, 1, 0, 1});
    file.attribute("/VTKHDF", "Origin", Reals{10, 20, 30});
    file.attribute("/VTKHDF", "Spacing", Reals{0.5, 1, 2});
    // x to y, y to -x
    file.attribute("/VTKHDF", "Direction", Reals{0, -1, 0, 1, 0, 0, 0, 0, 1});
    Reals s;
    for (std::uint64_t i = 0; i < 4 * nx; ++i) s.push_back(static_cast<double>(i));
    file.put("/VTKHDF/PointData/s", s, {2, 2, nx});
    file.put("/VTKHDF/CellData/c", Reals{7, 8}, {1, 1, 2});
  };
  write(3);
  const ZooMesh mesh = read_any(path).mesh;
  ASSERT_EQ(mesh.cell_count(), 2U);
  ASSERT_EQ(mesh.node_count(), 12U);
  EXPECT_NEAR(volume_of(mesh), 2, 1e-14);
  EXPECT_THAT(field_named(mesh, "c").values.view(), ElementsAre(7, 8));
  for (NodeId node = 0; node < 12; ++node) {
    const auto x = mesh.position(node);
    const double i = 2 * (x[1] - 20) - 1;
    const double j = 10 - x[0];
    const double k = (x[2] - 30) / 2;
    EXPECT_EQ(field_named(mesh, "s").values[node], i + 3 * (j + 2 * k));
  }
  write(4);
  EXPECT_THAT(refusal(path), HasSubstr("does not fit the image (3 x 2 x 2 values expected)"));
}

TEST(VtkHdf, WhatDoesNotFitIsRefused) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  {
    Hdf5Output file(path);
    begin(file, "OverlappingAMR");
  }
  EXPECT_THAT(refusal(path), HasSubstr("is of type 'OverlappingAMR'"));
  const auto write = [&](const Integers& offsets, const Integers& nodes) {
    Hdf5Output file(path);
    begin(file, "UnstructuredGrid");
    file.put("/VTKHDF/NumberOfPoints", Integers{4});
    file.put("/VTKHDF/NumberOfCells", Integers{1});
    file.put("/VTKHDF/NumberOfConnectivityIds", Integers{4});
    file.put("/VTKHDF/Points", Reals{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {4, 3});
    file.put("/VTKHDF/Types", std::vector<std::uint8_t>{10});
    file.put("/VTKHDF/Offsets", offsets);
    file.put("/VTKHDF/Connectivity", nodes);
  };
  write({0, 4}, {0, 1, 2, 3});
  EXPECT_EQ(refusal(path), "");
  write({0, 5}, {0, 1, 2, 3});
  EXPECT_THAT(refusal(path), HasSubstr("of cell 0 does not fit"));
  write({4, 0}, {0, 1, 2, 3});
  EXPECT_THAT(refusal(path), HasSubstr("of cell 0 does not fit"));
  write({0, 4}, {0, 1, 2, 4});
  EXPECT_NE(refusal(path), "");
  write({0, 4}, {0, 1, 2, -1});
  EXPECT_NE(refusal(path), "");
}

// As "VTKHDF" of "VTK File Formats" describes a file of one part: version 1 has no steps.
TEST(VtkHdf, WrittenFilesHaveTheListsOfTheirVersion) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  for (const bool timed : {false, true}) {
    ZooMesh mesh;
    mesh.kinds = std::vector{CellKind::tetrahedron4, CellKind::pyramid5};
    mesh.elems = std::vector<std::uint64_t>{0, 4, 9};
    mesh.nodes = std::vector<NodeId>{0, 1, 2, 3, 4, 5, 6, 7, 8};
    Reals xyz{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    xyz.insert(xyz.end(), {5, 0, 0, 6, 0, 0, 6, 1, 0, 5, 1, 0, 5, 0, 1});
    mesh.xyz = Reals(xyz);
    mesh.fields.push_back({"c", "", FieldLocation::cell, 1, Reals{7, 8}});
    mesh.fields.push_back({"v", "", FieldLocation::node, 2, Reals(18, 0.5)});
    mesh.metadata = {{"remark", "none"}};
    if (timed) mesh.metadata.emplace_back("time", "0.25");
    EXPECT_THAT(format_named("vtkhdf").write(path, mesh),
                ElementsAre("metadata 'remark' is left out"));
    const hdf5::File file(path);
    EXPECT_THAT(file.real_attribute("/VTKHDF", "Version"), ElementsAre(timed ? 2 : 1, 0));
    EXPECT_EQ(file.text_attribute("/VTKHDF", "Type"), "UnstructuredGrid");
    const auto integers = [&](const std::string& name) { return file.integers("/VTKHDF/" + name); };
    EXPECT_THAT(integers("NumberOfPoints"), ElementsAre(9));
    EXPECT_THAT(integers("NumberOfCells"), ElementsAre(2));
    EXPECT_THAT(integers("NumberOfConnectivityIds"), ElementsAre(9));
    EXPECT_THAT(integers("Types"), ElementsAre(10, 14));
    EXPECT_EQ(file.info("/VTKHDF/Types").type, "uint8");
    EXPECT_THAT(integers("Offsets"), ElementsAre(0, 4, 9));
    EXPECT_THAT(integers("Connectivity"), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8));
    EXPECT_EQ(file.reals("/VTKHDF/Points"), xyz);
    EXPECT_THAT(file.info("/VTKHDF/Points").shape, ElementsAre(9, 3));
    EXPECT_THAT(file.info("/VTKHDF/PointData/v").shape, ElementsAre(9, 2));
    EXPECT_THAT(file.info("/VTKHDF/CellData/c").shape, ElementsAre(2));
    EXPECT_EQ(file.is_group("/VTKHDF/Steps"), timed);
    if (!timed) continue;
    EXPECT_EQ(file.integer_attribute("/VTKHDF/Steps", "NSteps"), 1);
    EXPECT_THAT(file.reals("/VTKHDF/Steps/Values"), ElementsAre(0.25));
    EXPECT_THAT(integers("Steps/NumberOfParts"), ElementsAre(1));
    for (const char* list : {"PartOffsets", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets",
                             "PointDataOffsets/v", "CellDataOffsets/c"})
      EXPECT_THAT(integers(std::string("Steps/") + list), ElementsAre(0)) << list;
    // these have a column a topology
    EXPECT_THAT(file.info("/VTKHDF/Steps/CellOffsets").shape, ElementsAre(1, 1));
    EXPECT_THAT(file.info("/VTKHDF/Steps/ConnectivityIdOffsets").shape, ElementsAre(1, 1));
  }
}

TEST(VtkHdf, TypesOfFieldsAreListed) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  {
    Hdf5Output file(path);
    begin(file, "UnstructuredGrid");
    file.put("/VTKHDF/NumberOfPoints", Integers{4});
    file.put("/VTKHDF/NumberOfCells", Integers{1});
    file.put("/VTKHDF/NumberOfConnectivityIds", Integers{4});
    file.put("/VTKHDF/Points", Reals{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {4, 3});
    file.put("/VTKHDF/Types", std::vector<std::uint8_t>{10});
    file.put("/VTKHDF/Offsets", Integers{0, 4});
    file.put("/VTKHDF/Connectivity", Integers{0, 1, 2, 3});
    file.put("/VTKHDF/PointData/a", std::vector<float>{1, 2, 3, 4});
    file.put("/VTKHDF/PointData/b", Reals{1, 2, 3, 4});
    file.put("/VTKHDF/CellData/c", Integers{1});
    file.put("/VTKHDF/CellData/d", std::vector<std::uint8_t>{1});
  }
  std::vector<std::string> types;
  for (const FieldSummary& field : format_to_read(path).inspect(path).fields)
    types.push_back(field.name + " " + field.type);
  EXPECT_THAT(types, ElementsAre("a float32", "b float64", "c int64", "d uint8"));
}

}  // namespace
}  // namespace hiac::formats
