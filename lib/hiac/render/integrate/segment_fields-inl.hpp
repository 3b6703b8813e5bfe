// Fields along many segments of one cell at a time, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_SEGMENT_FIELDS_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_SEGMENT_FIELDS_INL
#    undef HIAC_RENDER_SEGMENT_FIELDS_INL
#  else
#    define HIAC_RENDER_SEGMENT_FIELDS_INL
#  endif

#  include <algorithm>
#  include <array>
#  include <cmath>
#  include <vector>

#  include <hwy/highway.h>

#  include "hiac/element/cell_rays-inl.hpp"
#  include "hiac/element/lane_polynomial-inl.hpp"
#  include "hiac/element/quotient_powers-inl.hpp"
#  include "hiac/frame/frame.hpp"
#  include "hiac/render/cells/cell_segments.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A mask's lanes, one by one.
template <class D>
HWY_INLINE std::array<bool, 8> lanes_of(D d, hn::Mask<D> mask) {
  static_assert(hn::MaxLanes(D()) <= 8);
  HWY_ALIGN double ones[8];
  hn::Store(hn::IfThenElseZero(mask, hn::Set(d, 1.0)), d, ones);
  std::array<bool, 8> lanes{};
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) lanes[lane] = ones[lane] != 0;
  return lanes;
}

// Computes the rays through points of the screen, relative to the cell's origin.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void set_rays(D d, const Projector& projector, const CellPolynomials& cell, V x, V y,
                         V (&origin)[3], V (&direction)[3]) {
  const Projector::Axes axes = projector.axes();
  const V scale = hn::Set(d, 1 / projector.pixels_per_unit());
  const V right = hn::Mul(hn::Sub(x, hn::Set(d, axes.center_x)), scale);
  const V up = hn::Mul(hn::Sub(hn::Set(d, axes.center_y), y), scale);
  for (std::size_t a = 0; a < 3; ++a) {
    const V aside =
        hn::MulAdd(right, hn::Set(d, axes.right[a]), hn::Mul(up, hn::Set(d, axes.up[a])));
    const V forward = hn::Set(d, axes.forward[a]), from = hn::Set(d, -cell.origin[a]);
    const bool perspective = projector.perspective();
    origin[a] = perspective ? from : hn::Add(from, aside);
    direction[a] = perspective ? hn::Add(forward, aside) : forward;
  }
}

// One or two fields on a part of segments, relative to their bases.
template <class V>
using FieldPolynomials = std::array<LanePolynomial<V>, 2>;

// Finds the fields along segments, one vector of segments after another.
//
// `Sink` receives the fields of one vector of segments, front to back, part by part:
//     void begin(std::size_t first, const CellSegments&)
//     void add(double begin, double end, FieldPolynomials<V>&, M& active)
// The parts cover [0, 1]; add() removes lanes that it cannot do from `active`, and may overwrite
// the polynomials' unused coefficients.
template <class Sink>
class SegmentFields {
 public:
  using D = hn::CappedTag<double, 8>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  SegmentFields(const Frame& frame, const CellPolynomials& cell, Sink& sink)
      : frame_(frame),
        cell_(cell),
        line_points_(chebyshev_points(std::max(cell.along_lines.degree, std::size_t{1}))),
        sink_(sink) {
    efforts_.fill(kFirstDegree);
    for (std::size_t a = 0; a < 3; ++a)
      starts_.front.c[a] = starts_.back.c[a] = hn::Set(D(), cell.middle[a]);
  }

  // Processes the vector of segments from `first` on. Returns the lanes that are done.
  HWY_INLINE M expand(std::size_t first, const CellSegments& s) {
    const D d;
    const auto at = [&](const std::vector<double>& of) { return hn::LoadU(d, of.data() + first); };
    V origin[3], direction[3];
    set_rays(d, frame_.projector, cell_, at(s.x), at(s.y), origin, direction);
    CellRays<D> rays(d, cell_, origin, direction, at(s.front), at(s.back), starts_);
    if (s.known) rays.start_at({{at(s.known_u), at(s.known_v), at(s.known_w)}});
    rays_ = &rays;
    active_ = hn::Gt(at(s.length), hn::Zero(d));
    const M wanted = active_;
    set_negligible(rays);
    sink_.begin(first, s);
    if (!cell_.affine)
      interpolate(0, 1, 0);
    else if (cell_.along_lines.pole_order > 0)
      expand_quotient(0, 1, 0);
    else
      add_polynomial();
    return hn::And(wanted, active_);
  }

