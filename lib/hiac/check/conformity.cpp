#include "hiac/check/conformity.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "hiac/base/collect.hpp"
#include "hiac/base/parallel_sort.hpp"
#include "hiac/check/interfaces.hpp"

namespace hiac {
namespace {

constexpr std::size_t kConformityGrain = 1 << 13;

std::vector<Offender> wrong_neighbors(const ZooMesh& mesh, const FaceAdjacency& right,
                                      const FaceNumbering& numbering) {
  if (!mesh.adjacency) return {};
  return collect<Offender>(mesh.cell_count(), kConformityGrain, [&](std::size_t cell, auto& found) {
    for (std::uint64_t f = 0; f < numbering.count(cell); ++f) {
      const std::uint64_t slot = numbering.first(cell) + f;
      if (mesh.adjacency->neighbors[slot] != right.neighbors[slot]) found.push_back({cell, f});
    }
  });
}

using Key = std::array<NodeId, 4>;

Key key_of(const FreeFace& face) {
  Key key = face.nodes;
  if (face.corner_count == 3) key[3] = std::max({key[0], key[1], key[2]});
  std::ranges::sort(key);
  return key;
}

// Returns the free faces that three or more cells have.
std::vector<Offender> overshared(const std::vector<FreeFace>& faces) {
  using Entry = std::pair<Key, std::uint32_t>;
  std::vector<Entry> entries(faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) entries[i] = {key_of(faces[i]), i};
  parallel_sort(entries, std::less<>());
  std::vector<Offender> found;
  for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    end = begin + 1;
    while (end < entries.size() && entries[end].first == entries[begin].first) ++end;
    if (end - begin < 3) continue;
    for (std::size_t i = begin; i < end; ++i) {
      const FreeFace& face = faces[entries[i].second];
      found.push_back({face.cell, face.face});
    }
  }
  std::ranges::sort(found, {}, [](const Offender& o) { return std::pair(o.id, o.other); });
  return found;
}

// Compares how two faces with the same corners run around them: +1 the same way, -1 the opposite
// way, 0 in a different order.
int same_way(std::span<const NodeId> a, std::span<const NodeId> b) {
  const std::size_t n = a.size();
  const auto at = static_cast<std::size_t>(std::ranges::find(b, a[0]) - b.begin());
  bool same = true, opposite = true;
  for (std::size_t k = 1; k < n; ++k) {
    same = same && a[k] == b[(at + k) % n];
    opposite = opposite && a[k] == b[(at + n - k) % n];
  }
  return same ? 1 : opposite ? -1 : 0;
}

struct FaceCorners {
  std::size_t count;
  std::array<NodeId, 4> nodes;

  [[nodiscard]] std::span<const NodeId> view() const { return std::span(nodes).first(count); }
};

FaceCorners corners_of(const ZooMesh& mesh, CellId cell, std::size_t face) {
  const ShapeFace& shape = topology_of(mesh.kinds[cell]).faces[face];
  const auto nodes = mesh.cell_nodes(cell);
  FaceCorners corners{shape.corner_count, {}};
  for (std::size_t k = 0; k < shape.corner_count; ++k) corners.nodes[k] = nodes[shape.corners[k]];
  return corners;
}

// The sign of an orientation; 0 if it is unknown.
int sign_of(Turn turn) { return turn == Turn::right ? 1 : turn == Turn::left ? -1 : 0; }

std::vector<Offender> folded(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                             const FaceNumbering& numbering, const CellShapes& shapes) {
  return collect<Offender>(mesh.cell_count(), kConformityGrain, [&](std::size_t i, auto& found) {
    const auto cell = static_cast<CellId>(i);
    for (std::size_t f = 0; f < numbering.count(cell); ++f) {
      const CellId other = adjacency.neighbors[numbering.first(cell) + f];
      if (other != kNoCell && other > cell && is_folded(mesh, shapes, cell, f, other))
        found.push_back({cell, other});
    }
  });
}

}  // namespace

bool is_folded(const ZooMesh& mesh, const CellShapes& shapes, CellId cell, std::size_t face,
               CellId other) {
  const int sides = sign_of(shapes.turns[cell]) * sign_of(shapes.turns[other]);
  if (sides == 0) return false;
  const FaceCorners here = corners_of(mesh, cell, face);
  for (std::size_t f = 0; f < face_count(mesh.kinds[other]); ++f) {
    FaceCorners there = corners_of(mesh, other, f);
    for (NodeId& node : there.nodes)
      for (const NodeId own : here.nodes)
        if (std::ranges::equal(mesh.position(node), mesh.position(own))) node = own;
    if (there.count != here.count || !std::ranges::is_permutation(here.view(), there.view()))
      continue;
    return same_way(here.view(), there.view()) != -sides;
  }
  return false;
}

std::vector<FreeFace> free_faces(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                                 const FaceNumbering& numbering, const CellShapes& shapes) {
  return collect<FreeFace>(mesh.cell_count(), kConformityGrain, [&](std::size_t i, auto& found) {
    const auto cell = static_cast<CellId>(i);
    for (std::size_t f = 0; f < numbering.count(cell); ++f) {
      if (adjacency.neighbors[numbering.first(cell) + f] != kNoCell) continue;
      FaceCorners corners = corners_of(mesh, cell, f);
      if (shapes.turns[cell] == Turn::left)
        std::reverse(corners.nodes.begin(),
                     corners.nodes.begin() + static_cast<std::ptrdiff_t>(corners.count));
      found.push_back({cell, static_cast<std::uint8_t>(f), static_cast<std::uint8_t>(corners.count),
                       corners.nodes});
    }
  });
}

std::vector<Finding> judge_conformity(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                                      const CellShapes& shapes, double planarity) {
  std::vector<Finding> findings;
  const FaceNumbering numbering(mesh);
  add_finding(findings, Defect::adjacency, wrong_neighbors(mesh, adjacency, numbering));
  const std::vector<FreeFace> faces = free_faces(mesh, adjacency, numbering, shapes);
  if (adjacency.overshared > 0) add_finding(findings, Defect::overshared_face, overshared(faces));
  add_finding(findings, Defect::folded_face, folded(mesh, adjacency, numbering, shapes));
  for (Finding& finding : find_interfaces(mesh, faces, planarity))
    findings.push_back(std::move(finding));
  return findings;
}

}  // namespace hiac
