#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace hiac::preview {

/// How light is computed from homogeneous regions (Williams, Max, Stein 1998, section 7).
enum class Method : std::uint8_t {
  interpolated_opacity,  ///< M0: alpha at the vertices, interpolated
  mean_color,            ///< M1: alpha = 1 - exp(-l tau_avg) at each pixel, mean of the colours
  tables,                ///< M2: M1's alpha; colour at the vertices from equation (8) with tables
  exact_at_vertices      ///< M3: the same with the functions of appendix B
};

/// "M0" to "M3"; none for other names.
constexpr std::optional<Method> method_of(std::string_view name) {
  if (name.size() != 2 || name[0] != 'M' || name[1] < '0' || name[1] > '3') return std::nullopt;
  return static_cast<Method>(name[1] - '0');
}

}  // namespace hiac::preview
