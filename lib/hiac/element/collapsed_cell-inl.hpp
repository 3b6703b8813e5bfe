// Collapsed coordinates (cell_polynomials.hpp) of points in cells, compiled once for every
// instruction set. Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_ELEMENT_COLLAPSED_CELL_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_ELEMENT_COLLAPSED_CELL_INL
#    undef HIAC_ELEMENT_COLLAPSED_CELL_INL
#  else
#    define HIAC_ELEMENT_COLLAPSED_CELL_INL
#  endif

#  include <cstddef>

#  include <hwy/highway.h>

#  include "hiac/element/cell_polynomials.hpp"
#  include "hiac/element/cube_polynomial-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// f.operator()<shape>().
template <class F>
HWY_INLINE void with_shape(CellShape shape, F&& f) {
  switch (shape) {
    case CellShape::tetrahedron:
      return f.template operator()<CellShape::tetrahedron>();
    case CellShape::pyramid:
      return f.template operator()<CellShape::pyramid>();
    case CellShape::prism:
      return f.template operator()<CellShape::prism>();
    case CellShape::wedge:
      return f.template operator()<CellShape::wedge>();
    case CellShape::brick:
      return f.template operator()<CellShape::brick>();
  }
}

// One cell, and points of it in every lane.
template <class D>
class CollapsedCell {
 public:
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  CollapsedCell(D d, const CellPolynomials& cell) : d_(d), cell_(cell) {}

  // Whether points are in the cell to within kMargin.
  [[nodiscard]] HWY_INLINE M inside(const LanePoint<V>& at) const {
    const V low = hn::Set(d_, -kMargin), high = hn::Set(d_, 1 + kMargin);
    const auto holds = [&](V x) { return hn::And(hn::Ge(x, low), hn::Le(x, high)); };
    return hn::And(holds(at.c[0]), hn::And(holds(at.c[1]), holds(at.c[2])));
  }

  // A quotient that is in [0, 1] for points of the reference cell.
  [[nodiscard]] HWY_INLINE V quotient(V a, V b) const {
    return near_cell(hn::Div(a, at_least_tiny(b)));
  }

  // The divisor of x in collapsed(), and of y in pyramids, in cells that taper to an edge or a tip.
  [[nodiscard]] HWY_INLINE V width_of(const LanePoint<V>& xi) const {
    const V one = hn::Set(d_, 1.0), width = hn::Sub(one, xi.c[2]);
    return cell_.shape == CellShape::wedge ? hn::Add(width, hn::Sub(one, xi.c[1])) : width;
  }

  // collapsed() of cell_polynomials.hpp, in every lane.
  template <CellShape kShape>
  [[nodiscard]] HWY_INLINE LanePoint<V> collapsed(const LanePoint<V>& xi) const {
    const auto& [x, y, z] = xi.c;
    const V one = hn::Set(d_, 1.0);
    if constexpr (kShape == CellShape::tetrahedron) {
      const V w = hn::Sub(one, z), rest = hn::Sub(w, y);
      return {{quotient(x, rest), quotient(rest, w), w}};
    } else if constexpr (kShape == CellShape::pyramid) {
      const V w = hn::Sub(one, z), inverse = hn::Div(one, at_least_tiny(w));
      return {{near_cell(hn::Mul(x, inverse)), near_cell(hn::Mul(y, inverse)), w}};
    } else if constexpr (kShape == CellShape::prism) {
      const V v = hn::Sub(one, y);
      return {{quotient(x, v), v, z}};
    } else if constexpr (kShape == CellShape::wedge) {
      const V v = hn::Sub(one, y), w = hn::Sub(one, z);
      return {{quotient(x, hn::Add(v, w)), v, w}};
    } else {
      return xi;
    }
  }

  // Finds, by Newton's iteration from `at`, the point that the map takes to `target`. Returns the
  // lanes in which it converges to a point in the cell; the others are set to the middle.
  HWY_INLINE M find(const LanePoint<V>& target, LanePoint<V>& at, M active) const {
    const std::size_t degree = cell_.position[0].degree;
    if (degree == 1) return find_by<1>(target, at, active);
    return degree == 2 ? find_by<2>(target, at, active) : find_by<3>(target, at, active);
  }

  // The width of the reference cell along collapsed coordinates.
  [[nodiscard]] HWY_INLINE LanePoint<V> widths(const LanePoint<V>& at) const {
    const V one = hn::Set(d_, 1.0);
    if (cell_.of_reference) return {{one, one, one}};
    const V v = at.c[1], w = at.c[2];
    switch (cell_.shape) {
      case CellShape::tetrahedron:
        return {{hn::Mul(v, w), w, one}};
      case CellShape::pyramid:
        return {{w, w, one}};
      case CellShape::prism:
        return {{v, one, one}};
      case CellShape::wedge:
        return {{hn::Add(v, w), one, one}};
      case CellShape::brick:
        break;
    }
    return {{one, one, one}};
  }

 private:
  static constexpr double kMargin = 1e-3;  // farther outside, roots belong to other branches
  static constexpr int kMostSteps = 10;
  // the next step would be about the square of this one
  static constexpr double kLastStep = 0x1p26;  // 1 / the step length

  template <std::size_t P>
  HWY_NOINLINE M find_by(const LanePoint<V>& target, LanePoint<V>& at, M active) const {
    M found = hn::Lt(hn::Set(d_, 1.0), hn::Zero(d_));
    for (int step = 0; step < kMostSteps; ++step) {
      JacobianSolver<V> jacobian;
      V off[3];
      for (std::size_t a = 0; a < 3; ++a) {
        V value;
        value_and_gradient<P>(d_, cell_.position[a], at, value, jacobian.row[a]);
        off[a] = hn::Sub(target.c[a], value);
      }
      jacobian.prepare(d_);
      const LanePoint<V> change = jacobian.solve(off);
      V largest = hn::Zero(d_);
      for (std::size_t a = 0; a < 3; ++a) {
        at.c[a] = hn::Add(at.c[a], change.c[a]);
        largest = hn::Max(largest, hn::Abs(change.c[a]));
      }
      found = hn::Le(hn::Mul(largest, hn::Set(d_, kLastStep)), nearness(at));
      if (hn::AllTrue(d_, hn::Or(hn::Not(active), found))) break;
    }
    found = hn::And(found, inside(at));
    for (std::size_t a = 0; a < 3; ++a)
      at.c[a] = hn::IfThenElse(found, at.c[a], hn::Set(d_, cell_.middle[a]));
    return found;
  }

  // The distance over which the Jacobian changes: it vanishes at the narrow end of the cell.
  [[nodiscard]] HWY_INLINE V nearness(const LanePoint<V>& at) const {
    return hn::Min(hn::Abs(widths(at).c[0]), hn::Set(d_, 1.0));
  }

  [[nodiscard]] HWY_INLINE V at_least_tiny(V b) const { return hn::Max(b, hn::Set(d_, 1e-300)); }
  [[nodiscard]] HWY_INLINE V near_cell(V q) const {
    return hn::Min(hn::Max(q, hn::Set(d_, -kMargin)), hn::Set(d_, 1 + kMargin));
  }

  D d_;
  const CellPolynomials& cell_;
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
