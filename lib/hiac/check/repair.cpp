#include "hiac/check/repair.hpp"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>
#include <vector>

#include "hiac/check/cells.hpp"
#include "hiac/check/numbers.hpp"

namespace hiac {
namespace {

// Reflections of the shapes onto themselves, which swap opposite corners.
constexpr std::array<std::array<std::uint8_t, 8>, kShapeCount> kMirroredCorners{
    {{0, 2, 1, 3},
     {0, 3, 2, 1, 4},
     {0, 2, 1, 3, 5, 4},
     {1, 0, 3, 2, 5, 4, 6},
     {0, 3, 2, 1, 4, 7, 6, 5}}};

// Returns the edge that joins two corners, and whether it runs in this direction.
std::pair<std::size_t, bool> edge_between(const ShapeTopology& shape, std::uint8_t from,
                                          std::uint8_t to) {
  std::size_t e = 0;
  while (shape.edges[e] != ShapeEdge{from, to} && shape.edges[e] != ShapeEdge{to, from}) ++e;
  return {e, shape.edges[e][0] == from};
}

std::size_t face_with(const ShapeTopology& shape, const std::array<std::uint8_t, 3>& corners) {
  std::size_t f = 0;
  while (!std::ranges::is_permutation(std::span(shape.faces[f].corners).first(3), corners)) ++f;
  return f;
}

// Returns whether two nodes have the same values in all node fields, bit for bit.
bool same_values(const ZooMesh& mesh, NodeId a, NodeId b) {
  return std::ranges::all_of(mesh.fields, [&](const Field& field) {
    if (field.location != FieldLocation::node) return true;
    for (std::size_t c = 0; c < field.components; ++c)
      if (std::bit_cast<std::uint64_t>(field.values[std::size_t{a} * field.components + c]) !=
          std::bit_cast<std::uint64_t>(field.values[std::size_t{b} * field.components + c]))
        return false;
    return true;
  });
}

// Returns the node that replaces each node; nodes that must not be merged represent themselves.
std::vector<NodeId> representatives(const ZooMesh& mesh, RepairCounts& counts) {
  std::vector<NodeId> of = first_at_place(mesh);
  std::vector<bool> kept(of.size(), false);
  for (std::size_t n = 0; n < of.size(); ++n)
    if (of[n] != n && !same_values(mesh, static_cast<NodeId>(n), of[n])) kept[n] = true;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto nodes = mesh.cell_nodes(cell);
    for (std::size_t i = 1; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (nodes[i] != nodes[j] && of[nodes[i]] == of[nodes[j]])
          kept[nodes[i]] = kept[nodes[j]] = true;
  }
  for (std::size_t n = 0; n < of.size(); ++n) {
    if (of[n] == n) continue;
    ++(kept[n] ? counts.unmerged_nodes : counts.merged_nodes);
    if (kept[n]) of[n] = static_cast<NodeId>(n);
  }
  return of;
}

// The mesh's cells and node entries that the repaired mesh keeps, in its order.
struct Selection {
  std::vector<CellId> cells;
  std::vector<std::uint64_t> entries;
};

Selection select(const ZooMesh& mesh, const std::vector<Turn>& turns, RepairCounts& counts) {
  Selection selection;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    if (turns[cell] == Turn::flat) {
      ++counts.dropped_cells;
      continue;
    }
    selection.cells.push_back(cell);
    const bool mirror = turns[cell] == Turn::left;
    if (mirror) ++counts.reoriented_cells;
    const auto order = mirrored_order(mesh.kinds[cell]);
    for (std::size_t k = 0; k < node_count(mesh.kinds[cell]); ++k)
      selection.entries.push_back(mesh.elems[cell] + (mirror ? order[k] : k));
  }
  return selection;
}

template <typename Index>
Field picked(const Field& field, const std::vector<Index>& tuples) {
  Field result = field;
  std::vector<double> values;
  values.reserve(tuples.size() * field.components);
  for (const Index tuple : tuples)
    for (std::size_t c = 0; c < field.components; ++c)
      values.push_back(field.values[std::size_t{tuple} * field.components + c]);
  result.values = std::move(values);
  return result;
}

}  // namespace

std::array<std::uint8_t, 32> mirrored_order(CellKind kind) {
  const ShapeTopology& shape = topology_of(kind);
  const auto& corners = kMirroredCorners[static_cast<std::size_t>(shape_of(kind))];
  const std::size_t per_edge = static_cast<std::size_t>(order_of(kind)) - 1;
  std::array<std::uint8_t, 32> order{};
  std::copy_n(corners.begin(), shape.corner_count, order.begin());
  std::size_t next = shape.corner_count;
  for (const auto& [from, to] : shape.edges) {
    const auto [edge, forwards] = edge_between(shape, corners[from], corners[to]);
    for (std::size_t i = 0; i < per_edge; ++i)
      order[next++] = static_cast<std::uint8_t>(shape.corner_count + edge * per_edge +
                                                (forwards ? i : per_edge - 1 - i));
  }
  for (std::size_t f = 0; next < node_count(kind); ++f) {
    const auto& c = shape.faces[f].corners;
    order[next++] =
        static_cast<std::uint8_t>(shape.corner_count + shape.edges.size() * per_edge +
                                  face_with(shape, {corners[c[0]], corners[c[1]], corners[c[2]]}));
  }
  return order;
}

Repaired repair(const ZooMesh& mesh) {
  Repaired repaired;
  const CellShapes shapes = judge_cells(mesh, 0);
  const std::vector<NodeId> of = representatives(mesh, repaired.counts);
  const Selection selection = select(mesh, shapes.turns, repaired.counts);
  ZooMesh& result = repaired.mesh;
  std::vector<std::uint64_t> elems{0};
  std::vector<CellKind> kinds;
  std::vector<NodeId> nodes;
  for (const CellId cell : selection.cells) {
    kinds.push_back(mesh.kinds[cell]);
    elems.push_back(elems.back() + node_count(mesh.kinds[cell]));
  }
  for (const std::uint64_t entry : selection.entries) nodes.push_back(of[mesh.nodes[entry]]);
  result.elems = std::move(elems);
  result.kinds = std::move(kinds);
  result.nodes = std::move(nodes);
  result.xyz = mesh.xyz;
  result.metadata = mesh.metadata;
  for (const Field& field : mesh.fields) {
    if (field.location == FieldLocation::node) result.fields.push_back(field);
    if (field.location == FieldLocation::cell)
      result.fields.push_back(picked(field, selection.cells));
    if (field.location == FieldLocation::corner)
      result.fields.push_back(picked(field, selection.entries));
  }
  return repaired;
}

}  // namespace hiac
