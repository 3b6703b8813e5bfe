// VTKHDF files whose lists do not fit one another: the whole complaint, and the nearest that fits.
#include <map>

#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/hdf5_output.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using HdfIntegers = std::vector<std::int64_t>;
using HdfReals = std::vector<double>;

const std::string kHdfRoot = "/VTKHDF";

template <typename More>
void write_hdf_tetrahedron(const std::string& path, const std::map<std::string, HdfIntegers>& other,
                           const More& more) {
  std::map<std::string, HdfIntegers> lists{
      {"NumberOfPoints", {4}}, {"NumberOfCells", {1}}, {"NumberOfConnectivityIds", {4}},
      {"Types", {10}},         {"Offsets", {0, 4}},    {"Connectivity", {0, 1, 2, 3}}};
  for (const auto& [name, list] : other) lists[name] = list;
  Hdf5Output file(path);
  file.group(kHdfRoot);
  file.attribute(kHdfRoot, "Type", std::string("UnstructuredGrid"));
  for (const auto& [name, list] : lists)
    if (!list.empty()) file.put(kHdfRoot + "/" + name, list);
  file.put(kHdfRoot + "/Points", HdfReals{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {4, 3});
  more(file);
}

std::string hdf_refusal(const std::map<std::string, HdfIntegers>& other) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  write_hdf_tetrahedron(path, other, [](Hdf5Output&) {});
  const std::string message = refusal(path);
  return message.empty() ? message : message.substr(path.size() + 2);
}

template <typename More>
std::string hdf_refusal_with(const More& more) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  write_hdf_tetrahedron(path, {}, more);
  const std::string message = refusal(path);
  return message.empty() ? message : message.substr(path.size() + 2);
}

TEST(VtkHdfRefusals, CountsOfParts) {
  EXPECT_EQ(hdf_refusal({}), "");
  EXPECT_EQ(hdf_refusal({{"NumberOfCells", {-1}}}),
            "/VTKHDF/NumberOfCells: -1 expected to be a count");
  EXPECT_EQ(hdf_refusal({{"NumberOfCells", {(std::int64_t{1} << 40) + 1}}}),
            "/VTKHDF/NumberOfCells: 1099511627777 expected to be a count");
  EXPECT_THAT(hdf_refusal({{"NumberOfCells", {std::int64_t{1} << 40}}}),
              HasSubstr("along dimension 0 (10995116277"));
  EXPECT_EQ(hdf_refusal({{"NumberOfPoints", {4, 0}}}), "/VTKHDF/NumberOfCells: has too few parts");
  EXPECT_THAT(hdf_refusal({{"NumberOfPoints", {3}}}), HasSubstr("there is no node 3"));
  EXPECT_EQ(hdf_refusal({{"NumberOfPoints", {5}}}),
            "/VTKHDF/Points: holds 4 along dimension 0 (5 expected)");
  EXPECT_EQ(hdf_refusal({{"NumberOfPoints", {}}}), "/VTKHDF/NumberOfPoints: no such dataset");
  EXPECT_EQ(hdf_refusal({{"Types", {}}}), "/VTKHDF/Types: no such dataset");
}

TEST(VtkHdfRefusals, OffsetsThatDoNotFit) {
  EXPECT_EQ(hdf_refusal({{"Offsets", {0, 5}}}),
            "/VTKHDF/Offsets: of cell 0 does not fit (between 0 and 4 expected, 5 found)");
  EXPECT_EQ(hdf_refusal({{"Offsets", {1, 0}}}),
            "/VTKHDF/Offsets: of cell 0 does not fit (between 1 and 4 expected, 0 found)");
  EXPECT_EQ(hdf_refusal({{"Offsets", {10, 14}}}), "");
  EXPECT_EQ(hdf_refusal({{"Offsets", {0}}}),
            "/VTKHDF/Offsets: holds 1 along dimension 0 (2 expected)");
}

