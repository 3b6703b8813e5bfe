#pragma once

#include "formats/foreign_mesh.hpp"
#include "formats/input_text.hpp"

namespace hiac::formats::ansys {

/// Reads a CDB archive: element types (ET, KEYOP), NBLOCK, EBLOCK,SOLID, CMBLOCK of elements;
/// nodes and elements told one by one (cdb_commands.hpp).
/// Throws InputError naming file and line.
ForeignMesh read_cdb(const InputText& text);

}  // namespace hiac::formats::ansys
