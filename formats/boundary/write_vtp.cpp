#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt64Array.h>
#include <vtkXMLPolyDataWriter.h>

#include "formats/boundary/write_boundary.hpp"
#include "formats/vtk/to_vtk.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

void set_polygons(const BoundarySurface& surface, vtkPolyData& data) {
  vtkNew<vtkTypeInt64Array> offsets;
  vtkNew<vtkTypeInt64Array> connectivity;
  const auto count = static_cast<vtkIdType>(surface.triangles.size());
  offsets->SetNumberOfValues(count + 1);
  connectivity->SetNumberOfValues(3 * count);
  for (vtkIdType t = 0; t < count; ++t) {
    offsets->SetValue(t, 3 * t);
    for (vtkIdType k = 0; k < 3; ++k)
      connectivity->SetValue(
          3 * t + k, surface.triangles[static_cast<std::size_t>(t)][static_cast<std::size_t>(k)]);
  }
  offsets->SetValue(count, 3 * count);
  vtkNew<vtkCellArray> polygons;
  polygons->SetData(offsets, connectivity);
  data.SetPolys(polygons);
}

}  // namespace

std::vector<std::string> write_vtp(const std::string& path, const BoundarySurface& surface) {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetData(vtk::array_of(surface.xyz, 3));
  data->SetPoints(points);
  set_polygons(surface, *data);
  for (const Field& field : surface.fields) vtk::add_field(field, "VTP", path, *data);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  vtk::write_xml(*writer, path);
  return {};
}

}  // namespace hiac::formats
