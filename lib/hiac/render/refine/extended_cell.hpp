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

/// A linear cell with planar faces, and fields in it along rays, in extended precision: the
/// counterpart of CellMap and FieldAlongRay. The map is that of the exact corners, affine or not.
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
  /// The largest distance of a corner from the camera's origin.
  [[nodiscard]] double reach() const { return reach_; }
  [[nodiscard]] double size() const { return size_; }

  /// The part of a ray inside all faces, and the faces by which it enters and leaves. Faces are
  /// represented by planes through the mean of their corners, parallel to their diagonals, which
  /// are the same to the bit for both cells of a face. The part is empty if front > back.
  struct Part {
    Real front, back;
    std::uint8_t front_face, back_face;
  };
  [[nodiscard]] Part inside(const ExtendedRay& ray) const;
  /// The largest distance of a face's corner from its plane.
  [[nodiscard]] double bent() const;

  struct Field {
    Values values;
    Real least, most;
    Real negligible;  ///< the error allowed for its interpolation
  };
  static constexpr std::size_t kMostFields = 2;
  /// Fields on a part of a stretch, from `begin` to `end` in [0, 1].
  struct Piece {
    Real begin, end;
    std::array<ExtendedBernstein, kMostFields> fields;
  };
  /// Replaces `pieces` by those between two points of a ray, interpolated as in FieldAlongRay.
  /// Returns false if the map's inverse was not found to rounding.
  bool along(const ExtendedRay& ray, Real front, Real back, std::span<const Field> fields,
             std::vector<Piece>& pieces) const;

  /// Computes the Jacobian's columns and a field's derivatives in reference coordinates at a point.
  /// Returns false if the map's inverse was not found to rounding.
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
