// Files cut off and files with changed bytes: a clear refusal or a correct mesh, no crash, and no
// memory for what a file merely declares.
#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <random>

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStructuredPointsWriter.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "hiac/mesh/cell_kind.hpp"
#include "tests/formats/files.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac::formats {
namespace {

/// A brick, a pyramid on its top and a quadratic tetrahedron apart, with fields.
vtkSmartPointer<vtkUnstructuredGrid> three_cells() {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i < 8; ++i) points->InsertNextPoint((i + 1) / 2 % 2, i / 2 % 2, i / 4);
  points->InsertNextPoint(0.5, 0.5, 2);
  constexpr std::array<std::array<double, 3>, 4> kCorners{
      {{3, 0, 0}, {4, 0, 0}, {3, 1, 0}, {3, 0, 1}}};
  for (const auto& corner : kCorners) points->InsertNextPoint(corner.data());
  for (const auto& [a, b] : topology_of(CellShape::tetrahedron).edges)
    points->InsertNextPoint((kCorners[a][0] + kCorners[b][0]) / 2,
                            (kCorners[a][1] + kCorners[b][1]) / 2,
                            (kCorners[a][2] + kCorners[b][2]) / 2);
  grid->SetPoints(points);
  std::array<vtkIdType, 19> ids;
  std::iota(ids.begin(), ids.end(), vtkIdType{0});
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids.data());
  grid->InsertNextCell(VTK_PYRAMID, 5, ids.data() + 4);
  grid->InsertNextCell(VTK_QUADRATIC_TETRA, 10, ids.data() + 9);
  vtkNew<vtkFloatArray> v;
  v->SetName("v");
  v->SetNumberOfComponents(3);
  for (int p = 0; p < 19; ++p) v->InsertNextTuple3(p, 0.5 * p, -p);
  grid->GetPointData()->AddArray(v);
  vtkNew<vtkDoubleArray> c;
  c->SetName("c");
  for (const double value : {1.5, -2.5, 3.5}) c->InsertNextValue(value);
  grid->GetCellData()->AddArray(c);
  return grid;
}

vtkSmartPointer<vtkImageData> image() {
  auto data = vtkSmartPointer<vtkImageData>::New();
  data->SetDimensions(4, 3, 2);
  vtkNew<vtkDoubleArray> s;
  s->SetName("s");
  for (int p = 0; p < 24; ++p) s->InsertNextValue(p);
  data->GetPointData()->SetScalars(s);
  return data;
}

template <typename Writer>
std::string written(const ScratchFolder& folder, const std::string& name, vtkDataObject* data,
                    const std::function<void(Writer&)>& set) {
  vtkNew<Writer> writer;
  writer->SetInputData(data);
  writer->SetFileName(folder.file(name).c_str());
  set(*writer);
  writer->Write();
  return folder.file(name);
}

/// Sound files in VTK's ways of writing.
std::vector<std::string> own_files(const ScratchFolder& folder) {
  std::vector<std::string> files;
  for (const int version : {42, 51})
    for (const bool binary : {false, true})
      files.push_back(written<vtkUnstructuredGridWriter>(
          folder, fmt::format("{}{}.vtk", binary ? "b" : "a", version), three_cells(),
          [&](vtkUnstructuredGridWriter& writer) {
            writer.SetFileVersion(version);
            binary ? writer.SetFileTypeToBinary() : writer.SetFileTypeToASCII();
          }));
  for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended})
    for (const int compressor : {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB})
      files.push_back(written<vtkXMLUnstructuredGridWriter>(
          folder, fmt::format("{}{}.vtu", mode, compressor), three_cells(),
          [&](vtkXMLUnstructuredGridWriter& writer) {
            writer.SetDataMode(mode);
            writer.SetCompressorType(compressor);
            writer.SetEncodeAppendedData(compressor == vtkXMLWriter::ZLIB);
          }));
  files.push_back(written<vtkStructuredPointsWriter>(folder, "i.vtk", image(),
                                                     [](vtkStructuredPointsWriter&) {}));
  files.push_back(written<vtkXMLImageDataWriter>(
      folder, "i.vti", image(),
      [](vtkXMLImageDataWriter& writer) { writer.SetDataModeToAscii(); }));
  return files;
}

/// Those, and the files of the data folder.
std::vector<std::string> vtk_files(const ScratchFolder& folder) {
  std::vector<std::string> files = own_files(folder);
  if (!std::filesystem::exists(data_dir())) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data_dir())) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".vtk" || extension == ".vtu" || extension == ".vts")
      files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// A line of /proc/self/status, in bytes.
std::size_t status_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key + ":")) return std::stoul(line.substr(key.size() + 1)) * 1024;
  return 0;
}

/// The most memory that `work` had beyond what there was before it.
template <typename Work>
std::size_t peak_memory_of(const Work& work) {
  std::ofstream("/proc/self/clear_refs") << "5";
  const std::size_t before = status_bytes("VmRSS");
  work();
  const std::size_t peak = status_bytes("VmHWM");
  return peak > before ? peak - before : 0;
}

/// Reads; says whether it was refused. Anything but an InputError with one line fails the test.
bool is_refused(const std::string& path) {
  const std::string message = refusal(path);
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  return !message.empty();
}