TEST(VtkHdfRefusals, PointsHaveThreeCoordinates) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  const auto write = [&](const std::vector<std::uint64_t>& shape) {
    Hdf5Output file(path);
    file.group(kHdfRoot);
    file.attribute(kHdfRoot, "Type", std::string("UnstructuredGrid"));
    file.put(kHdfRoot + "/NumberOfPoints", HdfIntegers{4});
    file.put(kHdfRoot + "/NumberOfCells", HdfIntegers{1});
    file.put(kHdfRoot + "/NumberOfConnectivityIds", HdfIntegers{4});
    file.put(kHdfRoot + "/Points", HdfReals(shape[0] * shape[1], 1), shape);
  };
  write({4, 2});
  EXPECT_EQ(refusal(path), path + ": /VTKHDF/Points: does not have three coordinates a point");
  write({4, 4});
  EXPECT_EQ(refusal(path), path + ": /VTKHDF/Points: does not have three coordinates a point");
}

/// Two steps of the tetrahedron; the lists are those of /VTKHDF/Steps.
std::string step_refusal(const std::map<std::string, HdfIntegers>& lists) {
  return hdf_refusal_with([&](Hdf5Output& file) {
    file.put(kHdfRoot + "/Steps/Values", HdfReals{0.5, 2});
    for (const auto& [name, list] : lists) file.put(kHdfRoot + "/Steps/" + name, list);
  });
}

TEST(VtkHdfRefusals, StepsNameTheirParts) {
  EXPECT_EQ(step_refusal({}), "");
  EXPECT_EQ(step_refusal({{"PartOffsets", {0, 0}}, {"NumberOfParts", {1, 1}}}), "");
  EXPECT_EQ(step_refusal({{"NumberOfParts", {1, 2}}}), "/VTKHDF/Steps: names part 2 of 1");
  EXPECT_EQ(step_refusal({{"PartOffsets", {0, 1}}}), "/VTKHDF/Steps: names part 2 of 1");
  EXPECT_EQ(step_refusal({{"PartOffsets", {0, 2}}, {"NumberOfParts", {1, 0}}}),
            "/VTKHDF/Steps: names part 2 of 1");
  EXPECT_EQ(step_refusal({{"PartOffsets", {0, 1}}, {"NumberOfParts", {1, 0}}}), "holds no cells");
  EXPECT_EQ(step_refusal({{"PartOffsets", {0}}}),
            "/VTKHDF/Steps/PartOffsets: has no offset of every step");
  EXPECT_EQ(step_refusal({{"PartOffsets", {0, -1}}}),
            "/VTKHDF/Steps/PartOffsets: has no offset of every step");
  EXPECT_EQ(step_refusal({{"PointOffsets", {0, 1}}}),
            "/VTKHDF/Points: holds 4 along dimension 0 (5 expected)");
  EXPECT_THAT(step_refusal({{"CellOffsets", {0, 1}}}), HasSubstr("along dimension 0"));
}

TEST(VtkHdfRefusals, FieldsOfSeveralColumns) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  write_hdf_tetrahedron(path, {}, [](Hdf5Output& file) {
    file.put(kHdfRoot + "/PointData/p", HdfReals{1, 2, 3, 4, 5, 6, 7, 8}, {4, 2});
    file.group(kHdfRoot + "/CellData");
    file.put(kHdfRoot + "/CellData/t", HdfReals{1, 2, 3, 4, 5, 6}, {1, 2, 3});
  });
  const ZooMesh mesh = read_any(path).mesh;
  expect_unit_tetrahedron(mesh);
  EXPECT_EQ(field_named(mesh, "p").components, 2U);
  EXPECT_EQ(field_named(mesh, "t").components, 6U);
  EXPECT_EQ(field_named(mesh, "t").values[5], 6);
  EXPECT_EQ(hdf_refusal_with([](Hdf5Output& file) {
              file.put(kHdfRoot + "/PointData/p", HdfReals{1, 2, 3});
            }),
            "/VTKHDF/PointData/p: holds 3 along dimension 0 (4 expected)");
}

/// An image of 3 x 2 x 2 points, of which the lists of `other` are changed or, if empty, missing.
void write_hdf_image(const std::string& path, const std::map<std::string, HdfReals>& other,
                     const std::vector<std::uint64_t>& shape = {2, 2, 3}) {
  std::map<std::string, HdfReals> lists{
      {"WholeExtent", {0, 2, 0, 1, 0, 1}}, {"Origin", {10, 20, 30}}, {"Spacing", {1, 2, 3}}};
  for (const auto& [name, list] : other) lists[name] = list;
  Hdf5Output file(path);
  file.group(kHdfRoot);
  file.attribute(kHdfRoot, "Type", std::string("ImageData"));
  for (const auto& [name, list] : lists)
    if (!list.empty()) file.attribute(kHdfRoot, name, list);
  std::size_t size = 1;
  for (const std::uint64_t n : shape) size *= n;
  if (size > 0) file.put(kHdfRoot + "/PointData/s", HdfReals(size, 1), shape);
}

