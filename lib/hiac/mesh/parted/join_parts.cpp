#include "hiac/mesh/parted/join_parts.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/parted/part_agreement.hpp"
#include "hiac/mesh/parted/part_file.hpp"

namespace hiac {
namespace {

/// Puts tuple i of `part` at place numbers[i] of `whole`.
template <typename T>
void scatter(std::span<const T> part, std::size_t width, std::span<const std::uint64_t> numbers,
             std::vector<T>& whole) {
  for (std::size_t i = 0; i < numbers.size(); ++i)
    std::ranges::copy(part.subspan(i * width, width), &whole[numbers[i] * width]);
}

/// Calls place(entry of the part's list of nodes, entry of the whole's) for all entries of a part.
template <typename Place>
void for_each_entry(const MeshPart& part, std::span<const std::uint64_t> elems,
                    const Place& place) {
  for (CellId cell = 0; cell < part.mesh.cell_count(); ++cell) {
    const std::uint64_t begin = part.mesh.elems[cell], end = part.mesh.elems[cell + 1];
    const std::uint64_t there = elems[part.global_cells[cell]];
    for (std::uint64_t entry = begin; entry < end; ++entry) place(entry, there + entry - begin);
  }
}

Field joined_field(std::size_t number, std::span<const MeshPart> parts, const ZooMesh& whole) {
  Field field = parts[0].mesh.fields[number];
  const std::size_t width = field.components;
  const std::size_t tuples = field.location == FieldLocation::node   ? whole.node_count()
                             : field.location == FieldLocation::cell ? whole.cell_count()
                                                                     : whole.nodes.size();
  std::vector<double> values(tuples * width);
  for (const MeshPart& part : parts) {
    const auto own = part.mesh.fields[number].values.view();
    if (field.location == FieldLocation::node)
      scatter(own, width, part.global_nodes.view(), values);
    else if (field.location == FieldLocation::cell)
      scatter(own, width, part.global_cells.view(), values);
    else
      for_each_entry(part, whole.elems.view(), [&](std::uint64_t from, std::uint64_t to) {
        std::ranges::copy(own.subspan(from * width, width), &values[to * width]);
      });
  }
  field.values = std::move(values);
  return field;
}

}  // namespace

std::vector<MeshPart> read_all_parts(const PartedIndex& index) {
  std::vector<MeshPart> parts;
  for (std::size_t k = 0; k < index.parts.size(); ++k) parts.push_back(read_mesh_part(index, k));
  check_agreement(index, parts);
  return parts;
}

ZooMesh join_parts(const PartedIndex& index, std::span<const MeshPart> parts) {
  if (index.nodes > std::numeric_limits<NodeId>::max() || index.cells >= kNoCell)
    throw InputError(index.path, fmt::format("is too large for one mesh (fewer than {} nodes and "
                                             "cells expected, {} and {} found)",
                                             kNoCell, index.nodes, index.cells));
  std::vector<double> xyz(3 * index.nodes);
  std::vector<CellKind> kinds(index.cells);
  for (const MeshPart& part : parts) {
    scatter(part.mesh.xyz.view(), 3, part.global_nodes.view(), xyz);
    scatter(part.mesh.kinds.view(), 1, part.global_cells.view(), kinds);
  }
  std::vector<std::uint64_t> elems{0};
  elems.reserve(kinds.size() + 1);
  for (const CellKind kind : kinds) elems.push_back(elems.back() + node_count(kind));
  std::vector<NodeId> nodes(elems.back());
  for (const MeshPart& part : parts)
    for_each_entry(part, elems, [&](std::uint64_t from, std::uint64_t to) {
      nodes[to] = static_cast<NodeId>(part.global_nodes[part.mesh.nodes[from]]);
    });

  ZooMesh whole;
  whole.elems = std::move(elems);
  whole.nodes = std::move(nodes);
  whole.xyz = std::move(xyz);
  whole.kinds = std::move(kinds);
  whole.metadata = parts[0].mesh.metadata;
  for (std::size_t f = 0; f < parts[0].mesh.fields.size(); ++f)
    whole.fields.push_back(joined_field(f, parts, whole));
  if (const std::string found = content_hash(whole); found != index.hash)
    throw InputError(index.path, fmt::format("its parts make another mesh (hash {} expected, {} "
                                             "found)",
                                             index.hash, found));
  return whole;
}

}  // namespace hiac