TEST(VtkDamage, TheFilesAreSound) {
  const ScratchFolder folder;
  for (const std::string& path : own_files(folder)) EXPECT_EQ(refusal(path), "") << path;
}

TEST(VtkDamage, TruncatedFilesAreRefusedOrWhole) {
  const ScratchFolder folder;
  const ScratchFolder own;
  const std::vector<std::string> files = vtk_files(own);
  for (const std::string& path : files) {
    const std::string text = text_of(path);
    const std::string extension = std::filesystem::path(path).extension().string();
    const bool xml = text.find("<VTKFile") != std::string::npos;
    for (std::size_t cut = 0; cut < 20; cut += test::kInstrumented ? 4 : 1) {
      // the last cuts near the end, where little is missing
      const std::size_t length = cut < 16 ? text.size() * cut / 16 : text.size() - (cut - 15) * 7;
      const std::string part =
          folder.write("part" + extension, text.substr(0, std::min(length, text.size())));
      bool refused = false;
      const std::size_t memory = peak_memory_of([&] { refused = is_refused(part); });
      EXPECT_TRUE(refused || !xml) << path << " cut to " << length;
      EXPECT_LE(memory, 2 * text.size() + (std::size_t{48} << 20)) << path << " cut to " << length;
    }
  }
}

// A legacy file has no end mark: cut between two arrays it is a file with fewer arrays. What is
// read of a cut file must be what the whole file has.
TEST(VtkDamage, WhatIsReadOfATruncatedLegacyFileIsRight) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "whole.vtk",
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n"
      "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\nCELLS 2 10\n4 0 1 2 3\n4 1 2 3 4\nCELL_TYPES 2\n"
      "10\n10\nCELL_DATA 2\nSCALARS c float 1\nLOOKUP_TABLE default\n5\n6\nPOINT_DATA 5\n"
      "SCALARS x float 1\nLOOKUP_TABLE default\n0\n1\n0\n0\n1\nVECTORS xyz float\n0 0 0\n"
      "1 0 0\n0 1 0\n0 0 1\n1 1 1\n");
  const std::string text = text_of(path);
  const ZooMesh whole = read_any(path).mesh;
  std::size_t read = 0;
  for (std::size_t length = 1; length < text.size(); ++length) {
    if (text[length - 1] != '\n') continue;  // else the last number may be cut: see the note
    const std::string part = folder.write("part.vtk", text.substr(0, length));
    if (is_refused(part)) continue;
    ++read;
    const ZooMesh mesh = read_any(part).mesh;
    ASSERT_TRUE(std::equal(mesh.xyz.begin(), mesh.xyz.end(), whole.xyz.begin(), whole.xyz.end()));
    for (const Field& field : mesh.fields) {
      const auto same = std::find_if(whole.fields.begin(), whole.fields.end(),
                                     [&](const Field& f) { return f.name == field.name; });
      ASSERT_NE(same, whole.fields.end());
      EXPECT_TRUE(std::equal(field.values.begin(), field.values.end(), same->values.begin(),
                             same->values.end()));
    }
  }
  EXPECT_GT(read, 2U);
  const std::string cut =
      folder.write("cut.vtk", text.substr(0, text.find_last_of("0123456789") + 1));
  EXPECT_THAT(read_any(cut).notes, testing::Contains(testing::HasSubstr("line end")));
}

TEST(VtkDamage, ChangedBytesAreSurvived) {
  const ScratchFolder folder;
  const ScratchFolder own;
  const std::vector<std::string> files = vtk_files(own);
  // for a longer search than every run of the tests can afford
  const char* asked = std::getenv("HIAC_DAMAGE_FACTOR");
  const std::size_t factor = asked == nullptr ? 1 : std::strtoul(asked, nullptr, 10);
  std::mt19937 random(20240101);  // NOLINT(cert-msc51-cpp): the same files every time
  const auto below = [&](std::size_t n) { return random() % std::max<std::size_t>(n, 1); };
  for (const std::string& path : files) {
    const std::string text = text_of(path);
    const std::string extension = std::filesystem::path(path).extension().string();
    const std::size_t trials = factor * test::tried(text.size() < 10'000    ? 60
                                                    : text.size() < 200'000 ? 20
                                                                            : 4);
    for (std::size_t trial = 0; trial < trials; ++trial) {
      std::string changed = text;
      const std::size_t changes = 1 + below(3);
      for (std::size_t c = 0; c < changes; ++c) {
        // headers most of the time, and digits with larger ones, which declare more
        const std::size_t header = std::min<std::size_t>(changed.size(), 1500);
        const std::size_t reach = below(4) == 0 ? changed.size() : header;
        const std::size_t at = below(reach);
        const bool digit = std::isdigit(static_cast<unsigned char>(changed[at])) != 0;
        changed[at] = digit && below(2) == 0 ? '9' : static_cast<char>(below(256));
        if (digit && below(4) == 0) changed.insert(at, "99999999");
      }
      const std::string file = folder.write("changed" + extension, changed);
      const std::size_t memory = peak_memory_of([&] { is_refused(file); });
      EXPECT_LE(memory, 8 * text.size() + (std::size_t{64} << 20)) << path << ", trial " << trial;
    }
  }
}

}  // namespace
}  // namespace hiac::formats
