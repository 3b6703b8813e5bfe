#include "hiac/geometry/inverse_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

using Point = CellMap::Point;
using InverseRows = std::array<Point, 3>;  // rows

// A corner's deviation from the affine map, relative to the cell's size, that changes a field no
// more than rounding does.
constexpr double kAffineDeviation = 1e-14;
// The same for the rounding of corner coordinates, relative to the largest coordinate: corners of
// small cells are no more exact than that.
constexpr double kCornerRounding = 4 * std::numeric_limits<double>::epsilon();
// Newton converges quadratically: after a step this short, relative to the distance over which the
// Jacobian changes, the next step would be below rounding.
constexpr double kLastStep = 1e-9;
constexpr int kMostIterations = 12;
// Residuals up to this fraction of the cell's size are rounding errors of the map itself.
constexpr double kResidualRounding = 16 * std::numeric_limits<double>::epsilon();
// Newton stops at this residual, relative to the cell's size; no smaller one can be reached.
constexpr double kLeastResidual = std::numeric_limits<double>::epsilon() / 2;
constexpr double kShortestContinuation = 0x1p-30;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
// The inverse of the matrix with these columns, as rows.
InverseRows inverse_of_columns(const Point& a, const Point& b, const Point& c) {
  const Point bc = cross(b, c);
  const double scale = 1 / dot(a, bc);
  return {scale * bc, scale * cross(c, a), scale * cross(a, b)};
}

Point times(const InverseRows& rows, const Point& v) {
  return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
}

// The products of coordinates that a kind's shape functions contain, with their gradients.
struct MixedTerms {
  std::size_t count = 0;
  std::array<double, 4> value;
  std::array<Point, 4> gradient;

  void add(double v, const Point& g) {
    value[count] = v;
    gradient[count++] = g;
  }
};

// Returns a / b. Where both vanish, any number between 0 and 1 serves.
double collapsed_quotient(double a, double b) { return b == 0 ? 0.5 : a / b; }

// The products that, with 1, x, y and z (for the wedge 1, y and z), span the shape functions of the
// linear kinds (shape_functions.cpp).
MixedTerms mixed_terms(CellShape shape, const Point& xi) {
  const auto& [x, y, z] = xi;
  MixedTerms terms;
  switch (shape) {
    case CellShape::tetrahedron:
      break;
    case CellShape::pyramid: {
      const double u = collapsed_quotient(x, 1 - z), v = collapsed_quotient(y, 1 - z);
      terms.add(u * y, {v, u, u * v});
      break;
    }
    case CellShape::prism:
      terms.add(x * z, {z, 0, x});
      terms.add(y * z, {0, z, y});
      break;
    case CellShape::wedge: {
      const double p = 1 - y, q = 1 - z;
      const double u = collapsed_quotient(x, p + q);
      const double b = collapsed_quotient(q, p + q), a = 1 - b;
      terms.add(u * p * q, {p * b, -x * b * b, -x * a * a});
      terms.add(u * y * q, {y * b, (x + u * y) * b, -u * y * a});
      terms.add(u * z * p, {z * a, -u * z * b, (x + u * z) * a});
      terms.add(y * z, {0, z, y});
      break;
    }
    case CellShape::brick:
      terms.add(x * y, {y, x, 0});
      terms.add(y * z, {0, z, y});
      terms.add(x * z, {z, 0, x});
      terms.add(x * y * z, {y * z, x * z, x * y});
      break;
  }
  return terms;
}

// The corners that lie on the reference cell's x, y and z axes.
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

// The distance over which the Jacobian changes. At a pyramid's apex and at a wedge's node 6 it
// depends on the direction of approach.
double jacobian_scale(CellShape shape, const Point& xi) {
  if (shape == CellShape::pyramid) return std::abs(1 - xi[2]);
  if (shape == CellShape::wedge) return std::abs(2 - xi[1] - xi[2]);
  return 1;
}

// Roots farther outside the reference cell than this belong to other branches of the map.
constexpr double kCellMargin = 1e-3;

bool near_reference_cell(CellShape shape, const Point& xi) {
  const auto& [x, y, z] = xi;
  if (std::min({x, y, z}) < -kCellMargin) return false;
  switch (shape) {
    case CellShape::tetrahedron:
      return x + y + z <= 1 + kCellMargin;
    case CellShape::pyramid:
      return std::max(x, y) + z <= 1 + kCellMargin;
    case CellShape::prism:
      return std::max(x + y, z) <= 1 + kCellMargin;
    case CellShape::wedge:
      return std::max(y, z) <= 1 + kCellMargin && x + y + z <= 2 + kCellMargin;
    case CellShape::brick:
      return std::max({x, y, z}) <= 1 + kCellMargin;
  }
  return false;
}

