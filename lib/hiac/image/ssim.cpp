#include "hiac/image/ssim.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "hiac/image/plane_filter.hpp"
#include "hiac/image/srgb.hpp"

namespace hiac {
namespace {

constexpr std::size_t kRadius = 5;
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01;  // (K1 L)^2
constexpr double kC2 = 0.03 * 0.03;  // (K2 L)^2

/// Returns the luma; none if the image has no colour or one that is not finite.
std::optional<Plane> luma(const Image& image) {
  constexpr double kWeights[] = {0.299, 0.587, 0.114};
  const auto channels = color_channels(image);
  if (!channels) return std::nullopt;
  Plane plane{image.width(), image.height(), {}};
  plane.values.reserve(image.width() * image.height());
  for (std::size_t y = 0; y < image.height(); ++y)
    for (std::size_t x = 0; x < image.width(); ++x) {
      double sum = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double value = image.at(x, y, (*channels)[c]);
        if (!std::isfinite(value)) return std::nullopt;
        sum += kWeights[c] * srgb_encode(std::clamp(value, 0.0, 1.0));
      }
      plane.values.push_back(sum);
    }
  return plane;
}

Plane product(const Plane& a, const Plane& b) {
  Plane result = a;
  std::transform(a.values.begin(), a.values.end(), b.values.begin(), result.values.begin(),
                 std::multiplies<>());
  return result;
}

}  // namespace

std::optional<double> structural_similarity(const Image& image, const Image& reference) {
  if (image.width() != reference.width() || image.height() != reference.height())
    throw std::invalid_argument("images of different sizes");
  constexpr std::size_t kWindow = 2 * kRadius + 1;
  if (image.width() < kWindow || image.height() < kWindow) return std::nullopt;
  const auto a = luma(image), b = luma(reference);
  if (!a || !b) return std::nullopt;

  std::vector<double> window = gaussian(kRadius, kSigma);
  const double total = std::accumulate(window.begin(), window.end(), 0.0);
  for (double& weight : window) weight /= total;
  const auto mean = [&](const Plane& plane) { return filtered(plane, window, window); };
  const Plane mu_a = mean(*a), mu_b = mean(*b);
  const Plane aa = mean(product(*a, *a)), bb = mean(product(*b, *b)), ab = mean(product(*a, *b));

  double sum = 0;
  for (std::size_t y = kRadius; y + kRadius < a->height; ++y)
    for (std::size_t x = kRadius; x + kRadius < a->width; ++x) {
      const std::size_t i = y * a->width + x;
      const double ma = mu_a.values[i], mb = mu_b.values[i];
      const double var_a = aa.values[i] - ma * ma, var_b = bb.values[i] - mb * mb;
      const double covariance = ab.values[i] - ma * mb;
      // equation (13)
      sum += (2 * ma * mb + kC1) * (2 * covariance + kC2) /
             ((ma * ma + mb * mb + kC1) * (var_a + var_b + kC2));
    }
  return sum / static_cast<double>((a->width - kWindow + 1) * (a->height - kWindow + 1));
}

}  // namespace hiac
