#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "hiac/mesh/cell_kind.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {

/// Returns how far the nodes between a cell's corners are from their places on straight edges: the
/// largest coordinate difference, divided by the largest coordinate difference between the first
/// corner and another. 0 for linear kinds. `nodes`: positions of the kind's nodes.
double edge_deviation(CellKind kind, std::span<const std::array<double, 3>> nodes);

/// The isoparametric map of one cell, x(xi) = sum N_i(xi) x_i, and its inverse.
///
/// Reference coordinates and shape functions are those of shape_functions.hpp. A cell with straight
/// edges has the map of its corners, whatever its order. If it is convex (in either orientation)
/// with planar faces, its map is one to one, and the inverse is found to within rounding at every
/// point of the cell and close to it. For other cells whose Jacobian keeps its sign, the inverse is
/// found where continuation from the guess can follow it.
class CellMap {
 public:
  using Point = std::array<double, 3>;
  static constexpr std::size_t kMostNodes = kMaxNodesPerCell;

  /// `nodes`: positions of the kind's nodes, in their order. The edges are treated as straight if
  /// edge_deviation is at most `straightness`.
  CellMap(CellKind kind, std::span<const Point> nodes, double straightness = 1e-14);

  /// Returns whether the edges are straight.
  [[nodiscard]] bool straight() const { return order_of(kind_) == CellOrder::linear; }

  /// Returns whether the cell is an affine image of the reference cell to within rounding: no
  /// corner is off by more than 1e-14 of the cell's size plus four epsilon of the largest
  /// coordinate.
  [[nodiscard]] bool affine() const { return affine_; }

  /// The largest coordinate difference between a corner and its place under the affine map; 0 if
  /// the map is not treated as affine.
  [[nodiscard]] double off_affine() const { return off_affine_; }

  /// Bounds, in world units, how far treating the edges as straight moves the map: four times the
  /// largest deviation of a node, as the shape functions of edge nodes add up to at most four.
  [[nodiscard]] double straightened() const { return straightened_; }

  /// x(xi).
  [[nodiscard]] Point position(const Point& xi) const;

  /// Returns the xi with x(xi) = point. An affine map is inverted as a matrix. Any other map is
  /// inverted by Newton's iteration from `guess` or, where that does not converge to the cell, by
  /// continuation: Newton follows the straight line from the guess's point to the given one, in
  /// steps as short as necessary; if that fails, it follows the line from the cell's middle. In a
  /// convex cell both lines lie inside; in other cells the first does when the guess is a nearby
  /// point of the same ray.
  [[nodiscard]] Point reference(const Point& point, const Point& guess) const;

  /// A reference point well inside the cell, for a first guess.
  [[nodiscard]] const Point& middle() const { return middle_; }

  /// The rows of the inverse of the Jacobian in the cell's middle; in an affine map, of the
  /// Jacobian everywhere.
  [[nodiscard]] const std::array<Point, 3>& inverse_in_middle() const { return inverse_; }

  /// The largest change of reference coordinates per unit of length in the cell's middle: the
  /// factor from an error of a point to the error of its reference coordinates.
  [[nodiscard]] double steepness() const { return steepness_; }

 private:
  /// The three columns of the map's Jacobian.
  struct Jacobian {
    Point x, y, z;
  };

  /// `deviation` is the edges' (edge_deviation).
  CellMap(CellKind kind, std::span<const Point> nodes, double deviation, double straightness);

  void set_terms();
  void evaluate(const Point& xi, Point& position, Jacobian& jacobian) const;
  void evaluate_curved(const Point& xi, Point& position, Jacobian& jacobian) const;
  bool newton(const Point& point, Point& xi) const;
  bool follow(const Point& point, Point& xi) const;

  CellKind kind_;  // the kind whose shape functions define the map
  std::size_t count_;
  std::array<Point, kMostNodes> nodes_{};  // relative to corner 0
  // with straight edges the map is linear_ xi + sum mixed_ phi(xi), where phi are the products of
  // coordinates in the shape functions
  Jacobian linear_{};
  std::array<Point, 4> mixed_{};
  Point origin_{};  // corner 0
  Point middle_{};
  double size_ = 0;  // largest coordinate difference from corner 0
  double steepness_ = 0, straightened_ = 0, off_affine_ = 0;
  bool affine_ = false;
  std::array<Point, 3> inverse_{};  // rows of the inverse of the Jacobian, in the middle
};

}  // namespace hiac
