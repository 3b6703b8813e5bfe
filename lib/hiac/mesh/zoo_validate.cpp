#include <algorithm>
#include <atomic>
#include <cmath>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/mesh/fields/tuple_count.hpp"
#include "hiac/mesh/zoo_chunks.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {
namespace {

constexpr std::size_t kZooValidateGrain = 1 << 16;
constexpr std::size_t kNoneBroken = std::numeric_limits<std::size_t>::max();

/// Returns the smallest index below `count` for which `is_broken(index)` holds, or kNoneBroken,
/// whatever the number of threads. `any_broken(range)` is the fast form of the loop.
template <typename AnyBroken, typename IsBroken>
std::size_t first_broken(std::size_t count, const AnyBroken& any_broken,
                         const IsBroken& is_broken) {
  std::atomic<std::size_t> first = kNoneBroken;
  parallel_for(count, kZooValidateGrain, [&](IndexRange range) {
    if (range.begin > first.load(std::memory_order_relaxed) || !any_broken(range)) return;
    std::size_t i = range.begin;
    while (!is_broken(i)) ++i;
    std::size_t known = first.load(std::memory_order_relaxed);
    while (i < known && !first.compare_exchange_weak(known, i, std::memory_order_relaxed)) {
    }
  });
  return first;
}

template <typename IsBroken>
std::size_t first_broken(std::size_t count, const IsBroken& is_broken) {
  const auto any_broken = [&](IndexRange range) {
    // without an early exit, so that the compiler vectorizes the loop
    bool any = false;
    for (std::size_t i = range.begin; i < range.end; ++i) any |= is_broken(i);
    return any;
  };
  return first_broken(count, any_broken, is_broken);
}

constexpr std::array<std::uint8_t, kKindCount> kNodeCounts = [] {
  std::array<std::uint8_t, kKindCount> counts{};
  for (std::size_t k = 0; k < kKindCount; ++k)
    counts[k] = static_cast<std::uint8_t>(node_count(static_cast<CellKind>(k)));
  return counts;
}();

void validate_sizes(const ZooMesh& mesh, const std::string& subject) {
  if (mesh.cell_count() >= kNoCell)
    throw InputError(subject, fmt::format("too many cells (at most {} expected, {} found)",
                                          kNoCell - 1, mesh.cell_count()));
  if (mesh.elems.size() != mesh.cell_count() + 1)
    throw InputError(subject, fmt::format("the cells' node offsets do not fit the cells (one more "
                                          "than {} cells expected, {} found)",
                                          mesh.cell_count(), mesh.elems.size()));
  if (mesh.xyz.size() % 3 != 0)
    throw InputError(subject, fmt::format("coordinates are not triples (a multiple of 3 expected, "
                                          "{} numbers found)",
                                          mesh.xyz.size()));
}

void validate_cells(const ZooMesh& mesh, const std::string& subject) {
  const auto kinds = mesh.kinds.view();
  const auto elems = mesh.elems.view();
  const auto kind_number = [&](std::size_t i) { return static_cast<std::uint8_t>(kinds[i]); };
  const std::size_t bad_kind =
      first_broken(kinds.size(), [&](std::size_t i) { return !is_kind(kind_number(i)); });
  if (bad_kind != kNoneBroken)
    throw InputError(subject, fmt::format("cell {}: unknown kind (below {} expected, {} found)",
                                          bad_kind, kKindCount, kind_number(bad_kind)));
  if (elems[0] != 0)
    throw InputError(subject,
                     fmt::format("cell 0: wrong node offset (0 expected, {} found)", elems[0]));
  const std::size_t bad_count = first_broken(kinds.size(), [&](std::size_t i) {
    return elems[i + 1] - elems[i] != kNodeCounts[kind_number(i)];
  });
  if (bad_count != kNoneBroken)
    throw InputError(
        subject,
        fmt::format("cell {}: wrong number of nodes ({} expected of a {}, offsets {} to {} "
                    "found)",
                    bad_count, kNodeCounts[kind_number(bad_count)], kind_name(kinds[bad_count]),
                    elems[bad_count], elems[bad_count + 1]));
  if (elems.back() != mesh.nodes.size())
    throw InputError(subject, fmt::format("the list of nodes does not fit the cells ({} entries "
                                          "expected, {} found)",
                                          elems.back(), mesh.nodes.size()));
}

void validate_nodes(const ZooMesh& mesh, const std::string& subject) {
  const auto nodes = mesh.nodes.view();
  const auto xyz = mesh.xyz.view();
  const std::size_t count = mesh.node_count();
  const std::size_t bad_node =
      first_broken(nodes.size(), [&](std::size_t i) { return nodes[i] >= count; });
  if (bad_node != kNoneBroken) {
    const auto cell =
        std::upper_bound(mesh.elems.begin(), mesh.elems.end(), bad_node) - mesh.elems.begin() - 1;
    throw InputError(subject,
                     fmt::format("cell {}: node out of range (below {} expected, {} found)", cell,
                                 count, nodes[bad_node]));
  }
  const std::size_t bad_number = first_broken(
      xyz.size(), [&](std::size_t i) { return !(std::abs(xyz[i]) <= 0x1.fffffffffffffp1023); });
  if (bad_number != kNoneBroken)
    throw InputError(subject, fmt::format("node {}: coordinate {} is not finite ({} found)",
                                          bad_number / 3, "xyz"[bad_number % 3], xyz[bad_number]));
}

void validate_field(const ZooMesh& mesh, const Field& field, const std::string& subject) {
  if (field.location > FieldLocation::corner)
    throw InputError(subject, fmt::format("field {:?}: unknown location (below 3 expected, {} "
                                          "found)",
                                          field.name, static_cast<unsigned>(field.location)));
  if (field.components == 0)
    throw InputError(subject, fmt::format("field {:?}: no components (1 or more expected, 0 found)",
                                          field.name));
  const std::size_t tuples = tuple_count(mesh, field.location);
  const std::size_t values = field.values.size();
  // by division, as a product could overflow
  if (values % field.components != 0 || values / field.components != tuples)
    throw InputError(subject, fmt::format("field {:?}: wrong number of values ({} x {} expected, "
                                          "{} found)",
                                          field.name, tuples, field.components, values));
}

void validate_adjacency(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                        const std::string& subject) {
  std::uint64_t faces = 0;
  for (const CellKind kind : mesh.kinds) faces += face_count(kind);
  const auto neighbors = adjacency.neighbors.view();
  if (neighbors.size() != faces)
    throw InputError(subject, fmt::format("the face adjacency does not fit the cells ({} faces "
                                          "expected, {} found)",
                                          faces, neighbors.size()));
  const std::size_t bad = first_broken(neighbors.size(), [&](std::size_t i) {
    return neighbors[i] != kNoCell && neighbors[i] >= mesh.cell_count();
  });
  if (bad != kNoneBroken)
    throw InputError(subject, fmt::format("face {}: neighbour out of range (below {} expected, {} "
                                          "found)",
                                          bad, mesh.cell_count(), neighbors[bad]));
}

}  // namespace

void validate(const ZooMesh& mesh, const std::string& subject) {
  validate_layout(mesh, subject);
  validate_nodes(mesh, subject);
}

void validate_layout(const ZooMesh& mesh, const std::string& subject) {
  validate_sizes(mesh, subject);
  validate_cells(mesh, subject);
  for (const Field& field : mesh.fields) validate_field(mesh, field, subject);
  if (mesh.adjacency) validate_adjacency(mesh, *mesh.adjacency, subject);
}

}  // namespace hiac
