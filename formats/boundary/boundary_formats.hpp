#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

// Surfaces of triangles: the boundary of a mesh is written to them, nothing is read.
Format stl_format();  ///< .stl, binary: single precision, no fields
Format ply_format();  ///< .ply, binary: fields as properties of vertices and faces
Format vtp_format();  ///< .vtp: VTK's polygons, with fields on points and cells

}  // namespace hiac::formats
