#pragma once

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// MED, the files of Salome and code_aster: unstructured meshes of every version of the format with
/// their groups, and fields on nodes, cells, and cells' nodes (ELNO) at their steps. Reads through
/// HDF5: MED-fichier in Debian is built for parallel HDF5 and would bring MPI into the program.
///
/// The layout of the files, and the node orders of the elements: MED-fichier 4.1.0, "Modele de
/// donnees" and "Elements de reference".
Format med_format();

}  // namespace hiac::formats
