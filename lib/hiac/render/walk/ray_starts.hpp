#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/render/walk/ray_scene.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// Where the ray of a pixel passes a face without a neighbour.
struct BoundaryHit {
  std::uint32_t face;  ///< its index into WalkableMesh::boundary
  double depth;        ///< ProjectedNode
};

/// The places where the rays of a picture enter and leave a mesh: as many of one as of the other.
class RayStarts {
 public:
  /// Of a picture of this size, that of the scene's projector. In parallel; the result does not
  /// depend on the number of threads.
  RayStarts(const RayScene& scene, ImageSize size);

  /// Of one pixel, by depth.
  [[nodiscard]] std::span<const BoundaryHit> of(int x, int y) const {
    const std::size_t pixel = static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
    return std::span(hits_).subspan(first_[pixel], first_[pixel + 1] - first_[pixel]);
  }

 private:
  std::size_t width_;
  std::vector<std::uint32_t> first_;  // of each pixel, row by row; one more entry
  std::vector<BoundaryHit> hits_;
};

}  // namespace hiac
