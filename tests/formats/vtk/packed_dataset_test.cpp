// Datasets that VTK reads in another process arrive whole, whatever that process packs.
#include "formats/vtk/packed_dataset.hpp"

#include <array>
#include <csignal>
#include <cstring>
#include <fstream>
#include <span>
#include <string>

#include <gmock/gmock.h>
#include <unistd.h>
#include <vtkBitArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "formats/vtk/reading_process.hpp"
#include "hiac/base/process/isolated_process.hpp"
#include "hiac/base/process/pack.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats::vtk {
namespace {

/// An answer that holds the packed dataset.
std::unique_ptr<PackedAnswer> packed(vtkDataSet& dataset) {
  const auto memory = std::make_shared<SharedMemory>();
  PackWriter out(memory->descriptor());
  pack_dataset(out, dataset);
  return std::make_unique<PackedAnswer>(memory, 0, out.end());
}

vtkSmartPointer<vtkDataSet> passed_on(vtkDataSet& dataset) {
  const auto copy = vtkSmartPointer<vtkDataSet>::Take(dataset.NewInstance());
  copy->DeepCopy(&dataset);
  const auto answer = packed(*copy);
  PackReader in(answer->bytes(), "file");
  return unpack_dataset(in, *answer);
}

void expect_same(vtkFieldData& expected, vtkFieldData& found) {
  ASSERT_EQ(found.GetNumberOfArrays(), expected.GetNumberOfArrays());
  for (int i = 0; i < expected.GetNumberOfArrays(); ++i) {
    vtkAbstractArray* const a = expected.GetAbstractArray(i);
    vtkAbstractArray* const b = found.GetAbstractArray(i);
    EXPECT_STREQ(a->GetName(), b->GetName());
    EXPECT_EQ(a->GetDataType(), b->GetDataType());
    EXPECT_EQ(a->GetNumberOfComponents(), b->GetNumberOfComponents());
    ASSERT_EQ(a->GetNumberOfValues(), b->GetNumberOfValues());
    for (vtkIdType v = 0; v < a->GetNumberOfValues(); ++v)
      ASSERT_EQ(a->GetVariantValue(v).ToString(), b->GetVariantValue(v).ToString());
  }
}

void expect_same(vtkDataSet& expected, vtkDataSet& found) {
  EXPECT_STREQ(expected.GetClassName(), found.GetClassName());
  ASSERT_EQ(expected.GetNumberOfPoints(), found.GetNumberOfPoints());
  ASSERT_EQ(expected.GetNumberOfCells(), found.GetNumberOfCells());
  for (vtkIdType p = 0; p < expected.GetNumberOfPoints(); ++p) {
    std::array<double, 3> a, b;
    expected.GetPoint(p, a.data());
    found.GetPoint(p, b.data());
    ASSERT_EQ(a, b) << p;
  }
  for (vtkIdType c = 0; c < expected.GetNumberOfCells(); ++c) {
    ASSERT_EQ(expected.GetCellType(c), found.GetCellType(c));
    vtkNew<vtkIdList> a;
    vtkNew<vtkIdList> b;
    expected.GetCellPoints(c, a);
    found.GetCellPoints(c, b);
    ASSERT_EQ(a->GetNumberOfIds(), b->GetNumberOfIds());
    for (vtkIdType n = 0; n < a->GetNumberOfIds(); ++n) ASSERT_EQ(a->GetId(n), b->GetId(n));
  }
  expect_same(*expected.GetPointData(), *found.GetPointData());
  expect_same(*expected.GetCellData(), *found.GetCellData());
  expect_same(*expected.GetFieldData(), *found.GetFieldData());
}

template <typename Array, typename Value>
vtkSmartPointer<Array> array(const char* name, int components, vtkIdType values, Value step) {
  auto result = vtkSmartPointer<Array>::New();
  result->SetName(name);
  result->SetNumberOfComponents(components);
  for (vtkIdType v = 0; v < values; ++v) result->InsertNextValue(static_cast<Value>(v) * step);
  return result;
}

/// Data of every sort on the points, on the cells and on the whole.
void add_data(vtkDataSet& dataset) {
  const vtkIdType points = dataset.GetNumberOfPoints();
  const vtkIdType cells = dataset.GetNumberOfCells();
  const auto velocity = array<vtkFloatArray>("v", 3, 3 * points, 0.25F);
  velocity->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), "m/s");
  dataset.GetPointData()->AddArray(velocity);
  dataset.GetPointData()->AddArray(array<vtkBitArray>("marks", 1, points, 1));
  dataset.GetCellData()->AddArray(array<vtkIntArray>("part", 1, cells, 7));
  dataset.GetCellData()->AddArray(array<vtkIdTypeArray>("ids", 1, cells, vtkIdType{1} << 40));
  vtkNew<vtkStringArray> texts;
  texts->SetName("title");
  texts->InsertNextValue("a mesh");
  texts->InsertNextValue("");
  dataset.GetFieldData()->AddArray(texts);
  vtkNew<vtkStringArray> pairs;
  pairs->SetName("pairs");
  pairs->SetNumberOfComponents(2);
  for (const char* word : {"a", "b", "c", "d"}) pairs->InsertNextValue(word);
  dataset.GetFieldData()->AddArray(pairs);
  dataset.GetFieldData()->AddArray(array<vtkDoubleArray>("TimeValue", 1, 1, 1.0));
}

