#include "hiac/tetrahedralize/cell_cut.hpp"

#include <algorithm>

namespace hiac {
namespace {

std::uint8_t least_corner(CellKind kind, std::span<const NodeId> nodes) {
  const auto corners = nodes.first(corner_count(kind));
  return static_cast<std::uint8_t>(std::ranges::min_element(corners) - corners.begin());
}

// A face's corners, the one of the least node id first; still counter-clockwise from outside.
std::array<std::uint8_t, 4> least_first(const ShapeFace& face, std::span<const NodeId> nodes) {
  const std::size_t count = face.corner_count;
  std::size_t least = 0;
  for (std::size_t k = 1; k < count; ++k)
    if (nodes[face.corners[k]] < nodes[face.corners[least]]) least = k;
  std::array<std::uint8_t, 4> corners{};
  for (std::size_t k = 0; k < count; ++k) corners[k] = face.corners[(least + k) % count];
  return corners;
}

// The triangles of all faces but those at corner `apart`, joined to `apex`.
CellCut joined_to(std::uint8_t apex, std::uint8_t apart, CellKind kind,
                  std::span<const NodeId> nodes) {
  CellCut cut;
  for (const ShapeFace& face : topology_of(kind).faces) {
    const std::array<std::uint8_t, 4> c = least_first(face, nodes);
    if (c[0] == apart) continue;
    // seen from the apex, inside, the triangles turn clockwise
    cut.tetrahedra[cut.count++] = {c[0], c[2], c[1], apex};
    if (face.corner_count == 4) cut.tetrahedra[cut.count++] = {c[0], c[3], c[2], apex};
  }
  return cut;
}

}  // namespace

CellCut cut_cell(CellKind kind, std::span<const NodeId> nodes) {
  CellCut cut;
  if (shape_of(kind) == CellShape::tetrahedron) {
    cut.tetrahedra[cut.count++] = {0, 1, 2, 3};
    return cut;
  }
  const std::uint8_t apex = least_corner(kind, nodes);  // which comes first wherever it is
  return joined_to(apex, apex, kind, nodes);
}

CellCut cut_cell_at_center(CellKind kind, std::span<const NodeId> nodes) {
  return joined_to(kCellCenter, kCellCenter, kind, nodes);
}

}  // namespace hiac
