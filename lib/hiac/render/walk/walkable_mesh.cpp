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

Nodes nodes_of(const ZooMesh& mesh, CellId cell) {
  const std::size_t first = std::size_t{4} * cell;
  return {mesh.nodes[first], mesh.nodes[first + 1], mesh.nodes[first + 2], mesh.nodes[first + 3]};
}

// The cells opposite a cell's nodes.
std::array<CellId, 4> across_of(const FaceAdjacency& adjacency, CellId cell) {
  std::array<CellId, 4> across{};
  for (std::size_t k = 0; k < 4; ++k)
    across[k] = adjacency.neighbors[std::size_t{4} * cell + kFaceOpposite[k]];
  return across;
}

// Whether every neighbour has the face, and this cell as its neighbour there.
bool is_sound(const ZooMesh& mesh, const FaceAdjacency& adjacency, CellId cell) {
  const Nodes own = nodes_of(mesh, cell);
  const std::array<CellId, 4> across = across_of(adjacency, cell);
  for (std::size_t k = 0; k < 4; ++k) {
    if (std::ranges::count(own, own[k]) != 1) return false;
    if (across[k] == kNoCell) continue;
    if (across[k] >= mesh.cell_count()) return false;
    const Nodes other = nodes_of(mesh, across[k]);
    if (!has_all(other, own, k)) return false;
    const NodeId beyond = node_beyond(own, k, other);
    const std::size_t opposite = WalkableMesh::number_of(beyond, other);
    // a node that the other cell has twice has no number there
    if (opposite > 3 || other[opposite] != beyond ||
        across_of(adjacency, across[k])[opposite] != cell)
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
    const Nodes nodes = nodes_of(mesh, order_.cells[cell]);
    for (std::size_t k = 0; k < 4; ++k) cells_[cell].nodes[k] = node_number[nodes[k]];
  });
  for_all_cells(cells_.size(), [&](std::size_t cell) {
    const std::array<CellId, 4> across = across_of(adjacency, order_.cells[cell]);
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
  if (count > OppositeFace::kMostCells || adjacency.neighbors.size() != 4 * count ||
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
