#pragma once

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// CGNS, in HDF5 and in ADF: structured and unstructured zones, sections of one kind and mixed,
/// solutions at points and cells, steps. Reads through the CGNS library's file layer (cgio), which
/// reads files of every version; the library's upper layer refuses files newer than itself.
///
/// The CFD General Notation System: Standard Interface Data Structures (AIAA R-101A, and
/// https://cgns.github.io), with the node orders in its section 3.3.
Format cgns_format();

}  // namespace hiac::formats
