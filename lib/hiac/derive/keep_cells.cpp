#include "hiac/derive/keep_cells.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac {
namespace {

// What is kept, in the new order: numbers of the old cells, nodes, and entries of ZooMesh::nodes.
struct Kept {
  std::vector<std::uint64_t> cells, nodes, entries;
};

template <typename T>
SharedArray<T> chosen(std::span<const T> values, std::size_t width,
                      const std::vector<std::uint64_t>& tuples) {
  std::vector<T> result;
  result.reserve(tuples.size() * width);
  for (const std::uint64_t tuple : tuples)
    for (std::size_t c = 0; c < width; ++c) result.push_back(values[tuple * width + c]);
  return SharedArray<T>(std::move(result));
}

const std::vector<std::uint64_t>& tuples_at(const Kept& kept, FieldLocation location) {
  switch (location) {
    case FieldLocation::node:
      return kept.nodes;
    case FieldLocation::cell:
      return kept.cells;
    case FieldLocation::corner:
      break;
  }
  return kept.entries;
}

}  // namespace

std::vector<bool> cells_within(const ZooMesh& mesh, const Field& field, double low, double high) {
  if (field.components != 1)
    throw UsageError(fmt::format("field '{}' has {} components (a scalar expected)", field.name,
                                 field.components));
  const auto is_within = [&](double value) { return low <= value && value <= high; };
  std::vector<bool> within(mesh.cell_count(), true);
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    if (field.location == FieldLocation::cell) {
      within[cell] = is_within(field.values[cell]);
      continue;
    }
    const bool of_nodes = field.location == FieldLocation::node;
    for (std::uint64_t entry = mesh.elems[cell]; entry < mesh.elems[cell + 1]; ++entry)
      if (!is_within(field.values[of_nodes ? mesh.nodes[entry] : entry])) within[cell] = false;
  }
  return within;
}

ZooMesh keep_cells(const ZooMesh& mesh, const std::vector<bool>& keep) {
  Kept kept;
  std::vector<bool> used(mesh.node_count(), false);
  std::vector<std::uint64_t> elems{0};
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    if (!keep[cell]) continue;
    kept.cells.push_back(cell);
    for (std::uint64_t entry = mesh.elems[cell]; entry < mesh.elems[cell + 1]; ++entry) {
      kept.entries.push_back(entry);
      used[mesh.nodes[entry]] = true;
    }
    elems.push_back(kept.entries.size());
  }
  std::vector<NodeId> new_number(mesh.node_count(), std::numeric_limits<NodeId>::max());
  for (std::size_t node = 0; node < used.size(); ++node) {
    if (!used[node]) continue;
    new_number[node] = static_cast<NodeId>(kept.nodes.size());
    kept.nodes.push_back(node);
  }
  std::vector<NodeId> nodes;
  nodes.reserve(kept.entries.size());
  for (const std::uint64_t entry : kept.entries) nodes.push_back(new_number[mesh.nodes[entry]]);

  ZooMesh result;
  result.elems = SharedArray<std::uint64_t>(std::move(elems));
  result.nodes = SharedArray<NodeId>(std::move(nodes));
  result.xyz = chosen(mesh.xyz.view(), 3, kept.nodes);
  result.kinds = chosen(mesh.kinds.view(), 1, kept.cells);
  result.metadata = mesh.metadata;
  for (const Field& field : mesh.fields)
    result.fields.push_back(
        {field.name, field.unit, field.location, field.components,
         chosen(field.values.view(), field.components, tuples_at(kept, field.location))});
  return result;
}

}  // namespace hiac
