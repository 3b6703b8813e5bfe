#include "hiac/geometry/patch_zeros.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "hiac/base/special_values.hpp"
#include "hiac/geometry/patch_border.hpp"

namespace hiac {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// The search covers the domain with this margin, as rounding may move zeros out of the domain.
constexpr double kDomainMargin = 1e-3;
// Parts are halved at most this often in each parameter.
constexpr int kMostHalvings = 26;
// All parts are examined down to kFewHalvings halvings, but only kMostFineParts of the smaller
// ones. A pair of close zeros needs a few parts of each smaller size; a curve of zeros, which
// arises where a ray runs along the patch, would need parts all along it.
constexpr int kFewHalvings = 12;
constexpr int kMostFineParts = 1024;
constexpr int kMostSteps = 12;
// Where the patch is seen almost edge-on, rounding hides a zero's parameters. Newton's iteration
// accepts a point where the ray meets the patch to within rounding if rounding moves the parameters
// by less than this.
constexpr double kLocated = 0x1p-7;
// Zeros whose parameters differ by less than this are the same.
constexpr double kSame = 1e-9;

int sign_of(double x) { return x < 0 ? -1 : 1; }

double outside(const PatchShape& shape, double u, double v) {
  const double below = std::max(-u, -v);
  return shape.triangle ? std::max(below, u + v - 1) : std::max({below, u - 1, v - 1});
}

PatchAndRay ray_of(const PatchZeroQuestion& q) { return {q.shape, q.a, q.b, q.depth, q.rounding}; }

PatchZero on_border(const PatchZeroQuestion& q, int sign) {
  const BorderPlace place = least_deep_on_border(ray_of(q));
  return {place.u, place.v, sign, 0};
}

// Moves a zero that rounding has put outside the domain to the point of the border that is nearest
// to the ray. In a patch seen almost edge-on, the border point with the nearest parameters could be
// far from the ray.
PatchZero taken_in(const PatchZeroQuestion& q, const PatchZero& zero) {
  if (outside(q.shape, zero.u, zero.v) <= 0) return zero;
  const BorderPlace place = nearest_on_border(ray_of(q), zero.u, zero.v);
  return {place.u, place.v, zero.sign, 0};
}

PatchZeros repeated(const PatchZero& zero, int winding) {
  PatchZeros zeros;
  for (int k = 0; k < std::abs(winding); ++k) zeros.add(zero);
  return zeros;
}

// Returns how far outside the domain a zero is after the ray is moved right by a quarter of
// `rounding` and down by much less. With this shift, all patches around an edge decide alike about
// a zero on their common border, and in agreement with the winding number. The parameters move by
// J^-1 times the shift.
double outside_moved(const PatchZeroQuestion& q, const PatchZero& zero) {
  if (std::abs(zero.outside) > kDomainMargin) return zero.outside;
  const double right = 0.25 * q.rounding, down = 0x1p-20 * right;
  const std::size_t n = q.shape.degree;
  const BernsteinValues bu(n, zero.u), bv(n, zero.v);
  const PatchValue a = evaluate_patch(n, q.a, bu, bv), b = evaluate_patch(n, q.b, bu, bv);
  const double determinant = a.by_u * b.by_v - a.by_v * b.by_u;
  return outside(q.shape, zero.u + (right * b.by_v + down * a.by_v) / determinant,
                 zero.v - (right * b.by_u + down * a.by_u) / determinant);
}

// Selects from the candidate zeros those whose signs add up to `winding`. Where the zeros inside do
// not, it adds or removes the zero nearest to the border; where none is left to add, a border
// point.
PatchZeros settled(const PatchZeroQuestion& q, const PatchZeros& candidates) {
  const int winding = q.winding;
  PatchZeros inside, beyond;
  int sum = 0;
  for (const PatchZero& candidate : candidates) {
    PatchZero zero = candidate;
    zero.outside = outside_moved(q, candidate);
    const bool in = zero.outside <= 0;
    (in ? inside : beyond).add(zero);
    if (in) sum += zero.sign;
  }
  while (sum != winding) {
    const int wanted = sum < winding ? 1 : -1;
    constexpr std::size_t kNone = PatchZeros::kMost;
    std::size_t take = kNone, leave = kNone;
    double least = kInfinity;
    for (std::size_t k = 0; k < beyond.size(); ++k)
      if (beyond[k].sign == wanted && beyond[k].outside < least) {
        least = beyond[k].outside;
        take = k;
      }
    for (std::size_t k = 0; k < inside.size(); ++k)
      if (inside[k].sign != wanted && -inside[k].outside < least) {
        least = -inside[k].outside;
        take = kNone;
        leave = k;
      }
    if (leave != kNone) {
      inside.remove(leave);
    } else if (take != kNone) {
      inside.add(beyond[take]);
      beyond.remove(take);
    } else {
      // rounding hides every zero that could be added
      if (inside.size() == PatchZeros::kMost) break;
      inside.add(on_border(q, wanted));
    }
    sum += wanted;
  }
  PatchZeros result;
  for (const PatchZero& zero : inside) result.add(taken_in(q, zero));
  return result;
}

// Returns whether the ray passes through a corner to within rounding.
bool is_at_corner(const PatchZeroQuestion& q) {
  const std::size_t n = q.shape.degree, last = n * (n + 1);
  const auto at = [&](std::size_t k) {
    return std::max(std::abs(q.a[k]), std::abs(q.b[k])) <= q.rounding;
  };
  return at(0) || at(n) || at(last) || (!q.shape.triangle && at(last + n));
}

// A ray that lies in the patch has no isolated crossing: all crossings are put on the border.
PatchZeros edge_on(const PatchZeroQuestion& q) {
  if (q.winding == 0) return {};
  return repeated(on_border(q, sign_of(q.winding)), q.winding);
}

// Degree 1 over the square ---------------------------------------------------------------------

class Bilinear {
 public:
  explicit Bilinear(const PatchZeroQuestion& question)
      : q_(question), a_(question.a), b_(question.b) {}

