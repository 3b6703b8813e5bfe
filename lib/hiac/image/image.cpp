#include "hiac/image/image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac {
namespace {

std::size_t checked_product(std::size_t a, std::size_t b) {
  if (b != 0 && a > std::numeric_limits<std::size_t>::max() / sizeof(double) / b)
    throw std::invalid_argument("an image larger than memory can be addressed");
  return a * b;
}

}  // namespace

Image::Image(std::size_t width, std::size_t height, std::vector<std::string> channels)
    : Image(width, height, channels,
            std::vector<double>(checked_product(checked_product(width, height), channels.size()))) {
}

Image::Image(std::size_t width, std::size_t height, std::vector<std::string> channels,
             std::vector<double> values)
    : width_(width), height_(height), channels_(std::move(channels)), values_(std::move(values)) {
  for (auto name = channels_.begin(); name != channels_.end(); ++name) {
    if (name->empty()) throw std::invalid_argument("an image channel without a name");
    if (std::find(channels_.begin(), name, *name) != name)
      throw std::invalid_argument("two image channels named " + *name);
  }
  const std::size_t count = checked_product(checked_product(width, height), channels_.size());
  if (values_.size() != count) throw std::invalid_argument("values that do not fill the image");
}

std::optional<std::size_t> Image::channel_index(std::string_view name) const {
  const auto found = std::find(channels_.begin(), channels_.end(), name);
  if (found == channels_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - channels_.begin());
}

std::optional<std::array<std::size_t, 3>> color_channels(const Image& image) {
  const auto r = image.channel_index("R"), g = image.channel_index("G"),
             b = image.channel_index("B"), grey = image.channel_index("Y");
  if (r && g && b) return std::array{*r, *g, *b};
  if (grey) return std::array{*grey, *grey, *grey};
  return std::nullopt;
}

void require_numbers(const Image& image) {
  const auto values = image.values();
  const auto bad = std::ranges::find_if(values, [](double value) { return std::isnan(value); });
  if (bad == values.end()) return;
  const auto at = static_cast<std::size_t>(bad - values.begin());
  const std::size_t pixel = at / image.channel_count();
  throw Error(ExitCode::internal,
              fmt::format("pixel {},{}: channel {} is not a number (a number expected; this is a "
                          "defect, and no picture is written)",
                          pixel % image.width(), pixel / image.width(),
                          image.channels()[at % image.channel_count()]));
}

std::vector<std::string> rgba_channels() { return {"R", "G", "B", "A"}; }

}  // namespace hiac
