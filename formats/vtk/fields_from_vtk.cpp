#include "formats/vtk/fields_from_vtk.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

/// Rows of numbers up to this length are kept as text.
constexpr vtkIdType kShortRow = 16;
/// Not all integers beyond this are representable as doubles.
constexpr double kLargestExactInteger = 9007199254740992.0;  // 2^53

bool is_time(const std::string& name) { return name == "TimeValue" || name == "TIME"; }

bool is_mark(const std::string& name) {
  return name == vtkDataSetAttributes::GhostArrayName() || name == "vtkGhostLevels";
}

std::string name_of(vtkAbstractArray* array, FieldLocation location, int index) {
  const char* name = array->GetName();
  if (name != nullptr && *name != '\0') return name;
  return fmt::format("{} field {}", location == FieldLocation::node ? "node" : "cell", index);
}

std::string unit_of(vtkDataArray* array) {
  if (!array->HasInformation()) return {};
  const char* unit = array->GetInformation()->Get(vtkDataArray::UNITS_LABEL());
  return unit == nullptr ? std::string() : std::string(unit);
}

template <typename Number>
void copy_tuples(const Number* from, std::size_t width, const TupleChoice& choice,
                 std::vector<double>& to) {
  if (choice.all) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = static_cast<double>(from[i]);
    return;
  }
  for (std::size_t t = 0; t < choice.chosen.size(); ++t)
    for (std::size_t c = 0; c < width; ++c)
      to[t * width + c] = static_cast<double>(from[choice.chosen[t] * width + c]);
}

/// For arrays that have no contiguous numbers in memory (bits).
void copy_tuples_slowly(vtkDataArray& array, const TupleChoice& choice, std::vector<double>& to) {
  const auto width = static_cast<std::size_t>(array.GetNumberOfComponents());
  for (std::size_t i = 0; i < to.size(); ++i) {
    const std::size_t tuple = choice.all ? i / width : choice.chosen[i / width];
    to[i] = array.GetComponent(static_cast<vtkIdType>(tuple), static_cast<int>(i % width));
  }
}

void note_large_integers(vtkDataArray& array, const Field& field, std::vector<std::string>& notes) {
  const int type = array.GetDataType();
  if (array.GetDataTypeSize() < 8 || type == VTK_DOUBLE) return;
  const bool any = std::any_of(field.values.begin(), field.values.end(),
                               [](double value) { return std::abs(value) > kLargestExactInteger; });
  if (any)
    notes.push_back(
        fmt::format("field '{}' holds integers beyond 2^53, which are rounded", field.name));
}

void move_attributes(vtkDataSetAttributes& attributes, FieldLocation location,
                     const TupleChoice& choice, const std::string& subject, ZooMesh& mesh,
                     std::vector<std::string>& notes) {
  for (int index = 0; attributes.GetNumberOfArrays() > 0; ++index) {
    const vtkSmartPointer<vtkAbstractArray> any = attributes.GetAbstractArray(0);
    attributes.RemoveArray(0);
    const std::string name = name_of(any, location, index);
    if (is_mark(name)) continue;
    const vtkSmartPointer<vtkDataArray> array = vtkDataArray::SafeDownCast(any);
    if (array == nullptr || array->GetNumberOfComponents() < 1) {
      notes.push_back(fmt::format("field '{}' holds no numbers: left out", name));
      continue;
    }
    if (static_cast<std::size_t>(array->GetNumberOfTuples()) != choice.total)
      throw InputError(subject,
                       fmt::format("field '{}' does not fit ({} tuples expected, {} found)", name,
                                   choice.total, array->GetNumberOfTuples()));
    Field field{name, unit_of(array), location,
                static_cast<std::uint32_t>(array->GetNumberOfComponents()),
                values_of(array, choice)};
    note_large_integers(*array, field, notes);
    mesh.fields.push_back(std::move(field));
  }
}

std::vector<double> row_of(vtkDataArray& array) {
  std::vector<double> row;
  for (vtkIdType t = 0; t < array.GetNumberOfTuples(); ++t)
    for (int c = 0; c < array.GetNumberOfComponents(); ++c) row.push_back(array.GetComponent(t, c));
  return row;
}

void set_metadata(ZooMesh& mesh, const std::string& key, const std::string& value) {
  for (auto& [known, text] : mesh.metadata) {
    if (known != key) continue;
    text = value;
    return;
  }
  mesh.metadata.emplace_back(key, value);
}

