#include "hiac/geometry/inverse_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

using Point = CellMap::Point;
using Matrix = std::array<Point, 3>;  // rows

// A corner this much of the cell's size off the affine map changes a field by as little as
// rounding does.
constexpr double kAffineDeviation = 1e-14;
// Newton converges quadratically: after a step this short the next would be below rounding.
constexpr double kLastStep = 1e-9;
constexpr int kMostIterations = 12;
// Residuals this much of the cell's size are rounding of the map itself.
constexpr double kResidualRounding = 16 * std::numeric_limits<double>::epsilon();
constexpr double kShortestContinuation = 0x1p-30;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double largest(const Point& a) {
  return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

// The inverse of the matrix with these columns, as rows.
Matrix inverse_of_columns(const Point& a, const Point& b, const Point& c) {
  const Point bc = cross(b, c);
  const double scale = 1 / dot(a, bc);
  return {scale * bc, scale * cross(c, a), scale * cross(a, b)};
}

Point apply(const Matrix& rows, const Point& v) {
  return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
}

// The corners that lie on the reference cell's x, y and z axis.
std::array<std::size_t, 3> axis_corners(CellShape shape) {
  switch (shape) {
    case CellShape::tetrahedron:
      return {1, 2, 3};
    case CellShape::prism:
      return {2, 1, 3};
    case CellShape::pyramid:
    case CellShape::wedge:
    case CellShape::brick:
      break;
  }
  return {1, 3, 4};
}

}  // namespace

CellMap::CellMap(CellKind kind, std::span<const Point> corners)
    : kind_(kind_of(shape_of(kind), CellOrder::linear)),
      count_(corner_count(kind)),
      origin_(corners[0]) {
  const auto nodes = reference_nodes(kind_);
  for (std::size_t k = 0; k < count_; ++k) {
    corners_[k] = corners[k] - origin_;
    size_ = std::max(size_, largest(corners_[k]));
    middle_ = middle_ + (1.0 / static_cast<double>(count_)) * nodes[k];
  }
  Matrix column;
  const auto axis = axis_corners(shape_of(kind_));
  for (std::size_t a = 0; a < 3; ++a) column[a] = (1 / nodes[axis[a]][a]) * corners_[axis[a]];
  affine_ = true;
  for (std::size_t k = 0; k < count_; ++k) {
    const Point image =
        nodes[k][0] * column[0] + nodes[k][1] * column[1] + nodes[k][2] * column[2];
    affine_ = affine_ && largest(corners_[k] - image) <= kAffineDeviation * size_;
  }
  if (!affine_) {
    std::array<Point, kMostCorners> gradient;
    shape_gradients<double>(kind_, middle_, gradient);
    column = {};
    for (std::size_t k = 1; k < count_; ++k)
      for (std::size_t a = 0; a < 3; ++a) column[a] = column[a] + gradient[k][a] * corners_[k];
  }
  inverse_ = inverse_of_columns(column[0], column[1], column[2]);
  for (const Point& row : inverse_) steepness_ = std::max(steepness_, std::sqrt(dot(row, row)));
}

Point CellMap::position(const Point& xi) const {
  std::array<double, kMostCorners> shape;
  shape_functions<double>(kind_, xi, shape);
  Point sum{};
  for (std::size_t k = 0; k < count_; ++k) sum = sum + shape[k] * corners_[k];
  return origin_ + sum;
}

Point CellMap::reference(const Point& point, const Point& guess) const {
  const Point relative = point - origin_;
  if (affine_) return apply(inverse_, relative);
  Point xi = guess;
  return newton(relative, xi) ? xi : continued(relative);
}

// Newton's iteration for a point relative to corner 0. False, and xi of no use, where it does not
// converge.
bool CellMap::newton(const Point& point, Point& xi) const {
  std::array<double, kMostCorners> shape;
  std::array<Point, kMostCorners> gradient;
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    shape_functions<double>(kind_, xi, shape);
    shape_gradients<double>(kind_, xi, gradient);
    Point residual = point;
    Matrix column{};
    for (std::size_t k = 1; k < count_; ++k) {
      residual = residual - shape[k] * corners_[k];
      for (std::size_t a = 0; a < 3; ++a) column[a] = column[a] + gradient[k][a] * corners_[k];
    }
    const double size = largest(residual);
    if (size <= kResidualRounding * size_) before = std::numeric_limits<double>::infinity();
    if (!(size < before)) return false;  // diverges, or is not a number
    before = size;
    const Point step = apply(inverse_of_columns(column[0], column[1], column[2]), residual);
    if (!std::isfinite(largest(step))) return size <= kResidualRounding * size_;
    xi = xi + step;
    if (largest(step) <= kLastStep) return true;
  }
  return before <= kResidualRounding * size_;
}

Point CellMap::continued(const Point& point) const {
  const Point start = position(middle_) - origin_;
  Point xi = middle_;
  double reached = 0, step = 0.5;
  while (reached < 1 && step > kShortestContinuation) {
    const double next = std::min(reached + step, 1.0);
    const Point target = next == 1 ? point : start + next * (point - start);
    Point trial = xi;
    if (newton(target, trial)) {
      xi = trial;
      reached = next;
      step *= 2;
    } else {
      step /= 2;
    }
  }
  return xi;
}

}  // namespace hiac
