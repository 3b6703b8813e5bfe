#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/geometry/extended_vector.hpp"
#include "hiac/geometry/inverse_map.hpp"
#include "hiac/optics/bernstein.hpp"
#include "hiac/render/refine/extended_ray.hpp"

namespace hiac {

/// A linear cell with planar faces, and fields in it along rays, in extended precision: as CellMap
/// and FieldAlongRay have them, with the map of its corners as they are, affine or not.
class ExtendedCell {
 public:
  using Real = long double;
  static constexpr std::size_t kMostCorners = 8;
  using Values = std::array<Real, kMostCorners>;

  ExtendedCell(const Frame& frame, CellId cell);

  /// Corners in the camera's frame.
  [[nodiscard]] std::span<const ExtendedVector> corners() const {
    return {corners_.data(), count_};
  }
  /// The largest distance of a corner from the camera's origin, and between two from the first.
  [[nodiscard]] double reach() const { return reach_; }
  [[nodiscard]] double size() const { return size_; }

  /// The part of a ray that is inside all faces, and by which it enters and leaves: planes through
  /// the middle of their corners along their diagonals, of both cells of a face the same to the
  /// bit. Nothing is inside where front > back.
  struct Part {
    Real front, back;
    std::uint8_t front_face, back_face;
  };
  [[nodiscard]] Part inside(const ExtendedRay& ray) const;
  /// How far the corners of the faces are off these planes, at most.
  [[nodiscard]] double bent() const;

  struct Field {
    Values values;
    Real least, most;
    Real negligible;  ///< what interpolation may leave out of it
  };
  static constexpr std::size_t kMostFields = 2;
  /// Fields on a part of a stretch, from `begin` to `end` in [0, 1].
  struct Piece {
    Real begin, end;
    std::array<ExtendedBernstein, kMostFields> fields;
  };
  /// Replaces `pieces` by those between two places of a ray, interpolated as in FieldAlongRay.
  /// False where the map's inverse was not found to rounding.
  bool along(const ExtendedRay& ray, Real front, Real back, std::span<const Field> fields,
             std::vector<Piece>& pieces) const;

  /// The Jacobian's columns and a field's derivatives in reference coordinates at a point; false
  /// as above.
  struct Derivatives {
    std::array<ExtendedVector, 3> columns;
    ExtendedVector gradient;
  };
  bool derivatives(const ExtendedVector& point, const Values& values, Derivatives& d) const;

 private:
  bool newton(const ExtendedVector& point, ExtendedVector& xi) const;
  bool interpolate(const ExtendedRay& ray, Real front, Real back, Real begin, Real end,
                   int bisections, std::span<const Field> fields, std::vector<Piece>& pieces) const;

  CellKind kind_;
  std::size_t count_;
  std::array<NodeId, kMostCorners> nodes_{};
  std::array<ExtendedVector, kMostCorners> corners_{}, edges_{};  // edges_: from corner 0
  std::optional<CellMap> rough_map_;
  ExtendedVector middle_{};  // reference coordinates
  double reach_ = 0, size_ = 0;
};

}  // namespace hiac
