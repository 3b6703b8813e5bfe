#pragma once

#include <array>
#include <span>
#include <vector>

#include "hiac/mesh/cell_kind.hpp"
#include "hiac/render/frame.hpp"

namespace hiac {

/// What rounding does to where a ray meets a cell (the model is in error_bound.hpp).
struct RayDisplacement {
  double aside = 0;   ///< how far from its ray a cell may be met, world units
  double spread = 1;  ///< of depths in the cell: the farthest by the nearest
};

/// Of one cell with straight edges: of its corners' projection, and of what its map is off the
/// cell's: edges that count as straight, faces as planar and cells as affine, though they are not
/// to the bit.
RayDisplacement ray_displacement(const Frame& frame, CellId cell);

/// How much a displacement of the ray moves the ends of its part inside a convex cell: through
/// faces seen nearly edge-on, much.
class EndDoubts {
 public:
  /// `nodes`: positions of the kind's nodes, in their order; its corners count.
  EndDoubts(CellKind kind, std::span<const std::array<double, 3>> nodes);
  EndDoubts() = default;

  struct Doubts {
    double front, back;  ///< lengths, may be infinite
  };
  /// `origin`, `direction` (of any length): of the ray, in the frame of the corners.
  [[nodiscard]] Doubts at(const std::array<double, 3>& origin,
                          const std::array<double, 3>& direction, double aside) const;

 private:
  struct Plane {
    std::array<double, 3> normal;  // inwards, of length 1; 0 where the face has no area
    std::array<double, 3> point;
  };
  std::array<Plane, 6> planes_{};
  std::size_t count_ = 0;
};

}  // namespace hiac
