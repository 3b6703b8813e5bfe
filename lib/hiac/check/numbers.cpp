#include "hiac/check/numbers.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <span>
#include <tuple>

#include "hiac/base/collect.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/base/parallel_sort.hpp"
#include "hiac/mesh/parts/used_nodes.hpp"

namespace hiac {
namespace {

constexpr std::size_t kNumbersGrain = 1 << 14;

// A node with a fingerprint of its position.
struct Placed {
  std::uint64_t hash;
  NodeId node;

  bool operator<(const Placed& other) const {
    return std::tie(hash, node) < std::tie(other.hash, other.node);
  }
};

std::uint64_t hash_of(std::span<const double, 3> p) {
  constexpr std::uint64_t kMix = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio
  std::uint64_t hash = 0;
  // + 0.0 turns both zeros into the same number
  for (const double x : p)
    hash = (hash ^ (hash >> 29) ^ std::bit_cast<std::uint64_t>(x + 0.0)) * kMix;
  return hash ^ (hash >> 32);
}

bool has_repeated_node(std::span<const NodeId> nodes) {
  for (std::size_t i = 1; i < nodes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (nodes[i] == nodes[j]) return true;
  return false;
}

std::vector<Offender> unused_nodes(const ZooMesh& mesh) {
  const auto used = mark_used_nodes(mesh.nodes.view(), mesh.node_count());
  return collect<Offender>(used.size(), kNumbersGrain, [&](std::size_t node, auto& found) {
    if (used[node] == 0) found.push_back({node});
  });
}

}  // namespace

std::vector<Finding> judge_numbers(const ZooMesh& mesh) {
  std::vector<Finding> findings;
  const std::size_t nodes = mesh.node_count();
  add_finding(
      findings, Defect::node_index,
      collect<Offender>(mesh.cell_count(), kNumbersGrain, [&](std::size_t cell, auto& found) {
        const auto of_cell = mesh.cell_nodes(static_cast<CellId>(cell));
        if (std::ranges::any_of(of_cell, [&](NodeId node) { return node >= nodes; }))
          found.push_back({cell});
      }));
  add_finding(findings, Defect::coordinate,
              collect<Offender>(nodes, kNumbersGrain, [&](std::size_t node, auto& found) {
                const auto at = mesh.position(static_cast<NodeId>(node));
                if (!std::ranges::all_of(at, [](double x) { return std::isfinite(x); }))
                  found.push_back({node});
              }));
  return findings;
}

std::vector<NodeId> first_at_place(const ZooMesh& mesh) {
  std::vector<Placed> placed(mesh.node_count());
  std::vector<NodeId> first(mesh.node_count());
  parallel_for(placed.size(), kNumbersGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto node = static_cast<NodeId>(i);
      placed[i] = {hash_of(mesh.position(node)), node};
      first[i] = node;
    }
  });
  parallel_sort(placed, std::less<>());
  for (std::size_t begin = 0, end = 0; begin < placed.size(); begin = end) {
    end = begin + 1;
    while (end < placed.size() && placed[end].hash == placed[begin].hash) ++end;
    for (std::size_t i = begin + 1; i < end; ++i)
      for (std::size_t j = begin; j < i; ++j) {
        if (!std::ranges::equal(mesh.position(placed[i].node), mesh.position(placed[j].node)))
          continue;
        first[placed[i].node] = placed[j].node;
        break;
      }
  }
  return first;
}

std::vector<Finding> judge_nodes(const ZooMesh& mesh) {
  std::vector<Finding> findings;
  const std::vector<NodeId> first = first_at_place(mesh);
  add_finding(
      findings, Defect::repeated_node,
      collect<Offender>(mesh.cell_count(), kNumbersGrain, [&](std::size_t cell, auto& found) {
        if (has_repeated_node(mesh.cell_nodes(static_cast<CellId>(cell)))) found.push_back({cell});
      }));
  add_finding(findings, Defect::duplicate_node,
              collect<Offender>(first.size(), kNumbersGrain, [&](std::size_t node, auto& found) {
                if (first[node] != node) found.push_back({node, first[node]});
              }));
  add_finding(findings, Defect::unused_node, unused_nodes(mesh));
  return findings;
}

}  // namespace hiac