  // Eliminates v: with z = u / (1 - u), c0 + m z + c2 z^2 = 0. At a root, the derivative by u is
  // d(a, b) / d(u, v) and has the sign of the derivative by z.
  [[nodiscard]] PatchZeros zeros() const {
    const double c0 = cross(0, 2), c2 = cross(1, 3), m = cross(0, 3) + cross(1, 2);
    if (within_rounding(c0, m, c2)) return edge_on(q_);
    const double discriminant = m * m - 4 * c0 * c2;
    PatchZeros candidates;
    if (discriminant < 0 && q_.winding == 0) return candidates;
    const double root = discriminant > 0 ? std::sqrt(discriminant) : 0;
    const int sign = sign_of(m);
    const double h = -0.5 * (m + sign * root);
    if (q_.one_way && std::abs(q_.winding) == 1) {
      const PatchZero zero = sign == q_.winding ? at(c0, h, q_.winding) : at(h, c2, q_.winding);
      if (std::isfinite(zero.u) && std::isfinite(zero.v)) {
        candidates.add(taken_in(q_, zero));
        return candidates;
      }
    }
    add(candidates, at(h, c2, -sign));
    add(candidates, at(c0, h, sign));
    return settled(q_, candidates);
  }

 private:
  [[nodiscard]] double cross(std::size_t i, std::size_t j) const {
    return a_[i] * b_[j] - a_[j] * b_[i];
  }

  // Returns whether the ray lies in the patch, or along a straight line in it, to within rounding.
  [[nodiscard]] bool within_rounding(double c0, double m, double c2) const {
    double size = 0;
    for (std::size_t k = 0; k < 4; ++k) size += std::abs(a_[k]) + std::abs(b_[k]);
    return std::max({std::abs(c0), std::abs(m), std::abs(c2)}) <= q_.rounding * size;
  }

  void add(PatchZeros& zeros, PatchZero zero) const {
    if (!std::isfinite(zero.u) || !std::isfinite(zero.v)) return;
    zero.outside = outside(q_.shape, zero.u, zero.v);
    zeros.add(zero);
  }

  // The zero where u / (1 - u) = s / r.
  [[nodiscard]] PatchZero at(double s, double r, int sign) const {
    const double u = s / (s + r);
    const double a0 = (1 - u) * a_[0] + u * a_[1], a1 = (1 - u) * a_[2] + u * a_[3];
    const double b0 = (1 - u) * b_[0] + u * b_[1], b1 = (1 - u) * b_[2] + u * b_[3];
    const double v = std::abs(a0 - a1) > std::abs(b0 - b1) ? a0 / (a0 - a1) : b0 / (b0 - b1);
    return {u, v, sign, 0};
  }

