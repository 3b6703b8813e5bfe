#pragma once

#include <array>
#include <span>

#include "hiac/frame/isosurfaces.hpp"
#include "hiac/frame/transfer_table.hpp"

namespace hiac {

/// Light of a part of a ray and what it lets through, in extended precision.
struct ExtendedLight {
  std::array<long double, 3> rgb{};
  long double transparency = 1;
  long double seen = 0;  ///< integral of the transparency along the part, of volumes

  /// Puts another behind it.
  void add_behind(const ExtendedLight& other);
};

/// What a linear scalar is at the two ends of a part of a ray.
struct ExtendedEnds {
  long double front, back;

  [[nodiscard]] long double at(long double u) const {
    return u >= 1 ? back : front + u * (back - front);
  }
};

/// The volume's light along a part of a ray of some length on which the fields of colour and
/// extinction are linear, by exact integration.
ExtendedLight extended_volume(const OpticsTables& optics, long double length,
                              const ExtendedEnds& color, const ExtendedEnds& extinction);

/// An isosurface's light: the formula of isosurface_shading.hpp, which isosurface_shading-inl.hpp
/// has in vectors. Those fuse operations and have powers and exponentials of their own; a common
/// text would round one of the two otherwise. `normal`, `ray`: unit vectors, camera frame.
ExtendedLight extended_surface(const FrameIsosurface& surface, std::span<const FrameLight> lights,
                               const std::array<long double, 3>& normal,
                               const std::array<long double, 3>& ray);

}  // namespace hiac
