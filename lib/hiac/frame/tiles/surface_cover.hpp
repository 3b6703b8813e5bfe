#pragma once

#include <cstddef>

namespace hiac {

/// A tile (DrawnTile) that tells skin and edges from the medium.
class SurfaceCover {
 public:
  SurfaceCover() = default;
  SurfaceCover(const SurfaceCover&) = delete;
  SurfaceCover& operator=(const SurfaceCover&) = delete;
  virtual ~SurfaceCover() = default;

  /// The transparency of the skin and the edges alone in a pixel, given by its index in the planes:
  /// the pixel's transparency divided by it is that of the medium and the isosurfaces.
  [[nodiscard]] virtual double surface_transparency(std::size_t at) const = 0;
};

}  // namespace hiac
