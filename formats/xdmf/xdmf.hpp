#pragma once

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// XDMF 2 and 3: XML that describes meshes whose numbers are in the XML itself, in HDF5 files or in
/// raw binary files. Uniform grids, trees and spatial collections of them, and temporal
/// collections, in which the mesh may change. Reads through pugixml and HDF5.
///
/// https://www.xdmf.org/index.php/XDMF_Model_and_Format
Format xdmf_format();

}  // namespace hiac::formats
