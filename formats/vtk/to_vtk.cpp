#include "formats/vtk/to_vtk.hpp"

#include <cerrno>
#include <charconv>
#include <cstring>

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "formats/vtk/message_capture.hpp"
#include "formats/vtk/written_cells.hpp"
#include "hiac/base/error.hpp"
#include "hiac/base/output_file.hpp"

namespace hiac::formats::vtk {
namespace {

void set_cells(const ZooMesh& mesh, const WrittenCells& table, vtkUnstructuredGrid& grid) {
  const auto cells = static_cast<vtkIdType>(mesh.cell_count());
  vtkNew<vtkUnsignedCharArray> types;
  vtkNew<vtkTypeInt64Array> offsets;
  vtkNew<vtkTypeInt64Array> connectivity;
  types->SetNumberOfValues(cells);
  offsets->SetNumberOfValues(cells + 1);
  offsets->SetValue(0, 0);
  connectivity->Allocate(static_cast<vtkIdType>(mesh.nodes.size()));
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const WrittenCell& written = *table[static_cast<std::size_t>(mesh.kinds[cell])];
    const auto nodes = mesh.cell_nodes(cell);
    types->SetValue(cell, static_cast<unsigned char>(written.type));
    if (written.nodes.empty())
      for (const NodeId node : nodes) connectivity->InsertNextValue(node);
    for (const std::uint8_t n : written.nodes) connectivity->InsertNextValue(nodes[n]);
    offsets->SetValue(vtkIdType{cell} + 1, connectivity->GetNumberOfValues());
  }
  vtkNew<vtkCellArray> array;
  array->SetData(offsets, connectivity);
  grid.SetCells(types, array);
}

void add_fields(const ZooMesh& mesh, const std::string& path, vtkUnstructuredGrid& grid,
                std::vector<std::string>& notes) {
  for (const Field& field : mesh.fields) {
    if (field.location == FieldLocation::corner) {
      notes.push_back(
          fmt::format("field '{}' lives on cell corners, which VTU cannot hold: left "
                      "out",
                      field.name));
      continue;
    }
    add_field(field, "VTU", path, grid);
  }
}

void add_metadata(const ZooMesh& mesh, vtkUnstructuredGrid& grid) {
  for (const auto& [key, text] : mesh.metadata) {
    double time = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
    if (key == "time" && error == std::errc() && end == text.data() + text.size()) {
      vtkNew<vtkDoubleArray> value;
      value->SetName("TimeValue");
      value->InsertNextValue(time);
      grid.GetFieldData()->AddArray(value);
      continue;
    }
    vtkNew<vtkStringArray> value;
    value->SetName(key.c_str());
    value->InsertNextValue(text);
    grid.GetFieldData()->AddArray(value);
  }
}

/// The reason for an error code, which is one of the system or one of VTK's own.
std::string reason_of(unsigned long code) {
  if (code > vtkErrorCode::NoError && code < vtkErrorCode::FirstVTKErrorCode)
    return std::strerror(static_cast<int>(code));
  return code == vtkErrorCode::OutOfDiskSpaceError ? std::strerror(ENOSPC) : "VTK refuses";
}

}  // namespace

vtkSmartPointer<vtkDoubleArray> array_of(std::span<const double> values, std::size_t components) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfComponents(static_cast<int>(components));
  constexpr int kDoNotFree = 1;
  // VTK's writer only reads them
  array->SetArray(const_cast<double*>(values.data()), static_cast<vtkIdType>(values.size()),
                  kDoNotFree);
  return array;
}

void add_field(const Field& field, std::string_view format, const std::string& path,
               vtkDataSet& dataset) {
  vtkDataSetAttributes* data = field.location == FieldLocation::node
                                   ? static_cast<vtkDataSetAttributes*>(dataset.GetPointData())
                                   : dataset.GetCellData();
  if (data->HasArray(field.name.c_str()) != 0)
    throw InputError(path, fmt::format("{} cannot hold two fields of one name in one place "
                                       "('{}' found twice: rename one)",
                                       format, field.name));
  const auto array = array_of(field.values.view(), field.components);
  array->SetName(field.name.c_str());
  if (!field.unit.empty())
    array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), field.unit.c_str());
  data->AddArray(array);
}

void write_xml(vtkXMLWriter& writer, const std::string& path) {
  OutputFile file(path);
  const MessageCapture messages;
  writer.SetFileName(file.temporary_path().c_str());
  writer.SetDataModeToAppended();
  writer.EncodeAppendedDataOff();
  writer.SetHeaderTypeToUInt64();
  if (writer.Write() == 0 || writer.GetErrorCode() != 0)
    file.fail(reason_of(writer.GetErrorCode()));
  if (messages.any_error()) file.fail("VTK refuses");
  file.commit();
}

std::vector<std::string> write_vtu(const std::string& path, const ZooMesh& mesh) {
  std::vector<std::string> notes;
  const WrittenCells table = written_cells(mesh, "VTU", path, notes);
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetData(array_of(mesh.xyz.view(), 3));
  grid->SetPoints(points);
  set_cells(mesh, table, *grid);
  add_fields(mesh, path, *grid, notes);
  add_metadata(mesh, *grid);

  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  write_xml(*writer, path);
  return notes;
}

}  // namespace hiac::formats::vtk
