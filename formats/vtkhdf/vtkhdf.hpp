#pragma once

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// VTKHDF: unstructured grids and images in HDF5 files, in parts and at several steps, where the
/// grid may change from step to step. Reads through HDF5.
///
/// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html#vtkhdf-file-format
Format vtkhdf_format();

}  // namespace hiac::formats
