#pragma once

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// An OpenFOAM case, named by a .foam file in its folder or by its system/controlDict: the mesh of
/// constant/polyMesh, whose cells are lists of faces and are read as hexahedra, prisms, pyramids,
/// tetrahedra and wedges (others are refused as polyhedra), and the fields on cells and points of
/// every time folder. ASCII and binary (32 and 64 bit labels and scalars), packed by gzip or not.
/// The parts of a decomposed case (processor0 ...) are joined if the case has no mesh of its own or
/// if they have later times.
///
/// OpenFOAM User Guide, section 4.1 "Mesh description" and 4.2 "File format".
Format openfoam_format();

}  // namespace hiac::formats
