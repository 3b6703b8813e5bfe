#pragma once

#include <array>
#include <span>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/mesh/cell_kind.hpp"
#include "hiac/render/bounds/arithmetic.hpp"

namespace hiac {

/// How far rounding displaces a ray in a cell (the model is in error_bound.hpp). Lengths in world
/// units.
struct RayDisplacement {
  double aside = 0;    ///< how far from the ray the fields in the cell may be evaluated
  double at_ends = 0;  ///< the same for the points of entry and exit
  double along = 0;    ///< how far these points may be off along the ray
  double spread = 1;   ///< the factor by which rounding of field values grows
};

/// The displacement in one cell as it is drawn: tetrahedra on the screen, from their projected
/// corners; others in the world, including the deviation of edges that count as straight, faces
/// that count as planar and cells that count as affine without being so to the bit. Curved faces
/// and maps contribute rounding alone.
RayDisplacement ray_displacement(const Frame& frame, CellId cell,
                                 const Arithmetic& numbers = kDoubles);

/// The same for points that are found in the world, in tetrahedra too (face_value.hpp).
RayDisplacement displacement_in_world(const Frame& frame, CellId cell,
                                      const Arithmetic& numbers = kDoubles);

/// How far a displacement of the ray moves the ends of its part inside a convex cell; far, if the
/// ray passes through a face seen nearly edge-on. `Real`: double, or long double where
/// displacements may be as small as rounding of doubles.
template <class Real>
class BasicEndDoubts {
 public:
  using Vector = std::array<Real, 3>;

  /// `nodes`: positions of the kind's nodes, in their order; only the corners are used.
  BasicEndDoubts(CellKind kind, std::span<const Vector> nodes);
  BasicEndDoubts() = default;

  struct Doubts {
    double front, back;  ///< lengths, may be infinite
  };
  /// The doubts about both ends of a ray's part inside the cell. `origin`, `direction` (of any
  /// length): those of the ray, in the frame of the corners.
  [[nodiscard]] Doubts at(const Vector& origin, const Vector& direction,
                          const RayDisplacement& moved) const;

  /// The doubt, along the ray, about a point on one planar face of a cell that need not be convex.
  [[nodiscard]] double through(std::size_t face, const Vector& direction,
                               const RayDisplacement& moved) const;

 private:
  struct Plane {
    Vector normal;  // inwards, of length 1; 0 where the face has no area
    Vector point;
  };
  std::array<Plane, 6> planes_{};
  Real reach_ = 0;  // largest distance of a corner from the frame's origin
  std::size_t count_ = 0;
};

using EndDoubts = BasicEndDoubts<double>;

}  // namespace hiac
