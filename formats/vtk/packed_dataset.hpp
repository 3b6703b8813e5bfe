#pragma once

#include <vtkSmartPointer.h>

class vtkDataSet;

namespace hiac {
class PackedAnswer;
class PackReader;
class PackWriter;
}  // namespace hiac

namespace hiac::formats::vtk {

/// Packs an unstructured, structured or rectilinear grid or an image: its points, cells, and the
/// arrays of its points, its cells and of the whole dataset with their names and units. Empties the
/// dataset on the way, so that the two are never both complete in memory.
void pack_dataset(PackWriter& out, vtkDataSet& dataset);

/// The dataset. Its large arrays lie where the other process wrote them. What is not plausible, as
/// extents that do not fit the points, is an InputError; what the arrays hold is not checked.
vtkSmartPointer<vtkDataSet> unpack_dataset(PackReader& in, PackedAnswer& answer);

}  // namespace hiac::formats::vtk
