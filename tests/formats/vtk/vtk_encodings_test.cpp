// One mesh written by VTK in every way that VTK writes it: all must read as the same mesh.
#include <algorithm>
#include <array>
#include <random>

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkStructuredGrid.h>
#include <vtkStructuredGridWriter.h>
#include <vtkStructuredPointsWriter.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLRectilinearGridWriter.h>
#include <vtkXMLStructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtkZLibDataCompressor.h>

#include "tests/formats/files.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac::formats {
namespace {

constexpr std::array<int, 4> kCompressors{vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4,
                                          vtkXMLWriter::LZMA};
constexpr int kSide = 16;  // large enough for several compressed blocks

/// Adds data with values that text writes exactly.
void add_data(vtkDataSet& dataset) {
  vtkNew<vtkDoubleArray> s;
  s->SetName("s");
  vtkNew<vtkFloatArray> v;
  v->SetName("v w");
  v->SetNumberOfComponents(3);
  for (vtkIdType p = 0; p < dataset.GetNumberOfPoints(); ++p) {
    const double* x = dataset.GetPoint(p);
    s->InsertNextValue(x[0] - 0.5 * x[1] + 0.25 * x[2] * x[2]);
    v->InsertNextTuple3(x[1], x[2], 100 - x[0]);
  }
  dataset.GetPointData()->AddArray(s);
  dataset.GetPointData()->AddArray(v);
  vtkNew<vtkIntArray> c;
  c->SetName("c");
  for (vtkIdType i = 0; i < dataset.GetNumberOfCells(); ++i)
    c->InsertNextValue(static_cast<int>(i % 1000) - 500);
  dataset.GetCellData()->AddArray(c);
}

void set_points(vtkPointSet& grid) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int k = 0; k < kSide; ++k)
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i) points->InsertNextPoint(0.5 * i, 0.25 * j, 2.0 * k);
  grid.SetPoints(points);
}

vtkIdType point_at(int i, int j, int k) { return (vtkIdType{k} * kSide + j) * kSide + i; }

/// The grid's bricks, one after the other.
vtkSmartPointer<vtkUnstructuredGrid> unstructured() {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  set_points(*grid);
  for (int k = 0; k + 1 < kSide; ++k)
    for (int j = 0; j + 1 < kSide; ++j)
      for (int i = 0; i + 1 < kSide; ++i) {
        const vtkIdType nodes[8] = {point_at(i, j, k),
                                    point_at(i + 1, j, k),
                                    point_at(i + 1, j + 1, k),
                                    point_at(i, j + 1, k),
                                    point_at(i, j, k + 1),
                                    point_at(i + 1, j, k + 1),
                                    point_at(i + 1, j + 1, k + 1),
                                    point_at(i, j + 1, k + 1)};
        grid->InsertNextCell(VTK_HEXAHEDRON, 8, nodes);
      }
  add_data(*grid);
  return grid;
}

std::string expected_hash() {
  static const std::string hash = [] {
    const ScratchFolder folder;
    vtkNew<vtkUnstructuredGridWriter> writer;
    writer->SetInputData(unstructured());
    writer->SetFileTypeToBinary();
    writer->SetFileName(folder.file("a.vtk").c_str());
    writer->Write();
    return content_hash(read_any(folder.file("a.vtk")).mesh);
  }();
  return hash;
}

TEST(VtkEncodings, TheReferenceIsTheGrid) {
  const ScratchFolder folder;
  vtkNew<vtkUnstructuredGridWriter> writer;
  writer->SetInputData(unstructured());
  writer->SetFileTypeToBinary();
  writer->SetFileName(folder.file("a.vtk").c_str());
  writer->Write();
  const ZooMesh mesh = read_any(folder.file("a.vtk")).mesh;
  ASSERT_EQ(mesh.node_count(), static_cast<std::size_t>(kSide * kSide * kSide));
  const Field s = scalar_field(mesh, "s");
  const Field z = scalar_field(mesh, "v w:z");
  for (NodeId n = 0; n < mesh.node_count(); ++n) {
    const auto x = mesh.position(n);
    ASSERT_EQ(s.values[n], x[0] - 0.5 * x[1] + 0.25 * x[2] * x[2]);
    ASSERT_EQ(z.values[n], 100 - x[0]);
  }
  EXPECT_EQ(scalar_field(mesh, "c").values[1001], -499);
}

