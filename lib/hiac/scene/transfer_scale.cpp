#include "hiac/scene/transfer_scale.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hiac {
namespace {

/// Into how many pieces, of equal ratio, a step of `height` over scalars of the ratio exp(extent)
/// has to be divided. The logarithm, scaled to a rise of 1 over [1, r] with ln r = l, has second
/// derivatives of at most 1/l, so that it differs from its chord by at most (r - 1)^2 / (8 l).
std::size_t pieces_for(double height, double extent, double tolerance) {
  const auto fits = [&](double n) {
    const double l = extent / n;
    const double rise = std::expm1(l);
    return height / n * rise * rise / (8 * l) <= tolerance;
  };
  double n = std::max(1.0, std::floor(std::sqrt(height * extent / (8 * tolerance))));
  while (!fits(n)) n = std::ceil(1.1 * n);
  return static_cast<std::size_t>(n);
}

}  // namespace

template <std::size_t N>
TransferPoints<N> stretched(TransferPoints<N> points, double low, double high,
                            TransferScale scale) {
  for (auto& point : points) {
    const double t = point.scalar;
    if (t == 0 || t == 1)
      point.scalar = t == 0 ? low : high;
    else if (scale == TransferScale::linear)
      point.scalar = (1 - t) * low + t * high;
    else
      point.scalar = std::clamp(std::exp((1 - t) * std::log(low) + t * std::log(high)), low, high);
  }
  return points;
}

template <std::size_t N>
TransferPoints<N> logarithmic(const TransferPoints<N>& points, double tolerance) {
  TransferPoints<N> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& to = points[i];
    if (i > 0 && points[i - 1].scalar < to.scalar) {
      const auto& from = points[i - 1];
      double height = 0;
      for (std::size_t c = 0; c < N; ++c)
        height = std::max(height, std::fabs(to.value[c] - from.value[c]));
      const double extent = std::log(to.scalar) - std::log(from.scalar);
      const std::size_t pieces = extent > 0 ? pieces_for(height, extent, tolerance) : 1;
      for (std::size_t k = 1; k < pieces; ++k) {
        const double t = static_cast<double>(k) / static_cast<double>(pieces);
        auto& point = result.emplace_back();
        point.scalar = std::clamp(from.scalar * std::exp(t * extent), from.scalar, to.scalar);
        for (std::size_t c = 0; c < N; ++c)
          point.value[c] = (1 - t) * from.value[c] + t * to.value[c];
      }
    }
    result.push_back(to);
  }
  return result;
}

template TransferPoints<1> stretched<1>(TransferPoints<1>, double, double, TransferScale);
template TransferPoints<3> stretched<3>(TransferPoints<3>, double, double, TransferScale);
template TransferPoints<1> logarithmic<1>(const TransferPoints<1>&, double);
template TransferPoints<3> logarithmic<3>(const TransferPoints<3>&, double);

}  // namespace hiac
