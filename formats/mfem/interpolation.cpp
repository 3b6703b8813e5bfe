#include "formats/mfem/interpolation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace hiac::formats::mfem {
namespace {

using Place = std::array<int, 3>;

/// Bernstein's polynomial with these powers of the barycentric coordinates.
double bernstein(std::span<const double> coordinates, std::span<const int> powers) {
  double value = 1;
  int degree = 0;
  for (std::size_t v = 0; v < powers.size(); ++v)
    for (int m = 1; m <= powers[v]; ++m) value *= coordinates[v] * ++degree / m;
  return value;
}

/// The Lagrange or Bernstein polynomials along a line: the weight of every point at the target t of
/// `order` parts.
class Line {
 public:
  Line(const Space& space, int order)
      : points_(evenly_or_lobatto(space)), order_(order), bernstein_(space.bernstein) {}

  [[nodiscard]] double weight(int target, int point) const {
    const double t = static_cast<double>(target) / order_;
    if (bernstein_) {
      const int last = static_cast<int>(points_.size()) - 1;
      const std::array<double, 2> at{1 - t, t};
      const std::array<int, 2> powers{last - point, point};
      return bernstein(at, powers);
    }
    double weight = 1;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (i != static_cast<std::size_t>(point))
        weight *= (t - points_[i]) / (points_[static_cast<std::size_t>(point)] - points_[i]);
    return weight;
  }

 private:
  static std::vector<double> evenly_or_lobatto(const Space& space) {
    if (space.lobatto) return gauss_lobatto_points(space.order);
    std::vector<double> points;
    for (int i = 0; i <= space.order; ++i) points.push_back(static_cast<double>(i) / space.order);
    return points;
  }
  std::vector<double> points_;
  int order_;
  bool bernstein_;
};

/// The weight in a simplex of 2 or 3 dimensions; targets and points have barycentric coordinates.
double simplex_weight(std::span<const int> target, std::span<const int> point, const Space& space,
                      int order, const Line& line) {
  if (space.bernstein) {
    std::array<double, 4> coordinates{};
    for (std::size_t v = 0; v < target.size(); ++v)
      coordinates[v] = static_cast<double>(target[v]) / order;
    return bernstein(coordinates, point);
  }
  const bool same = std::equal(target.begin(), target.end(), point.begin());
  if (space.order == order) {
    if (!space.lobatto) return same ? 1 : 0;
    std::array<std::size_t, 4> corners{};
    std::size_t count = 0;
    for (std::size_t v = 0; v < target.size(); ++v)
      if (target[v] > 0) corners[count++] = v;
    if (count != 2) return same ? 1 : 0;
    if (point[corners[0]] + point[corners[1]] != order) return 0;
    return line.weight(target[corners[1]], point[corners[1]]);
  }
  double weight = 1;
  for (std::size_t v = 0; v < target.size(); ++v)
    for (int m = 0; m < point[v]; ++m)
      weight *= (static_cast<double>(space.order * target[v]) / order - m) / (point[v] - m);
  return weight;
}

/// The weight in a pyramid (rational functions); if the space has the same order, the points
/// coincide.
double pyramid_weight(const LatticePoint& target, const LatticePoint& point, const Space& space,
                      int order) {
  if (space.order == order)
    return target.place == point.place && target.narrowing == point.narrowing ? 1 : 0;
  const std::array<double, 3> at = position_of(target, order);
  if (point.place[2] > 0) return at[2];
  if (target.place[2] == order) return 0;
  double weight = 1 - at[2];
  for (std::size_t c = 0; c < 2; ++c) {
    const double along = at[c] / (1 - at[2]);
    weight *= point.place[c] > 0 ? along : 1 - along;
  }
  return weight;
}

double weight_of(Geometry geometry, const LatticePoint& target_point,
                 const LatticePoint& from_point, const Space& space, int order, const Line& line) {
  if (geometry == Geometry::pyramid) return pyramid_weight(target_point, from_point, space, order);
  const Place& target = target_point.place;
  const Place& point = from_point.place;
  if (geometry == Geometry::cube)
    return line.weight(target[0], point[0]) * line.weight(target[1], point[1]) *
           line.weight(target[2], point[2]);
  if (geometry == Geometry::prism) {
    const std::array<int, 3> to{order - target[0] - target[1], target[0], target[1]};
    const std::array<int, 3> from{space.order - point[0] - point[1], point[0], point[1]};
    return simplex_weight(to, from, space, order, line) * line.weight(target[2], point[2]);
  }
  const std::array<int, 4> to{order - target[0] - target[1] - target[2], target[0], target[1],
                              target[2]};
  const std::array<int, 4> from{space.order - point[0] - point[1] - point[2], point[0], point[1],
                                point[2]};
  return simplex_weight(to, from, space, order, line);
}

}  // namespace

std::vector<std::vector<double>> interpolation(Geometry geometry, const Space& space,
                                               const Space& cells) {
  const std::vector<LatticePoint> points = lattice_points(geometry, space);
  const Line line(space, cells.order);
  std::vector<std::vector<double>> rows;
  for (const LatticePoint& target : lattice_points(geometry, cells)) {
    rows.emplace_back();
    for (const LatticePoint& point : points)
      rows.back().push_back(weight_of(geometry, target, point, space, cells.order, line));
  }
  return rows;
}

std::vector<double> gauss_lobatto_points(int order) {
  std::vector<double> points(static_cast<std::size_t>(order) + 1, 0.0);
  points.back() = 1;
  constexpr int kSteps = 100;
  // Newton's iteration for the roots of (1 - x^2) P'(x), starting from those of the Chebyshev
  // polynomials
  for (int i = 1; i < order; ++i) {
    double x = -std::cos(std::numbers::pi * i / order);
    for (int step = 0; step < kSteps; ++step) {
      double before = 1;
      double legendre = x;
      for (int n = 2; n <= order; ++n)
        before = std::exchange(legendre, ((2 * n - 1) * x * legendre - (n - 1) * before) / n);
      const double change = (x * legendre - before) / ((order + 1) * legendre);
      x -= change;
      if (std::abs(change) < 1e-16) break;
    }
    points[static_cast<std::size_t>(i)] = (1 + x) / 2;
  }
  return points;
}

}  // namespace hiac::formats::mfem
