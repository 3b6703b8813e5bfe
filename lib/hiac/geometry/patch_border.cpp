#include "hiac/geometry/patch_border.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hiac/base/special_values.hpp"

namespace hiac {
namespace {

// The distance of a curved edge from the ray is sampled at the ends of this many intervals.
constexpr std::size_t kIntervals = 8;
constexpr int kMostNewtonSteps = 12;

// A point that is closer to the ray than this fraction of `rounding` is not improved.
constexpr double kOnRay = 0x1p-6;

struct Parameters {
  double u, v;
};

// Corner k; the number after the last corner is corner 0 again.
Parameters corner(const PatchShape& shape, std::size_t k) {
  constexpr std::array<Parameters, 4> kSquare{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  constexpr std::array<Parameters, 3> kTriangle{{{0, 0}, {1, 0}, {0, 1}}};
  return shape.triangle ? kTriangle[k % 3] : kSquare[k % 4];
}

// The parameters of a point on the edge from corner k to the next. They never lie outside the
// domain, whatever rounding does.
Parameters on_edge(const PatchShape& shape, std::size_t k, double s) {
  const auto [u0, v0] = corner(shape, k);
  const auto [u1, v1] = corner(shape, k + 1);
  return {u0 == u1 ? u0 : (u0 < u1 ? s : 1 - s), v0 == v1 ? v0 : (v0 < v1 ? s : 1 - s)};
}

// The distances from the ray at a point of an edge, and their derivatives along the edge.
struct EdgePoint {
  double a, b, a_along, b_along;

  [[nodiscard]] double off() const { return std::max(std::abs(a), std::abs(b)); }
  [[nodiscard]] double square() const { return a * a + b * b; }
};

EdgePoint point_on_edge(const PatchAndRay& q, std::size_t k, double s) {
  const auto [u0, v0] = corner(q.shape, k);
  const auto [u1, v1] = corner(q.shape, k + 1);
  const auto [u, v] = on_edge(q.shape, k, s);
  const std::size_t n = q.shape.degree;
  const BernsteinValues bu(n, u), bv(n, v);
  const PatchValue a = evaluate_patch(n, q.a, bu, bv), b = evaluate_patch(n, q.b, bu, bv);
  const double along_u = u1 - u0, along_v = v1 - v0;
  return {a.value, b.value, along_u * a.by_u + along_v * a.by_v,
          along_u * b.by_u + along_v * b.by_v};
}

// Returns the parameter of a local minimum of the distance from the ray, by Gauss-Newton iteration
// from s.
double nearest_from(const PatchAndRay& q, std::size_t k, double s) {
  EdgePoint here = point_on_edge(q, k, s);
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    const double steep = here.a_along * here.a_along + here.b_along * here.b_along;
    const double next =
        std::clamp(s - (here.a * here.a_along + here.b * here.b_along) / steep, 0.0, 1.0);
    if (!(next >= 0) || next == s) break;
    const EdgePoint there = point_on_edge(q, k, next);
    if (!(there.square() < here.square())) break;
    s = next;
    here = there;
  }
  return s;
}

// Keeps, of the points added, the one of least rank among those that are as near to the ray as the
// nearest one to within rounding.
class Nearest {
 public:
  explicit Nearest(double rounding) : rounding_(rounding) {}

  void add(const Parameters& at, double off, double rank) {
    if (!(off <= least_off_ + rounding_)) return;
    least_off_ = std::min(least_off_, off);
    if (place_.off <= least_off_ + rounding_ && !(rank < rank_)) return;
    place_ = {at.u, at.v, off};
    rank_ = rank;
  }
  [[nodiscard]] const BorderPlace& place() const { return place_; }

