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

  // Collapsed coordinates at the Chebyshev points of [begin, end]; `refine`: those of `degree` that
  // are not of half of it. Lanes for which they are not found are taken off `active`.
  HWY_NOINLINE void sample(double begin, double end, std::size_t degree, bool refine, M& active) {
    if (!cell_.affine && !refine) return sample_five(begin, end, active);
    const ChebyshevPoints& points = chebyshev_points(degree);
    const std::size_t stride = cell_.exact_degree > 0 ? 1 : kMostChebyshevDegree / degree;
    for (std::size_t j = refine ? 1 : 0; j <= degree; j += refine ? 2 : 1) {
      LanePoint<V>& here = at_[j * stride];
      const double u = begin + (end - begin) * points.place(j);
      if (cell_.affine) {
        LanePoint<V> xi;
        for (std::size_t a = 0; a < 3; ++a)
          xi.c[a] = hn::MulAdd(hn::Set(d_, u), xi_change_.c[a], xi_front_.c[a]);
        here = collapsed_in(xi);
        continue;
      }
      here = predicted(degree, j);
      find_at(u, here, active);
    }
  }

  // A field's values at the points of sample(), front to back, in its bounds.
  HWY_NOINLINE void values(const CellPolynomials::Field& field, std::size_t degree,
                           V* value) const {
    const std::size_t stride = cell_.exact_degree > 0 ? 1 : kMostChebyshevDegree / degree;
    const V least = hn::Set(d_, field.least - field.base);
    const V most = hn::Set(d_, field.most - field.base);
    for (std::size_t j = 0; j <= degree; ++j)
      value[j] = hn::Min(hn::Max(value_of(d_, field.f, at_[j * stride]), least), most);
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

  // The points of degree 4: the ends, then those between them from where parabolas have them.
  void sample_five(double begin, double end, M& active) {
    const ChebyshevPoints& points = chebyshev_points(4);
    constexpr std::size_t kStride = kMostChebyshevDegree / 4;
    LanePoint<V>&front = at_[0], &middle = at_[2 * kStride], &back = at_[4 * kStride];
    const auto u = [&](std::size_t j) { return begin + (end - begin) * points.place(j); };
    front = starts_.front;
    back = starts_.back;
    find_at(u(0), front, active);
    find_at(u(4), back, active);
    starts_ = {front, back};
    const V half = hn::Set(d_, 0.5);
    for (std::size_t a = 0; a < 3; ++a) middle.c[a] = hn::Mul(half, hn::Add(front.c[a], back.c[a]));
    find_at(u(2), middle, active);
    // Lagrange's weights at (1 - sqrt(1/2)) / 2
    const V near = hn::Set(d_, 0.60355339059327379), far = hn::Set(d_, -0.10355339059327377);
    for (std::size_t a = 0; a < 3; ++a) {
      const V shared = hn::Mul(half, middle.c[a]);
      at_[kStride].c[a] = hn::MulAdd(near, front.c[a], hn::MulAdd(far, back.c[a], shared));
      at_[3 * kStride].c[a] = hn::MulAdd(near, back.c[a], hn::MulAdd(far, front.c[a], shared));
    }
    find_at(u(1), at_[kStride], active);
    find_at(u(3), at_[3 * kStride], active);
  }

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

  // From the points of half the degree, the polynomial through them at point j.
  [[nodiscard]] HWY_INLINE LanePoint<V> predicted(std::size_t degree, std::size_t j) const {
    const std::size_t half = degree / 2, stride = kMostChebyshevDegree / half;
    const std::vector<double>& weights = between_points(half)[j / 2];
    LanePoint<V> p{{hn::Zero(d_), hn::Zero(d_), hn::Zero(d_)}};
    for (std::size_t i = 0; i <= half; ++i)
      for (std::size_t a = 0; a < 3; ++a)
        p.c[a] = hn::MulAdd(hn::Set(d_, weights[i]), at_[i * stride].c[a], p.c[a]);
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
    const V zero = hn::Zero(d_);
    M found = hn::Lt(hn::Set(d_, 1.0), zero);
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
      V largest = zero;
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
