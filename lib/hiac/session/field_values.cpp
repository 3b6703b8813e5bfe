#include "hiac/session/field_values.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/mesh/parts/used_nodes.hpp"

namespace hiac {

std::vector<double> values_in_cells(const ZooMesh& mesh, const Field& field) {
  const auto values = field.values.view();
  std::vector<double> finite;
  finite.reserve(values.size());
  if (field.location != FieldLocation::node) {
    for (const double value : values)
      if (std::isfinite(value)) finite.push_back(value);
    return finite;
  }
  const auto used = mark_used_nodes(mesh.nodes.view(), mesh.node_count());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (used[i] != 0 && std::isfinite(values[i])) finite.push_back(values[i]);
  return finite;
}

bool is_finite_in_cells(const ZooMesh& mesh, const Field& field) {
  const auto values = field.values.view();
  const auto finite = [&](std::size_t i) { return std::isfinite(values[i]); };
  if (field.location == FieldLocation::node) return std::ranges::all_of(mesh.nodes, finite);
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

Interval extent_of(const std::vector<double>& values) {
  Interval extent;
  for (const double value : values) extent.include(value);
  return extent;
}

PercentileRank percentile_rank(double percent, std::size_t count) {
  const double rank = percent / 100 * static_cast<double>(count - 1);
  const auto below = static_cast<std::size_t>(rank);
  return {below, rank - static_cast<double>(below)};
}

double percentile(std::vector<double>& values, double percent) {
  const auto [below, share] = percentile_rank(percent, values.size());
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(values.begin(), at, values.end());
  if (share == 0) return *at;
  return (1 - share) * *at + share * *std::min_element(at + 1, values.end());
}

}  // namespace hiac