 private:
  static constexpr int kMostHalvings = 8;
  static constexpr std::size_t kLeastDegree = 4, kFirstDegree = 8;
  static constexpr double kLeastShare = 0.2, kOptimism = 1.002;

  // Sets the size of negligible terms of the fields' polynomials, and from it the accuracy required
  // of reference coordinates in cells that are not affine: over the reference cell, coordinates
  // change a field by a few times its spread.
  HWY_INLINE void set_negligible(CellRays<D>& rays) {
    const D d;
    V accuracy = hn::Set(d, 1.0);
    for (std::size_t f = 0; f < cell_.field_count; ++f) {
      const CellPolynomials::Field& field = cell_.fields[f];
      negligible_[f] = hn::Max(rays.rounding(field), hn::Set(d, field.allowed));
      if (cell_.affine) continue;
      const double spread = 0x1p4 * (field.most - field.least);
      if (spread > 0) accuracy = hn::Min(accuracy, hn::Div(negligible_[f], hn::Set(d, spread)));
    }
    rays.set_accuracy(accuracy);
  }

  // Computes the values of field f at the sampled points.
  HWY_INLINE void field_values(std::size_t f, std::size_t degree) {
    rays_->values(cell_.fields[f], degree, values_);
    for (std::size_t j = 0; j <= degree; ++j) values_[j] = hn::IfThenElseZero(active_, values_[j]);
  }

  // Computes the Chebyshev coefficients of field f from these values.
  HWY_NOINLINE void transform(std::size_t f, const ChebyshevPoints& points) {
    const D d;
    const std::size_t degree = points.degree();
    V(&value)[kMostChebyshevDegree + 1] = values_;
    // the cosines are alternately even and odd
    const std::size_t half = degree / 2;
    for (std::size_t j = 0; j < degree - half; ++j) {
      const V front = value[j], back = value[degree - j];
      value[j] = hn::Add(front, back);
      value[degree - j] = hn::Sub(front, back);
    }
    for (std::size_t k = 0; k <= degree; ++k) {
      V sum = hn::Mul(hn::Set(d, points.transform(k, half)),
                      degree % 2 == 0 ? value[half] : hn::Zero(d));
      if (k % 2 == 0)
        for (std::size_t j = 0; j < degree - half; ++j)
          sum = hn::MulAdd(hn::Set(d, points.transform(k, j)), value[j], sum);
      else
        for (std::size_t j = 0; j < degree - half; ++j)
          sum = hn::MulAdd(hn::Set(d, points.transform(k, j)), value[degree - j], sum);
      chebyshev_[f][k] = sum;
    }
  }

  // Passes fields whose series have this degree to the sink. Returns the highest degree that is not
  // negligible.
  std::size_t add(double begin, double end, std::size_t degree) {
    std::size_t counted = 0;
    for (std::size_t f = 0; f < cell_.field_count; ++f) {
      to_powers(f, counted_degree(chebyshev_[f], f, degree));
      counted = std::max(counted, polynomials_[f].degree);
    }
    sink_.add(begin, end, polynomials_, active_);
    return counted;
  }

  // The degree of field f without trailing coefficients that are negligible in all lanes.
  HWY_INLINE std::size_t counted_degree(const V* c, std::size_t f, std::size_t degree) const {
    const D d;
    V dropped = hn::Zero(d);
    while (degree > 0) {
      dropped = hn::Add(dropped, hn::Abs(c[degree]));
      if (!hn::AllTrue(d, hn::Le(dropped, negligible_[f]))) break;
      --degree;
    }
    return degree;
  }

