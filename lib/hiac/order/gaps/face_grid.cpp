#include "hiac/order/gaps/face_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hiac {
namespace {

constexpr double kMostTilesPerSide = 2048;
constexpr double kLastStep = 32767;

float rounded(double value, bool upwards) {
  const auto nearest = static_cast<float>(value);
  if (upwards ? nearest >= value : nearest <= value) return nearest;
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  return std::nextafter(nearest, upwards ? kInfinity : -kInfinity);
}

}  // namespace

void FaceExtent::include(const Outline& outline) {
  x.include(outline.x.low), x.include(outline.x.high);
  y.include(outline.y.low), y.include(outline.y.high);
  sum_of_widths += outline.x.high - outline.x.low;
  sum_of_heights += outline.y.high - outline.y.low;
  ++faces;
}

FaceGrid::Axis::Axis(const Interval& range, double sum_of_sizes, std::size_t faces) {
  const double width = range.high - range.low;
  // if rounding makes all places uncertain, there is a single tile
  if (!std::isfinite(width) || !(width > 0) || !(sum_of_sizes > 0)) return;
  const auto count = static_cast<double>(faces);
  const double most = std::clamp(std::sqrt(count), 1.0, kMostTilesPerSide);
  tiles = static_cast<std::uint16_t>(std::clamp(width / sum_of_sizes * count, 1.0, most));
  low = range.low;
  scale = kLastStep / width;
}

// NaN, which a window of uncertain size yields, covers all steps.
std::uint16_t FaceGrid::Axis::step_below(double v) const {
  const double u = std::floor((v - low) * scale);
  return u > 0 ? static_cast<std::uint16_t>(std::min(u, kLastStep)) : std::uint16_t{0};
}
std::uint16_t FaceGrid::Axis::step_above(double v) const {
  const double u = std::ceil((v - low) * scale);
  return static_cast<std::uint16_t>(u < kLastStep ? std::max(u, 0.0) : kLastStep);
}

FaceGrid::FaceGrid(const FaceExtent& extent)
    : x_(extent.x, extent.sum_of_widths, extent.faces),
      y_(extent.y, extent.sum_of_heights, extent.faces) {}

BinnedFace FaceGrid::binned(const Outline& outline, double depth, bool upwards,
                            std::uint32_t face) const {
  return {{x_.step_below(outline.x.low), y_.step_below(outline.y.low),
           x_.step_above(outline.x.high), y_.step_above(outline.y.high)},
          rounded(depth, upwards),
          face};
}

template <typename Visit>
void FaceGrid::for_each_place(std::span<const BinnedFace> faces, const Visit& visit) const {
  for (const BinnedFace& face : faces) {
    const std::size_t first = x_.tile(face.bounds.x_low), last = x_.tile(face.bounds.x_high);
    const std::size_t last_row = y_.tile(face.bounds.y_high);
    for (std::size_t row = y_.tile(face.bounds.y_low); row <= last_row; ++row)
      for (std::size_t column = first; column <= last; ++column)
        visit(row * x_.tiles + column, face);
  }
}

FaceBins FaceGrid::bin(std::span<const BinnedFace> faces) const {
  FaceBins bins;
  bins.start.assign(tiles() + 1, 0);
  for_each_place(faces, [&](std::size_t t, const BinnedFace&) { ++bins.start[t + 1]; });
  for (std::size_t t = 0; t < tiles(); ++t) bins.start[t + 1] += bins.start[t];
  bins.members.resize(bins.start.back());
  std::vector<std::uint64_t> next(bins.start.begin(), bins.start.end() - 1);
  for_each_place(faces,
                 [&](std::size_t t, const BinnedFace& face) { bins.members[next[t]++] = face; });
  return bins;
}

}  // namespace hiac
