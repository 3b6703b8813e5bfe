#include "formats/common/cells/keep_corners.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace hiac::formats {
namespace {

constexpr NodeId kUnused = ~NodeId{0};

/// A field restricted to the tuples `chosen`.
SharedArray<double> chosen_tuples(std::span<const double> values, std::size_t width,
                                  const std::vector<std::uint64_t>& chosen) {
  std::vector<double> result;
  result.reserve(chosen.size() * width);
  for (const std::uint64_t tuple : chosen)
    for (std::size_t c = 0; c < width; ++c) result.push_back(values[tuple * width + c]);
  return result;
}

}  // namespace

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
  std::vector<NodeId> number(mesh.node_count(), kUnused);
  for (const std::uint64_t entry : entries) number[mesh.nodes[entry]] = 0;
  std::vector<std::uint64_t> kept;
  for (std::size_t node = 0; node < number.size(); ++node) {
    if (number[node] == kUnused) continue;
    number[node] = static_cast<NodeId>(kept.size());
    kept.push_back(node);
  }
  std::vector<NodeId> nodes;
  nodes.reserve(entries.size());
  for (const std::uint64_t entry : entries) nodes.push_back(number[mesh.nodes[entry]]);

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