  HWY_NOINLINE void to_powers(std::size_t f, std::size_t degree) {
    const D d;
    const V(&c)[kMostChebyshevDegree + 1] = chebyshev_[f];
    const ChebyshevPowers& powers = chebyshev_powers();
    LanePolynomial<V>& p = polynomials_[f];
    p.degree = degree;
    for (std::size_t i = 0; i <= degree; ++i) {
      V sum = hn::Mul(hn::Set(d, powers[i][i]), c[i]);
      for (std::size_t k = i + 2; k <= degree; k += 2)
        sum = hn::MulAdd(hn::Set(d, powers[k][i]), c[k], sum);
      p.c[i] = sum;
    }
  }

  // Passes fields that are polynomials along the ray to the sink.
  HWY_INLINE void add_polynomial() {
    const std::size_t degree = line_points_.degree();
    rays_->sample(line_points_, active_);
    for (std::size_t f = 0; f < cell_.field_count; ++f) {
      field_values(f, degree);
      LanePolynomial<V>& p = polynomials_[f];
      powers_from_points(D(), line_points_, degree, values_, p.c);
      p.degree = counted_degree(p.c, f, degree);
    }
    sink_.add(0, 1, polynomials_, active_);
  }

  // Expands, on a part of the segments, fields that are polynomials divided by powers of the width
  // of a tapering cell: from their values at a few points, or on two parts.
  HWY_NOINLINE void expand_quotient(double begin, double end, int splits) {
    rays_->open(begin, end, active_);
    const EndWidths<V> widths = rays_->end_widths();
    const Taper<D> taper(D(), widths, active_);
    const double steepest = hn::GetLane(hn::MaxOfLanes(D(), hn::Abs(taper.r)));
    if (splits == kMostHalvings || steepest <= resolvable_) {
      M resolved = active_;
      bool expanded = expand_at(taper, resolved);
      if (splits == kMostHalvings)
        while (!expanded) {
          active_ = resolved;
          expanded = expand_at(Taper<D>(D(), widths, active_), resolved);
        }
      if (expanded) {
        // allows neighbours a slightly stronger taper
        resolvable_ *= kOptimism;
        sink_.add(begin, end, polynomials_, active_);
        return;
      }
      resolvable_ = steepest / kOptimism;
    }
    // both parts taper in the same proportion, except at the tip of a cell: the front part has the
    // share sqrt(a) / (sqrt(a) + sqrt(b)), with a and b the widths at both ends
    const double share = std::clamp(0.5 * (1 - steepest_of(taper.r)), kLeastShare, 1 - kLeastShare);
    const double between = begin + (end - begin) * share;
    expand_quotient(begin, between, splits + 1);
    expand_quotient(between, end, splits + 1);
  }

  // Computes the polynomials of these fields. Returns false if their degrees would be too high;
  // then `resolved` excludes the lanes concerned.
  HWY_INLINE bool expand_at(const Taper<D>& taper, M& resolved) {
    rays_->sample(line_points_, active_);
    switch (cell_.along_lines.degree) {
      case 2:
        return expand_as<1, 2>(taper, resolved);
      case 3:
        return expand_as<1, 3>(taper, resolved);
      case 5:
        return expand_as<2, 5>(taper, resolved);
      default:
        return expand_as<3, 7>(taper, resolved);
    }
  }

  template <std::size_t kPoleOrder, std::size_t kDegree>
  HWY_INLINE bool expand_as(const Taper<D>& taper, M& resolved) {
    const QuotientPowers<kPoleOrder, kDegree, D> quotient(D(), line_points_, taper);
    for (std::size_t f = 0; f < cell_.field_count; ++f) {
      field_values(f, kDegree);
      if (!quotient.expand(values_, negligible_[f], resolved, polynomials_[f])) return false;
    }
    return true;
  }

  // The lane value of largest magnitude, with its sign.
  static HWY_INLINE double steepest_of(V taper) {
    const D d;
    const double least = hn::GetLane(hn::MinOfLanes(d, taper));
    const double most = hn::GetLane(hn::MaxOfLanes(d, taper));
    return most > -least ? most : least;
  }

