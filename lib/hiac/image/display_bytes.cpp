#include "hiac/image/display_bytes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/image/srgb.hpp"

namespace hiac {
namespace {

// What is rounded down; increasing.
double scaled(double value) { return srgb_encode(value) * 255 + 0.5; }

std::uint8_t exact_byte(double value) {
  return static_cast<std::uint8_t>(std::floor(scaled(value)));
}

// Over most of 4096 intervals of [0, 1] the byte is one and the same: it is looked up there, and
// computed elsewhere.
class ByteTable {
 public:
  ByteTable() {
    // more than the encoding's rounding, and far less than a step of the bytes
    constexpr double kScaledMargin = 1e-9;
    for (std::size_t k = 0; k < kIntervals; ++k) {
      const double low = std::floor(scaled(static_cast<double>(k) / kIntervals) - kScaledMargin);
      const double high =
          std::floor(scaled(static_cast<double>(k + 1) / kIntervals) + kScaledMargin);
      bytes_[k] = low == high ? static_cast<std::int16_t>(low) : kMixed;
    }
  }

  [[nodiscard]] std::uint8_t operator()(double value) const {
    if (!(value > 0)) return 0;
    if (value >= 1) return 255;
    const std::int16_t byte = bytes_[static_cast<std::size_t>(value * kIntervals)];
    return byte == kMixed ? exact_byte(value) : static_cast<std::uint8_t>(byte);
  }

 private:
  static constexpr std::size_t kIntervals = 4096;
  static constexpr std::int16_t kMixed = -1;
  std::array<std::int16_t, kIntervals> bytes_{};
};

}  // namespace

std::vector<std::uint8_t> display_bytes(const Image& image) {
  static const ByteTable kTable;
  const auto colors = color_channels(image);
  if (!colors) throw UsageError("the picture has no colour");
  const std::size_t pixels = image.width() * image.height(), stride = image.channel_count();
  std::vector<std::uint8_t> bytes(3 * pixels);
  parallel_for(pixels, std::size_t{1} << 14, [&](IndexRange range) {
    for (std::size_t p = range.begin; p < range.end; ++p)
      for (std::size_t c = 0; c < 3; ++c)
        bytes[3 * p + c] = kTable(image.values()[p * stride + (*colors)[c]]);
  });
  return bytes;
}

}  // namespace hiac
