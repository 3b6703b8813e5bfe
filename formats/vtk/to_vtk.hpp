#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <vtkSmartPointer.h>

#include "hiac/mesh/zoo_mesh.hpp"

class vtkDataSet;
class vtkDoubleArray;
class vtkXMLWriter;

namespace hiac::formats::vtk {

/// Writes a mesh as .vtu, completely or not at all: every number as it is in memory, node and cell
/// fields, units, and metadata as data of the whole dataset. VTK has no cell for the wedges: they
/// are written as bricks with a repeated node, which read_vtu turns back into wedges. Returns notes
/// on that and on corner fields, which VTU cannot hold and which are left out. Throws InputError
/// naming the file for kinds that VTU cannot hold.
std::vector<std::string> write_vtu(const std::string& path, const ZooMesh& mesh);

/// A VTK array that refers to the values, which must outlive it.
vtkSmartPointer<vtkDoubleArray> array_of(std::span<const double> values, std::size_t components);

/// Adds a node or cell field to a dataset, which refers to its values. Throws InputError(path, ...)
/// if the dataset has one of that name in that place; `format` is its name in the message.
void add_field(const Field& field, std::string_view format, const std::string& path,
               vtkDataSet& dataset);

/// Writes what the writer's input is, completely or not at all. Throws InputError naming the file.
void write_xml(vtkXMLWriter& writer, const std::string& path);

}  // namespace hiac::formats::vtk
