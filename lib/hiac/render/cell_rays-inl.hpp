// Fields along rays through cells of any kind, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_CELL_RAYS_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_CELL_RAYS_INL
#    undef HIAC_RENDER_CELL_RAYS_INL
#  else
#    define HIAC_RENDER_CELL_RAYS_INL
#  endif

#  include <hwy/highway.h>

#  include "hiac/render/cell_polynomials.hpp"
#  include "hiac/render/chebyshev_points.hpp"
#  include "hiac/render/polynomial_walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct LanePoint {
  V c[3];
};

// A cube polynomial, of degree P, by Horner's rule.
template <std::size_t P, class D, class V = hn::Vec<D>>
HWY_INLINE V value_of(D d, const CubePolynomial& f, const LanePoint<V>& at) {
  constexpr std::size_t kN = P + 1;
  V sum = hn::Zero(d);
  for (std::size_t k = kN; k-- > 0;) {
    V plane = hn::Zero(d);
    for (std::size_t j = kN; j-- > 0;) {
      const double* c = f.c.data() + (k * kN + j) * kN;
      V line = hn::Set(d, c[P]);
      for (std::size_t i = P; i-- > 0;) line = hn::MulAdd(line, at.c[0], hn::Set(d, c[i]));
      plane = j == P ? line : hn::MulAdd(plane, at.c[1], line);
    }
    sum = k == P ? plane : hn::MulAdd(sum, at.c[2], plane);
  }
  return sum;
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V value_of(D d, const CubePolynomial& f, const LanePoint<V>& at) {
  return f.degree == 1   ? value_of<1>(d, f, at)
         : f.degree == 2 ? value_of<2>(d, f, at)
                         : value_of<3>(d, f, at);
}

// The same with its gradient.
template <std::size_t P, class D, class V = hn::Vec<D>>
HWY_INLINE void value_and_gradient(D d, const CubePolynomial& f, const LanePoint<V>& at, V& value,
                                   V (&gradient)[3]) {
  constexpr std::size_t kN = P + 1;
  const auto& [u, v, w] = at.c;
  if constexpr (P == 1) {  // as most maps are
    const auto along_u = [&](std::size_t k) {
      return hn::MulAdd(hn::Set(d, f.c[k + 1]), u, hn::Set(d, f.c[k]));
    };
    const auto slope = [&](std::size_t k) {
      return hn::MulAdd(hn::Set(d, f.c[k + 5]), w, hn::Set(d, f.c[k + 1]));
    };
    const V by_vw = along_u(6), by_w = along_u(4);
    gradient[0] = hn::MulAdd(slope(2), v, slope(0));
    gradient[1] = hn::MulAdd(by_vw, w, along_u(2));
    gradient[2] = hn::MulAdd(by_vw, v, by_w);
    value = hn::MulAdd(gradient[1], v, hn::MulAdd(by_w, w, along_u(0)));
    return;
  }
  const V zero = hn::Zero(d);
  value = gradient[0] = gradient[1] = gradient[2] = zero;
  for (std::size_t k = kN; k-- > 0;) {
    V plane = zero, by_u = zero, by_v = zero;
    for (std::size_t j = kN; j-- > 0;) {
      const double* c = f.c.data() + (k * kN + j) * kN;
      V line = hn::Set(d, c[P]), slope = zero;
      for (std::size_t i = P; i-- > 0;) {
        slope = i + 1 == P ? line : hn::MulAdd(slope, u, line);
        line = hn::MulAdd(line, u, hn::Set(d, c[i]));
      }
      by_v = hn::MulAdd(by_v, v, plane);
      plane = hn::MulAdd(plane, v, line);
      by_u = hn::MulAdd(by_u, v, slope);
    }
    gradient[2] = hn::MulAdd(gradient[2], w, value);
    value = hn::MulAdd(value, w, plane);
    gradient[0] = hn::MulAdd(gradient[0], w, by_u);
    gradient[1] = hn::MulAdd(gradient[1], w, by_v);
  }
}

// Collapsed coordinates from which those where rays enter and leave the cell may be found.
template <class V>
struct RayStarts {
  LanePoint<V> front, back;
};

// The rays of one vector of segments through one cell.
template <class D>
class CellRays {
 public:
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  // Relative to the cell's origin. `starts` come to be those for the next segments.
  CellRays(D d, const CellPolynomials& cell, const V (&origin)[3], const V (&direction)[3], V front,
           V back, RayStarts<V>& starts)
      : d_(d), cell_(cell), front_(front), back_(back), starts_(starts) {
    for (std::size_t a = 0; a < 3; ++a) {
      origin_[a] = origin[a];
      direction_[a] = direction[a];
    }
    if (!cell.affine) return;
    const LanePoint<V> from = place(front_), to = place(back_);
    for (std::size_t a = 0; a < 3; ++a) {
      const auto along = [&](const LanePoint<V>& p) {
        return hn::MulAdd(hn::Set(d, cell.inverse[a][0]), p.c[0],
                          hn::MulAdd(hn::Set(d, cell.inverse[a][1]), p.c[1],
                                     hn::Mul(hn::Set(d, cell.inverse[a][2]), p.c[2])));
      };
      xi_front_.c[a] = along(from);
      xi_change_.c[a] = hn::Sub(along(to), xi_front_.c[a]);
    }
  }

  // Where the rays are known to be near the front, or near the back.
  void start_at(const LanePoint<V>& known) { starts_ = {known, known}; }

  // Collapsed coordinates at the Chebyshev points of [begin, end]; an even `degree` where the cell
  // is not affine. Lanes for which they are not found are taken off `active`.
  HWY_NOINLINE void sample(double begin, double end, std::size_t degree, M& active) {
    const ChebyshevPoints& points = chebyshev_points(degree);
    const auto u = [&](std::size_t j) { return begin + (end - begin) * points.place(j); };
    if (cell_.affine) {
      for (std::size_t j = 0; j <= degree; ++j) {
        const V part = hn::Set(d_, u(j));
        LanePoint<V> xi;
        for (std::size_t a = 0; a < 3; ++a)
          xi.c[a] = hn::MulAdd(part, xi_change_.c[a], xi_front_.c[a]);
        at_[j] = collapsed_in(xi);
      }
      return;
    }
    at_[0] = starts_.front;
    at_[degree] = starts_.back;
    find_at(u(0), at_[0], active);
    find_at(u(degree), at_[degree], active);
    starts_ = {at_[0], at_[degree]};
    for (const PointPrediction& p : points_in_turn(degree)) {
      at_[p.point] = predicted(p, at_);
      find_at(u(p.point), at_[p.point], active);
    }
  }

  // The same where they are known at the points of another degree.
  HWY_NOINLINE void sample_again(double begin, double end, std::size_t known, std::size_t degree,
                                 M& active) {
    if (cell_.affine) return sample(begin, end, degree, active);
    LanePoint<V> before[kMostChebyshevDegree + 1];
    for (std::size_t j = 0; j <= known; ++j) before[j] = at_[j];
    const ChebyshevPoints& points = chebyshev_points(degree);
    for (const PointPrediction& p : points_from(known, degree)) {
      at_[p.point] = predicted(p, before);
      if (p.from.size() == 1) continue;
      find_at(begin + (end - begin) * points.place(p.point), at_[p.point], active);
    }
  }

  // What the ends of the next part are found from: of the points of `degree`.
  [[nodiscard]] RayStarts<V> starts(std::size_t front, std::size_t back) const {
    return {at_[front], at_[back]};
  }

  // A field's values at the points of sample(), front to back, in its bounds.
  HWY_NOINLINE void values(const CellPolynomials::Field& field, std::size_t degree,
                           V* value) const {
    const V least = hn::Set(d_, field.least - field.base);
    const V most = hn::Set(d_, field.most - field.base);
    for (std::size_t j = 0; j <= degree; ++j)
      value[j] = hn::Min(hn::Max(value_of(d_, field.f, at_[j]), least), most);
  }

  // What of a field's values is rounding (FieldAlongRay::rounding).
  HWY_INLINE V rounding(const CellPolynomials::Field& field) const {
    const V farthest = hn::Max(hn::Abs(front_), hn::Abs(back_));
    V from = hn::Zero(d_), step = hn::Zero(d_);
    for (std::size_t a = 0; a < 3; ++a) {
      from = hn::Max(from, hn::Abs(origin_[a]));
      step = hn::Max(step, hn::Abs(direction_[a]));
    }
    constexpr double kEpsilon = 0x1p-52;
    const double value = kEpsilon * 4 * std::max(std::abs(field.least), std::abs(field.most));
    const double point = kEpsilon * 8 * cell_.steepness * (field.most - field.least);
    return hn::MulAdd(hn::MulAdd(farthest, step, from), hn::Set(d_, point), hn::Set(d_, value));
  }

 private:
  static constexpr double kMargin = 1e-3;  // outside the cell roots belong to other branches
  static constexpr int kMostSteps = 10;
  // the next step would be as short as this one squared
  static constexpr double kLastStep = 0x1p26;  // its inverse

  HWY_INLINE void find_at(double u, LanePoint<V>& at, M& active) const {
    const V t = hn::MulAdd(hn::Set(d_, u), hn::Sub(back_, front_), front_);
    active = hn::And(active, find(place(t), at, active));
  }

  [[nodiscard]] HWY_INLINE LanePoint<V> place(V t) const {
    LanePoint<V> p;
    for (std::size_t a = 0; a < 3; ++a) p.c[a] = hn::MulAdd(t, direction_[a], origin_[a]);
    return p;
  }

  // In the reference cell quotients are in [0, 1].
  [[nodiscard]] HWY_INLINE V quotient(V a, V b) const {
    const V q = hn::Div(a, hn::Max(b, hn::Set(d_, 1e-300)));
    return hn::Min(hn::Max(q, hn::Set(d_, -kMargin)), hn::Set(d_, 1 + kMargin));
  }

  // collapsed() of cell_polynomials.hpp.
  [[nodiscard]] HWY_INLINE LanePoint<V> collapsed_in(const LanePoint<V>& xi) const {
    const auto& [x, y, z] = xi.c;
    const V one = hn::Set(d_, 1.0);
    switch (cell_.shape) {
      case CellShape::tetrahedron: {
        const V rest = hn::Sub(one, z);
        return {{quotient(x, hn::Sub(rest, y)), quotient(y, rest), z}};
      }
      case CellShape::pyramid: {
        const V rest = hn::Sub(one, z);
        return {{quotient(x, rest), quotient(y, rest), z}};
      }
      case CellShape::prism:
        return {{quotient(x, hn::Sub(one, y)), y, z}};
      case CellShape::wedge:
        return {{quotient(x, hn::Sub(hn::Sub(hn::Set(d_, 2.0), y), z)), y, z}};
      case CellShape::brick:
        break;
    }
    return xi;
  }

  [[nodiscard]] HWY_INLINE LanePoint<V> predicted(const PointPrediction& prediction,
                                                  const LanePoint<V>* known) const {
    LanePoint<V> p{{hn::Zero(d_), hn::Zero(d_), hn::Zero(d_)}};
    for (std::size_t i = 0; i < prediction.from.size(); ++i) {
      const V weight = hn::Set(d_, prediction.weights[i]);
      const LanePoint<V>& from = known[prediction.from[i]];
      for (std::size_t a = 0; a < 3; ++a) p.c[a] = hn::MulAdd(weight, from.c[a], p.c[a]);
    }
    return p;
  }

  // Newton's iteration from `at` for the point that the map takes to `target`. True where it
  // converges to one in the cell; the others are put into the middle.
  HWY_INLINE M find(const LanePoint<V>& target, LanePoint<V>& at, M active) const {
    const std::size_t degree = cell_.position[0].degree;
    if (degree == 1) return find_by<1>(target, at, active);
    return degree == 2 ? find_by<2>(target, at, active) : find_by<3>(target, at, active);
  }

  template <std::size_t P>
  HWY_NOINLINE M find_by(const LanePoint<V>& target, LanePoint<V>& at, M active) const {
    M found = hn::Lt(hn::Set(d_, 1.0), hn::Zero(d_));
    for (int step = 0; step < kMostSteps; ++step) {
      V off[3], g[3][3];
      for (std::size_t a = 0; a < 3; ++a) {
        V value;
        value_and_gradient<P>(d_, cell_.position[a], at, value, g[a]);
        off[a] = hn::Sub(target.c[a], value);
      }
      // Cramer's rule: columns b_0, b_1, b_2 of g, change_k = det(.. off ..) / det
      const auto minor = [&](std::size_t a, std::size_t b, std::size_t i, std::size_t j) {
        return hn::MulSub(g[a][i], g[b][j], hn::Mul(g[a][j], g[b][i]));
      };
      V inverse[3][3];  // adjugate
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t a = 0; a < 3; ++a)
          inverse[i][a] = minor((a + 1) % 3, (a + 2) % 3, (i + 1) % 3, (i + 2) % 3);
      const V det = hn::MulAdd(g[0][0], inverse[0][0],
                               hn::MulAdd(g[1][0], inverse[0][1], hn::Mul(g[2][0], inverse[0][2])));
      const V scale = hn::Div(hn::Set(d_, 1.0), det);
      V largest = hn::Zero(d_);
      for (std::size_t i = 0; i < 3; ++i) {
        const V sum = hn::MulAdd(inverse[i][0], off[0],
                                 hn::MulAdd(inverse[i][1], off[1], hn::Mul(inverse[i][2], off[2])));
        const V change = hn::Mul(sum, scale);
        at.c[i] = hn::Add(at.c[i], change);
        largest = hn::Max(largest, hn::Abs(change));
      }
      found = hn::Le(hn::Mul(largest, hn::Set(d_, kLastStep)), nearness(at));
      if (hn::AllTrue(d_, hn::Or(hn::Not(active), found))) break;
    }
    for (std::size_t a = 0; a < 3; ++a)
      found = hn::And(found, hn::And(hn::Ge(at.c[a], hn::Set(d_, -kMargin)),
                                     hn::Le(at.c[a], hn::Set(d_, 1 + kMargin))));
    for (std::size_t a = 0; a < 3; ++a)
      at.c[a] = hn::IfThenElse(found, at.c[a], hn::Set(d_, cell_.middle[a]));
    return found;
  }

  // Over what distance the Jacobian changes: it vanishes where the cell tapers.
  [[nodiscard]] HWY_INLINE V nearness(const LanePoint<V>& at) const {
    const V one = hn::Set(d_, 1.0);
    const V v = hn::Sub(one, at.c[1]), w = hn::Sub(one, at.c[2]);
    switch (cell_.shape) {
      case CellShape::tetrahedron:
        return hn::Mul(hn::Abs(v), hn::Abs(w));
      case CellShape::pyramid:
        return hn::Abs(w);
      case CellShape::prism:
        return hn::Abs(v);
      case CellShape::wedge:
        return hn::Min(hn::Abs(hn::Add(v, w)), one);
      case CellShape::brick:
        break;
    }
    return one;
  }

  D d_;
  const CellPolynomials& cell_;
  V front_, back_;
  RayStarts<V>& starts_;
  V origin_[3], direction_[3];
  LanePoint<V> xi_front_, xi_change_;          // of affine cells
  LanePoint<V> at_[kMostChebyshevDegree + 1];  // what is sampled
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
