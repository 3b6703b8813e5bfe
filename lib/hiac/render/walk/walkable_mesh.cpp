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

}  // namespace

WalkableMesh::WalkableMesh(const ZooMesh& mesh, const FaceAdjacency& adjacency)
    : mesh_(&mesh), cells_(large_vector<Cell>(mesh.cell_count())) {
  parallel_for(cells_.size(), kWalkableGrain, [&](IndexRange range) {
    for (std::size_t cell = range.begin; cell < range.end; ++cell)
      for (std::size_t k = 0; k < 4; ++k) {
        cells_[cell].nodes[k] = mesh.nodes[4 * cell + k];
        cells_[cell].across[k] = adjacency.neighbors[4 * cell + kFaceOpposite[k]];
      }
  });
}

WalkableMesh WalkableMesh::again(const ZooMesh& mesh, const FaceAdjacency& adjacency) {
  WalkableMesh walkable(mesh, adjacency);
  walkable.find_boundary();
  return walkable;
}

std::optional<WalkableMesh> WalkableMesh::of(const ZooMesh& mesh, const FaceAdjacency& adjacency) {
  const std::size_t count = mesh.cell_count();
  if (!std::ranges::all_of(mesh.kinds.view(),
                           [](CellKind kind) { return kind == CellKind::tetrahedron4; }) ||
      adjacency.neighbors.size() != 4 * count)
    return std::nullopt;
  WalkableMesh walkable(mesh, adjacency);
  std::atomic<bool> sound = true;
  parallel_for(count, kWalkableGrain, [&](IndexRange range) {
    for (std::size_t cell = range.begin; cell < range.end && sound; ++cell)
      if (!walkable.is_sound(static_cast<CellId>(cell))) sound = false;
  });
  if (!sound) return std::nullopt;
  walkable.find_boundary();
  return walkable;
}

// Whether every neighbour has the face, and this cell as its neighbour there.
bool WalkableMesh::is_sound(CellId cell) const {
  const Cell& own = cells_[cell];
  for (std::size_t k = 0; k < 4; ++k) {
    if (std::ranges::count(own.nodes, own.nodes[k]) != 1) return false;
    if (own.across[k] == kNoCell) continue;
    if (own.across[k] >= cells_.size()) return false;
    const Cell& other = cells_[own.across[k]];
    if (!has_all(other.nodes, own.nodes, k)) return false;
    const NodeId beyond = mixed(other.nodes) ^ mixed(own.nodes) ^ own.nodes[k];
    const auto place = std::ranges::find(other.nodes, beyond) - other.nodes.begin();
    if (place == 4 || other.across[static_cast<std::size_t>(place)] != cell) return false;
  }
  return true;
}

void WalkableMesh::find_boundary() {
  for (std::size_t cell = 0; cell < mesh_->cell_count(); ++cell)
    for (std::uint8_t k = 0; k < 4; ++k)
      if (cells_[cell].across[k] == kNoCell)
        boundary_.push_back({{static_cast<CellId>(cell), k}, corners_of(cells_[cell].nodes, k)});
}

}  // namespace hiac