TEST(VtkEncodings, LegacyFiles) {
  const ScratchFolder folder;
  for (const int version : {42, 51})
    for (const bool binary : {false, true}) {
      vtkNew<vtkUnstructuredGridWriter> writer;
      writer->SetInputData(unstructured());
      writer->SetFileVersion(version);
      if (binary)
        writer->SetFileTypeToBinary();
      else
        writer->SetFileTypeToASCII();
      writer->SetFileName(folder.file("a.vtk").c_str());
      writer->Write();
      EXPECT_EQ(content_hash(read_any(folder.file("a.vtk")).mesh), expected_hash())
          << version << (binary ? " binary" : " ASCII");
    }
}

enum class Mode { ascii, binary, appended_raw, appended_base64 };

template <typename Writer>
void write_xml(vtkDataSet* dataset, const std::string& path, Mode mode, int compressor,
               bool wide_header, bool big_endian) {
  vtkNew<Writer> writer;
  writer->SetInputData(dataset);
  writer->SetFileName(path.c_str());
  writer->SetCompressorType(compressor);
  writer->SetBlockSize(8192);
  writer->SetHeaderType(wide_header ? vtkXMLWriter::UInt64 : vtkXMLWriter::UInt32);
  if (big_endian) writer->SetByteOrderToBigEndian();
  if (mode == Mode::ascii) writer->SetDataModeToAscii();
  if (mode == Mode::binary) writer->SetDataModeToBinary();
  if (mode == Mode::appended_raw || mode == Mode::appended_base64) writer->SetDataModeToAppended();
  writer->SetEncodeAppendedData(mode == Mode::appended_base64);
  writer->Write();
}

TEST(VtkEncodings, XmlFiles) {
  const ScratchFolder folder;
  const auto grid = unstructured();
  for (const Mode mode : {Mode::ascii, Mode::binary, Mode::appended_raw, Mode::appended_base64})
    for (const int compressor : kCompressors)
      for (const bool other : {false, true}) {
        const std::string path = folder.file("a.vtu");
        write_xml<vtkXMLUnstructuredGridWriter>(grid, path, mode, compressor, other, other);
        EXPECT_EQ(content_hash(read_any(path).mesh), expected_hash())
            << static_cast<int>(mode) << " " << compressor << " " << other;
        // every one of them refuses to be cut
        const std::string text = text_of(path);
        for (const double part : {0.3, 0.6, 0.9, 0.99}) {
          const auto length = static_cast<std::size_t>(part * static_cast<double>(text.size()));
          EXPECT_NE(refusal(folder.write("cut.vtu", text.substr(0, length))), "");
        }
      }
}

/// Three steps, at each of which a field and the points are other ones: s = step + x, z -> z +
/// step.
template <typename Writer>
void write_steps(vtkPointSet& dataset, const std::string& path, Mode mode, int compressor) {
  vtkNew<Writer> writer;
  writer->SetFileName(path.c_str());
  writer->SetCompressorType(compressor);
  if (mode == Mode::ascii) writer->SetDataModeToAscii();
  writer->SetEncodeAppendedData(mode == Mode::appended_base64);
  writer->SetNumberOfTimeSteps(3);
  writer->SetInputData(&dataset);
  writer->Start();
  for (const int step : {0, 1, 2}) {
    set_points(dataset);
    vtkNew<vtkDoubleArray> s;
    s->SetName("s");
    for (vtkIdType p = 0; p < dataset.GetNumberOfPoints(); ++p) {
      std::array<double, 3> x{};
      dataset.GetPoint(p, x.data());
      s->InsertNextValue(step + x[0]);
      dataset.GetPoints()->SetPoint(p, x[0], x[1], x[2] + step);
    }
    dataset.GetPointData()->AddArray(s);
    dataset.Modified();
    writer->WriteNextTime(0.5 * step);
  }
  writer->Stop();
}

