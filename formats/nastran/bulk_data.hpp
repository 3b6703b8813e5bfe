#pragma once

#include <string>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::nastran {

/// Reads the bulk data of a deck and of the files that it includes. Throws InputError naming file
/// and line.
ForeignMesh read_bulk_data(const std::string& path);

}  // namespace hiac::formats::nastran
