#include "formats/vtk/packed_dataset.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

#include <vtkAbstractArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkMatrix3x3.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "hiac/base/process/isolated_process.hpp"
#include "hiac/base/process/pack.hpp"

namespace hiac::formats::vtk {
namespace {

/// Arrays of this size are mapped by the process that unpacks them; smaller ones are copied.
constexpr std::size_t kLargeBytes = std::size_t{1} << 20;

enum class Grid : std::uint64_t { none, unstructured, structured, image, rectilinear, count };
enum class Kind : std::uint64_t { none, numbers, texts, count };

std::size_t bytes_of(vtkDataArray& array) {
  const auto values = static_cast<std::size_t>(array.GetNumberOfValues());
  if (array.GetDataType() == VTK_BIT) return (values + 7) / 8;
  return values * static_cast<std::size_t>(array.GetDataTypeSize());
}

/// Whether vtkAbstractArray::CreateArray knows an array of such numbers.
bool is_number_type(int type) {
  constexpr std::array kArrayTypes{VTK_BIT,           VTK_CHAR,      VTK_SIGNED_CHAR,
                                   VTK_UNSIGNED_CHAR, VTK_SHORT,     VTK_UNSIGNED_SHORT,
                                   VTK_INT,           VTK_LONG,      VTK_UNSIGNED_INT,
                                   VTK_UNSIGNED_LONG, VTK_DOUBLE,    VTK_UNSIGNED_LONG_LONG,
                                   VTK_FLOAT,         VTK_LONG_LONG, VTK_ID_TYPE};
  return std::ranges::find(kArrayTypes, type) != kArrayTypes.end();
}

std::string unit_of(vtkAbstractArray& array) {
  if (!array.HasInformation()) return {};
  const char* unit = array.GetInformation()->Get(vtkDataArray::UNITS_LABEL());
  return unit == nullptr ? std::string() : std::string(unit);
}

// ---- packing

void pack_numbers(PackWriter& out, vtkDataArray& array) {
  const std::size_t size = bytes_of(array);
  out.number(size >= kLargeBytes ? 1 : 0);
  auto* const data = static_cast<char*>(size == 0 ? nullptr : array.GetVoidPointer(0));
  if (size >= kLargeBytes)
    out.consume_block(data, size);
  else
    out.text({data, size});
}

/// Packs an array, which may be absent; its values are lost.
void pack_array(PackWriter& out, vtkAbstractArray* array) {
  auto* const numbers = vtkDataArray::SafeDownCast(array);
  const Kind kind = array == nullptr     ? Kind::none
                    : numbers != nullptr ? Kind::numbers
                                         : Kind::texts;
  out.number(static_cast<std::uint64_t>(kind));
  if (kind == Kind::none) return;
  const char* name = array->GetName();
  out.text(name == nullptr ? "" : name);
  out.text(unit_of(*array));
  out.number(static_cast<std::uint64_t>(array->GetNumberOfComponents()));
  if (kind == Kind::numbers) {
    out.number(static_cast<std::uint64_t>(array->GetDataType()));
    out.number(static_cast<std::uint64_t>(array->GetNumberOfValues()));
    return pack_numbers(out, *numbers);
  }
  out.number(static_cast<std::uint64_t>(array->GetNumberOfValues()));
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
    out.text(array->GetVariantValue(i).ToString());
}

void pack_arrays(PackWriter& out, vtkFieldData& data) {
  out.number(static_cast<std::uint64_t>(data.GetNumberOfArrays()));
  while (data.GetNumberOfArrays() > 0) {
    const vtkSmartPointer<vtkAbstractArray> array = data.GetAbstractArray(0);
    // by its place: several arrays may have one name
    data.RemoveArray(0);
    pack_array(out, array);
  }
}

void pack_points(PackWriter& out, vtkPointSet& set) {
  pack_array(out, set.GetPoints() == nullptr ? nullptr : set.GetPoints()->GetData());
  set.SetPoints(nullptr);
}

void pack_cells(PackWriter& out, vtkUnstructuredGrid& grid) {
  vtkCellArray* const cells = grid.GetCells();
  const bool any = cells != nullptr && grid.GetCellTypesArray() != nullptr;
  out.number(any ? 1 : 0);
  if (!any) return;
  out.number(cells->IsStorage64Bit() ? 1 : 0);
  pack_array(out, grid.GetCellTypesArray());
  pack_array(out, cells->GetOffsetsArray());
  pack_array(out, cells->GetConnectivityArray());
  pack_array(out, grid.GetFaceLocations());
  pack_array(out, grid.GetFaces());
}

template <typename T>
void pack_plain(PackWriter& out, const T* values, std::size_t count) {
  out.array(std::span<const T>(values, count));
}

void pack_image(PackWriter& out, vtkImageData& image) {
  pack_plain(out, image.GetOrigin(), 3);
  pack_plain(out, image.GetSpacing(), 3);
  pack_plain(out, image.GetDirectionMatrix()->GetData(), 9);
}

// ---- unpacking

class Unpacker {
 public:
  Unpacker(PackReader& in, PackedAnswer& answer) : in_(in), answer_(answer) {}

