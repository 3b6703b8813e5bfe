#pragma once

#include <array>
#include <span>

#include "hiac/frame/surfaces/isosurfaces.hpp"
#include "hiac/frame/transfer_table.hpp"

namespace hiac {

/// Light and transparency of a part of a ray, in extended precision.
struct ExtendedLight {
  std::array<long double, 3> rgb{};
  long double transparency = 1;
  long double seen = 0;  ///< for volumes: integral of the transparency along the part

  /// Adds another part behind this one.
  void add_behind(const ExtendedLight& other);
};

/// The values of a linear scalar at the two ends of a part of a ray.
struct ExtendedEnds {
  long double front, back;

  [[nodiscard]] long double at(long double u) const {
    return u >= 1 ? back : front + u * (back - front);
  }
};

/// The volume's light along a part of a ray of the given length (world units) on which the fields
/// of colour and extinction are linear, by exact integration.
ExtendedLight extended_volume(const OpticsTables& optics, long double length,
                              const ExtendedEnds& color, const ExtendedEnds& extinction);

/// An isosurface's light by the formula of isosurface_shading.hpp, which isosurface_shading-inl.hpp
/// vectorizes. The vector code fuses operations and has its own powers and exponentials; shared
/// code would change the rounding of one of the two. `normal`, `ray`: unit vectors, camera frame.
ExtendedLight extended_surface(const FrameIsosurface& surface, std::span<const FrameLight> lights,
                               const std::array<long double, 3>& normal,
                               const std::array<long double, 3>& ray);

}  // namespace hiac
