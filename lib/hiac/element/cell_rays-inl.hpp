// Fields along rays through cells of any kind, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_CELL_RAYS_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_CELL_RAYS_INL
#    undef HIAC_RENDER_CELL_RAYS_INL
#  else
#    define HIAC_RENDER_CELL_RAYS_INL
#  endif

#  include <hwy/highway.h>

#  include "hiac/base/rounding.hpp"
#  include "hiac/element/cell_polynomials.hpp"
#  include "hiac/element/chebyshev_points.hpp"
#  include "hiac/element/collapsed_cell-inl.hpp"
#  include "hiac/element/cube_polynomial-inl.hpp"
#  include "hiac/element/inverse_series-inl.hpp"
#  include "hiac/element/ray_rounding.hpp"
#  include "hiac/element/taper-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Collapsed coordinates from which Newton's iteration finds those of entry and exit points.
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

  // `origin` is relative to the cell's origin. `starts` is updated for the next segments.
  CellRays(D d, const CellPolynomials& cell, const V (&origin)[3], const V (&direction)[3], V front,
           V back, RayStarts<V>& starts)
      : d_(d),
        cell_(cell),
        front_(front),
        back_(back),
        starts_(starts),
        collapsed_(d, cell),
        by_series_(!cell.affine && !cell.twisted_pyramid && cell.position[0].degree == 1) {
    for (std::size_t a = 0; a < 3; ++a) {
      origin_[a] = origin[a];
      direction_[a] = direction[a];
    }
    if (!cell.affine && !cell.twisted_pyramid) return;
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

  // Sets the accuracy required of coordinates where the accuracy of a series is known only from its
  // decay.
  void set_accuracy(V accuracy) { accuracy_ = accuracy; }

  // Sets known coordinates of the rays near the front, or near the back, as starts.
  void start_at(const LanePoint<V>& known) {
    LanePoint<V> at = known;
    if (cell_.of_reference) at.c[0] = hn::Mul(at.c[0], at.c[1]);
    starts_ = {at, at};
  }

  // Selects the part [begin, end] of the rays. Returns false if the part must be halved, because
  // fields on the whole part would need too many points.
  HWY_INLINE bool open(double begin, double end, M& active) {
    begin_ = begin;
    end_ = end;
    sampled_ = 0;
    if (!by_series_) return true;
    LanePoint<V> middle;
    V step[3];
    const V half = hn::Mul(hn::Set(d_, 0.5 * (end - begin)), hn::Sub(back_, front_));
    for (std::size_t a = 0; a < 3; ++a) {
      middle.c[a] = hn::Mul(hn::Set(d_, 0.5), hn::Add(starts_.front.c[a], starts_.back.c[a]));
      step[a] = hn::Mul(half, direction_[a]);
    }
    find_at(0.5, middle, active);
    starts_ = {middle, middle};
    outcome_ = series_.expand(d_, cell_.position, middle, collapsed_.widths(middle), step,
                              accuracy_, active);
    return outcome_ != Outcome::hopeless;
  }

  // Computes the collapsed coordinates at the Chebyshev points of that part; their degree must be
  // even if the cell is not affine. Lanes whose coordinates are not found are removed from
  // `active`.
  HWY_NOINLINE void sample(const ChebyshevPoints& points, M& active) {
    if (cell_.affine)
      sample_line(points);
    else if (cell_.twisted_pyramid)
      sample_twisted(points, active);
    else if (by_series_)
      sample_series(points, active);
    else if (sampled_ == 0)
      sample_map(points, active);
    else
      sample_map_again(points, active);
    sampled_ = points.degree();
  }

  // In affine cells, the width to which the cell tapers at both ends of the part.
  [[nodiscard]] HWY_INLINE EndWidths<V> end_widths() const {
    const auto width = [&](double part) HWY_ATTR {
      return hn::Max(collapsed_.width_of(on_line(part)), hn::Zero(d_));
    };
    return {width(0), width(1)};
  }

  // The starts for the two halves of the part.
  struct Halves {
    RayStarts<V> front, back;
  };
  [[nodiscard]] HWY_INLINE Halves halves() const {
    if (!by_series_) {
      const LanePoint<V>& middle = at_[sampled_ / 2];
      return {{at_[0], middle}, {middle, at_[sampled_]}};
    }
    LanePoint<V> front, back;
    series_.at(d_, 0.5, front, back);
    return {{front, front}, {back, back}};
  }

  // Computes a field's values at the points of sample(), front to back, clamped to its bounds.
  HWY_NOINLINE void values(const CellPolynomials::Field& field, std::size_t degree,
                           V* value) const {
    with_shape(cell_.shape,
               [&]<CellShape kShape>() HWY_ATTR { values_of_shape<kShape>(field, degree, value); });
  }

  // The rounding error of a field's values (FieldAlongRay::rounding).
  HWY_INLINE V rounding(const CellPolynomials::Field& field) const {
    const V farthest = hn::Max(hn::Abs(front_), hn::Abs(back_));
    V from = hn::Zero(d_), step = hn::Zero(d_);
    for (std::size_t a = 0; a < 3; ++a) {
      from = hn::Max(from, hn::Abs(origin_[a]));
      step = hn::Max(step, hn::Abs(direction_[a]));
    }
    const double value =
        kUnit * kRayValueRounding * std::max(std::abs(field.least), std::abs(field.most));
    const double point = kUnit * kRayPointRounding * cell_.steepness * (field.most - field.least);
    return hn::MulAdd(hn::MulAdd(farthest, step, from), hn::Set(d_, point), hn::Set(d_, value));
  }

 private:
  template <CellShape kShape>
  HWY_INLINE void values_of_shape(const CellPolynomials::Field& field, std::size_t degree,
                                  V* value) const {
    if (field.f.degree == 1) return values_of_order<1, kShape>(field, degree, value);
    if (field.f.degree == 2) return values_of_order<2, kShape>(field, degree, value);
    return values_of_order<3, kShape>(field, degree, value);
  }

  template <std::size_t P, CellShape kShape>
  HWY_INLINE void values_of_order(const CellPolynomials::Field& field, std::size_t degree,
                                  V* value) const {
    const V least = hn::Set(d_, field.least - field.base);
    const V most = hn::Set(d_, field.most - field.base);
    for (std::size_t j = 0; j <= degree; ++j)
      value[j] = hn::Min(hn::Max(value_of<P, kShape>(d_, field.f, at_[j]), least), most);
  }

  using Outcome = typename InverseSeries<D>::Outcome;

  // Reference coordinates of a point of the part, computed from `inverse` alone.
  [[nodiscard]] HWY_INLINE LanePoint<V> on_line(double part) const {
    const V at = hn::Set(d_, begin_ + (end_ - begin_) * part);
    LanePoint<V> xi;
    for (std::size_t a = 0; a < 3; ++a) xi.c[a] = hn::MulAdd(at, xi_change_.c[a], xi_front_.c[a]);
    return xi;
  }

  // Does the work of sample() in affine cells.
  HWY_INLINE void sample_line(const ChebyshevPoints& points) {
    with_shape(cell_.shape, [&]<CellShape kShape>() HWY_ATTR {
      for (std::size_t j = 0; j <= points.degree(); ++j)
        at_[j] = collapsed_.template collapsed<kShape>(on_line(points.place(j)));
    });
  }

  // Does the work of sample() in twisted pyramids: with p the result of `inverse`, xi = p - twist q
  // turns q (1 - z) = x y into
  //     alpha q^2 + beta q - p_0 p_1 = 0,  alpha = twist_2 - twist_0 twist_1,
  //     beta = 1 - p_2 + twist_0 p_1 + twist_1 p_0.
  // 2 alpha q + beta is the Jacobian's determinant divided by that of A and by 1 - z. It is
  // positive, so that q is the root in which the square root is added.
  HWY_INLINE void sample_twisted(const ChebyshevPoints& points, M& active) {
    const std::size_t degree = points.degree();
    const V one = hn::Set(d_, 1.0), zero = hn::Zero(d_);
    const V t[3] = {hn::Set(d_, cell_.twist[0]), hn::Set(d_, cell_.twist[1]),
                    hn::Set(d_, cell_.twist[2])};
    const V two_alpha = hn::Mul(hn::Set(d_, 2.0), hn::NegMulAdd(t[0], t[1], t[2]));
    for (std::size_t j = 0; j <= degree; ++j) {
      LanePoint<V> xi = on_line(points.place(j));
      const V beta = hn::MulAdd(t[0], xi.c[1], hn::MulAdd(t[1], xi.c[0], hn::Sub(one, xi.c[2])));
      const V product = hn::Mul(hn::Set(d_, 2.0), hn::Mul(xi.c[0], xi.c[1]));
      const V square = hn::MulAdd(two_alpha, product, hn::Mul(beta, beta));
      active = hn::And(active, hn::Ge(square, zero));
      const V root = hn::Sqrt(hn::Max(square, zero));
      // the form without cancellation
      const M plus = hn::Ge(beta, zero);
      const V q = hn::Div(hn::IfThenElse(plus, product, hn::Sub(root, beta)),
                          hn::IfThenElse(plus, hn::Add(root, beta), two_alpha));
      for (std::size_t a = 0; a < 3; ++a) xi.c[a] = hn::NegMulAdd(t[a], q, xi.c[a]);
      at_[j] = collapsed_.template collapsed<CellShape::pyramid>(xi);
      active = hn::And(active, collapsed_.inside(at_[j]));
    }
  }

  // Does the work of sample() by the series, or by Newton's iteration from its result.
  HWY_INLINE void sample_series(const ChebyshevPoints& points, M& active) {
    const std::size_t degree = points.degree();
    for (std::size_t j = 0; 2 * j <= degree; ++j)
      series_.at(d_, 1 - 2 * points.place(j), at_[j], at_[degree - j]);
    if (outcome_ == Outcome::converged)
      active = hn::And(active, hn::And(collapsed_.inside(at_[0]), collapsed_.inside(at_[degree])));
    else
      for (std::size_t j = 0; j <= degree; ++j) find_at(points.place(j), at_[j], active);
    if (cell_.of_reference)
      for (std::size_t j = 0; j <= degree; ++j)
        at_[j].c[0] = collapsed_.quotient(at_[j].c[0], at_[j].c[1]);
  }

  HWY_INLINE void sample_map(const ChebyshevPoints& points, M& active) {
    const std::size_t degree = points.degree();
    at_[0] = starts_.front;
    at_[degree] = starts_.back;
    find_at(points.place(0), at_[0], active);
    find_at(points.place(degree), at_[degree], active);
    starts_ = {at_[0], at_[degree]};
    for (const PointPrediction& p : points_in_turn(degree)) {
      at_[p.point] = predicted(p, at_);
      find_at(points.place(p.point), at_[p.point], active);
    }
  }

  // Does the work of sample() if coordinates are known at the points of another degree.
  HWY_INLINE void sample_map_again(const ChebyshevPoints& points, M& active) {
    const std::size_t degree = points.degree();
    LanePoint<V> before[kMostChebyshevDegree + 1];
    for (std::size_t j = 0; j <= sampled_; ++j) before[j] = at_[j];
    for (const PointPrediction& p : points_from(sampled_, degree)) {
      at_[p.point] = predicted(p, before);
      if (p.from.size() == 1) continue;
      find_at(points.place(p.point), at_[p.point], active);
    }
  }

  // Finds the coordinates at the fraction `part` of the current part.
  HWY_INLINE void find_at(double part, LanePoint<V>& at, M& active) const {
    const double u = begin_ + (end_ - begin_) * part;
    const V t = hn::MulAdd(hn::Set(d_, u), hn::Sub(back_, front_), front_);
    active = hn::And(active, collapsed_.find(place(t), at, active));
  }

  [[nodiscard]] HWY_INLINE LanePoint<V> place(V t) const {
    LanePoint<V> p;
    for (std::size_t a = 0; a < 3; ++a) p.c[a] = hn::MulAdd(t, direction_[a], origin_[a]);
    return p;
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

  D d_;
  const CellPolynomials& cell_;
  V front_, back_;
  RayStarts<V>& starts_;
  V origin_[3], direction_[3];
  CollapsedCell<D> collapsed_;
  LanePoint<V> xi_front_, xi_change_;  // from `inverse`: for affine cells, twisted pyramids
  InverseSeries<D> series_;            // for cells with straight edges
  Outcome outcome_ = Outcome::hopeless;
  bool by_series_;
  double begin_ = 0, end_ = 1;  // of the current part
  std::size_t sampled_ = 0;     // the degree of the known points; 0: none
  V accuracy_ = hn::Zero(d_);
  LanePoint<V> at_[kMostChebyshevDegree + 1];  // the sampled coordinates
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
