#include "hiac/image/difference.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "hiac/base/special_values.hpp"

namespace hiac {
namespace {

void require_one_size(const Image& image, const Image& reference) {
  if (image.width() != reference.width() || image.height() != reference.height())
    throw std::invalid_argument("images of different sizes");
}

/// The indices of a channel in both images.
using ChannelPair = std::pair<std::size_t, std::size_t>;

std::vector<ChannelPair> common_channels(const Image& image, const Image& reference) {
  std::vector<ChannelPair> pairs;
  for (std::size_t c = 0; c < image.channel_count(); ++c)
    if (const auto other = reference.channel_index(image.channels()[c]))
      pairs.emplace_back(c, *other);
  return pairs;
}

Difference channel_difference(const Image& image, const Image& reference,
                              const ChannelPair& channels) {
  constexpr double kDarkest = 0.01;
  Difference d{.channel = image.channels()[channels.first]};
  double squares = 0, relative = 0, sum = 0;
  d.largest = -1;  // so that the first pixel attains a largest difference of 0
  for (std::size_t y = 0; y < image.height(); ++y)
    for (std::size_t x = 0; x < image.width(); ++x) {
      const double b = reference.at(x, y, channels.second);
      const double error = absolute_difference(image.at(x, y, channels.first), b);
      if (error > d.largest) {
        d.largest = error;
        d.x = x;
        d.y = y;
      }
      if (error == kInfinity) {
        ++d.infinite;
        continue;
      }
      sum += error;
      squares += error * error;
      if (error > 0) relative += std::pow(error / (std::fabs(b) + kDarkest), 2);
    }
  const auto count = static_cast<double>(image.width() * image.height());
  const auto mean = [&](double total) { return d.infinite > 0 ? kInfinity : total / count; };
  d.rmse = std::sqrt(mean(squares));
  d.relative_mse = mean(relative);
  d.mean_absolute = mean(sum);
  d.largest = std::max(d.largest, 0.0);
  return d;
}

}  // namespace

double absolute_difference(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double error = std::fabs(a - b);
  return std::isnan(error) ? kInfinity : error;
}

std::vector<Difference> channel_differences(const Image& image, const Image& reference) {
  require_one_size(image, reference);
  std::vector<Difference> differences;
  for (const ChannelPair& channels : common_channels(image, reference))
    differences.push_back(channel_difference(image, reference, channels));
  return differences;
}

std::optional<double> peak_signal_to_noise(const Image& image, const Image& reference) {
  require_one_size(image, reference);
  const auto a = color_channels(image), b = color_channels(reference);
  if (!a || !b) return std::nullopt;
  double mean = 0;
  for (std::size_t c = 0; c < 3; ++c)
    mean += std::pow(channel_difference(image, reference, {(*a)[c], (*b)[c]}).rmse, 2) / 3;
  return -10 * std::log10(mean);
}

Image difference_map(const Image& image, const Image& reference) {
  require_one_size(image, reference);
  const auto pairs = common_channels(image, reference);
  Image map(image.width(), image.height(), {"difference"});
  for (std::size_t y = 0; y < image.height(); ++y)
    for (std::size_t x = 0; x < image.width(); ++x)
      for (const auto& [a, b] : pairs)
        map.at(x, y, 0) = std::max(map.at(x, y, 0),
                                   absolute_difference(image.at(x, y, a), reference.at(x, y, b)));
  return map;
}

}  // namespace hiac
