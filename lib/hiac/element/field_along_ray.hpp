#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "hiac/element/cell_field.hpp"
#include "hiac/optics/bernstein.hpp"

namespace hiac {

/// A stretch of the ray origin + t direction, from t = front to t = back.
struct RayStretch {
  std::array<double, 3> origin, direction;
  double front, back;
  /// Reference coordinates of a point of the ray in the cell, if known; otherwise NaN.
  CellMap::Point known{std::numeric_limits<double>::quiet_NaN()};

  /// The start for finding those of other points: `known`, or the cell's middle.
  [[nodiscard]] const CellMap::Point& guess(const CellMap& map) const {
    return std::isnan(known[0]) ? map.middle() : known;
  }

  [[nodiscard]] std::array<double, 3> at(double t) const {
    return {origin[0] + t * direction[0], origin[1] + t * direction[1],
            origin[2] + t * direction[2]};
  }
};

/// The degree of a kind's shape functions along lines through the reference cell; 0 if they are not
/// polynomials (pyramids, wedges).
std::size_t degree_along_lines(CellKind kind);

/// The isoparametric interpolants of up to two fields along a ray through a cell, as polynomials.
class FieldAlongRay {
 public:
  static constexpr std::size_t kMostFields = 2;
  using Polynomials = std::array<BernsteinPolynomial, kMostFields>;

  /// A part of the stretch, from `begin` to `end` in [0, 1], and the fields on it, each as a
  /// polynomial on [0, 1].
  struct Piece {
    double begin, end;
    Polynomials fields;
  };

  /// `fields`: one or two.
  FieldAlongRay(CellKind kind, const CellMap& map, std::span<const CellField> fields);

  /// Replaces `pieces` by those of a stretch inside the cell, front to back.
  ///
  /// Fields that are polynomials in the world (CellField::polynomial) are polynomials along the
  /// ray.
  ///
  /// Where the map is affine the fields of tetrahedra (degree 1, 2, 3 by order), prisms (2, 3, 4)
  /// and bricks (3, 4, 5) are polynomials and treated as such. Otherwise, and in pyramids and
  /// wedges, whose shape functions are rational, they are analytic. They are interpolated at more
  /// and more Chebyshev points until the last coefficients are below the allowed error or below
  /// rounding, and on halves of the stretch if too many points would be needed (L. N. Trefethen,
  /// "Approximation Theory and Approximation Practice", 2013, chapters 3 and 8).
  void along(const RayStretch& stretch, std::vector<Piece>& pieces) const;

  /// The rounding error of a field's values on a stretch: that of the ray's points, propagated
  /// through the field, and that of the field itself.
  [[nodiscard]] double rounding(const RayStretch& stretch, const CellField& field) const;

 private:
  struct Samples;
  void evaluate(const CellMap::Point& xi, std::span<double, kMostFields> values) const;
  [[nodiscard]] Piece exact(const RayStretch& stretch) const;
  void evaluate_in_world(const CellMap::Point& point, std::span<double, kMostFields> values) const;
  void sample(const RayStretch& stretch, double begin, double end, std::size_t stride,
              Samples& samples) const;
  void interpolate(const RayStretch& stretch, double begin, double end, int bisections,
                   std::vector<Piece>& pieces) const;
  CellKind kind_;
  const CellMap& map_;
  std::span<const CellField> fields_;
  bool in_world_;             // a field is a polynomial in the world
  std::size_t exact_degree_;  // 0: not a polynomial
};

}  // namespace hiac
