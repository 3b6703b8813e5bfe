#include "hiac/render/edges/pixel_layers.hpp"

#include <algorithm>
#include <cmath>

namespace hiac {
namespace {

constexpr int kRowSamples = PixelSamples::kRows;
constexpr double kSamples = kRowSamples;

// So many layers of lines let less than this through, and more of them change nothing.
constexpr double kLeastTransparency = 1e-4;

// Samples of the rows of a pixel: in row k from low + step * k on to high + step * k.
struct SampleBand {
  double low = 0, high = kSamples, step = 0;
};

// Rows of a pixel, from one real number on to another.
struct SampleRows {
  double first = 0, last = kSamples - 1;

  void limit(double a, double b) {
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
};

// Where low <= value <= high, of a value that is `value` at the first sample and grows by so much
// from sample to sample of a row, and from row to row. What holds for whole rows limits these.
SampleBand solve(double value, double by_sample, double by_row, double low, double high,
                 SampleRows& rows) {
  constexpr double kFlat = 1e-12;  // less than samples tell apart
  if (std::abs(by_sample) < kFlat) {
    rows.limit((low - value) / by_row, (high - value) / by_row);
    return {};
  }
  const double a = (low - value) / by_sample, b = (high - value) / by_sample;
  return {std::min(a, b), std::max(a, b), -by_row / by_sample};
}

// The bits from sample `from` on to sample `to`.
std::uint64_t bits_between(int from, int to) {
  return from > to ? 0 : (~std::uint64_t{0} << from) & (~std::uint64_t{0} >> (63 - to));
}

// The number of bits in row(k) of all rows: side by side in the bytes of a word, for processors
// without an instruction that counts them.
template <typename Row>
int count_bits(const Row& row) {
  constexpr std::uint64_t kOdd = 0x5555555555555555, kPairs = 0x3333333333333333,
                          kFours = 0x0f0f0f0f0f0f0f0f, kBytes = 0x00ff00ff00ff00ff;
  constexpr std::size_t kAtOnce = 16;  // a byte holds eight bits of each
  std::uint64_t sum = 0;
  for (std::size_t first = 0; first < PixelSamples::kRows; first += kAtOnce) {
    std::uint64_t bytes = 0;
    for (std::size_t k = first; k < first + kAtOnce; ++k) {
      std::uint64_t bits = row(k);
      bits -= bits >> 1 & kOdd;
      bits = (bits & kPairs) + (bits >> 2 & kPairs);
      bytes += (bits + (bits >> 4)) & kFours;
    }
    sum += (bytes & kBytes) + (bytes >> 8 & kBytes);
  }
  return static_cast<int>(sum * 0x0001000100010001 >> 48);
}

int common(const PixelSamples& a, const PixelSamples& b) {
  return count_bits([&](std::size_t k) { return a.rows[k] & b.rows[k]; });
}

}  // namespace

int PixelSamples::count() const {
  return count_bits([&](std::size_t k) { return rows[k]; });
}

void PixelSamples::operator|=(const PixelSamples& other) {
  for (std::size_t k = 0; k < kRows; ++k) rows[k] |= other.rows[k];
}

PixelSamples strip_samples(const Strip& strip, double x, double y) {
  PixelSamples samples;
  const double dx = strip.x1 - strip.x0, dy = strip.y1 - strip.y0;
  const double length = std::sqrt(dx * dx + dy * dy);
  if (!(length > 0)) return samples;
  const double ux = dx / length, uy = dy / length, half = strip.width / 2;
  // the first sample, relative to the strip's beginning
  const double first_x = x - 0.5 + 0.5 / kSamples - strip.x0;
  const double first_y = y - 0.5 + 0.5 / kSamples - strip.y0;
  SampleRows rows;
  const SampleBand along =
      solve(ux * first_x + uy * first_y, ux / kSamples, uy / kSamples, 0, length, rows);
  const SampleBand aside =
      solve(ux * first_y - uy * first_x, -uy / kSamples, ux / kSamples, -half, half, rows);
  if (!(rows.first <= rows.last)) return samples;
  const auto begin = static_cast<std::size_t>(std::ceil(rows.first)),
             end = static_cast<std::size_t>(rows.last) + 1;
  std::array<int, PixelSamples::kRows> from, to;
  // as the processor's instructions have it, which std::max and std::min are not made to
  const auto higher = [](double a, double b) { return a > b ? a : b; };
  const auto lower = [](double a, double b) { return a < b ? a : b; };
  for (std::size_t k = begin; k < end; ++k) {
    const auto row = static_cast<double>(k);
    const double low = higher(along.low + along.step * row, aside.low + aside.step * row);
    const double high = lower(along.high + along.step * row, aside.high + aside.step * row);
    // rounded up and down; conversions to integers round towards zero
    from[k] = kRowSamples - static_cast<int>(kSamples - lower(higher(low, 0), kSamples));
    to[k] = static_cast<int>(lower(higher(high, -1), kSamples - 1) + 1) - 1;
  }
  for (std::size_t k = begin; k < end; ++k) samples.rows[k] = bits_between(from[k], to[k]);
  return samples;
}

double PixelLayers::add(const PixelSamples& covered, double share, double opacity) {
  if (!(transparency_ > 0)) return 1;
  if (opacity == 0) return 0;
  // what reaches the layer where it is, in the mean
  double reaches = transparency_;
  if (const int all = covered_.empty() ? 0 : covered.count(); all > 0) {
    double sum = 0, through = 1;
    int left = all;
    for (const PixelSamples& level : covered_) {
      const int below = common(covered, level);
      sum += through * (left - below);
      left = below;
      through *= 1 - opacity;
    }
    if (through > kLeastTransparency) sum += through * left;
    reaches = sum / all;
  }
  const double taken = std::min(opacity * share * reaches, transparency_);
  const double result = taken / transparency_;
  transparency_ -= taken;
  // deepest first: what one more layer covers now
  double through = 1;
  std::size_t levels = 0;
  while (levels <= covered_.size() && through > kLeastTransparency) {
    ++levels;
    through *= 1 - opacity;
  }
  covered_.resize(levels);
  for (std::size_t m = levels - 1; m > 0; --m)
    for (std::size_t k = 0; k < PixelSamples::kRows; ++k)
      covered_[m].rows[k] |= covered_[m - 1].rows[k] & covered.rows[k];
  covered_[0] |= covered;
  return result;
}

double PixelLayers::add(std::span<const CoveringStrip> strips, double x, double y, double opacity) {
  PixelSamples covered = strip_samples(strips.front().strip, x, y);
  double share = strips.front().share;
  if (strips.size() > 1) {
    int samples = covered.count();
    for (const CoveringStrip& s : strips.subspan(1)) {
      const PixelSamples of_strip = strip_samples(s.strip, x, y);
      samples += of_strip.count();
      covered |= of_strip;
      share += s.share;
    }
    if (samples > 0) share *= static_cast<double>(covered.count()) / samples;
  }
  return add(covered, std::min(share, 1.0), opacity);
}

}  // namespace hiac
