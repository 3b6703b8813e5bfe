#pragma once

#include <cstddef>
#include <string>

#include "formats/common/mesh/foreign_mesh.hpp"
#include "formats/silo/silo_file.hpp"

namespace hiac::formats::silo {

/// One block of the mesh, for its variables.
struct Block {
  Place mesh;
  std::size_t first_point = 0;
  std::size_t points = 0;
  std::size_t first_cell = 0;
  std::size_t cells = 0;  ///< in the file, in its order
  bool structured = false;
};

/// Appends the mesh at that place, of zones or structured, to `mesh` as a block with that name. Its
/// ghost zones become cells without volume; a mesh that is not of three dimensions is left out,
/// with a note. Throws InputError naming the file and the mesh.
Block add_block(SiloFiles& files, const Place& place, const std::string& name, ForeignMesh& mesh);

}  // namespace hiac::formats::silo