  const PatchZeroQuestion& q_;
  const PatchNet<double>&a_, &b_;
};

// Higher degrees ------------------------------------------------------------------------------

// Returns whether all coefficients have the same sign whatever their rounding errors are.
bool has_one_sign(const PatchNet<double>& net, std::size_t count, double rounding) {
  double least = kInfinity, most = -kInfinity;
  for (std::size_t k = 0; k < count; ++k) {
    least = std::min(least, net[k]);
    most = std::max(most, net[k]);
  }
  return least > rounding || most < -rounding;
}

double largest_of(const PatchNet<double>& net, std::size_t count) {
  double most = 0;
  for (std::size_t k = 0; k < count; ++k) most = std::max(most, std::abs(net[k]));
  return most;
}

// De Casteljau's algorithm on `degree` + 1 coefficients that are `stride` apart: `line` becomes the
// coefficients on [0, s], `rest` those on [s, 1].
void split_line(std::size_t degree, std::size_t stride, double s, double* line, double* rest) {
  for (std::size_t k = 0; k <= degree; ++k) rest[k * stride] = line[k * stride];
  for (std::size_t level = 1; level <= degree; ++level) {
    for (std::size_t k = degree; k >= level; --k)
      line[k * stride] = (1 - s) * line[(k - 1) * stride] + s * line[k * stride];
    rest[(degree - level) * stride] = line[degree * stride];
  }
}

struct NetPair {
  PatchNet<double> low, high;
};

NetPair split(const PatchNet<double>& net, std::size_t degree, bool along_v, double s) {
  NetPair parts{net, {}};
  const std::size_t side = degree + 1;
  for (std::size_t k = 0; k <= degree; ++k) {
    const std::size_t first = along_v ? k : k * side;
    split_line(degree, along_v ? side : 1, s, &parts.low[first], &parts.high[first]);
  }
  return parts;
}

class Search {
 public:
  explicit Search(const PatchZeroQuestion& question)
      : q_(question),
        shape_(question.shape),
        n_(shape_.degree),
        count_(shape_.control_count()),
        a_(question.a),
        b_(question.b) {
    const double size = std::max(largest_of(a_, count_), largest_of(b_, count_));
    rounding_ = 16 * kEpsilon * size;
  }

  [[nodiscard]] PatchZeros zeros() {
    if (std::isfinite(rounding_)) look(widened(a_), widened(b_), -kDomainMargin, -kDomainMargin, 0);
    return settled(q_, found_);
  }

  // Newton's iteration. The result's sign is 0 if it does not converge.
  [[nodiscard]] PatchZero newton(std::array<double, 2> at) const {
    auto [u, v] = at;
    for (int step = 0; step < kMostSteps; ++step) {
      const BernsteinValues bu(n_, u), bv(n_, v);
      const PatchValue a = evaluate_patch(n_, a_, bu, bv), b = evaluate_patch(n_, b_, bu, bv);
      const double determinant = a.by_u * b.by_v - a.by_v * b.by_u;
      const double du = (a.value * b.by_v - a.by_v * b.value) / determinant;
      const double dv = (a.by_u * b.value - a.value * b.by_u) / determinant;
      const double moved = std::max(std::abs(du), std::abs(dv));
      // rounding limits the quadratic convergence
      if (!(moved < kSame) && std::max(std::abs(a.value), std::abs(b.value)) <= rounding_ &&
          hidden(a, b) < kLocated)
        return {u, v, sign_of(determinant), outside(shape_, u, v)};
      u -= du;
      v -= dv;
      if (!(std::abs(u) < 4 && std::abs(v) < 4)) break;
      if (moved < kSame) return {u, v, sign_of(determinant), outside(shape_, u, v)};
    }
    return {u, v, 0, kInfinity};
  }

 private:
  // The coefficients over the square extended by kDomainMargin on every side.
  [[nodiscard]] PatchNet<double> widened(PatchNet<double> net) const {
    for (const bool along_v : {false, true}) {
      net = split(net, n_, along_v, -kDomainMargin).high;
      net = split(net, n_, along_v, (1 + 2 * kDomainMargin) / (1 + kDomainMargin)).low;
    }
    return net;
  }

  [[nodiscard]] static double size_at(int halvings) {
    return std::ldexp(1 + 2 * kDomainMargin, -halvings);
  }

  void look(const PatchNet<double>& a, const PatchNet<double>& b, double u, double v,
            int halvings) {
    const double size = size_at(halvings);
    if (shape_.triangle && u + v > 1 + kDomainMargin) return;
    if (has_one_sign(a, count_, rounding_) || has_one_sign(b, count_, rounding_)) return;
    bool unique = false;
    if (!may_have_zeros(a, b, unique)) return;
    const bool last =
        halvings == kMostHalvings || (halvings >= kFewHalvings && fine_parts_++ >= kMostFineParts);
    if (unique || last) {
      const PatchZero zero = newton({u + 0.5 * size, v + 0.5 * size});
      const double slack = (unique ? 1e-6 : 1.0) * size;
      const bool here = zero.sign != 0 && zero.u >= u - slack && zero.u <= u + size + slack &&
                        zero.v >= v - slack && zero.v <= v + size + slack;
      if (here) add(zero);
      if (here || last) return;
    }
    const NetPair a_v = split(a, n_, true, 0.5), b_v = split(b, n_, true, 0.5);
    const double half = 0.5 * size;
    for (const bool upper : {false, true}) {
      const NetPair a_u = split(upper ? a_v.high : a_v.low, n_, false, 0.5);
      const NetPair b_u = split(upper ? b_v.high : b_v.low, n_, false, 0.5);
      const double at_v = upper ? v + half : v;
      look(a_u.low, b_u.low, u, at_v, halvings + 1);
      look(a_u.high, b_u.high, u + half, at_v, halvings + 1);
    }
  }