  vtkSmartPointer<vtkDataSet> dataset() {
    vtkSmartPointer<vtkDataSet> dataset = grid();
    if (dataset == nullptr) return nullptr;
    for (vtkFieldData* data :
         {static_cast<vtkFieldData*>(dataset->GetPointData()),
          static_cast<vtkFieldData*>(dataset->GetCellData()), dataset->GetFieldData()})
      for (std::uint64_t count = in_.count(); count > 0; --count)
        if (const auto one = array()) data->AddArray(one);
    return dataset;
  }

 private:
  vtkSmartPointer<vtkDataSet> grid() {
    switch (static_cast<Grid>(in_.number_below(static_cast<std::uint64_t>(Grid::count)))) {
      case Grid::unstructured:
        return unstructured_grid();
      case Grid::structured:
        return structured_grid();
      case Grid::image:
        return image();
      case Grid::rectilinear:
        return rectilinear_grid();
      case Grid::none:
      case Grid::count:
        break;
    }
    return nullptr;
  }

  vtkSmartPointer<vtkDataSet> unstructured_grid() {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    set_points(*grid);
    if (in_.number() == 0) return grid;
    const bool wide = in_.number() != 0;
    const auto types = array_of<vtkUnsignedCharArray>();
    const auto cells = vtkSmartPointer<vtkCellArray>::New();
    if (wide)
      set_cells<vtkTypeInt64Array>(*cells);
    else
      set_cells<vtkTypeInt32Array>(*cells);
    const auto face_places = vtkSmartPointer<vtkIdTypeArray>(vtkIdTypeArray::SafeDownCast(array()));
    const auto faces = vtkSmartPointer<vtkIdTypeArray>(vtkIdTypeArray::SafeDownCast(array()));
    grid->SetCells(types, cells, face_places, faces);
    return grid;
  }

  vtkSmartPointer<vtkDataSet> structured_grid() {
    auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
    auto [extent, points] = checked_extent();
    grid->SetExtent(extent.data());
    set_points(*grid);
    if (static_cast<std::size_t>(grid->GetNumberOfPoints()) != points) in_.fail();
    return grid;
  }

  vtkSmartPointer<vtkDataSet> image() {
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetExtent(checked_extent().first.data());
    image->SetOrigin(plain<double>(3).data());
    image->SetSpacing(plain<double>(3).data());
    image->SetDirectionMatrix(plain<double>(9).data());
    return image;
  }

  vtkSmartPointer<vtkDataSet> rectilinear_grid() {
    auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
    std::array<int, 6> extent = checked_extent().first;
    grid->SetExtent(extent.data());
    std::array<vtkSmartPointer<vtkDataArray>, 3> axes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      axes[axis] = vtkDataArray::SafeDownCast(array());
      if (axes[axis] == nullptr ||
          axes[axis]->GetNumberOfValues() != extent[2 * axis + 1] - extent[2 * axis] + 1)
        in_.fail();
    }
    grid->SetXCoordinates(axes[0]);
    grid->SetYCoordinates(axes[1]);
    grid->SetZCoordinates(axes[2]);
    return grid;
  }

  void set_points(vtkPointSet& set) {
    const vtkSmartPointer<vtkDataArray> data = vtkDataArray::SafeDownCast(array());
    if (data == nullptr) return;
    if (data->GetNumberOfComponents() != 3) in_.fail();
    vtkNew<vtkPoints> points;
    points->SetData(data);
    set.SetPoints(points);
  }

  template <typename Array>
  void set_cells(vtkCellArray& cells) {
    const auto offsets = array_of<Array>();
    const auto connectivity = array_of<Array>();
    cells.SetData(offsets.GetPointer(), connectivity.GetPointer());
  }

  /// The first and last point along x, y and z, and how many points that are.
  std::pair<std::array<int, 6>, std::size_t> checked_extent() {
    constexpr long kMost = std::size_t{1} << 30;
    std::array<int, 6> extent{};
    const std::vector<int> values = plain<int>(6);
    std::copy(values.begin(), values.end(), extent.begin());
    std::size_t points = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const long count = long{extent[2 * axis + 1]} - extent[2 * axis] + 1;
      if (count < 0 || count > kMost) in_.fail();
      if (__builtin_mul_overflow(points, static_cast<std::size_t>(count), &points)) in_.fail();
    }
    return {extent, points};
  }

  template <typename T>
  std::vector<T> plain(std::size_t count) {
    std::vector<T> values = in_.array<T>();
    if (values.size() != count) in_.fail();
    return values;
  }

