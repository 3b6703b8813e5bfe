#include "tests/order/exact_relation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>

#include <gmpxx.h>

namespace hiac::test {
namespace {

__extension__ using Int128 = __int128;

// Coordinates of at most so many bits have determinants of at most 127 bits.
constexpr int kShortBits = 40;

// A point or vector: exactly, as integer multiples of a power of two, and as it was given.
template <typename Int>
struct Exact {
  std::array<Int, 3> exact;
  std::array<double, 3> given;
};

// The powers of two of which a value's lowest and highest bits are multiples.
struct BitRange {
  int low = std::numeric_limits<int>::max(), high = std::numeric_limits<int>::min();

  void include(double value) {
    if (value == 0) return;
    int exponent = 0;
    auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    int lowest = exponent - 53;
    for (; mantissa % 2 == 0; mantissa /= 2) ++lowest;
    low = std::min(low, lowest);
    high = std::max(high, exponent);
  }
  [[nodiscard]] int bits() const { return low > high ? 0 : high - low; }
};

BitRange bits_of_points(const ZooMesh& mesh, const View& view) {
  BitRange range;
  for (const double x : mesh.xyz) range.include(x);
  if (view.perspective)
    for (const double x : view.eye) range.include(x);
  return range;
}

BitRange bits_of_direction(const View& view) {
  BitRange range;
  if (!view.perspective)
    for (const double x : view.direction) range.include(x);
  return range;
}

// value / 2^low, an integer.
Int128 scaled(double value, int low, Int128 /*of this type*/) {
  return value == 0 ? 0 : static_cast<Int128>(std::ldexp(value, -low));
}
mpz_class scaled(double value, int low, const mpz_class& /*of this type*/) {
  if (value == 0) return 0;
  int exponent = 0;
  mpz_class mantissa(std::ldexp(std::frexp(value, &exponent), 53));
  const int shift = exponent - 53 - low;
  return shift >= 0 ? mpz_class(mantissa << static_cast<unsigned>(shift))
                    : mpz_class(mantissa >> static_cast<unsigned>(-shift));
}

template <typename Int>
Exact<Int> exact(const std::array<double, 3>& p, int low) {
  return {{scaled(p[0], low, Int{}), scaled(p[1], low, Int{}), scaled(p[2], low, Int{})}, p};
}

int sign_of(const Int128& x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
int sign_of(const mpz_class& x) { return sgn(x); }

template <typename Number>
using Triple = std::array<Number, 3>;

template <typename Number>
Number determinant(const Triple<Number>& u, const Triple<Number>& v, const Triple<Number>& w) {
  return Number(u[0] * Number(v[1] * w[2] - v[2] * w[1])) +
         Number(u[1] * Number(v[2] * w[0] - v[0] * w[2])) +
         Number(u[2] * Number(v[0] * w[1] - v[1] * w[0]));
}

template <typename Number>
Triple<Number> minus(const Triple<Number>& a, const Triple<Number>& b) {
  return {Number(a[0] - b[0]), Number(a[1] - b[1]), Number(a[2] - b[2])};
}

// |a| + |b|: bounds the rounding of a - b.
Triple<double> size(const Triple<double>& a, const Triple<double>& b) {
  return {std::abs(a[0]) + std::abs(b[0]), std::abs(a[1]) + std::abs(b[1]),
          std::abs(a[2]) + std::abs(b[2])};
}

double permanent(const Triple<double>& u, const Triple<double>& v, const Triple<double>& w) {
  return u[0] * (v[1] * w[2] + v[2] * w[1]) + u[1] * (v[2] * w[0] + v[0] * w[2]) +
         u[2] * (v[0] * w[1] + v[1] * w[0]);
}

// The sign of a rounded determinant where it is certain by orders of magnitude, else 0.
int surely(double value, double bound) {
  if (!(bound > 1e-280 && bound < 1e280)) return 0;
  return value > 1e-13 * bound ? 1 : value < -1e-13 * bound ? -1 : 0;
}

// The sign of det[b - a, c - a, d - a].
template <typename Int>
int side(const Exact<Int>& a, const Exact<Int>& b, const Exact<Int>& c, const Exact<Int>& d) {
  if (d.given == a.given || d.given == b.given || d.given == c.given) return 0;
  if constexpr (!std::is_same_v<Int, Int128>) {
    const int certain = surely(
        determinant(minus(b.given, a.given), minus(c.given, a.given), minus(d.given, a.given)),
        permanent(size(b.given, a.given), size(c.given, a.given), size(d.given, a.given)));
    if (certain != 0) return certain;
  }
  return sign_of(
      determinant(minus(b.exact, a.exact), minus(c.exact, a.exact), minus(d.exact, a.exact)));
}

// The sign of det[b - a, c - a, v].
template <typename Int>
int side_towards(const Exact<Int>& a, const Exact<Int>& b, const Exact<Int>& c,
                 const Exact<Int>& v) {
  if constexpr (!std::is_same_v<Int, Int128>) {
    const int certain =
        surely(determinant(minus(b.given, a.given), minus(c.given, a.given), v.given),
               permanent(size(b.given, a.given), size(c.given, a.given), size(v.given, {})));
    if (certain != 0) return certain;
  }
  return sign_of(determinant(minus(b.exact, a.exact), minus(c.exact, a.exact), v.exact));
}

template <typename Int>
class PairwiseTruth {
 public:
  PairwiseTruth(const ZooMesh& mesh, const View& view) : perspective_(view.perspective) {
    const int low = bits_of_points(mesh, view).low;
    eye_ = perspective_ ? exact<Int>(view.eye, low)
                        : exact<Int>(view.direction, bits_of_direction(view).low);
    std::vector<Exact<Int>> points;
    for (NodeId node = 0; node < mesh.node_count(); ++node) {
      const auto p = mesh.position(node);
      points.push_back(exact<Int>({p[0], p[1], p[2]}, low));
    }
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
      Body body;
      for (const NodeId node : mesh.cell_nodes(cell).first(corner_count(mesh.kinds[cell])))
        body.corners.push_back(points[node]);
      find_planes(body);
      bodies_.push_back(std::move(body));
    }
  }

  [[nodiscard]] ExactRelation relation() const {
    ExactRelation result;
    for (CellId p = 0; p < bodies_.size(); ++p) {
      if (bodies_[p].hull.empty()) result.flat.push_back(p);
      for (CellId q = p + 1; q < bodies_.size(); ++q) {
        if (bodies_[p].hull.empty() || bodies_[q].hull.empty()) continue;
        if (seen_apart(bodies_[p], bodies_[q])) continue;
        const int first = nearer(bodies_[p], bodies_[q]);
        if (first == 0) result.overlapping.emplace_back(p, q);
        if (first > 0) result.arrows.emplace_back(p, q);
        if (first < 0) result.arrows.emplace_back(q, p);
      }
    }
    return result;
  }

 private:
  // Corners of a body, by number; the body lies where the orientation is `inside` or 0.
  struct Plane {
    std::array<std::size_t, 3> corners;
    int inside;
  };
  struct Edge {
    std::array<std::size_t, 2> corners;
    int inside;
  };
  struct Body {
    std::vector<Exact<Int>> corners;
    std::vector<Plane> hull;  // empty for a body without volume
    std::vector<Edge> seen;   // edges of its outline: planes through the eye that hold all of it
  };

  // The side of the plane through the eye, a and b on which c is seen: that of the plane of a, b
  // and c on which the eye is.
  int seen_side(const Exact<Int>& a, const Exact<Int>& b, const Exact<Int>& c) const {
    if (c.given == a.given || c.given == b.given) return 0;
    return perspective_ ? side(a, b, c, eye_) : -side_towards(a, b, c, eye_);
  }

  // The sides of a plane on which corners lie: -1 or 1 when on one alone, 0 when all are in it, 2
  // when on both.
  template <typename Side>
  static int sides_of(std::span<const Exact<Int>> corners, const Side& side_of) {
    int sides = 0;
    for (const auto& corner : corners) {
      const int s = side_of(corner);
      if (s * sides < 0) return 2;
      if (s != 0) sides = s;
    }
    return sides;
  }

  // Each plane once: a side of more than three corners is that of many triples.
  void find_planes(Body& body) const {
    const auto& c = body.corners;
    for (std::size_t i = 0; i < c.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        for (std::size_t k = 0; k < j; ++k) {
          const bool known = std::ranges::any_of(body.hull, [&](const Plane& plane) {
            const auto& [a, b, d] = plane.corners;
            return side(c[a], c[b], c[d], c[i]) == 0 && side(c[a], c[b], c[d], c[j]) == 0 &&
                   side(c[a], c[b], c[d], c[k]) == 0;
          });
          if (known) continue;
          const int inside =
              sides_of(std::span(c), [&](const auto& p) { return side(c[i], c[j], c[k], p); });
          if (inside == 1 || inside == -1) body.hull.push_back({{i, j, k}, inside});
        }
        const int inside =
            sides_of(std::span(c), [&](const auto& p) { return seen_side(c[i], c[j], p); });
        if (inside == 1 || inside == -1) body.seen.push_back({{i, j}, inside});
      }
  }

  // Whether no ray meets the inner of both: whether a plane through the eye has them on different
  // sides, or (one of them) in it. It is enough to try those through two of their corners: the
  // normals of all such planes are a pointed cone, and these are its edges.
  bool seen_apart(const Body& p, const Body& q) const {
    const auto beyond_outline = [&](const Body& a, const Body& b) {
      return std::ranges::any_of(a.seen, [&](const Edge& edge) {
        return std::ranges::all_of(b.corners, [&](const auto& x) {
          return seen_side(a.corners[edge.corners[0]], a.corners[edge.corners[1]], x) *
                     edge.inside <=
                 0;
        });
      });
    };
    if (beyond_outline(p, q) || beyond_outline(q, p)) return true;
    for (const auto& a : p.corners)
      for (const auto& b : q.corners) {
        const auto side_of = [&](const auto& x) { return seen_side(a, b, x); };
        const int of_p = sides_of(std::span(p.corners), side_of);
        if (of_p != 1 && of_p != -1) continue;  // in the plane: a and b are in line with the eye
        const int of_q = sides_of(std::span(q.corners), side_of);
        if (of_q == -of_p) return true;
      }
    return false;
  }

  // 1 when p is on the eye's side of a plane that separates the two, -1 when q is, 0 when there is
  // no such plane.
  int nearer(const Body& p, const Body& q) const {
    if (const int sign = by_hull(p, q); sign != 0) return sign;
    if (const int sign = by_hull(q, p); sign != 0) return -sign;
    if (const int sign = by_edge_and_corner(p, q); sign != 0) return sign;
    return -by_edge_and_corner(q, p);
  }

  int by_hull(const Body& p, const Body& q) const {
    for (const Plane& plane : p.hull) {
      const auto &a = p.corners[plane.corners[0]], &b = p.corners[plane.corners[1]],
                 &c = p.corners[plane.corners[2]];
      const bool apart = std::ranges::all_of(
          q.corners, [&](const auto& x) { return side(a, b, c, x) * plane.inside <= 0; });
      if (apart) return seen_side(a, b, c) * plane.inside;
    }
    return 0;
  }

  int by_edge_and_corner(const Body& p, const Body& q) const {
    for (std::size_t i = 0; i < p.corners.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (const auto& c : q.corners) {
          const auto &a = p.corners[i], &b = p.corners[j];
          const auto side_of = [&](const auto& x) { return side(a, b, c, x); };
          const int of_p = sides_of(std::span(p.corners), side_of);
          if (of_p != 1 && of_p != -1) continue;
          if (sides_of(std::span(q.corners), side_of) == -of_p) return seen_side(a, b, c) * of_p;
        }
    return 0;
  }

  bool perspective_;
  Exact<Int> eye_;  // orthographic: the direction
  std::vector<Body> bodies_;
};

}  // namespace

ExactRelation exact_relation(const ZooMesh& mesh, const View& view) {
  const bool are_short = bits_of_points(mesh, view).bits() <= kShortBits &&
                         bits_of_direction(view).bits() <= kShortBits;
  return are_short ? PairwiseTruth<Int128>(mesh, view).relation()
                   : exact_relation_in_gmp(mesh, view);
}

ExactRelation exact_relation_in_gmp(const ZooMesh& mesh, const View& view) {
  return PairwiseTruth<mpz_class>(mesh, view).relation();
}

}  // namespace hiac::test
