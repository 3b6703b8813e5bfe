#include "hiac/partition/partition.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <span>

#include <fmt/format.h>
#include <metis.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/parted/cell_weight.hpp"

namespace hiac {
namespace {

/// METIS sums weights in idx_t, of which we use half.
constexpr std::uint64_t kMostWeight = std::uint64_t{1} << 30;
/// The weight of a part is allowed to exceed the mean by this many thousandths.
constexpr idx_t kImbalance = 20;
/// Parts whose weights differ by more are divided once more, by bisection.
constexpr double kGoodBalance = 1.03;

/// The cells as nodes of a graph, with an edge for each pair that shares faces.
struct Graph {
  std::vector<idx_t> ends;  ///< cell i has neighbors[ends[i]] to neighbors[ends[i + 1] - 1]
  std::vector<idx_t> neighbors;
  std::vector<idx_t> weights;
};

/// The weights of all cells, in a coarser unit where their sum would be too large.
std::vector<idx_t> weights_of(const ZooMesh& mesh) {
  std::uint64_t total = 0;
  for (const CellKind kind : mesh.kinds) total += cell_weight(kind);
  const double unit = std::max(1.0, static_cast<double>(total) / static_cast<double>(kMostWeight));
  std::vector<idx_t> weights;
  weights.reserve(mesh.cell_count());
  for (const CellKind kind : mesh.kinds)
    weights.push_back(std::max(1, static_cast<idx_t>(cell_weight(kind) / unit)));
  return weights;
}

Graph graph_of(const ZooMesh& mesh, const std::string& subject) {
  const FaceAdjacency adjacency = mesh.adjacency ? *mesh.adjacency : build_face_adjacency(mesh);
  const auto all = adjacency.neighbors.view();
  if (all.size() > static_cast<std::size_t>(std::numeric_limits<idx_t>::max()))
    throw InputError(subject, fmt::format("has too many faces to be divided into parts (at most {} "
                                          "expected, {} found)",
                                          std::numeric_limits<idx_t>::max(), all.size()));
  Graph graph{{0}, {}, weights_of(mesh)};
  graph.ends.reserve(mesh.cell_count() + 1);
  graph.neighbors.reserve(all.size());
  std::size_t face = 0;
  for (const CellKind kind : mesh.kinds) {
    const auto begin = static_cast<std::ptrdiff_t>(graph.neighbors.size());
    for (const std::size_t end = face + face_count(kind); face < end; ++face) {
      if (all[face] == kNoCell) continue;
      const auto neighbor = static_cast<idx_t>(all[face]);
      // two cells may share several faces
      const auto known = std::span(graph.neighbors).subspan(static_cast<std::size_t>(begin));
      if (std::ranges::find(known, neighbor) == known.end()) graph.neighbors.push_back(neighbor);
    }
    graph.ends.push_back(static_cast<idx_t>(graph.neighbors.size()));
  }
  return graph;
}

using Divide = decltype(METIS_PartGraphKway)*;

std::vector<idx_t> divided(Divide divide, Graph& graph, std::size_t parts, idx_t imbalance) {
  std::array<idx_t, METIS_NOPTIONS> options{};
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_UFACTOR] = imbalance;
  auto cells = static_cast<idx_t>(graph.weights.size());
  auto count = static_cast<idx_t>(parts);
  idx_t constraints = 1, cut = 0;
  std::vector<idx_t> part(graph.weights.size());
  graph.neighbors.reserve(1);  // METIS wants a pointer even where there is no edge
  const int status =
      divide(&cells, &constraints, graph.ends.data(), graph.neighbors.data(), graph.weights.data(),
             nullptr, nullptr, &count, nullptr, nullptr, options.data(), &cut, part.data());
  if (status == METIS_ERROR_MEMORY) throw std::bad_alloc();
  if (status != METIS_OK)
    throw Error(ExitCode::internal, fmt::format("METIS failed to divide {} cells into {} parts "
                                                "(status {})",
                                                cells, parts, status));
  return part;
}

std::vector<std::uint64_t> weights_of_parts(const Graph& graph, const std::vector<idx_t>& part,
                                            std::size_t parts) {
  std::vector<std::uint64_t> weights(parts, 0);
  for (std::size_t cell = 0; cell < part.size(); ++cell)
    weights[static_cast<std::size_t>(part[cell])] +=
        static_cast<std::uint64_t>(graph.weights[cell]);
  return weights;
}

/// The largest weight of a part over the mean.
double balance(const std::vector<std::uint64_t>& weights) {
  std::uint64_t total = 0;
  for (const std::uint64_t weight : weights) total += weight;
  return static_cast<double>(*std::ranges::max_element(weights)) *
         static_cast<double>(weights.size()) / static_cast<double>(total);
}

/// Gives each part without cells one of the heaviest part that can spare one.
void fill_empty_parts(const Graph& graph, std::size_t parts, std::vector<idx_t>& part) {
  std::vector<std::size_t> counts(parts, 0);
  for (const idx_t p : part) ++counts[static_cast<std::size_t>(p)];
  for (std::size_t empty = 0; empty < parts; ++empty) {
    if (counts[empty] > 0) continue;
    auto weights = weights_of_parts(graph, part, parts);
    for (std::size_t p = 0; p < parts; ++p)
      if (counts[p] < 2) weights[p] = 0;
    const auto from = std::ranges::max_element(weights) - weights.begin();
    *std::ranges::find(part, static_cast<idx_t>(from)) = static_cast<idx_t>(empty);
    --counts[static_cast<std::size_t>(from)];
    ++counts[empty];
  }
}

}  // namespace

std::vector<std::uint32_t> partition_cells(const ZooMesh& mesh, std::size_t parts,
                                           const std::string& subject) {
  if (parts == 0 || parts > mesh.cell_count())
    throw UsageError(fmt::format("{} parts of {} cells (1 to {} parts expected)", parts,
                                 mesh.cell_count(), mesh.cell_count()));
  if (parts == 1) return std::vector<std::uint32_t>(mesh.cell_count(), 0);
  Graph graph = graph_of(mesh, subject);
  std::vector<idx_t> part = divided(METIS_PartGraphKway, graph, parts, kImbalance);
  const double reached = balance(weights_of_parts(graph, part, parts));
  if (reached > kGoodBalance) {
    std::vector<idx_t> other = divided(METIS_PartGraphRecursive, graph, parts, 1);
    if (balance(weights_of_parts(graph, other, parts)) < reached) part = std::move(other);
  }
  fill_empty_parts(graph, parts, part);
  return {part.begin(), part.end()};
}

std::string partitioner_version() {
  return fmt::format("METIS {}.{}.{}", METIS_VER_MAJOR, METIS_VER_MINOR, METIS_VER_SUBMINOR);
}

}  // namespace hiac
