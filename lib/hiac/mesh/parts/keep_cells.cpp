#include "hiac/mesh/parts/keep_cells.hpp"

#include <cstdint>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/parts/chosen_tuples.hpp"
#include "hiac/mesh/parts/used_nodes.hpp"

namespace hiac {
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
  std::vector<CellId> cells;
  std::vector<std::uint64_t> entries, elems{0};  // entries: of the given mesh's list of nodes
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    if (!keep[cell]) continue;
    cells.push_back(cell);
    for (std::uint64_t entry = mesh.elems[cell]; entry < mesh.elems[cell + 1]; ++entry)
      entries.push_back(entry);
    elems.push_back(entries.size());
  }
  std::vector<NodeId> nodes = chosen_tuples(mesh.nodes.view(), 1, entries);
  const std::vector<NodeId> used = renumber_used_nodes(nodes, mesh.node_count());
  const auto values_of = [&](const Field& field) -> SharedArray<double> {
    const auto values = field.values.view();
    switch (field.location) {
      case FieldLocation::node:
        return chosen_tuples(values, field.components, used);
      case FieldLocation::cell:
        return chosen_tuples(values, field.components, cells);
      case FieldLocation::corner:
        break;
    }
    return chosen_tuples(values, field.components, entries);
  };

  ZooMesh result;
  result.elems = std::move(elems);
  result.nodes = std::move(nodes);
  result.xyz = chosen_tuples(mesh.xyz.view(), 3, used);
  result.kinds = chosen_tuples(mesh.kinds.view(), 1, cells);
  result.metadata = mesh.metadata;
  for (const Field& field : mesh.fields)
    result.fields.push_back(
        {field.name, field.unit, field.location, field.components, values_of(field)});
  return result;
}

}  // namespace hiac
