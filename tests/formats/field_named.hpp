#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats {

/// The field of that name. Throws std::runtime_error where there is none.
inline const Field& field_named(const ZooMesh& mesh, const std::string& name) {
  const auto found = std::find_if(mesh.fields.begin(), mesh.fields.end(),
                                  [&](const Field& field) { return field.name == name; });
  if (found == mesh.fields.end()) throw std::runtime_error("no field " + name);
  return *found;
}

}  // namespace hiac::formats