  /// A dataset's array; null where there is none.
  vtkSmartPointer<vtkAbstractArray> array() {
    const auto kind = static_cast<Kind>(in_.number_below(static_cast<std::uint64_t>(Kind::count)));
    if (kind == Kind::none) return nullptr;
    const std::string name = in_.text();
    const std::string unit = in_.text();
    const auto components = static_cast<int>(in_.number_below(1 << 30));
    const vtkSmartPointer<vtkAbstractArray> result =
        kind == Kind::numbers ? numbers(components) : texts(components);
    if (!name.empty()) result->SetName(name.c_str());
    if (!unit.empty()) result->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit.c_str());
    return result;
  }

  vtkSmartPointer<vtkAbstractArray> numbers(int components) {
    const auto type = static_cast<int>(in_.number_below(VTK_OBJECT));
    if (!is_number_type(type)) in_.fail();
    auto result = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(type));
    auto* const values = vtkDataArray::SafeDownCast(result);
    if (values == nullptr) in_.fail();
    values->SetNumberOfComponents(components);
    fill(*values);
    return result;
  }

  vtkSmartPointer<vtkAbstractArray> texts(int components) {
    auto result = vtkSmartPointer<vtkStringArray>::New();
    result->SetNumberOfComponents(components);
    for (std::uint64_t count = in_.count(); count > 0; --count) result->InsertNextValue(in_.text());
    return result;
  }

  /// The dataset's next array, which is of this class.
  template <typename Array>
  vtkSmartPointer<Array> array_of() {
    const vtkSmartPointer<vtkAbstractArray> any = array();
    auto* const numbers = vtkDataArray::SafeDownCast(any);
    const auto wanted = vtkSmartPointer<Array>::New();
    if (numbers == nullptr || numbers->GetDataTypeSize() != wanted->GetDataTypeSize() ||
        numbers->GetNumberOfComponents() != 1)
      in_.fail();
    if (auto* same = Array::SafeDownCast(numbers)) return same;
    // one size of integers has several classes; the values stay where they are
    wanted->ShallowCopy(numbers);
    return wanted;
  }

  /// Gives an array of set type and components its values.
  void fill(vtkDataArray& array) {
    const std::uint64_t count = in_.number();
    const bool large = in_.number() != 0;
    const std::span<const char> bytes = large ? in_.block() : in_.text_bytes();
    const std::size_t size = array.GetDataTypeSize() == 0
                                 ? (count + 7) / 8
                                 : count * static_cast<std::size_t>(array.GetDataTypeSize());
    if (count > 8 * bytes.size() || size != bytes.size()) in_.fail();
    const auto values = static_cast<vtkIdType>(count);
    if (large) {
      array.SetVoidArray(answer_.take_block(bytes), values, 0,
                         vtkAbstractArray::VTK_DATA_ARRAY_USER_DEFINED);
      array.SetArrayFreeFunction(free_block);
    } else {
      array.SetNumberOfValues(values);
      if (count > 0) std::memcpy(array.GetVoidPointer(0), bytes.data(), bytes.size());
    }
  }

  PackReader& in_;
  PackedAnswer& answer_;
};

Grid grid_of(vtkDataSet& dataset) {
  if (vtkUnstructuredGrid::SafeDownCast(&dataset) != nullptr) return Grid::unstructured;
  if (vtkStructuredGrid::SafeDownCast(&dataset) != nullptr) return Grid::structured;
  if (vtkImageData::SafeDownCast(&dataset) != nullptr) return Grid::image;
  if (vtkRectilinearGrid::SafeDownCast(&dataset) != nullptr) return Grid::rectilinear;
  return Grid::none;
}

}  // namespace

void pack_dataset(PackWriter& out, vtkDataSet& dataset) {
  out.number(static_cast<std::uint64_t>(grid_of(dataset)));
  if (auto* grid = vtkUnstructuredGrid::SafeDownCast(&dataset)) {
    pack_points(out, *grid);
    pack_cells(out, *grid);
  } else if (auto* structured = vtkStructuredGrid::SafeDownCast(&dataset)) {
    pack_plain(out, structured->GetExtent(), 6);
    pack_points(out, *structured);
  } else if (auto* image = vtkImageData::SafeDownCast(&dataset)) {
    pack_plain(out, image->GetExtent(), 6);
    pack_image(out, *image);
  } else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(&dataset)) {
    pack_plain(out, rectilinear->GetExtent(), 6);
    for (vtkDataArray* axis : {rectilinear->GetXCoordinates(), rectilinear->GetYCoordinates(),
                               rectilinear->GetZCoordinates()})
      pack_array(out, axis);
  }
  pack_arrays(out, *dataset.GetPointData());
  pack_arrays(out, *dataset.GetCellData());
  pack_arrays(out, *dataset.GetFieldData());
}

vtkSmartPointer<vtkDataSet> unpack_dataset(PackReader& in, PackedAnswer& answer) {
  return Unpacker(in, answer).dataset();
}

}  // namespace hiac::formats::vtk
