#include "hiac/derive/averages.hpp"

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"

namespace hiac {
namespace {

constexpr std::size_t kAveragesGrain = 1 << 12;  // cells a thread takes at a time

Field at_location(const Field& like, FieldLocation location, std::vector<double> values) {
  return {like.name, like.unit, location, like.components, SharedArray<double>(std::move(values))};
}

}  // namespace

SharedArray<double> values_at_corners(const ZooMesh& mesh, const Field& field) {
  if (field.location == FieldLocation::corner) return field.values;
  const std::size_t width = field.components;
  std::vector<double> values(mesh.nodes.size() * width);
  parallel_for(mesh.cell_count(), kAveragesGrain, [&](IndexRange cells) {
    for (std::size_t cell = cells.begin; cell < cells.end; ++cell)
      for (std::uint64_t entry = mesh.elems[cell]; entry < mesh.elems[cell + 1]; ++entry) {
        const std::size_t tuple = field.location == FieldLocation::cell ? cell : mesh.nodes[entry];
        for (std::size_t c = 0; c < width; ++c)
          values[entry * width + c] = field.values[tuple * width + c];
      }
  });
  return SharedArray<double>(std::move(values));
}

Field node_average(const ZooMesh& mesh, const Field& field) {
  if (field.location == FieldLocation::node)
    throw UsageError(fmt::format("field '{}' is one of nodes already", field.name));
  const auto corners = values_at_corners(mesh, field);
  const std::size_t width = field.components;
  std::vector<double> sums(mesh.node_count() * width, 0.0);
  std::vector<std::uint32_t> counts(mesh.node_count(), 0);
  for (std::size_t entry = 0; entry < mesh.nodes.size(); ++entry) {
    const NodeId node = mesh.nodes[entry];
    ++counts[node];
    for (std::size_t c = 0; c < width; ++c) sums[node * width + c] += corners[entry * width + c];
  }
  for (std::size_t node = 0; node < counts.size(); ++node)
    for (std::size_t c = 0; c < width; ++c)
      sums[node * width + c] = counts[node] == 0 ? std::numeric_limits<double>::quiet_NaN()
                                                 : sums[node * width + c] / counts[node];
  return at_location(field, FieldLocation::node, std::move(sums));
}

Field cell_average(const ZooMesh& mesh, const Field& field) {
  if (field.location == FieldLocation::cell)
    throw UsageError(fmt::format("field '{}' is one of cells already", field.name));
  const bool of_nodes = field.location == FieldLocation::node;
  const std::size_t width = field.components;
  std::vector<double> means(mesh.cell_count() * width, 0.0);
  parallel_for(mesh.cell_count(), kAveragesGrain, [&](IndexRange cells) {
    for (std::size_t cell = cells.begin; cell < cells.end; ++cell) {
      const std::uint64_t first = mesh.elems[cell], end = mesh.elems[cell + 1];
      for (std::size_t c = 0; c < width; ++c) {
        double sum = 0;
        for (std::uint64_t entry = first; entry < end; ++entry)
          sum += field.values[(of_nodes ? mesh.nodes[entry] : entry) * width + c];
        means[cell * width + c] = sum / static_cast<double>(end - first);
      }
    }
  });
  return at_location(field, FieldLocation::cell, std::move(means));
}

}  // namespace hiac
