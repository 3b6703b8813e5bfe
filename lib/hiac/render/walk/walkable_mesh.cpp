#include "hiac/render/walk/walkable_mesh.hpp"

#include <algorithm>
#include <atomic>

#include "hiac/base/large_pages.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/mesh/cell_kind.hpp"

namespace hiac {
namespace {

using Nodes = std::array<NodeId, 4>;

constexpr std::size_t kWalkableGrain = std::size_t{1} << 14;

// The exclusive or of a cell's nodes; with that of a face's nodes it is the node opposite the face.
NodeId mixed(const Nodes& nodes) { return nodes[0] ^ nodes[1] ^ nodes[2] ^ nodes[3]; }

bool has_all(const Nodes& nodes, const Nodes& face, std::size_t lacking) {
  for (std::size_t k = 0; k < 4; ++k)
    if (k != lacking && std::ranges::find(nodes, face[k]) == nodes.end()) return false;
  return true;
}

std::array<NodeId, 3> corners_of(const Nodes& nodes, std::size_t opposite) {
  std::array<NodeId, 3> corners{};
  for (std::size_t k = 0, n = 0; k < 4; ++k)
    if (k != opposite) corners[n++] = nodes[k];
  return corners;
}

// The number of the face opposite a node.
constexpr std::array<std::size_t, 4> kFaceOpposite = [] {
  std::array<std::size_t, 4> face{};
  const auto faces = topology_of(CellShape::tetrahedron).faces;
  for (std::size_t f = 0; f < faces.size(); ++f)
    face[6U - faces[f].corners[0] - faces[f].corners[1] - faces[f].corners[2]] = f;
  return face;
}();

// The node of `other` that a cell lacks with which it shares the face opposite its node `opposite`.
NodeId node_beyond(const Nodes& own, std::size_t opposite, const Nodes& other) {
  return mixed(other) ^ mixed(own) ^ own[opposite];
}

// A cell's nodes, and the cells opposite each of them, as the mesh numbers them.
struct Linked {
  Nodes nodes;
  std::array<CellId, 4> across;
};
Linked linked(const ZooMesh& mesh, const FaceAdjacency& adjacency, CellId cell) {
  Linked at{};
  const std::size_t first = std::size_t{4} * cell;
  for (std::size_t k = 0; k < 4; ++k) {
    at.nodes[k] = mesh.nodes[first + k];
    at.across[k] = adjacency.neighbors[first + kFaceOpposite[k]];
  }
  return at;
}

// Whether every neighbour has the face, and this cell as its neighbour there.
bool is_sound(const ZooMesh& mesh, const FaceAdjacency& adjacency, CellId cell) {
  const Linked own = linked(mesh, adjacency, cell);
  for (std::size_t k = 0; k < 4; ++k) {
    if (std::ranges::count(own.nodes, own.nodes[k]) != 1) return false;
    if (own.across[k] == kNoCell) continue;
    if (own.across[k] >= mesh.cell_count()) return false;
    const Linked other = linked(mesh, adjacency, own.across[k]);
    if (!has_all(other.nodes, own.nodes, k)) return false;
    const NodeId beyond = node_beyond(own.nodes, k, other.nodes);
    const std::size_t opposite = WalkableMesh::number_of(beyond, other.nodes);
    // of a node that a cell has twice there is no number
    if (opposite > 3 || other.nodes[opposite] != beyond || other.across[opposite] != cell)
      return false;
  }
  return true;
}

template <typename Do>
void for_all_cells(std::size_t count, const Do& act) {
  parallel_for(count, kWalkableGrain, [&](IndexRange range) {
    for (std::size_t cell = range.begin; cell < range.end; ++cell) act(cell);
  });
}

}  // namespace

WalkableMesh::WalkableMesh(const ZooMesh& mesh, const FaceAdjacency& adjacency)
    : mesh_(&mesh), order_(near_order(mesh)), cells_(large_vector<Cell>(mesh.cell_count())) {
  const std::vector<std::uint32_t> cell_number = numbers_in(order_.cells);
  const std::vector<std::uint32_t> node_number = numbers_in(order_.nodes);
  for_all_cells(cells_.size(), [&](std::size_t cell) {
    for (std::size_t k = 0; k < 4; ++k)
      cells_[cell].nodes[k] = node_number[mesh.nodes[std::size_t{4} * order_.cells[cell] + k]];
  });
  for_all_cells(cells_.size(), [&](std::size_t cell) {
    const std::array<CellId, 4> across = linked(mesh, adjacency, order_.cells[cell]).across;
    for (std::size_t k = 0; k < 4; ++k) {
      if (across[k] == kNoCell) continue;
      const CellId other = cell_number[across[k]];
      const Nodes& nodes = cells_[other].nodes;
      cells_[cell].across[k] = {other, number_of(node_beyond(cells_[cell].nodes, k, nodes), nodes)};
    }
  });
  find_boundary();
}

WalkableMesh WalkableMesh::again(const ZooMesh& mesh, const FaceAdjacency& adjacency) {
  return {mesh, adjacency};
}

std::optional<WalkableMesh> WalkableMesh::of(const ZooMesh& mesh, const FaceAdjacency& adjacency) {
  const std::size_t count = mesh.cell_count();
  if (count >= OppositeFace::kMostCells || adjacency.neighbors.size() != 4 * count ||
      !std::ranges::all_of(mesh.kinds.view(),
                           [](CellKind kind) { return kind == CellKind::tetrahedron4; }))
    return std::nullopt;
  std::atomic<bool> sound = true;
  for_all_cells(count, [&](std::size_t cell) {
    if (sound && !is_sound(mesh, adjacency, static_cast<CellId>(cell))) sound = false;
  });
  if (!sound) return std::nullopt;
  return WalkableMesh(mesh, adjacency);
}

void WalkableMesh::find_boundary() {
  for (std::size_t cell = 0; cell < cells_.size(); ++cell)
    for (std::size_t k = 0; k < 4; ++k)
      if (!cells_[cell].across[k].exists())
        boundary_.push_back({{static_cast<CellId>(cell), k}, corners_of(cells_[cell].nodes, k)});
}

}  // namespace hiac