void expect_steps(const std::string& path) {
  EXPECT_THAT(format_to_read(path).inspect(path).times, testing::ElementsAre(0, 0.5, 1));
  for (const std::size_t step : {0, 1, 2}) {
    ReadOptions options;
    options.step = step;
    const ZooMesh mesh = read_any(path, options).mesh;
    ASSERT_EQ(mesh.node_count(), static_cast<std::size_t>(kSide * kSide * kSide));
    const Field s = scalar_field(mesh, "s");
    double lowest = 1e9;
    for (NodeId n = 0; n < mesh.node_count(); ++n) {
      ASSERT_EQ(s.values[n], static_cast<double>(step) + mesh.position(n)[0]);
      lowest = std::min(lowest, mesh.position(n)[2]);
    }
    EXPECT_EQ(lowest, static_cast<double>(step));
  }
}

TEST(VtkEncodings, StepsOfOneXmlFile) {
  const ScratchFolder folder;
  for (const Mode mode : {Mode::appended_raw, Mode::appended_base64})
    for (const int compressor : {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB}) {
      const std::string path = folder.file("a.vtu");
      write_steps<vtkXMLUnstructuredGridWriter>(*unstructured(), path, mode, compressor);
      expect_steps(path);
      vtkNew<vtkStructuredGrid> grid;
      grid->SetDimensions(kSide, kSide, kSide);
      set_points(*grid);
      write_steps<vtkXMLStructuredGridWriter>(*grid, folder.file("a.vts"), mode, compressor);
      expect_steps(folder.file("a.vts"));
    }
  // inline, VTK itself cannot tell the steps apart
  write_steps<vtkXMLUnstructuredGridWriter>(*unstructured(), folder.file("i.vtu"), Mode::ascii,
                                            vtkXMLWriter::NONE);
  EXPECT_THAT(refusal(folder.file("i.vtu")), testing::HasSubstr("no array belongs to step 1"));
}

/// What becomes of a damaged file: refused in one line that names it, or a mesh that holds
/// together.
enum class Outcome { refused, same, other };

Outcome outcome_of(const std::string& path) {
  try {
    const ZooMesh mesh = read_any(path).mesh;
    EXPECT_NO_THROW(validate(mesh, path));
    return content_hash(mesh) == expected_hash() ? Outcome::same : Outcome::other;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(path));
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
    return Outcome::refused;
  }
}

// zlib and xz have sums of what they compressed: a damaged block is refused, or the damage is where
// nothing stands. LZ4's blocks and plain bytes have none: what is read of them holds together.
TEST(VtkEncodings, DamagedCompressedBlocksAreRefused) {
  const ScratchFolder folder;
  for (const int compressor : kCompressors) {
    const std::string path = folder.file("a.vtu");
    write_xml<vtkXMLUnstructuredGridWriter>(unstructured(), path, Mode::appended_raw, compressor,
                                            true, false);
    const std::string text = text_of(path);
    const std::size_t data = text.find("<AppendedData") + 40;
    const bool summed = compressor == vtkXMLWriter::ZLIB || compressor == vtkXMLWriter::LZMA;
    const std::size_t trials = test::tried(200);
    std::size_t refused = 0;
    for (std::size_t trial = 0; trial < trials; ++trial) {
      std::string damaged = text;
      const std::size_t at = data + trial * 7919 % (text.size() - data - 60);
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << trial % 8));
      if (trial % 5 == 0) damaged[data + trial % 64] = static_cast<char>(0xff);
      const Outcome outcome = outcome_of(folder.write("damaged.vtu", damaged));
      if (outcome == Outcome::refused) ++refused;
      if (summed) {
        EXPECT_NE(outcome, Outcome::other) << "compressor " << compressor << ", trial " << trial;
      }
    }
    EXPECT_GT(refused, summed ? trials * 9 / 10 : trials / 10) << "compressor " << compressor;
  }
}