// The place of a node between corners in a cell with straight edges, as weights of corners. The
// weights add up to 1; the first corner's is omitted, as positions are relative to it.
struct CornerShare {
  std::size_t corner;
  double weight;
};
using StraightPlace = std::vector<CornerShare>;

// The places of a kind's nodes that are not corners.
std::vector<StraightPlace> straight_places(CellKind kind) {
  const CellKind linear = kind_of(shape_of(kind), CellOrder::linear);
  const auto reference = reference_nodes(kind);
  std::vector<StraightPlace> places;
  for (std::size_t k = corner_count(kind); k < node_count(kind); ++k) {
    std::array<double, kMaxNodesPerCell> shape;
    shape_functions<double>(linear, reference[k], shape);
    StraightPlace& place = places.emplace_back();
    for (std::size_t c = 1; c < corner_count(kind); ++c)
      if (shape[c] != 0) place.push_back({c, shape[c]});
  }
  return places;
}

const std::vector<StraightPlace>& straight_places_of(CellKind kind) {
  static const auto kPlaces = [] {
    std::vector<std::vector<StraightPlace>> places;
    for (std::size_t k = 0; k < kKindCount; ++k)
      places.push_back(straight_places(static_cast<CellKind>(k)));
    return places;
  }();
  return kPlaces[static_cast<std::size_t>(kind)];
}

}  // namespace

double edge_deviation(CellKind kind, std::span<const Point> nodes) {
  if (order_of(kind) == CellOrder::linear) return 0;
  const std::size_t corners = corner_count(kind);
  const std::vector<StraightPlace>& places = straight_places_of(kind);
  double size = 0, deviation = 0;
  for (std::size_t k = 1; k < corners; ++k) size = std::max(size, largest(nodes[k] - nodes[0]));
  for (std::size_t k = 0; k < places.size(); ++k) {
    Point off = nodes[0] - nodes[corners + k];
    for (const auto& [corner, weight] : places[k]) off = off + weight * (nodes[corner] - nodes[0]);
    deviation = std::max(deviation, largest(off));
  }
  return deviation == 0 ? 0 : deviation / size;
}

CellMap::CellMap(CellKind kind, std::span<const Point> nodes, double straightness)
    : CellMap(kind, nodes, edge_deviation(kind, nodes), straightness) {}

CellMap::CellMap(CellKind kind, std::span<const Point> nodes, double deviation, double straightness)
    : kind_(deviation <= straightness ? kind_of(shape_of(kind), CellOrder::linear) : kind),
      count_(node_count(kind_)),
      origin_(nodes[0]) {
  const auto reference = reference_nodes(kind_);
  double farthest = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    nodes_[k] = nodes[k] - origin_;
    size_ = std::max(size_, largest(nodes_[k]));
    farthest = std::max(farthest, largest(nodes[k]));
  }
  const std::size_t corners = corner_count(kind_);
  for (std::size_t k = 0; k < corners; ++k)
    middle_ = middle_ + (1.0 / static_cast<double>(corners)) * reference[k];
  // the corners on the axes define the affine map; the other nodes are compared with it
  const auto axis = axis_corners(shape_of(kind_));
  const auto on_axis = [&](std::size_t a) { return (1 / reference[axis[a]][a]) * nodes_[axis[a]]; };
  Jacobian jacobian{on_axis(0), on_axis(1), on_axis(2)};
  affine_ = straight();
  for (std::size_t k = 0; k < count_; ++k) {
    const Point image =
        reference[k][0] * jacobian.x + reference[k][1] * jacobian.y + reference[k][2] * jacobian.z;
    off_affine_ = std::max(off_affine_, largest(nodes_[k] - image));
  }
  affine_ = affine_ && off_affine_ <= kAffineDeviation * size_ + kCornerRounding * farthest;
  if (!affine_) off_affine_ = 0;
  if (straight()) {
    set_terms();
    straightened_ = 4 * deviation * size_;
  }
  Point unused;
  if (!affine_) evaluate(middle_, unused, jacobian);
  inverse_ = inverse_of_columns(jacobian.x, jacobian.y, jacobian.z);
  for (const Point& row : inverse_) steepness_ = std::max(steepness_, std::sqrt(dot(row, row)));
}

