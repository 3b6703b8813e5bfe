#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// "node", "cell" or "corner".
constexpr std::string_view location_name(FieldLocation location) {
  constexpr std::array<std::string_view, 3> kNames{"node", "cell", "corner"};
  return kNames[static_cast<std::size_t>(location)];
}

}  // namespace hiac
