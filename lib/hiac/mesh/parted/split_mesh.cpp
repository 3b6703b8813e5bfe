#include "hiac/mesh/parted/split_mesh.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/parts/chosen_tuples.hpp"
#include "hiac/mesh/parts/used_nodes.hpp"

namespace hiac {
namespace {

constexpr NodeId kNotHere = std::numeric_limits<NodeId>::max();

std::vector<std::uint64_t> widened(std::span<const std::uint32_t> numbers) {
  return {numbers.begin(), numbers.end()};
}

/// Checks the parts of the cells and returns how many cells each part has.
std::vector<std::size_t> counted(const ZooMesh& mesh, std::span<const std::uint32_t> part_of_cell,
                                 std::size_t parts) {
  if (part_of_cell.size() != mesh.cell_count())
    throw std::invalid_argument(fmt::format("parts of {} cells are given, the mesh has {} cells",
                                            part_of_cell.size(), mesh.cell_count()));
  std::vector<std::size_t> counts(parts, 0);
  for (const std::uint32_t part : part_of_cell) {
    if (part >= parts)
      throw std::invalid_argument(fmt::format("a cell is in part {} of {}", part, parts));
    ++counts[part];
  }
  return counts;
}

}  // namespace

MeshSplitter::MeshSplitter(const ZooMesh& mesh, std::span<const std::uint32_t> part_of_cell,
                           std::size_t parts)
    : mesh_(mesh), cells_(mesh.cell_count()), local_(mesh.node_count(), kNotHere) {
  // a counting sort: each entry of `ends_` starts as its part's beginning
  ends_ = counted(mesh, part_of_cell, parts);
  std::size_t begin = 0;
  for (std::size_t& end : ends_) begin += std::exchange(end, begin);
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    cells_[ends_[part_of_cell[cell]]++] = cell;

  const std::vector<std::uint8_t> used = mark_used_nodes(mesh.nodes.view(), mesh.node_count());
  for (NodeId node = 0; node < mesh.node_count(); ++node)
    if (used[node] == 0) unused_.push_back(node);
  // a face of three cells is unmatched in the whole, but may be one of two cells in a part
  if (mesh.adjacency && mesh.adjacency->overshared == 0) face_offsets_ = face_offsets(mesh);
}

std::span<const CellId> MeshSplitter::cells_of(std::size_t part) const {
  const std::size_t begin = part == 0 ? 0 : ends_[part - 1];
  return std::span(cells_).subspan(begin, ends_[part] - begin);
}

/// Returns the nodes of a part, ascending, and gives `nodes` their numbers in the part.
std::vector<NodeId> MeshSplitter::take_nodes(std::size_t part, std::span<NodeId> nodes) {
  std::vector<NodeId> taken(nodes.begin(), nodes.end());
  if (part == 0) taken.insert(taken.end(), unused_.begin(), unused_.end());
  std::ranges::sort(taken);
  taken.erase(std::unique(taken.begin(), taken.end()), taken.end());
  taken.shrink_to_fit();
  for (std::size_t i = 0; i < taken.size(); ++i) local_[taken[i]] = static_cast<NodeId>(i);
  for (NodeId& node : nodes) node = local_[node];
  return taken;
}

FaceAdjacency MeshSplitter::adjacency_of(const ZooMesh& part, std::span<const CellId> cells) {
  if (face_offsets_.empty()) return build_face_adjacency(part);
  std::vector<CellId> neighbors;
  for (const CellId cell : cells)
    for (std::uint64_t face = face_offsets_[cell]; face < face_offsets_[cell + 1]; ++face) {
      const CellId other = mesh_.adjacency->neighbors[face];
      const auto found = std::ranges::lower_bound(cells, other);
      const bool here = found != cells.end() && *found == other;
      neighbors.push_back(here ? static_cast<CellId>(found - cells.begin()) : kNoCell);
    }
  return {std::move(neighbors), 0};
}

MeshPart MeshSplitter::part(std::size_t part) {
  const std::span<const CellId> cells = cells_of(part);
  std::vector<std::uint64_t> entries, elems{0};  // entries: of the whole mesh's list of nodes
  for (const CellId cell : cells) {
    for (std::uint64_t entry = mesh_.elems[cell]; entry < mesh_.elems[cell + 1]; ++entry)
      entries.push_back(entry);
    elems.push_back(entries.size());
  }
  std::vector<NodeId> nodes = chosen_tuples(mesh_.nodes.view(), 1, entries);
  const std::vector<NodeId> taken = take_nodes(part, nodes);

  MeshPart result;
  ZooMesh& mesh = result.mesh;
  mesh.elems = std::move(elems);
  mesh.nodes = std::move(nodes);
  mesh.xyz = chosen_tuples(mesh_.xyz.view(), 3, taken);
  mesh.kinds = chosen_tuples(mesh_.kinds.view(), 1, cells);
  mesh.metadata = mesh_.metadata;
  for (const Field& field : mesh_.fields) {
    const auto values = field.values.view();
    const std::size_t width = field.components;
    Field& kept = mesh.fields.emplace_back(field);
    if (field.location == FieldLocation::node) kept.values = chosen_tuples(values, width, taken);
    if (field.location == FieldLocation::cell) kept.values = chosen_tuples(values, width, cells);
    if (field.location == FieldLocation::corner)
      kept.values = chosen_tuples(values, width, entries);
  }
  if (mesh_.adjacency) mesh.adjacency = adjacency_of(mesh, cells);
  result.global_nodes = widened(taken);
  result.global_cells = widened(cells);
  return result;
}

std::vector<MeshPart> split_mesh(const ZooMesh& mesh, std::span<const std::uint32_t> part_of_cell,
                                 std::size_t parts) {
  MeshSplitter splitter(mesh, part_of_cell, parts);
  std::vector<MeshPart> result;
  for (std::size_t part = 0; part < parts; ++part) result.push_back(splitter.part(part));
  return result;
}

}  // namespace hiac
