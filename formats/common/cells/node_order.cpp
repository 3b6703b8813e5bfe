#include "formats/common/cells/node_order.hpp"

#include <array>
#include <atomic>
#include <cmath>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"

namespace hiac::formats {
namespace {

constexpr std::size_t kGrain = 4096;
/// Coordinates are often stored in single precision: positions are accurate to this fraction of the
/// cell's size only, which matters where the ends of an edge coincide.
constexpr double kCoordinateError = 1e-6;
/// The most edge nodes that a kind has: the cubic brick's.
constexpr std::size_t kMostEdgeNodes = 24;

using Point = std::array<double, 3>;

double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// The edge nodes of one cell, their expected places on the straight edges, and the edge lengths.
struct EdgeNodes {
  std::size_t count = 0;
  std::array<Point, kMostEdgeNodes> nodes;
  std::array<Point, kMostEdgeNodes> places;
  std::array<double, kMostEdgeNodes> lengths;
  double longest = 0;
};

Point point_of(const ZooMesh& mesh, NodeId node) {
  const auto position = mesh.position(node);
  return {position[0], position[1], position[2]};
}

EdgeNodes edge_nodes_of(const ZooMesh& mesh, CellId cell) {
  const CellKind kind = mesh.kinds[cell];
  const auto nodes = mesh.cell_nodes(cell);
  const std::size_t per_edge = static_cast<std::size_t>(order_of(kind)) - 1;
  EdgeNodes result;
  for (const ShapeEdge& edge : topology_of(kind).edges) {
    const Point a = point_of(mesh, nodes[edge[0]]);
    const Point b = point_of(mesh, nodes[edge[1]]);
    const double length = distance(a, b);
    result.longest = std::max(result.longest, length);
    for (std::size_t k = 1; k <= per_edge; ++k) {
      const double t = static_cast<double>(k) / static_cast<double>(per_edge + 1);
      const std::size_t i = result.count++;
      result.nodes[i] = point_of(mesh, nodes[corner_count(kind) + i]);
      result.lengths[i] = length;
      for (std::size_t c = 0; c < 3; ++c) result.places[i][c] = a[c] + t * (b[c] - a[c]);
    }
  }
  return result;
}

/// How well an edge node is placed, from good to bad.
enum class Placement : std::uint8_t { fine, misplaced, exchanged };

Placement placement_of(const EdgeNodes& cell, std::size_t i) {
  const double off = distance(cell.nodes[i], cell.places[i]);
  const double slack = kCoordinateError * cell.longest;
  if (off <= kFarAndNearerToAnother * cell.lengths[i] + slack) return Placement::fine;
  auto result =
      off > kFarFromPlace * cell.lengths[i] + slack ? Placement::misplaced : Placement::fine;
  for (std::size_t j = 0; j < cell.count; ++j) {
    if (j == i) continue;
    const double other = distance(cell.nodes[i], cell.places[j]);
    if (other <= kInAnothersPlace * cell.lengths[j]) return Placement::exchanged;
    if (other < off) result = Placement::misplaced;
  }
  return result;
}

/// The worst-placed edge node of a cell and how it is placed.
struct WorstNode {
  std::size_t index = 0;
  Placement placement = Placement::fine;
};

WorstNode worst_node(const EdgeNodes& cell) {
  WorstNode worst;
  for (std::size_t i = 0; i < cell.count && worst.placement != Placement::exchanged; ++i)
    if (const Placement placement = placement_of(cell, i); placement > worst.placement)
      worst = {i, placement};
  return worst;
}

/// Lowers `value` to `candidate` if that is less.
void lower(std::atomic<std::size_t>& value, std::size_t candidate) {
  std::size_t known = value;
  while (candidate < known && !value.compare_exchange_weak(known, candidate)) {
  }
}

/// The findings for the cells of one kind.
struct KindFindings {
  std::atomic<std::size_t> cells = 0;
  std::atomic<std::size_t> misplaced = 0;  ///< cells with misplaced nodes, exchanged ones included
  std::atomic<std::size_t> exchanged = 0;
  std::atomic<std::size_t> first_misplaced = kNoCell;
  std::atomic<std::size_t> first_exchanged = kNoCell;
};

std::string description(const ZooMesh& mesh, CellId cell) {
  const EdgeNodes edge_nodes = edge_nodes_of(mesh, cell);
  const std::size_t i = worst_node(edge_nodes).index;
  const CellKind kind = mesh.kinds[cell];
  const std::size_t per_edge = static_cast<std::size_t>(order_of(kind)) - 1;
  const ShapeEdge& edge = topology_of(kind).edges[i / per_edge];
  return fmt::format(
      "node {} of cell {} lies {:.3g} edge lengths from its place on the edge from "
      "node {} to node {}",
      corner_count(kind) + i, cell,
      distance(edge_nodes.nodes[i], edge_nodes.places[i]) / edge_nodes.lengths[i], edge[0],
      edge[1]);
}

}  // namespace

void check_edge_nodes(const ZooMesh& mesh, const std::string& subject,
                      std::vector<std::string>& notes) {
  std::array<KindFindings, kKindCount> findings;
  parallel_for(mesh.cell_count(), kGrain, [&](IndexRange range) {
    for (std::size_t cell = range.begin; cell < range.end; ++cell) {
      if (order_of(mesh.kinds[cell]) == CellOrder::linear) continue;
      KindFindings& found = findings[static_cast<std::size_t>(mesh.kinds[cell])];
      ++found.cells;
      const Placement placement =
          worst_node(edge_nodes_of(mesh, static_cast<CellId>(cell))).placement;
      if (placement == Placement::fine) continue;
      ++found.misplaced;
      lower(found.first_misplaced, cell);
      if (placement != Placement::exchanged) continue;
      ++found.exchanged;
      lower(found.first_exchanged, cell);
    }
  });
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const KindFindings& found = findings[k];
    if (found.misplaced == 0) continue;
    const std::string_view name = kind_name(static_cast<CellKind>(k));
    const bool too_many = static_cast<double>(found.misplaced) >
                          kMostMisplacedCells * static_cast<double>(found.cells);
    const std::size_t cell = found.exchanged > 0 ? found.first_exchanged : found.first_misplaced;
    if (found.exchanged > 0 || too_many)
      throw InputError(
          subject, fmt::format("wrong node order of {} cells: {} (at most {} expected; {} of "
                               "{} cells are wrong)",
                               name, description(mesh, static_cast<CellId>(cell)), kFarFromPlace,
                               found.misplaced, found.cells));
    notes.push_back(fmt::format(
        "{} of {} {} cells have edge nodes far from their edges (strongly "
        "curved, or tangled): {}",
        found.misplaced, found.cells, name, description(mesh, static_cast<CellId>(cell))));
  }
}

}  // namespace hiac::formats
