#include "hiac/session/field_range.hpp"

#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/transfer_scale.hpp"
#include "hiac/session/field_values.hpp"
#include "hiac/session/session.hpp"

namespace hiac {
namespace {

/// The function that points on 0 to 1 make over a range, as points.
template <std::size_t N>
TransferPoints<N> placed(UnscaledPoints<N>&& wanted, const std::array<double, 2>& range) {
  const auto [low, high] = range;
  if (!(low < high)) return {{low, PiecewiseLinear<N>(wanted.points)(0.5)}};
  const TransferScale scale = wanted.logarithmic ? TransferScale::log : TransferScale::linear;
  TransferPoints<N> points = stretched<N>(std::move(wanted.points), low, high, scale);
  return wanted.logarithmic ? logarithmic<N>(points, wanted.tolerance) : points;
}

}  // namespace

void FieldRanges::OpenRange::add(const ZooMesh& mesh) {
  std::vector<double> added = values_in_cells(mesh, scalar_field(mesh, field));
  if (logarithmic) std::erase_if(added, [](double value) { return !(value > 0); });
  values.add(std::move(added));
}

/// The scalars that the percentiles of the field's values are at.
std::array<double, 2> FieldRanges::OpenRange::ends() {
  const std::string subject = fmt::format("field '{}'", field);
  if (values.count() == 0)
    throw InputError(subject, logarithmic
                                  ? "has no positive value, as a logarithmic scale needs"
                                  : "has no finite value from which a range could be taken");
  const std::array<double, 2> range{values.percentile(percents[0]), values.percentile(percents[1])};
  for (const double end : range)
    if (std::fabs(end) > kLargestNumber)
      throw InputError(subject,
                       fmt::format("values are too large (at most {} in magnitude expected, {} "
                                   "found)",
                                   kLargestNumber, end));
  return range;
}

template <std::size_t N>
std::optional<FieldRanges::OpenRange> FieldRanges::open_range(
    const std::optional<UnscaledPoints<N>>& wanted,
    const std::optional<TransferFunction<N>>& transfer, std::size_t most_in_memory) {
  if (!wanted) return std::nullopt;
  const bool extremes_only = wanted->percents == std::array<double, 2>{0, 100};
  return OpenRange{transfer->field, wanted->percents, wanted->logarithmic,
                   PooledValues(extremes_only, most_in_memory)};
}

template <std::size_t N>
void FieldRanges::place(const std::string& key, OpenRange& range,
                        std::optional<UnscaledPoints<N>>& wanted,
                        std::optional<TransferFunction<N>>& transfer,
                        std::vector<std::string>& notes) const {
  const auto [low, high] = range.ends();
  transfer->points = placed<N>(std::move(*wanted), {low, high});
  wanted.reset();
  const std::string where = meshes_ <= 1 ? "" : fmt::format(" over {} steps", meshes_);
  notes.push_back(
      low < high ? fmt::format("{}: '{}' from {:g} to {:g}{}", key, range.field, low, high, where)
                 : fmt::format("{}: '{}' has the one value {:g}{}, and takes the middle of "
                               "the points",
                               key, range.field, low, where));
}

FieldRanges::FieldRanges(const ParsedScene& parsed, std::size_t most_in_memory)
    : color_(open_range<3>(parsed.color, parsed.scene.volume.color, most_in_memory)),
      extinction_(
          open_range<1>(parsed.extinction, parsed.scene.volume.extinction, most_in_memory)) {
  if (parsed.scene.skin)
    skin_ = open_range<3>(parsed.skin_color, parsed.scene.skin->color_by, most_in_memory);
}

void FieldRanges::add(const ZooMesh& mesh) {
  ++meshes_;
  if (color_) color_->add(mesh);
  if (extinction_) extinction_->add(mesh);
  if (skin_) skin_->add(mesh);
}

std::vector<FieldRanges::Wanted> FieldRanges::wanted() const {
  std::vector<Wanted> all;
  for (const auto* range : {&color_, &extinction_, &skin_})
    if (*range) all.push_back({(*range)->field, (*range)->percents, (*range)->logarithmic});
  return all;
}

void FieldRanges::set_ends(std::span<const Interval> ends) {
  std::size_t next = 0;
  for (auto* range : {&color_, &extinction_, &skin_}) {
    if (!*range) continue;
    const Interval& found = ends[next++];
    (*range)->percents = {0, 100};
    (*range)->values = PooledValues(true);
    if (!found.empty()) (*range)->values.add({found.low, found.high});
  }
}

ParsedScene FieldRanges::place(ParsedScene parsed) {
  Volume& volume = parsed.scene.volume;
  if (color_) place<3>("volume.color.range", *color_, parsed.color, volume.color, parsed.notes);
  if (extinction_)
    place<1>("volume.extinction.range", *extinction_, parsed.extinction, volume.extinction,
             parsed.notes);
  if (skin_)
    place<3>("skin.color.range", *skin_, parsed.skin_color, parsed.scene.skin->color_by,
             parsed.notes);
  return parsed;
}

ParsedScene with_field_ranges(ParsedScene parsed, const ZooMesh& mesh) {
  FieldRanges ranges(parsed);
  ranges.add(mesh);
  return ranges.place(std::move(parsed));
}

}  // namespace hiac