/// `count` tetrahedra in a row and a polyhedron.
vtkSmartPointer<vtkUnstructuredGrid> unstructured(vtkIdType count) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType p = 0; p < count + 3; ++p)
    points->InsertNextPoint(static_cast<double>(p % 2), static_cast<double>(p / 2 % 2),
                            static_cast<double>(p));
  grid->SetPoints(points);
  for (vtkIdType c = 0; c < count; ++c) {
    const std::array<vtkIdType, 4> nodes{c, c + 1, c + 2, c + 3};
    grid->InsertNextCell(VTK_TETRA, 4, nodes.data());
  }
  const std::array<vtkIdType, 4> nodes{0, 1, 2, 3};
  const std::array<vtkIdType, 16> faces{3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3};
  grid->InsertNextCell(VTK_POLYHEDRON, 4, nodes.data(), 4, faces.data());
  add_data(*grid);
  return grid;
}

TEST(PackedDataset, UnstructuredGridsArriveWhole) {
  // small arrays are copied, large ones mapped
  for (const vtkIdType count : {1, 40'000}) {
    const auto grid = unstructured(count);
    const auto found = passed_on(*grid);
    ASSERT_NE(found, nullptr);
    expect_same(*grid, *found);
    auto* const other = vtkUnstructuredGrid::SafeDownCast(found);
    vtkNew<vtkIdList> a;
    vtkNew<vtkIdList> b;
    grid->GetFaceStream(count, a);
    other->GetFaceStream(count, b);
    ASSERT_EQ(a->GetNumberOfIds(), 17);
    ASSERT_EQ(b->GetNumberOfIds(), 17);
    for (vtkIdType i = 0; i < 17; ++i) EXPECT_EQ(a->GetId(i), b->GetId(i));
    vtkDataArray* const velocity = found->GetPointData()->GetArray("v");
    EXPECT_STREQ(velocity->GetInformation()->Get(vtkDataArray::UNITS_LABEL()), "m/s");
  }
  const auto empty = vtkSmartPointer<vtkUnstructuredGrid>::New();
  expect_same(*empty, *passed_on(*empty));
}

// From a mebibyte on arrays are mapped, smaller ones copied.
TEST(PackedDataset, ArraysOnBothSidesOfTheLimit) {
  constexpr vtkIdType kMebibyte = 1 << 20;
  for (const vtkIdType bytes : {kMebibyte - 1, kMebibyte, kMebibyte + 1}) {
    const auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(2, 2, 2);
    auto large = vtkSmartPointer<vtkUnsignedCharArray>::New();
    large->SetName("large");
    large->SetNumberOfValues(bytes);
    for (vtkIdType i = 0; i < bytes; ++i)
      large->SetValue(i, static_cast<unsigned char>(i * 7 + i / 251));
    image->GetFieldData()->AddArray(large);
    image->GetFieldData()->AddArray(array<vtkIntArray>("behind", 1, 3, 5));
    const auto found = passed_on(*image);
    vtkFieldData* const data = found->GetFieldData();
    ASSERT_EQ(data->GetNumberOfArrays(), 2);
    auto* const same = vtkUnsignedCharArray::SafeDownCast(data->GetArray("large"));
    ASSERT_NE(same, nullptr);
    ASSERT_EQ(same->GetNumberOfValues(), bytes);
    EXPECT_EQ(
        std::memcmp(same->GetPointer(0), large->GetPointer(0), static_cast<std::size_t>(bytes)), 0);
    EXPECT_EQ(data->GetArray("behind")->GetComponent(2, 0), 10);
  }
}

TEST(PackedDataset, StructuredDatasetsArriveWhole) {
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(1, 4, 0, 2, -1, 0);
  image->SetOrigin(1, 2, 3);
  image->SetSpacing(0.5, 0.25, 2);
  image->SetDirectionMatrix(0, 1, 0, 1, 0, 0, 0, 0, 1);
  add_data(*image);
  expect_same(*image, *passed_on(*image));

  const auto rectilinear = vtkSmartPointer<vtkRectilinearGrid>::New();
  rectilinear->SetExtent(0, 2, 0, 1, 5, 6);
  rectilinear->SetXCoordinates(array<vtkFloatArray>("x", 1, 3, 0.5F));
  rectilinear->SetYCoordinates(array<vtkDoubleArray>("y", 1, 2, 0.1));
  rectilinear->SetZCoordinates(array<vtkDoubleArray>("z", 1, 2, 3.0));
  add_data(*rectilinear);
  expect_same(*rectilinear, *passed_on(*rectilinear));

  const auto structured = vtkSmartPointer<vtkStructuredGrid>::New();
  structured->SetExtent(0, 2, 0, 1, 0, 1);
  vtkNew<vtkPoints> points;
  for (int p = 0; p < 12; ++p) points->InsertNextPoint(p % 3, p / 3 % 2, p / 6 + 0.1 * p);
  structured->SetPoints(points);
  add_data(*structured);
  expect_same(*structured, *passed_on(*structured));
}

TEST(PackedDataset, WhatAnotherProcessMadeUpIsRefusedOrHarmless) {
  const auto grid = unstructured(2);
  const auto structured = vtkSmartPointer<vtkStructuredGrid>::New();
  structured->SetExtent(0, 1, 0, 1, 0, 1);
  vtkNew<vtkPoints> points;
  for (int p = 0; p < 8; ++p) points->InsertNextPoint(p % 2, p / 2 % 2, p / 4);
  structured->SetPoints(points);
  add_data(*structured);
  const auto rectilinear = vtkSmartPointer<vtkRectilinearGrid>::New();
  rectilinear->SetExtent(0, 2, 0, 1, 5, 6);
  rectilinear->SetXCoordinates(array<vtkDoubleArray>("x", 1, 3, 0.5));
  rectilinear->SetYCoordinates(array<vtkDoubleArray>("y", 1, 2, 0.1));
  rectilinear->SetZCoordinates(array<vtkDoubleArray>("z", 1, 2, 3.0));
  const auto longer = vtkSmartPointer<vtkRectilinearGrid>::New();
  longer->DeepCopy(rectilinear);
  longer->SetYCoordinates(array<vtkDoubleArray>("y", 1, 3, 0.1));
  EXPECT_NO_THROW(passed_on(*rectilinear));
  EXPECT_THROW(passed_on(*longer), InputError);
  for (vtkDataSet* dataset : {static_cast<vtkDataSet*>(grid), static_cast<vtkDataSet*>(structured),
                              static_cast<vtkDataSet*>(rectilinear)}) {
    const std::size_t size = [&] {
      const auto copy = vtkSmartPointer<vtkDataSet>::Take(dataset->NewInstance());
      copy->DeepCopy(dataset);
      return packed(*copy)->bytes().size();
    }();
    std::size_t refused = 0;
    for (std::size_t at = 0; at + 8 <= size; at += 8)
      for (const std::uint64_t value : {std::uint64_t{0}, std::uint64_t{3}, ~std::uint64_t{0},
                                        std::uint64_t{1} << 62, std::uint64_t{1} << 31}) {
        const auto copy = vtkSmartPointer<vtkDataSet>::Take(dataset->NewInstance());
        copy->DeepCopy(dataset);
        const auto answer = packed(*copy);
        std::memcpy(const_cast<char*>(answer->bytes().data()) + at, &value, sizeof value);
        try {
          PackReader in(answer->bytes(), "file");
          const auto found = unpack_dataset(in, *answer);
          if (found != nullptr) static_cast<void>(found->GetNumberOfCells());
        } catch (const InputError&) {
          ++refused;
        }
      }
    EXPECT_GT(refused, size / 8);
  }
}

TEST(ReadingProcess, VtkReadsThere) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "a.vtk",
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n"
      "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n");
  const auto process = reading_process();
  EXPECT_EQ(process, reading_process());
  EXPECT_EQ(read_any(path).mesh.cell_count(), 1U);
  pid_t child = 0;
  std::ifstream("/proc/self/task/" + std::to_string(getpid()) + "/children") >> child;
  ASSERT_GT(child, 0);
  kill(child, SIGSEGV);
  try {
    read_any(path);
    ADD_FAILURE() << "something else reads";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("a.vtk: VTK breaks down on it (a damaged file; "
                                                 "signal 11)"));
  }
}