void summarize_attributes(vtkDataSetAttributes& attributes, FieldLocation location,
                          std::vector<FieldSummary>& summaries) {
  for (int index = 0; index < attributes.GetNumberOfArrays(); ++index) {
    vtkAbstractArray* any = attributes.GetAbstractArray(index);
    FieldSummary summary;
    summary.name = name_of(any, location, index);
    summary.location = location == FieldLocation::node ? "node" : "cell";
    summary.type = any->GetDataTypeAsString();
    summary.components = static_cast<std::uint32_t>(any->GetNumberOfComponents());
    summary.tuples = static_cast<std::size_t>(any->GetNumberOfTuples());
    const vtkSmartPointer<vtkDataArray> array = vtkDataArray::SafeDownCast(any);
    const SharedArray<double> values =
        array == nullptr ? SharedArray<double>() : values_of(array, {summary.tuples, true, {}});
    summarize_values(values.view(), summary);
    summaries.push_back(std::move(summary));
  }
}

}  // namespace

SharedArray<double> values_of(const vtkSmartPointer<vtkDataArray>& array,
                              const TupleChoice& choice) {
  const auto width = static_cast<std::size_t>(array->GetNumberOfComponents());
  const auto total = static_cast<std::size_t>(array->GetNumberOfValues());
  if (auto* doubles = vtkDoubleArray::SafeDownCast(array); doubles != nullptr && choice.all)
    return {std::span<const double>(doubles->GetPointer(0), total),
            std::make_shared<vtkSmartPointer<vtkDataArray>>(array)};
  std::vector<double> values(choice.all ? total : choice.chosen.size() * width);
  if (values.empty()) return values;
  switch (array->GetDataType()) {
    vtkTemplateMacro(
        copy_tuples(static_cast<const VTK_TT*>(array->GetVoidPointer(0)), width, choice, values));
    default:
      copy_tuples_slowly(*array, choice, values);
  }
  return values;
}

void move_fields(vtkDataSet& dataset, const TupleChoice& points, const TupleChoice& cells,
                 const std::string& subject, ZooMesh& mesh, std::vector<std::string>& notes) {
  move_attributes(*dataset.GetPointData(), FieldLocation::node, points, subject, mesh, notes);
  move_attributes(*dataset.GetCellData(), FieldLocation::cell, cells, subject, mesh, notes);
}

void add_metadata(vtkFieldData& data, ZooMesh& mesh, std::vector<std::string>& notes) {
  std::vector<std::string> left_out;
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    vtkAbstractArray* any = data.GetAbstractArray(i);
    const std::string name = any->GetName() == nullptr ? fmt::format("{}", i) : any->GetName();
    auto* texts = vtkStringArray::SafeDownCast(any);
    auto* numbers = vtkDataArray::SafeDownCast(any);
    if (texts != nullptr && texts->GetNumberOfValues() == 1) {
      set_metadata(mesh, name, texts->GetValue(0));
    } else if (numbers != nullptr && numbers->GetNumberOfValues() > 0 &&
               numbers->GetNumberOfValues() <= kShortRow) {
      set_metadata(mesh, is_time(name) ? "time" : name,
                   fmt::format("{}", fmt::join(row_of(*numbers), " ")));
    } else if (any->GetNumberOfValues() > 0) {
      left_out.push_back(fmt::format("{} ({} values)", name, any->GetNumberOfValues()));
    }
  }
  if (!left_out.empty())
    notes.push_back(
        fmt::format("left out data of the whole dataset: {}", fmt::join(left_out, ", ")));
}

std::vector<double> times_of(vtkFieldData& data) {
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    auto* array = vtkDataArray::SafeDownCast(data.GetAbstractArray(i));
    if (array != nullptr && array->GetName() != nullptr && is_time(array->GetName()))
      return row_of(*array);
  }
  return {};
}

std::vector<FieldSummary> summarize_fields(vtkDataSet& dataset) {
  std::vector<FieldSummary> summaries;
  summarize_attributes(*dataset.GetPointData(), FieldLocation::node, summaries);
  summarize_attributes(*dataset.GetCellData(), FieldLocation::cell, summaries);
  return summaries;
}

}  // namespace hiac::formats::vtk
