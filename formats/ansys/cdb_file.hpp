#pragma once

#include "formats/common/io/input_text.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::ansys {

/// Reads a CDB archive: element types (ET, KEYOP), NBLOCK, EBLOCK,SOLID, CMBLOCK of elements; nodes
/// and elements defined by single commands (cdb_commands.hpp). Throws InputError naming file and
/// line.
ForeignMesh read_cdb(const InputText& text);

}  // namespace hiac::formats::ansys
