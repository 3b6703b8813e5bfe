#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// The isoparametric map of one linear cell, x(xi) = sum N_i(xi) x_i, and its inverse.
///
/// Reference coordinates and shape functions are those of shape_functions.hpp. The cell is convex
/// (either orientation) with planar faces; then the map is one to one and the inverse is found to
/// rounding at every point of the cell and close to it.
class CellMap {
 public:
  using Point = std::array<double, 3>;
  static constexpr std::size_t kMostCorners = 8;

  /// `corners`: positions of the kind's corner_count(kind) nodes, in their order.
  CellMap(CellKind kind, std::span<const Point> corners);

  /// Whether the cell is an affine image of the reference cell to within rounding: no corner is
  /// off by more than 1e-14 of the cell's size.
  [[nodiscard]] bool affine() const { return affine_; }

  /// x(xi).
  [[nodiscard]] Point position(const Point& xi) const;

  /// The xi with x(xi) = point. An affine map is inverted as a matrix. Any other by Newton's
  /// iteration from `guess`, or where that does not converge to the cell by continuation: the
  /// straight line from the cell's middle to the point lies inside the cell, and Newton follows it
  /// in steps as short as it needs.
  [[nodiscard]] Point reference(const Point& point, const Point& guess) const;

  /// A reference point well inside the cell, for a first guess.
  [[nodiscard]] const Point& middle() const { return middle_; }

  /// How much reference coordinates change per unit of length in the cell's middle, at most:
  /// what an error of a point does to its reference coordinates.
  [[nodiscard]] double steepness() const { return steepness_; }

 private:
  /// The three columns of the map's Jacobian.
  struct Jacobian {
    Point x, y, z;
  };

  void set_terms();
  void evaluate(const Point& xi, Point& position, Jacobian& jacobian) const;
  bool newton(const Point& point, Point& xi) const;
  [[nodiscard]] Point continued(const Point& point) const;

  CellKind kind_;
  std::size_t count_;
  std::array<Point, kMostCorners> corners_{};  // relative to corner 0
  // the map is linear_ xi + sum mixed_ phi(xi): what the shape functions are made of
  Jacobian linear_{};
  std::array<Point, 4> mixed_{};
  Point origin_{};  // corner 0
  Point middle_{};
  double size_ = 0;  // largest coordinate difference from corner 0
  double steepness_ = 0;
  bool affine_ = false;
  std::array<Point, 3> inverse_{};  // rows of the inverse of the Jacobian, in the middle
};

}  // namespace hiac
