#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hiac {

/// An image of named channels in double precision.
///
/// Values are interleaved: channel c of pixel (x, y) is values()[(y * width + x) * channels + c],
/// x from the left, y from the top (row 0 is the top row). "R" "G" "B" "A", where present, are
/// linear and premultiplied by alpha = 1 - transparency; further channels ("depth", "error",
/// "order" ...) are plain numbers.
class Image {
 public:
  Image() = default;

  /// Sets all values to 0. Throws std::invalid_argument unless channel names are distinct and not
  /// empty.
  Image(std::size_t width, std::size_t height, std::vector<std::string> channels);

  /// Takes over the values; also throws std::invalid_argument if their number is wrong.
  Image(std::size_t width, std::size_t height, std::vector<std::string> channels,
        std::vector<double> values);

  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] std::size_t height() const { return height_; }
  [[nodiscard]] std::size_t channel_count() const { return channels_.size(); }
  [[nodiscard]] std::span<const std::string> channels() const { return channels_; }
  [[nodiscard]] std::optional<std::size_t> channel_index(std::string_view name) const;

  [[nodiscard]] std::span<double> values() { return values_; }
  [[nodiscard]] std::span<const double> values() const { return values_; }

  /// All channels of one pixel.
  [[nodiscard]] std::span<double> pixel(std::size_t x, std::size_t y) {
    return values().subspan((y * width_ + x) * channels_.size(), channels_.size());
  }
  [[nodiscard]] std::span<const double> pixel(std::size_t x, std::size_t y) const {
    return values().subspan((y * width_ + x) * channels_.size(), channels_.size());
  }

  double& at(std::size_t x, std::size_t y, std::size_t channel) { return pixel(x, y)[channel]; }
  [[nodiscard]] double at(std::size_t x, std::size_t y, std::size_t channel) const {
    return pixel(x, y)[channel];
  }

 private:
  std::size_t width_ = 0;
  std::size_t height_ = 0;
  std::vector<std::string> channels_;
  std::vector<double> values_;
};

/// Returns the indices of R, G and B, or that of Y three times; none if an image has neither.
std::optional<std::array<std::size_t, 3>> color_channels(const Image& image);

/// Throws Error (ExitCode::internal), with the first pixel and its channel, if a value is NaN: such
/// a picture must not be written.
void require_numbers(const Image& image);

/// Returns the channels of a rendered image, in this order, before any others.
std::vector<std::string> rgba_channels();

}  // namespace hiac