std::string image_complaint(const std::map<std::string, HdfReals>& other,
                            const std::vector<std::uint64_t>& shape = {2, 2, 3}) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  write_hdf_image(path, other, shape);
  const std::string message = refusal(path);
  return message.empty() ? message : message.substr(path.size() + 2);
}

TEST(VtkHdfRefusals, ImagesNeedTheirPlace) {
  const std::string lacks = "/VTKHDF: lacks the WholeExtent, Origin or Spacing of its image";
  EXPECT_EQ(image_complaint({}), "");
  EXPECT_EQ(image_complaint({{"WholeExtent", {}}}), lacks);
  EXPECT_EQ(image_complaint({{"WholeExtent", {0, 2, 0, 1, 0}}}), lacks);
  EXPECT_EQ(image_complaint({{"Origin", {}}}), lacks);
  EXPECT_EQ(image_complaint({{"Origin", {1, 2}}}), lacks);
  EXPECT_EQ(image_complaint({{"Spacing", {}}}), lacks);
  EXPECT_EQ(image_complaint({{"Spacing", {1, 2, 3, 4}}}), lacks);
  EXPECT_EQ(image_complaint({{"Direction", {1, 0, 0}}}), lacks);
  EXPECT_EQ(image_complaint({{"Direction", {1, 0, 0, 0, 1, 0, 0, 0, 1}}}), "");
}

TEST(VtkHdfRefusals, ImagesNeedAFieldOfTheirSize) {
  EXPECT_EQ(image_complaint({}, {0, 0, 0}), "/VTKHDF: has no field over its image");
  EXPECT_EQ(image_complaint({}, {1}), "/VTKHDF: has no field over its image");
  const std::string fit = "/VTKHDF/PointData/s: does not fit the image (3 x 2 x 2 values expected)";
  EXPECT_EQ(image_complaint({}, {2}), fit);
  EXPECT_EQ(image_complaint({}, {2, 2}), fit);
  EXPECT_EQ(image_complaint({}, {3, 2, 2}), fit);
  EXPECT_EQ(image_complaint({}, {2, 2, 3, 2}), "");
  EXPECT_EQ(image_complaint({}, {2, 2, 3, 2, 1}), fit);
}

TEST(VtkHdfRefusals, ImagesOfSteps) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  {
    Hdf5Output file(path);
    file.group(kHdfRoot);
    file.attribute(kHdfRoot, "Type", std::string("ImageData"));
    file.attribute(kHdfRoot, "WholeExtent", HdfReals{0, 1, 0, 1, 0, 1});
    file.attribute(kHdfRoot, "Origin", HdfReals{0, 0, 0});
    file.attribute(kHdfRoot, "Spacing", HdfReals{1, 1, 1});
    file.put(kHdfRoot + "/Steps/Values", HdfReals{0.5, 2});
    file.put(kHdfRoot + "/CellData/c", HdfReals{7, 8}, {2, 1, 1, 1});
  }
  EXPECT_THAT(field_named(read_any(path).mesh, "c").values.view(), ElementsAre(8));
  ReadOptions options;
  options.step = 0;
  EXPECT_THAT(field_named(read_any(path, options).mesh, "c").values.view(), ElementsAre(7));
}

TEST(VtkHdfRefusals, ImagesAlongTheirAxes) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.vtkhdf");
  write_hdf_image(path, {{"WholeExtent", {1, 3, 4, 5, -2, -1}}});
  const ZooMesh mesh = read_any(path).mesh;
  ASSERT_EQ(mesh.node_count(), 12U);
  EXPECT_EQ(mesh.cell_count(), 2U);
  EXPECT_THAT(mesh.position(0), ElementsAre(11, 28, 24));
  EXPECT_THAT(mesh.position(11), ElementsAre(13, 30, 27));
  EXPECT_NEAR(volume_of(mesh), 12, 1e-12);
}

}  // namespace
}  // namespace hiac::formats
