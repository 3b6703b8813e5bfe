#include "formats/common/cells/keep_corners.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "hiac/mesh/parts/chosen_tuples.hpp"
#include "hiac/mesh/parts/used_nodes.hpp"

namespace hiac::formats {

void keep_corners(ZooMesh& mesh, std::vector<std::string>& notes) {
  const auto is_high = [](CellKind kind) { return order_of(kind) != CellOrder::linear; };
  const auto high = std::count_if(mesh.kinds.begin(), mesh.kinds.end(), is_high);
  if (high == 0) return;

  std::vector<CellKind> kinds;
  std::vector<std::uint64_t> elems{0};
  std::vector<std::uint64_t> entries;  // of mesh.nodes that stay
  kinds.reserve(mesh.cell_count());
  elems.reserve(mesh.cell_count() + 1);
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    kinds.push_back(kind_of(shape_of(mesh.kinds[cell]), CellOrder::linear));
    for (std::size_t n = 0; n < corner_count(mesh.kinds[cell]); ++n)
      entries.push_back(mesh.elems[cell] + n);
    elems.push_back(entries.size());
  }
  std::vector<NodeId> nodes = chosen_tuples(mesh.nodes.view(), 1, entries);
  const std::vector<NodeId> kept = renumber_used_nodes(nodes, mesh.node_count());

  notes.push_back(
      fmt::format("kept the corners alone of {} cells of higher order: the data at {} "
                  "nodes are neglected",
                  high, mesh.node_count() - kept.size()));
  for (Field& field : mesh.fields) {
    if (field.location == FieldLocation::node)
      field.values = chosen_tuples(field.values.view(), field.components, kept);
    if (field.location == FieldLocation::corner)
      field.values = chosen_tuples(field.values.view(), field.components, entries);
  }
  mesh.xyz = chosen_tuples(mesh.xyz.view(), 3, kept);
  mesh.kinds = std::move(kinds);
  mesh.elems = std::move(elems);
  mesh.nodes = std::move(nodes);
}

}  // namespace hiac::formats
