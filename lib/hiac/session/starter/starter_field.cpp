#include "hiac/session/starter/starter_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/fields/find_field.hpp"
#include "hiac/scene/scene.hpp"
#include "hiac/session/field_values.hpp"

namespace hiac::starter {
namespace {

/// The height of a mesh's nodes, for meshes without a field.
constexpr const char* kHeight = "position:z";

/// The name of the scalar that stands for a field: von Mises' stress of tensors where it is known,
/// else the magnitude.
std::string scalar_name(const ZooMesh& mesh, const Field& field) {
  const std::string name = distinct_name(mesh, field);
  if (field.components == 1) return name;
  const std::vector<std::string> known = scalar_field_names(mesh);
  const std::string von_mises = name + ":von_mises";
  return std::ranges::find(known, von_mises) != known.end() ? von_mises : name + ":magnitude";
}

bool are_whole(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return value == std::floor(value); });
}

/// Whether whole numbers number cells or nodes: each occurs once, without a gap.
bool are_numbers(std::vector<double> values) {
  std::ranges::sort(values);
  const auto follows = [](double a, double b) { return b == a + 1; };
  return std::ranges::adjacent_find(values, std::not_fn(follows)) == values.end();
}

constexpr double kLowPercent = 1, kHighPercent = 99;

/// The range of a field's values, without the outermost percents where these make up most of it.
Interval range_to_show(const Interval& whole, const Interval& inner) {
  constexpr double kMost = 3;
  const bool spread =
      inner.high > inner.low && whole.high - whole.low > kMost * (inner.high - inner.low);
  return spread ? inner : whole;
}

/// Shannon's entropy, in bits, of a histogram of 64 equal bins over a range.
double entropy(const std::vector<double>& values, const Interval& range) {
  constexpr std::size_t kBins = 64;
  std::array<double, kBins> bins{};
  for (const double value : values) {
    const double t = (std::clamp(value, range.low, range.high) / 2 - range.low / 2) /
                     (range.high / 2 - range.low / 2);
    ++bins[std::min(static_cast<std::size_t>(t * kBins), kBins - 1)];
  }
  double sum = 0;
  for (const double bin : bins)
    if (bin > 0)
      sum -= bin / static_cast<double>(values.size()) *
             std::log2(bin / static_cast<double>(values.size()));
  return sum;
}

/// The values of a field that a view can show.
std::vector<double> values_to_show(const ZooMesh& mesh, const Field& field) {
  std::vector<double> values = values_in_cells(mesh, field);
  std::erase_if(values, [](double value) { return std::fabs(value) > kLargestNumber; });
  return values;
}

/// A field, how much it says, and what of it is to be shown.
struct Candidate {
  Field field;
  Interval whole, range;
  double score;
  bool is_numbering;
};

std::optional<Candidate> candidate(const ZooMesh& mesh, const std::string& name) {
  Candidate found{scalar_field(mesh, name), {}, {}, 0, false};
  found.field.name = name;
  std::vector<double> values = values_to_show(mesh, found.field);
  if (values.empty()) return std::nullopt;
  found.whole = extent_of(values);
  found.is_numbering = are_whole(values) && are_numbers(values);
  const double low = percentile(values, kLowPercent);
  found.range = range_to_show(found.whole, {low, percentile(values, kHighPercent)});
  if (found.range.low < found.range.high) {
    // whole numbers are mostly names of parts, materials or processors
    constexpr double kLessThanAny = 100;
    found.score = entropy(values, found.range) - (are_whole(values) ? kLessThanAny : 0);
  }
  return found;
}

/// Whether a field says something of the mesh.
bool is_fit(const ZooMesh& mesh, const Candidate& field) {
  return field.range.low < field.range.high && !field.is_numbering &&
         is_finite_in_cells(mesh, field.field);
}

std::string range_note(const Candidate& chosen) {
  const bool narrowed =
      chosen.range.low > chosen.whole.low || chosen.range.high < chosen.whole.high;
  return narrowed ? fmt::format(
                        "'{}' from {:g} to {:g}: 98 percent of its values, which go from {:g} "
                        "to {:g}",
                        chosen.field.name, chosen.range.low, chosen.range.high, chosen.whole.low,
                        chosen.whole.high)
                  : fmt::format("'{}' from {:g} to {:g}", chosen.field.name, chosen.range.low,
                                chosen.range.high);
}

Choice choice_of(Candidate&& chosen, std::string why) {
  Choice choice{std::move(chosen.field), chosen.range.low, chosen.range.high, {}};
  chosen.field.name = choice.field.name;
  choice.notes.push_back(fmt::format("shows {}{}", range_note(chosen), why));
  return choice;
}

/// The field of several components that is asked for by its name alone becomes a scalar of it.
std::string scalar_asked_for(const ZooMesh& mesh, const std::string& asked) {
  const Field* field = find_field(mesh, asked);
  return field != nullptr && field->components > 1 ? scalar_name(mesh, *field) : asked;
}

}  // namespace

Choice choose_field(const ZooMesh& mesh, const std::string& asked, const std::string& subject) {
  if (!asked.empty()) {
    std::optional<Candidate> found = candidate(mesh, scalar_asked_for(mesh, asked));
    if (!found) throw InputError(subject, fmt::format("field '{}': has no finite values", asked));
    return choice_of(std::move(*found), "");
  }
  std::optional<Candidate> best;
  std::size_t unfit = 0;
  for (const Field& field : mesh.fields) {
    std::optional<Candidate> found = candidate(mesh, scalar_name(mesh, field));
    if (!found || !is_fit(mesh, *found))
      ++unfit;
    else if (!best || found->score > best->score)
      best = std::move(found);
  }
  if (best)
    return choice_of(std::move(*best),
                     mesh.fields.size() > 1
                         ? fmt::format(", the one of {} fields that says most", mesh.fields.size())
                         : "");
  const std::string reason =
      mesh.fields.empty()
          ? "the mesh has no field"
          : fmt::format("none of {} fields has finite values that differ and are no numbering",
                        unfit);
  std::optional<Candidate> height = candidate(mesh, kHeight);
  if (!height) throw InputError(subject, "nothing to look at (no node has a place)");
  Choice choice = choice_of(std::move(*height), fmt::format(", the height: {}", reason));
  choice.is_height = true;
  return choice;
}

void show_range(Choice& choice, const std::array<double, 2>& range) {
  choice.low = range[0];
  choice.high = range[1];
  choice.notes = {fmt::format("shows '{}' from {:g} to {:g}, the range of all steps",
                              choice.field.name, choice.low, choice.high)};
}

void SeriesRange::add(const ZooMesh& mesh) {
  values_.add(values_to_show(mesh, scalar_field(mesh, field_)));
}

std::array<double, 2> SeriesRange::range() {
  const double low = values_.percentile(kLowPercent);
  const auto [shown_low, shown_high] =
      range_to_show(values_.extent(), {low, values_.percentile(kHighPercent)});
  return {shown_low, shown_high};
}

}  // namespace hiac::starter