TEST(ReadingProcess, StepsThatAnotherProcessMadeUpAreRefused) {
  const auto opened = [](std::uint64_t step, const std::vector<double>& times,
                         const std::vector<std::size_t>& of_field) -> std::string {
    const auto memory = std::make_shared<SharedMemory>();
    PackWriter out(memory->descriptor());
    out.number(1);
    out.array(std::span<const double>(times));
    out.number(step);
    out.number(1);
    out.text("p");
    out.array(std::span<const std::size_t>(of_field));
    out.number(1);
    out.text("a note");
    const PackedAnswer answer(memory, 0, out.end());
    PackReader in(answer.bytes(), "file");
    try {
      const OpenedXml found = unpack_opened(in);
      EXPECT_EQ(found.pieces, 1U);
      EXPECT_EQ(found.times, times);
      EXPECT_EQ(found.step, step);
      EXPECT_EQ(found.field_steps.at("p").size(), of_field.size());
      EXPECT_THAT(found.notes, testing::ElementsAre("a note"));
    } catch (const InputError&) {
      return "refused";
    }
    return "read";
  };
  EXPECT_EQ(opened(0, {}, {}), "read");
  EXPECT_EQ(opened(1, {0.5, 2}, {0, 1}), "read");
  EXPECT_EQ(opened(2, {0.5, 2}, {0}), "refused");
  EXPECT_EQ(opened(3, {0.5, 2}, {0}), "refused");
  EXPECT_EQ(opened(0, {0.5, 2}, {2}), "refused");
  EXPECT_EQ(opened(0, {}, {0}), "refused");
}

TEST(ReadingProcess, IsNewWhenNobodyHoldsIt) {
  std::weak_ptr<IsolatedProcess> first = reading_process();
  EXPECT_TRUE(first.expired());
  const auto second = reading_process();
  EXPECT_NE(second, nullptr);
}

}  // namespace
}  // namespace hiac::formats::vtk
