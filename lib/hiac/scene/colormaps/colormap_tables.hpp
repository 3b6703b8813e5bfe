#pragma once

#include <span>
#include <string_view>

namespace hiac {

/// A published table of equally spaced colours.
struct ColormapTable {
  std::string_view name;
  /// Twelve hexadecimal digits a colour: red, green, blue, each 0 to ffff, sRGB-encoded.
  std::string_view colors;
};

std::span<const ColormapTable> colormap_tables();

}  // namespace hiac
