#pragma once

#include <string>

#include <vtkSmartPointer.h>

#include "formats/common/mesh/format.hpp"

class vtkDataSet;

namespace hiac::formats::vtk {

/// Converts a VTK dataset (unstructured, structured, rectilinear grid or image) to a zoo mesh and
/// empties it on the way, so that the two are never both complete in memory. Points that no
/// converted cell uses are dropped with a note. Checks coordinates, node order and the mesh's
/// invariants. The mesh may be empty: see finish_reading (gate.hpp). Throws InputError(subject,
/// ...).
Reading mesh_from_vtk(const vtkSmartPointer<vtkDataSet>& dataset, const ReadOptions& options,
                      const std::string& subject);

/// The inventory of a dataset.
Inventory inventory_from_vtk(vtkDataSet& dataset, const std::string& subject);

/// Refuses a time, step or block that the dataset does not have. Throws UsageError.
void check_step(const ReadOptions& options, const std::vector<double>& times,
                const std::string& subject);

}  // namespace hiac::formats::vtk
