#pragma once

#include <string_view>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Returns the field with exactly this name, with its location (NAME@node, NAME@cell, NAME@corner)
/// or without; null if there is none. Throws UsageError if there are several.
const Field* find_field(const ZooMesh& mesh, std::string_view name);

}  // namespace hiac
