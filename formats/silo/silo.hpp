#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Silo files (HDF5): unstructured meshes of the zoo's zones and of polyhedra, curvilinear and
/// rectilinear ones, multi-block meshes over several files, variables on nodes and zones.
Format silo_format();

}  // namespace hiac::formats