 private:
  double rounding_;
  BorderPlace place_{0, 0, kInfinity};
  double rank_ = kInfinity, least_off_ = kInfinity;
};

double depth_at(const PatchAndRay& q, const Parameters& at) {
  const std::size_t n = q.shape.degree;
  return evaluate_patch(n, q.depth, BernsteinValues(n, at.u), BernsteinValues(n, at.v)).value;
}

}  // namespace

BorderPlace least_deep_on_border(const PatchAndRay& q) {
  Nearest nearest(q.rounding);
  const auto add = [&](std::size_t k, double s) {
    const Parameters at = on_edge(q.shape, k, s);
    nearest.add(at, point_on_edge(q, k, s).off(), depth_at(q, at));
  };
  const std::size_t intervals = q.shape.degree == 1 ? 1 : kIntervals;
  const auto place = [&](std::size_t i) {
    return static_cast<double>(i) / static_cast<double>(intervals);
  };
  for (std::size_t k = 0; k < q.shape.corner_count(); ++k) {
    add(k, 0);
    std::array<double, kIntervals + 1> square;
    for (std::size_t i = 0; i <= intervals; ++i) square[i] = point_on_edge(q, k, place(i)).square();
    for (std::size_t i = 0; i <= intervals; ++i)
      if ((i == 0 || square[i] <= square[i - 1]) && (i == intervals || square[i] < square[i + 1]))
        add(k, nearest_from(q, k, place(i)));
  }
  return nearest.place();
}

BorderPlace nearest_on_border(const PatchAndRay& q, double u, double v) {
  Nearest nearest(q.rounding);
  for (std::size_t k = 0; k < q.shape.corner_count(); ++k) {
    const auto [u0, v0] = corner(q.shape, k);
    const auto [u1, v1] = corner(q.shape, k + 1);
    const double along_u = u1 - u0, along_v = v1 - v0;
    double s = ((u - u0) * along_u + (v - v0) * along_v) / (along_u * along_u + along_v * along_v);
    s = s > 0 ? std::min(s, 1.0) : 0;
    if (!(point_on_edge(q, k, s).off() <= kOnRay * q.rounding)) s = nearest_from(q, k, s);
    const Parameters at = on_edge(q.shape, k, s);
    nearest.add(at, point_on_edge(q, k, s).off(), std::hypot(at.u - u, at.v - v));
  }
  return nearest.place();
}

bool runs_along_edge(const PatchAndRay& q, BorderPlace& place) {
  const std::size_t corners = q.shape.corner_count(), n = q.shape.degree;
  std::array<bool, 4> near{};
  const std::size_t last = n * (n + 1);
  const std::array<std::size_t, 4> control = q.shape.triangle
                                                 ? std::array<std::size_t, 4>{0, n, last, 0}
                                                 : std::array<std::size_t, 4>{0, n, last + n, last};
  std::size_t count = 0;
  for (std::size_t k = 0; k < corners; ++k) {
    near[k] = std::max(std::abs(q.a[control[k]]), std::abs(q.b[control[k]])) <= q.rounding;
    if (near[k]) ++count;
  }
  if (count < 2) return false;
  Nearest nearest(q.rounding);
  for (std::size_t k = 0; k < corners; ++k) {
    const std::size_t next = (k + 1) % corners;
    if (!near[k] || !near[next]) continue;
    // a polynomial that is small at as many points as it has coefficients is small between them
    bool along = true;
    for (std::size_t i = 1; i < n; ++i)
      along = along && point_on_edge(q, k, static_cast<double>(i) / static_cast<double>(n)).off() <=
                           q.rounding;
    if (!along) continue;
    for (const std::size_t end : {k, next})
      nearest.add(corner(q.shape, end), 0, q.depth[control[end]]);
  }
  place = nearest.place();
  return place.off == 0;
}

bool is_edge_on(const PatchAndRay& q) {
  const std::size_t count = q.shape.control_count();
  double far = 0, along_a = 0, along_b = 0;
  for (std::size_t k = 1; k < count; ++k) {
    const double a = q.a[k] - q.a[0], b = q.b[k] - q.b[0];
    if (a * a + b * b > far) {
      far = a * a + b * b;
      along_a = a;
      along_b = b;
    }
  }
  const double allowed = q.rounding * std::sqrt(far);
  for (std::size_t k = 1; k < count; ++k)
    if (!(std::abs((q.a[k] - q.a[0]) * along_b - (q.b[k] - q.b[0]) * along_a) <= allowed))
      return false;
  return true;
}

}  // namespace hiac