TEST(VtkEncodings, DamagedBinaryLegacyFilesHoldTogetherOrAreRefused) {
  const ScratchFolder folder;
  std::mt19937 random(7);  // NOLINT(cert-msc51-cpp): the same files every time
  std::array<std::size_t, 3> met{};
  for (const int version : {42, 51}) {
    vtkNew<vtkUnstructuredGridWriter> writer;
    writer->SetInputData(unstructured());
    writer->SetFileVersion(version);
    writer->SetFileTypeToBinary();
    writer->SetFileName(folder.file("a.vtk").c_str());
    writer->Write();
    const std::string text = text_of(folder.file("a.vtk"));
    for (const char* section : {"POINTS", "CELLS", "OFFSETS", "CELL_TYPES", "POINT_DATA", "c 1"}) {
      const std::size_t begin = text.find(section);
      if (begin == std::string::npos) continue;
      for (int trial = 0; trial < 25; ++trial) {
        std::string damaged = text;
        const std::size_t at = std::min(begin + random() % 80, text.size() - 1);
        damaged[at] = static_cast<char>(random());
        const Outcome outcome = outcome_of(folder.write("damaged.vtk", damaged));
        if (damaged == text) {
          EXPECT_EQ(outcome, Outcome::same);
        }
        ++met[static_cast<std::size_t>(outcome)];
      }
    }
  }
  // words and counts are refused, values are read as they stand
  EXPECT_GT(met[static_cast<std::size_t>(Outcome::refused)], 50U);
  EXPECT_GT(met[static_cast<std::size_t>(Outcome::other)], 50U);
}

TEST(VtkEncodings, StructuredDatasets) {
  const ScratchFolder folder;
  vtkNew<vtkStructuredGrid> curvilinear;
  curvilinear->SetDimensions(kSide, kSide, kSide);
  set_points(*curvilinear);
  add_data(*curvilinear);
  write_xml<vtkXMLStructuredGridWriter>(curvilinear, folder.file("a.vts"), Mode::appended_raw,
                                        vtkXMLWriter::ZLIB, true, false);
  EXPECT_EQ(content_hash(read_any(folder.file("a.vts")).mesh), expected_hash());
  vtkNew<vtkStructuredGridWriter> legacy;
  legacy->SetInputData(curvilinear);
  legacy->SetFileTypeToBinary();
  legacy->SetFileName(folder.file("s.vtk").c_str());
  legacy->Write();
  EXPECT_EQ(content_hash(read_any(folder.file("s.vtk")).mesh), expected_hash());

  vtkNew<vtkImageData> image;
  image->SetDimensions(kSide, kSide, kSide);
  image->SetSpacing(0.5, 0.25, 2.0);
  add_data(*image);
  write_xml<vtkXMLImageDataWriter>(image, folder.file("a.vti"), Mode::binary, vtkXMLWriter::LZ4,
                                   false, true);
  EXPECT_EQ(content_hash(read_any(folder.file("a.vti")).mesh), expected_hash());
  vtkNew<vtkStructuredPointsWriter> points;
  points->SetInputData(image);
  points->SetFileName(folder.file("p.vtk").c_str());
  points->Write();
  EXPECT_EQ(content_hash(read_any(folder.file("p.vtk")).mesh), expected_hash());

  vtkNew<vtkRectilinearGrid> rectilinear;
  rectilinear->SetDimensions(kSide, kSide, kSide);
  const double steps[3] = {0.5, 0.25, 2.0};
  for (int axis = 0; axis < 3; ++axis) {
    vtkNew<vtkDoubleArray> coordinates;
    for (int i = 0; i < kSide; ++i) coordinates->InsertNextValue(steps[axis] * i);
    if (axis == 0) rectilinear->SetXCoordinates(coordinates);
    if (axis == 1) rectilinear->SetYCoordinates(coordinates);
    if (axis == 2) rectilinear->SetZCoordinates(coordinates);
  }
  add_data(*rectilinear);
  write_xml<vtkXMLRectilinearGridWriter>(rectilinear, folder.file("a.vtr"), Mode::appended_base64,
                                         vtkXMLWriter::NONE, false, false);
  EXPECT_EQ(content_hash(read_any(folder.file("a.vtr")).mesh), expected_hash());
}

TEST(VtkEncodings, TiltedImagesKeepTheirDirections) {
  const ScratchFolder folder;
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 2);
  image->SetOrigin(1, 2, 3);
  const double turn[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  image->SetDirectionMatrix(turn);
  add_data(*image);
  write_xml<vtkXMLImageDataWriter>(image, folder.file("a.vti"), Mode::binary, vtkXMLWriter::NONE,
                                   false, false);
  const ZooMesh mesh = read_any(folder.file("a.vti")).mesh;
  EXPECT_EQ(mesh.position(1)[0], 1);
  EXPECT_EQ(mesh.position(1)[1], 3);
}

}  // namespace
}  // namespace hiac::formats
