#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "hiac/mesh/cell_kind.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {

/// How far the nodes between a cell's corners are from where straight edges have them: the largest
/// coordinate difference, relative to the cell's (from its first corner). 0 for linear kinds.
/// `nodes`: positions of the kind's nodes.
double edge_deviation(CellKind kind, std::span<const std::array<double, 3>> nodes);

/// The isoparametric map of one cell, x(xi) = sum N_i(xi) x_i, and its inverse.
///
/// Reference coordinates and shape functions are those of shape_functions.hpp. A cell with straight
/// edges has the map of its corners, whatever its order. Where it is convex (either orientation)
/// with planar faces, its map is one to one and the inverse is found to rounding at every point of
/// the cell and close to it. Of other cells, whose Jacobian keeps its sign, it is found where
/// continuation from the guess can follow it.
class CellMap {
 public:
  using Point = std::array<double, 3>;
  static constexpr std::size_t kMostNodes = kMaxNodesPerCell;

  /// `nodes`: positions of the kind's nodes, in their order. Edges whose edge_deviation is not
  /// above `straightness` are taken as straight.
  CellMap(CellKind kind, std::span<const Point> nodes, double straightness = 1e-14);

  /// Whether edges are straight.
  [[nodiscard]] bool straight() const { return order_of(kind_) == CellOrder::linear; }

  /// Whether the cell is an affine image of the reference cell to within rounding: no corner is
  /// off by more than 1e-14 of the cell's size and four epsilon of the largest coordinate.
  [[nodiscard]] bool affine() const { return affine_; }

  /// How far corners are off the affine map where that is taken: the largest coordinate
  /// difference.
  [[nodiscard]] double off_affine() const { return off_affine_; }

  /// How far edges taken as straight may take the map from that of all nodes, in world units: four
  /// times what a node is off, as the shape functions of edges add up to at most that.
  [[nodiscard]] double straightened() const { return straightened_; }

  /// x(xi).
  [[nodiscard]] Point position(const Point& xi) const;

  /// The xi with x(xi) = point. An affine map is inverted as a matrix. Any other by Newton's
  /// iteration from `guess`, or where that does not converge to the cell by continuation: Newton
  /// follows the straight line from the guess's point to the given one, in steps as short as it
  /// needs, or where it gets lost the line from the cell's middle. In a convex cell both lie
  /// inside; in others the first does when the guess is a point of the same ray close by.
  [[nodiscard]] Point reference(const Point& point, const Point& guess) const;

  /// A reference point well inside the cell, for a first guess.
  [[nodiscard]] const Point& middle() const { return middle_; }

  /// Rows of the inverse of the Jacobian in the cell's middle: where the map is affine, of it all.
  [[nodiscard]] const std::array<Point, 3>& inverse_in_middle() const { return inverse_; }

  /// How much reference coordinates change per unit of length in the cell's middle, at most:
  /// what an error of a point does to its reference coordinates.
  [[nodiscard]] double steepness() const { return steepness_; }

 private:
  /// The three columns of the map's Jacobian.
  struct Jacobian {
    Point x, y, z;
  };

  /// `deviation`: of the edges.
  CellMap(CellKind kind, std::span<const Point> nodes, double deviation, double straightness);

  void set_terms();
  void evaluate(const Point& xi, Point& position, Jacobian& jacobian) const;
  void evaluate_curved(const Point& xi, Point& position, Jacobian& jacobian) const;
  bool newton(const Point& point, Point& xi) const;
  bool follow(const Point& point, Point& xi) const;

  CellKind kind_;  // whose shape functions make the map
  std::size_t count_;
  std::array<Point, kMostNodes> nodes_{};  // relative to corner 0
  // with straight edges the map is linear_ xi + sum mixed_ phi(xi): what the shape functions are
  // made of
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