  // Returns whether a part may contain zeros, after the map is multiplied by the inverse of its
  // Jacobian in the middle. `unique` is set when the product is so near to the identity that the
  // map is one to one on the whole part.
  bool may_have_zeros(const PatchNet<double>& a, const PatchNet<double>& b, bool& unique) const {
    const BernsteinValues middle(n_, 0.5);
    const PatchValue da = evaluate_patch(n_, a, middle, middle),
                     db = evaluate_patch(n_, b, middle, middle);
    const double inverse = 1 / (da.by_u * db.by_v - da.by_v * db.by_u);
    if (!std::isfinite(inverse)) return true;
    PatchNet<double> p, q;
    double rounding_p = 0, rounding_q = 0;
    const double p_a = db.by_v * inverse, p_b = -da.by_v * inverse, q_a = -db.by_u * inverse,
                 q_b = da.by_u * inverse;
    for (std::size_t k = 0; k < count_; ++k) {
      p[k] = p_a * a[k] + p_b * b[k];
      q[k] = q_a * a[k] + q_b * b[k];
    }
    rounding_p = 2 * (std::abs(p_a) + std::abs(p_b)) * rounding_;
    rounding_q = 2 * (std::abs(q_a) + std::abs(q_b)) * rounding_;
    if (has_one_sign(p, count_, rounding_p) || has_one_sign(q, count_, rounding_q)) return false;
    unique = nearly_identity(p, true) && nearly_identity(q, false);
    return true;
  }

  // Returns whether |dp / d own - 1| + |dp / d other| < 1 on the whole part, with a margin.
  [[nodiscard]] bool nearly_identity(const PatchNet<double>& p, bool own_is_u) const {
    const std::size_t side = n_ + 1;
    const auto n = static_cast<double>(n_);
    double own = 0, other = 0;
    for (std::size_t j = 0; j < side; ++j)
      for (std::size_t i = 0; i < n_; ++i) {
        const double by_u = n * (p[i + 1 + side * j] - p[i + side * j]);
        const double by_v = n * (p[j + side * (i + 1)] - p[j + side * i]);
        own = std::max(own, std::abs((own_is_u ? by_u : by_v) - 1));
        other = std::max(other, std::abs(own_is_u ? by_v : by_u));
      }
    return own + other < 0.95;
  }

  // Returns by how much rounding may move the parameters of a zero with these derivatives.
  [[nodiscard]] double hidden(const PatchValue& a, const PatchValue& b) const {
    return (std::max(std::abs(a.by_u), std::abs(a.by_v)) +
            std::max(std::abs(b.by_u), std::abs(b.by_v))) *
           rounding_ / std::abs(a.by_u * b.by_v - a.by_v * b.by_u);
  }

  void add(const PatchZero& zero) {
    const BernsteinValues bu(n_, zero.u), bv(n_, zero.v);
    const double within =
        2 * std::max(kSame, hidden(evaluate_patch(n_, a_, bu, bv), evaluate_patch(n_, b_, bu, bv)));
    for (const PatchZero& known : found_)
      if (known.sign == zero.sign && std::abs(known.u - zero.u) <= within &&
          std::abs(known.v - zero.v) <= within)
        return;
    found_.add(zero);
  }

  const PatchZeroQuestion& q_;
  const PatchShape& shape_;
  std::size_t n_, count_;
  const PatchNet<double>&a_, &b_;
  double rounding_;
  int fine_parts_ = 0;  // parts examined after kFewHalvings halvings or more
  PatchZeros found_;
};

}  // namespace

PatchZeros patch_zeros(const PatchZeroQuestion& q) {
  if (q.one_way && q.winding == 0) return {};
  BorderPlace corner;
  if (is_at_corner(q) && runs_along_edge(ray_of(q), corner))
    return repeated({corner.u, corner.v, sign_of(q.winding), 0}, q.winding);
  if (q.shape.degree == 1) return Bilinear(q).zeros();
  Search search(q);
  if (q.one_way && std::abs(q.winding) == 1) {
    const PatchZero zero = search.newton(q.guess);
    if (zero.sign == q.winding && zero.outside < kSame) return repeated(taken_in(q, zero), 1);
  }
  if (is_edge_on(ray_of(q))) return edge_on(q);
  return search.zeros();
}

}  // namespace hiac
