#pragma once

#include <array>
#include <optional>
#include <string>

#include "hiac/scene/specification.hpp"
#include "hiac/scene/toml/spec_key.hpp"
#include "hiac/scene/transfer_scale.hpp"

namespace hiac {

/// What the keys `range` and `scale` of a transfer function say.
struct TransferRange {
  std::optional<std::array<double, 2>> fixed;     ///< the scalars low < high
  std::optional<std::array<double, 2>> percents;  ///< of the field's values; "auto" is {0, 100}
  TransferScale scale = TransferScale::linear;

  [[nodiscard]] bool is_given() const { return fixed || percents; }
};

/// [low, high], "auto", or "percentile:LOW,HIGH".
void read_range(const SpecValue& value, TransferRange& into);
void read_scale(const SpecValue& value, TransferRange& into);

/// Throws through the table unless the points suit the range: on 0 to 1 with one, positive on a
/// logarithmic scale, for which a fixed range is positive, too.
template <std::size_t N>
void check_points(const SpecValue& table, const TransferPoints<N>& points,
                  const TransferRange& range) {
  const double first = points.front().scalar, last = points.back().scalar;
  if (range.is_given() && !(first >= 0 && last <= 1))
    table.fail_at("points", "with `range`, scalars go from 0 to 1 (found " + toml_text(first) +
                                " to " + toml_text(last) + ")");
  if (range.scale == TransferScale::linear) return;
  if (range.fixed && !((*range.fixed)[0] > 0))
    table.fail_at("range", "a logarithmic scale needs a positive range");
  if (!range.is_given() && !(first > 0))
    table.fail_at("points", "a logarithmic scale needs positive scalars");
}

/// Puts the points on the scalars that the range names. Where only the field's values decide, they
/// stay away from `into`, which then has none, and are returned.
template <std::size_t N>
std::optional<UnscaledPoints<N>> place_points(TransferPoints<N> points, const TransferRange& range,
                                              double tolerance, TransferPoints<N>& into) {
  if (range.percents)
    return UnscaledPoints<N>{std::move(points), *range.percents, range.scale == TransferScale::log,
                             tolerance};
  if (range.fixed)
    points = stretched<N>(std::move(points), (*range.fixed)[0], (*range.fixed)[1], range.scale);
  into = range.scale == TransferScale::log ? logarithmic<N>(points, tolerance) : std::move(points);
  return std::nullopt;
}

/// Largest error of extinctions on a logarithmic scale as piecewise-linear functions, relative to
/// the largest extinction.
inline constexpr double kExtinctionTolerance = 1e-4;

}  // namespace hiac
