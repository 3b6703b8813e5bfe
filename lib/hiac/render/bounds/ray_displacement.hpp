#pragma once

#include <array>
#include <span>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/mesh/cell_kind.hpp"
#include "hiac/render/bounds/arithmetic.hpp"

namespace hiac {

/// What rounding does to where a ray meets a cell (the model is in error_bound.hpp).
/// Lengths in world units.
struct RayDisplacement {
  double aside = 0;    ///< how far from the ray the fields in the cell may be met
  double at_ends = 0;  ///< the same of where it is entered and left
  double along = 0;    ///< how far these may be along the ray besides
  double spread = 1;   ///< what the rounding of field values grows by
};

/// Of one cell, as it is drawn: tetrahedra over the screen, where their projected corners are;
/// others in the world, with what their map is off the cell's: edges that count as straight, faces
/// as planar and cells as affine, though they are not to the bit. Curved faces and maps are met as
/// they are, but for rounding.
RayDisplacement ray_displacement(const Frame& frame, CellId cell,
                                 const Arithmetic& numbers = kDoubles);

/// The same for what is found in the world in tetrahedra, too (face_value.hpp).
RayDisplacement displacement_in_world(const Frame& frame, CellId cell,
                                      const Arithmetic& numbers = kDoubles);

/// How much a displacement of the ray moves the ends of its part inside a convex cell: through
/// faces seen nearly edge-on, much. `Real`: double, or long double where displacements may be as
/// small as rounding of doubles.
template <class Real>
class BasicEndDoubts {
 public:
  using Vector = std::array<Real, 3>;

  /// `nodes`: positions of the kind's nodes, in their order; its corners count.
  BasicEndDoubts(CellKind kind, std::span<const Vector> nodes);
  BasicEndDoubts() = default;

  struct Doubts {
    double front, back;  ///< lengths, may be infinite
  };
  /// `origin`, `direction` (of any length): of the ray, in the frame of the corners.
  [[nodiscard]] Doubts at(const Vector& origin, const Vector& direction,
                          const RayDisplacement& moved) const;

  /// That of a place on one planar face, of a cell that need not be convex: how far along the ray.
  [[nodiscard]] double through(std::size_t face, const Vector& direction,
                               const RayDisplacement& moved) const;

 private:
  struct Plane {
    Vector normal;  // inwards, of length 1; 0 where the face has no area
    Vector point;
  };
  std::array<Plane, 6> planes_{};
  Real reach_ = 0;  // of the corners, from the frame's origin
  std::size_t count_ = 0;
};

using EndDoubts = BasicEndDoubts<double>;

}  // namespace hiac