void CellMap::set_terms() {
  const auto& p = nodes_;  // p[0] is 0
  switch (shape_of(kind_)) {
    case CellShape::tetrahedron:
      linear_ = {p[1], p[2], p[3]};
      break;
    case CellShape::pyramid:
      linear_ = {p[1], p[3], p[4]};
      mixed_ = {p[2] - p[1] - p[3]};
      break;
    case CellShape::prism:
      linear_ = {p[2], p[1], p[3]};
      mixed_ = {p[5] - p[2] - p[3], p[4] - p[1] - p[3]};
      break;
    case CellShape::wedge:
      linear_ = {{}, p[3], p[4]};
      mixed_ = {p[1], p[2] - p[3], p[5] - p[4], p[6] - p[3] - p[4]};
      break;
    case CellShape::brick:
      linear_ = {p[1], p[3], p[4]};
      mixed_ = {p[2] - p[1] - p[3], p[7] - p[3] - p[4], p[5] - p[1] - p[4],
                (p[6] - p[2]) + (p[1] - p[5]) + (p[3] - p[7]) + p[4]};
      break;
  }
}

// Position and Jacobian; the position is relative to corner 0.
void CellMap::evaluate(const Point& xi, Point& position, Jacobian& jacobian) const {
  if (!straight()) return evaluate_curved(xi, position, jacobian);
  const MixedTerms terms = mixed_terms(shape_of(kind_), xi);
  position = xi[0] * linear_.x + xi[1] * linear_.y + xi[2] * linear_.z;
  jacobian = linear_;
  for (std::size_t k = 0; k < terms.count; ++k) {
    position = position + terms.value[k] * mixed_[k];
    jacobian.x = jacobian.x + terms.gradient[k][0] * mixed_[k];
    jacobian.y = jacobian.y + terms.gradient[k][1] * mixed_[k];
    jacobian.z = jacobian.z + terms.gradient[k][2] * mixed_[k];
  }
}

void CellMap::evaluate_curved(const Point& xi, Point& position, Jacobian& jacobian) const {
  std::array<double, kMostNodes> shape;
  std::array<Point, kMostNodes> gradient;
  shape_functions<double>(kind_, xi, shape);
  shape_gradients<double>(kind_, xi, gradient);
  position = {};
  jacobian = {};
  for (std::size_t k = 1; k < count_; ++k) {
    position = position + shape[k] * nodes_[k];
    jacobian.x = jacobian.x + gradient[k][0] * nodes_[k];
    jacobian.y = jacobian.y + gradient[k][1] * nodes_[k];
    jacobian.z = jacobian.z + gradient[k][2] * nodes_[k];
  }
}

Point CellMap::position(const Point& xi) const {
  std::array<double, kMostNodes> shape;
  shape_functions<double>(kind_, xi, shape);
  Point sum{};
  for (std::size_t k = 0; k < count_; ++k) sum = sum + shape[k] * nodes_[k];
  return origin_ + sum;
}

Point CellMap::reference(const Point& point, const Point& guess) const {
  const Point relative = point - origin_;
  if (affine_) return times(inverse_, relative);
  Point xi = guess;
  if (newton(relative, xi) && near_reference_cell(shape_of(kind_), xi)) return xi;
  xi = guess;
  if (follow(relative, xi) && near_reference_cell(shape_of(kind_), xi)) return xi;
  xi = middle_;
  follow(relative, xi);
  return xi;
}

// Newton's iteration for a point relative to corner 0. Returns false, with a meaningless xi, if it
// does not converge.
bool CellMap::newton(const Point& point, Point& xi) const {
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    Point here;
    Jacobian jacobian;
    evaluate(xi, here, jacobian);
    const Point residual = point - here;
    const double size = largest(residual);
    if (size <= kResidualRounding * size_) before = std::numeric_limits<double>::infinity();
    if (!(size < before)) return false;  // diverges, or is not a number
    if (size <= kLeastResidual * size_) return true;
    before = size;
    const Point step = times(inverse_of_columns(jacobian.x, jacobian.y, jacobian.z), residual);
    if (!std::isfinite(largest(step))) return size <= kResidualRounding * size_;
    xi = xi + step;
    if (largest(step) <= kLastStep * jacobian_scale(shape_of(kind_), xi)) return true;
  }
  return before <= kResidualRounding * size_;
}

// Continuation from the point of xi to a point relative to corner 0. Returns false if it fails; xi
// then belongs to the last point that it reached.
bool CellMap::follow(const Point& point, Point& xi) const {
  const Point start = position(xi) - origin_;
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
  return reached == 1;
}

}  // namespace hiac