  // Interpolates fields that are not polynomials, on a part of the segments: with the degree that
  // sufficed for such a part the last time, with higher degrees, or on halves.
  HWY_NOINLINE void interpolate(double begin, double end, int halvings) {
    const D d;
    std::size_t& effort = efforts_[static_cast<std::size_t>(halvings)];
    std::size_t degree = effort;
    M resolved = active_;
    const bool halve = !rays_->open(begin, end, active_) && halvings < kMostHalvings;
    // the points of degree 8 are also points of degree 16
    for (; !halve; degree = std::min(degree + 8, kMostChebyshevDegree)) {
      const ChebyshevPoints& points = chebyshev_points(degree);
      rays_->sample(points, active_);
      resolved = active_;
      M hopeless = hn::Lt(hn::Set(d, 1.0), hn::Zero(d));
      for (std::size_t f = 0; f < cell_.field_count; ++f) {
        field_values(f, degree);
        transform(f, points);
        const V last = last_two(f, degree);
        resolved = hn::And(resolved, hn::Le(last, negligible_[f]));
        hopeless = hn::Or(
            hopeless, hn::Gt(at_most_degree(f, degree), hn::Mul(hn::Set(d, 8.0), negligible_[f])));
      }
      if (hn::AllFalse(d, active_)) return;
      if (hn::AllTrue(d, hn::Or(hn::Not(active_), resolved))) {
        // a margin, so that the last two coefficients are negligible again for neighbouring rays
        const std::size_t enough = add(begin, end, degree) + 3;
        effort = std::clamp((enough + 1) / 2 * 2, std::max(degree - 2, kLeastDegree),
                            kMostChebyshevDegree);
        return;
      }
      hopeless = hn::And(hopeless, hn::AndNot(resolved, active_));
      effort = std::min(degree + 2, kMostChebyshevDegree);
      if (degree == kMostChebyshevDegree) break;
      if (halvings < kMostHalvings && !hn::AllFalse(d, hopeless)) break;
    }
    if (!halve) effort = kFirstDegree;
    if (halvings == kMostHalvings) {
      active_ = resolved;
      if (!hn::AllFalse(d, active_)) add(begin, end, kMostChebyshevDegree);
      return;
    }
    const double middle = 0.5 * (begin + end);
    const RayStarts<V> whole = starts_;
    const auto halves = rays_->halves();
    starts_ = halves.front;
    interpolate(begin, middle, halvings + 1);
    starts_ = halves.back;
    interpolate(middle, end, halvings + 1);
    starts_ = whole;
  }

  HWY_INLINE V last_two(std::size_t f, std::size_t degree) const {
    return hn::Add(hn::Abs(chebyshev_[f][degree]), hn::Abs(chebyshev_[f][degree - 1]));
  }

  // An estimate of the last coefficients at the highest degree, extrapolated from their decay
  // between half of this degree and this degree.
  HWY_INLINE V at_most_degree(std::size_t f, std::size_t degree) const {
    V last = last_two(f, degree);
    if (degree > 8) return hn::Zero(D());
    const V rate = hn::Div(last, last_two(f, degree / 2));
    for (std::size_t at = degree; at + degree / 2 <= kMostChebyshevDegree; at += degree / 2)
      last = hn::Mul(last, rate);
    return last;
  }

  const Frame& frame_;
  const CellPolynomials& cell_;
  const ChebyshevPoints& line_points_;  // in affine cells
  Sink& sink_;
  // the degree that sufficed for the previous segments, by number of halvings
  std::array<std::size_t, kMostHalvings + 1> efforts_;
  // the largest Taper::r up to which quotients seem to be resolved
  double resolvable_ = 1;
  // of the current segments
  CellRays<D>* rays_ = nullptr;
  RayStarts<V> starts_;  // from the previous segments
  V values_[kMostChebyshevDegree + 1];
  V chebyshev_[2][kMostChebyshevDegree + 1];  // series of the fields
  V negligible_[2];                           // negligible parts of these
  FieldPolynomials<V> polynomials_;
  M active_;
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
