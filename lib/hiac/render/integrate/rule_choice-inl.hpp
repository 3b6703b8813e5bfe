// The Gauss-Legendre rules that pieces of segments need, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_RULE_CHOICE_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_RULE_CHOICE_INL
#    undef HIAC_RENDER_RULE_CHOICE_INL
#  else
#    define HIAC_RENDER_RULE_CHOICE_INL
#  endif

#  include <cstddef>

#  include <hwy/highway.h>

#  include "hiac/render/integrate/symmetric_rules.hpp"
#  include "hiac/render/integrate/transparency-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A bound of an integrand without exp(-A), divided by the error allowed for its integral: steepness
// times the sum of size_k |z|^k, plus brightest.
template <class V, std::size_t kDegree>
struct FactorBound {
  V size[kDegree + 1];
  V steepness, brightest;
};

// The number of nodes that gives the mean of p(z) exp(-A(z)) over [-1, 1] with an error of at most
// 1 in all active lanes, where `factor` bounds p and A is the sum of alpha_k z^k, k up to kDepth. 0
// if no rule has enough nodes (symmetric_rules.hpp). `ellipse`: the best ellipse of the last call;
// one of its neighbours is tried as well, the two neighbours by turns.
template <std::size_t kDepth, std::size_t kFactor, class D, class V = hn::Vec<D>>
HWY_INLINE std::size_t nodes_needed(D d, const BernsteinEllipses& table, const V* alpha,
                                    const FactorBound<V, kFactor>& factor, hn::Mask<D> active,
                                    EllipseChoice& ellipse) {
  V size[kDepth + 1];
  for (std::size_t k = 1; k <= kDepth; ++k) size[k] = hn::Abs(alpha[k]);
  const V middle = hn::Max(alpha[0], hn::Zero(d));
  const auto needed_on = [&](std::size_t e) HWY_ATTR {
    const V reach = hn::Set(d, table.reach[e]);
    V grown = size[kDepth], p = factor.size[kFactor];
    for (std::size_t k = kDepth; k-- > 1;) grown = hn::MulAdd(grown, reach, size[k]);
    for (std::size_t k = kFactor; k-- > 0;) p = hn::MulAdd(p, reach, factor.size[k]);
    const V log = log_above(d, hn::MulAdd(p, factor.steepness, factor.brightest));
    grown = hn::MulSub(grown, reach, middle);
    const V needed = hn::Mul(hn::Add(hn::Add(grown, hn::Set(d, table.log_factor[e])), log),
                             hn::Set(d, table.rate[e]));
    return hn::GetLane(hn::MaxOfLanes(d, hn::IfThenElseZero(active, needed)));
  };
  constexpr double kMostNodes = kMostSymmetricNodes;
  double fewest = needed_on(ellipse.best);
  const std::size_t other = ellipse.neighbour();
  if (const double needed = needed_on(other); needed < fewest) {
    fewest = needed;
    ellipse.best = other;
  }
  // tries all ellipses before giving up
  for (std::size_t e = 0; !(fewest < kMostNodes) && e < BernsteinEllipses::kCount; ++e)
    if (const double needed = needed_on(e); needed < fewest) {
      fewest = needed;
      ellipse.best = e;
    }
  // rounds up
  if (!(fewest < kMostNodes)) return 0;
  return fewest < 0 ? 1 : static_cast<std::size_t>(fewest) + 1;
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
