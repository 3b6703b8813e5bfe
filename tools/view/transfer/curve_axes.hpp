#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "hiac/scene/scene.hpp"
#include "hiac/scene/transfer_scale.hpp"

namespace hiac::view {

/// A place in a widget: pixels from the left and from the top.
struct Place {
  double x, y;
};

/// The plot of an extinction over a field: where values and extinctions are on the screen, and
/// back.
///
/// Values lie evenly along x, or evenly in their logarithm. Extinctions lie evenly in their
/// logarithm along y, from `least` to `most`; below a gap at the bottom the extinction is zero,
/// which no logarithm reaches.
class CurveAxes {
 public:
  /// The plot's edges, pixels.
  struct Box {
    double left = 0, top = 0, right = 1, bottom = 1;
  };

  CurveAxes() = default;
  /// low < high, both positive on a logarithmic scale; both extinctions positive, least < most.
  CurveAxes(const Box& box, const std::array<double, 2>& values,
            const std::array<double, 2>& extinctions, TransferScale scale = TransferScale::linear)
      : box_(box), values_(values), extinctions_(extinctions), scale_(scale) {}

  [[nodiscard]] const Box& box() const { return box_; }
  [[nodiscard]] const std::array<double, 2>& values() const { return values_; }
  [[nodiscard]] const std::array<double, 2>& extinctions() const { return extinctions_; }

  /// Of the values.
  [[nodiscard]] TransferScale scale() const { return scale_; }

  /// On a logarithmic scale, values that are not positive are left of the plot.
  [[nodiscard]] double x_of(double value) const;
  [[nodiscard]] double y_of(double extinction) const;
  /// The value at a share of the way from the left edge to the right one.
  [[nodiscard]] double value_along(double share) const;
  /// Numbers as short as a tenth of a pixel allows.
  [[nodiscard]] double value_at(double x) const;
  [[nodiscard]] double extinction_at(double y) const;

  /// The line above which extinctions are positive.
  [[nodiscard]] double zero_line() const { return box_.bottom - kZeroBand; }

  /// The values with a place held where it is, `factor` times as many as before.
  [[nodiscard]] std::array<double, 2> zoomed(double x, double factor) const;

  static constexpr double kZeroBand = 16;  ///< pixels

 private:
  Box box_;
  std::array<double, 2> values_{0, 1}, extinctions_{1e-4, 1};
  TransferScale scale_ = TransferScale::linear;
};

/// The extinctions that an axis should show: whole powers of ten, at least five of them, around all
/// that are positive.
std::array<double, 2> extinction_range(std::span<const ExtinctionTransfer::Point> points);

/// The values that an axis should show for a field whose values are these: wider by a little, and
/// never one value alone.
std::array<double, 2> shown_values(const std::array<double, 2>& extent);

/// The same on a logarithmic axis: the positive ones alone, down to kLogDecades powers of ten below
/// the largest where the least is not positive. None without positive values.
std::optional<std::array<double, 2>> shown_log_values(const std::array<double, 2>& extent);
inline constexpr int kLogDecades = 6;

/// A field's extent with those scalars beside it that lie no farther than half its width away.
std::array<double, 2> with_nearby(std::array<double, 2> extent, std::span<const double> scalars);

/// The item nearest to a place, by its places; none within `reach` pixels.
std::optional<std::size_t> nearest(std::span<const Place> items, const Place& place, double reach);

/// A value between those of the points before and behind point `index`: where it may be dragged.
template <std::size_t N>
double between_neighbors(std::span<const typename PiecewiseLinear<N>::Point> points,
                         std::size_t index, double value) {
  if (index > 0) value = value < points[index - 1].scalar ? points[index - 1].scalar : value;
  if (index + 1 < points.size() && value > points[index + 1].scalar)
    value = points[index + 1].scalar;
  return value;
}

/// The length over which half of the light is absorbed; none where nothing is.
std::optional<double> half_value_length(double extinction);

}  // namespace hiac::view
