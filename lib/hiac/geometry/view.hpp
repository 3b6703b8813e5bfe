#pragma once

#include <array>

namespace hiac {

/// What a visibility order depends on: where rays come from. World units.
struct View {
  bool perspective = true;
  std::array<double, 3> eye{};        ///< perspective: all rays start here
  std::array<double, 3> direction{};  ///< orthographic: all rays run this way (any length > 0)
};

}  // namespace hiac
