#include "hiac/session/histogram/tetrahedron_shares.hpp"

#include <algorithm>
#include <cstddef>

namespace hiac {
namespace {

/// The integral of a product of two linear functions, times a factor. They are 0 at one scalar
/// each, and keep their signs in between.
template <typename Real>
struct Product {
  Real p_zero, q_zero, factor;

  Real operator()(Real s, Real t) const {
    const Real ps = s - p_zero, pt = t - p_zero, qs = s - q_zero, qt = t - q_zero;
    return factor * (t - s) * (ps * (2 * qs + qt) + pt * (qs + 2 * qt));
  }
};

class Shares {
 public:
  Shares(std::span<const double> edges, std::span<double> bins, std::array<double, 2>& outside)
      : edges_(edges), bins_(bins), outside_(outside) {}

  /// The number of edges at or below s.
  [[nodiscard]] std::size_t edges_up_to(double s) const {
    return static_cast<std::size_t>(std::upper_bound(edges_.begin(), edges_.end(), s) -
                                    edges_.begin());
  }

  /// All of the volume where the field is s.
  void add_at(double s, double volume) {
    const std::size_t above = edges_up_to(s);
    if (above == 0)
      outside_[0] += volume;
    else if (above == edges_.size() && s > edges_.back())
      outside_[1] += volume;
    else
      bins_[std::min(above, bins_.size()) - 1] += volume;
  }

  /// Adds an integral from `begin` to `end` to the bins there. There are `first` edges at or below
  /// `begin`; returns the number of those below `end`.
  template <typename Real, typename Integral>
  std::size_t add_piece(double begin, double end, std::size_t first, const Integral& integral) {
    const std::size_t count = edges_.size();
    std::size_t k = first;
    const auto between = [&](double s, double t) {
      return static_cast<double>(integral(Real{s}, Real{t}));
    };
    if (k == count || edges_[k] >= end) {
      cell(k) += between(begin, end);
      return k;
    }
    cell(k) += between(begin, edges_[k]);
    const double* const edge = edges_.data();
    double* const bin = bins_.data();
    const auto last = static_cast<std::size_t>(
        std::lower_bound(edges_.begin() + static_cast<std::ptrdiff_t>(k), edges_.end(), end) -
        edges_.begin() - 1);
    for (; k < last; ++k) bin[k] += between(edge[k], edge[k + 1]);  // whole bins
    cell(last + 1) += between(edge[last], end);
    return last + 1;
  }

 private:
  /// The place for what lies above k edges.
  double& cell(std::size_t k) {
    if (k == 0) return outside_[0];
    return k == edges_.size() ? outside_[1] : bins_[k - 1];
  }

  std::span<const double> edges_;
  std::span<double> bins_;
  std::array<double, 2>& outside_;
};

void sort(std::array<double, 4>& v) {
  const auto order = [&](std::size_t i, std::size_t j) {
    const double low = std::min(v[i], v[j]), high = std::max(v[i], v[j]);
    v[i] = low, v[j] = high;
  };
  order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
}

/// The pieces of the B-spline between its knots, not all equal. Its factor 3 / (v3 - v0) meets the
/// sixth of the integral's rule.
template <typename Real>
void add_pieces(Shares& shares, const std::array<double, 4>& knots, double volume,
                std::size_t first) {
  const auto [v0, v1, v2, v3] = knots;
  const Real a = v0, b = v1, c = v2, d = v3;
  const Real half = Real{volume} / 2 / (d - a);
  std::size_t k = first;
  if (v0 < v1) {
    const Product<Real> rising{a, a, half / ((b - a) * (c - a))};
    k = shares.add_piece<Real>(v0, v1, k, rising);
  }
  if (v1 < v2) {
    const Product<Real> left{a, c, -half / ((c - a) * (c - b))};
    const Product<Real> right{d, b, -half / ((d - b) * (c - b))};
    k = shares.add_piece<Real>(v1, v2, k, [&](Real s, Real t) { return left(s, t) + right(s, t); });
  }
  if (v2 < v3) {
    const Product<Real> falling{d, d, half / ((d - b) * (d - c))};
    shares.add_piece<Real>(v2, v3, k, falling);
  }
}

/// Whether products of three differences stay far from the ends of double's range.
bool is_moderate(const std::array<double, 4>& knots) {
  constexpr double kLeast = 1e-90, kMost = 1e90;
  if (!(knots[3] - knots[0] < kMost)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const double gap = knots[i + 1] - knots[i];
    if (gap > 0 && gap < kLeast) return false;
  }
  return true;
}

}  // namespace

void add_tetrahedron(std::array<double, 4> values, double volume, std::span<const double> edges,
                     std::span<double> bins, std::array<double, 2>& outside) {
  sort(values);
  const double low = values[0], high = values[3];
  Shares shares(edges, bins, outside);
  const std::size_t first = shares.edges_up_to(low);
  const bool in_one_bin = first > 0 && first < edges.size() && high < edges[first];
  if (in_one_bin || low == high)
    shares.add_at(low, volume);
  else if (is_moderate(values))
    add_pieces<double>(shares, values, volume, first);
  else
    add_pieces<long double>(shares, values, volume, first);
}

}  // namespace hiac
