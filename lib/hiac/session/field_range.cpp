#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/transfer_scale.hpp"
#include "hiac/session/field_values.hpp"
#include "hiac/session/session.hpp"

namespace hiac {
namespace {

/// The scalars that the percentiles of a field's values are at.
std::array<double, 2> field_range(const ZooMesh& mesh, const std::string& name,
                                  const std::array<double, 2>& percents, bool logarithmic) {
  std::vector<double> values = values_in_cells(mesh, scalar_field(mesh, name));
  if (logarithmic) std::erase_if(values, [](double value) { return !(value > 0); });
  if (values.empty())
    throw InputError(fmt::format("field '{}'", name),
                     logarithmic ? "has no positive value, as a logarithmic scale needs"
                                 : "has no finite value from which a range could be taken");
  const std::array<double, 2> range{percentile(values, percents[0]),
                                    percentile(values, percents[1])};
  for (const double end : range)
    if (std::fabs(end) > kLargestNumber)
      throw InputError(fmt::format("field '{}'", name),
                       fmt::format("values are too large (at most {} in magnitude expected, {} "
                                   "found)",
                                   kLargestNumber, end));
  return range;
}

/// The function that points on 0 to 1 make over a range, as points.
template <std::size_t N>
TransferPoints<N> placed(UnscaledPoints<N>&& wanted, const std::array<double, 2>& range) {
  const auto [low, high] = range;
  if (!(low < high)) return {{low, PiecewiseLinear<N>(wanted.points)(0.5)}};
  const TransferScale scale = wanted.logarithmic ? TransferScale::log : TransferScale::linear;
  TransferPoints<N> points = stretched<N>(std::move(wanted.points), low, high, scale);
  return wanted.logarithmic ? logarithmic<N>(points, wanted.tolerance) : points;
}

template <std::size_t N>
void place(const ZooMesh& mesh, const std::string& key, std::optional<UnscaledPoints<N>>& wanted,
           std::optional<TransferFunction<N>>& transfer, std::vector<std::string>& notes) {
  if (!wanted) return;
  const std::array<double, 2> range =
      field_range(mesh, transfer->field, wanted->percents, wanted->logarithmic);
  transfer->points = placed<N>(std::move(*wanted), range);
  wanted.reset();
  notes.push_back(
      range[0] < range[1]
          ? fmt::format("{}: '{}' from {:g} to {:g}", key, transfer->field, range[0], range[1])
          : fmt::format("{}: '{}' has the one value {:g}, and takes the middle of the "
                        "points",
                        key, transfer->field, range[0]));
}

}  // namespace

ParsedScene with_field_ranges(ParsedScene parsed, const ZooMesh& mesh) {
  Volume& volume = parsed.scene.volume;
  place<3>(mesh, "volume.color.range", parsed.color, volume.color, parsed.notes);
  place<1>(mesh, "volume.extinction.range", parsed.extinction, volume.extinction, parsed.notes);
  return parsed;
}

}  // namespace hiac
