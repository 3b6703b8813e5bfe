#pragma once

#include <array>

namespace hiac {

/// The part of a camera that decides a visibility order: the rays' origin or direction. World
/// units.
struct View {
  bool perspective = true;
  std::array<double, 3> eye{};        ///< perspective: all rays start here
  std::array<double, 3> direction{};  ///< orthographic: all rays run this way (any length > 0)
};

}  // namespace hiac
