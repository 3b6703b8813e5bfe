#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace hiac {

/// Converts the values of polynomials over a simplex, or a product of simplices, at evenly spaced
/// points into Bernstein coefficients. The polynomial lies between the least and the largest
/// coefficient; at a corner it equals the corner's coefficient.
class BernsteinDomain {
 public:
  /// One factor: a simplex of 1, 2 or 3 dimensions (a line, a triangle, a tetrahedron) with the
  /// degree of the polynomial in it.
  struct Factor {
    std::size_t dimensions, degree;
  };

  /// The factors have at most three dimensions in all.
  explicit BernsteinDomain(std::span<const Factor> factors);

  /// The points at which values are needed, in coordinates of the unit simplices, factor by factor.
  [[nodiscard]] std::span<const std::array<double, 3>> points() const { return points_; }
  [[nodiscard]] std::size_t size() const { return points_.size(); }

  /// Replaces the values at points() by the coefficients.
  void to_coefficients(std::span<double> values) const;

  /// Bounds a coefficient's rounding error, relative to the largest rounding error of a value.
  [[nodiscard]] double condition() const { return condition_; }

 private:
  struct Block {
    std::size_t size;             // number of points
    std::vector<double> inverse;  // row i gives coefficient i from the values
  };

  std::vector<Block> blocks_;
  std::vector<std::array<double, 3>> points_;
  double condition_ = 1;
};

}  // namespace hiac
