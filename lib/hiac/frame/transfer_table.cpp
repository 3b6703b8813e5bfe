#include "hiac/frame/transfer_table.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/base/error.hpp"
#include "hiac/base/large_pages.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/base/special_values.hpp"

namespace hiac {
namespace {

constexpr std::size_t kMostBreakpoints = 65535;

std::vector<double> merged(std::span<const double> a, std::span<const double> b) {
  std::vector<double> all(a.begin(), a.end());
  all.insert(all.end(), b.begin(), b.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// The table of a function on the intervals between `breakpoints`, which include all of its own.
template <std::size_t N>
TransferTable<N> tabulate(const PiecewiseLinear<N>& function, std::span<const double> breakpoints) {
  if (breakpoints.size() > kMostBreakpoints)
    throw InputError("transfer functions have more than 65535 breakpoints");
  TransferTable<N> table;
  for (std::size_t k = 0; k <= breakpoints.size(); ++k) {
    const double lower = k == 0 ? -kInfinity : breakpoints[k - 1];
    const double upper = k == breakpoints.size() ? kInfinity : breakpoints[k];
    const std::size_t own = k == 0 ? 0 : function.interval_of(lower);
    const auto& piece = function.piece(own);
    table.lower.push_back(lower);
    table.upper.push_back(upper);
    table.anchor.push_back(piece.anchor);
    for (std::size_t c = 0; c < N; ++c) {
      table.value[c].push_back(piece.value[c]);
      table.slope[c].push_back(piece.slope[c]);
    }
  }
  return table;
}

template <std::size_t N>
std::vector<std::uint8_t> zero_intervals(const TransferTable<N>& table) {
  std::vector<std::uint8_t> zero(table.intervals(), 1);
  for (std::size_t k = 0; k < zero.size(); ++k)
    for (std::size_t c = 0; c < N; ++c)
      if (table.value[c][k] != 0 || table.slope[c][k] != 0) zero[k] = 0;
  return zero;
}

using ExtinctionPoint = PiecewiseLinear<1>::Point;

// The scalar between two points, one of them above `most`, at which the function is `most`. It is
// never the lower point itself, whose value does not change.
double scalar_of(const ExtinctionPoint& low, const ExtinctionPoint& high, double most) {
  const double share = (most - low.value[0]) / (high.value[0] - low.value[0]);
  const double scalar = low.scalar + share * (high.scalar - low.scalar);
  return scalar == low.scalar ? std::nextafter(low.scalar, high.scalar) : scalar;
}

PiecewiseLinear<1> limited(const ExtinctionTransfer& extinction, double most) {
  const auto above = [most](const ExtinctionPoint& point) { return point.value[0] > most; };
  if (std::ranges::none_of(extinction.points, above)) return extinction.function();
  std::vector<ExtinctionPoint> points;
  for (const ExtinctionPoint& point : extinction.points) {
    const ExtinctionPoint kept{point.scalar, {std::min(point.value[0], most)}};
    if (!points.empty() && points.back().scalar < point.scalar) {
      const ExtinctionPoint& before = (&point)[-1];
      if (above(point) && before.value[0] < most)
        points.push_back({scalar_of(before, point, most), {most}});
      else if (above(before) && point.value[0] < most)
        points.push_back({scalar_of(point, before, most), {most}});
    }
    points.push_back(kept);
  }
  return PiecewiseLinear<1>(points);
}

// The steepest slope of any channel.
template <std::size_t N>
double steepest(const TransferTable<N>& table) {
  double most = 0;
  for (const std::vector<double>& slope : table.slope)
    for (const double s : slope) most = std::max(most, std::abs(s));
  return most;
}

}  // namespace

bool is_steep(const OpticsTables& optics, double largest_color_field,
              double largest_extinction_field, double longest) {
  // In cells other than linear tetrahedra, fields along rays have an error below 2^-40.
  constexpr double kMost = 0x1p40;
  const double color = steepest(optics.color) * largest_color_field;
  const double depth = steepest(optics.extinction) * largest_extinction_field * longest;
  // a NaN counts as steep
  return !(depth <= kMost && color <= kMost * std::max(1.0, optics.largest_color));
}

OpticsTables make_optics_tables(const Volume& volume, Integration integration,
                                double most_extinction) {
  OpticsTables tables;
  if (volume.color) tables.color_function = volume.color->function();
  if (volume.extinction) tables.extinction_function = limited(*volume.extinction, most_extinction);
  const auto& color = tables.color_function;
  const auto& extinction = tables.extinction_function;
  tables.emission = volume.glow == Glow::emission;
  if (integration == Integration::gauss5)
    tables.rule = PieceRule::five_points;
  else if (integration != Integration::exact)
    tables.rule = PieceRule::mean_color;
  tables.unsliced = integration == Integration::approximate_unsliced;
  tables.same_field =
      !volume.color || !volume.extinction || volume.color->field == volume.extinction->field;
  if (tables.same_field) {
    const auto all = merged(color.breakpoints(), extinction.breakpoints());
    tables.color = tabulate(color, all);
    tables.extinction = tabulate(extinction, all);
  } else {
    tables.color = tabulate(color, color.breakpoints());
    tables.extinction = tabulate(extinction, extinction.breakpoints());
  }
  if (volume.color)
    for (const auto& point : volume.color->points)
      for (const double component : point.value)
        tables.largest_color = std::max(tables.largest_color, std::abs(component));
  tables.no_color = zero_intervals(tables.color);
  tables.no_extinction = zero_intervals(tables.extinction);
  return tables;
}

template <std::size_t N>
ScalarIntervals classify_value(double value, const TransferTable<N>& table) {
  const std::span<const double> breakpoints(table.lower.data() + 1, table.intervals() - 1);
  const auto [low, high] = std::equal_range(breakpoints.begin(), breakpoints.end(), value);
  return {static_cast<std::uint16_t>(low - breakpoints.begin()),
          static_cast<std::uint16_t>(high - breakpoints.begin())};
}

template <std::size_t N>
std::vector<ScalarIntervals> classify_values(std::span<const double> values,
                                             const TransferTable<N>& table) {
  auto intervals = large_vector<ScalarIntervals>(values.size());
  parallel_for(values.size(), std::size_t{1} << 14, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      intervals[i] = classify_value(values[i], table);
  });
  return intervals;
}

template ScalarIntervals classify_value(double, const TransferTable<1>&);
template ScalarIntervals classify_value(double, const TransferTable<3>&);
template std::vector<ScalarIntervals> classify_values(std::span<const double>,
                                                      const TransferTable<1>&);
template std::vector<ScalarIntervals> classify_values(std::span<const double>,
                                                      const TransferTable<3>&);

}  // namespace hiac
