#include "hiac/frame/surfaces/skin_sides.hpp"

#include <algorithm>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

std::vector<SkinSide> skin_sides(const ZooMesh& mesh, std::span<const std::uint8_t> faces) {
  std::vector<SkinSide> sides;
  for (CellId cell = 0; cell < faces.size(); ++cell) {
    const auto shape_faces = topology_of(mesh.kinds[cell]).faces;
    const auto nodes = mesh.cell_nodes(cell);
    for (std::size_t f = 0; f < shape_faces.size(); ++f) {
      if ((faces[cell] >> f & 1U) == 0) continue;
      const ShapeFace& face = shape_faces[f];
      for (std::size_t k = 0; k < face.corner_count; ++k) {
        const NodeId a = nodes[face.corners[k]],
                     b = nodes[face.corners[(k + 1) % face.corner_count]];
        sides.push_back(
            {{std::min(a, b), std::max(a, b)}, cell, static_cast<std::uint8_t>(f), a < b});
      }
    }
  }
  std::ranges::stable_sort(sides, {}, &SkinSide::edge);
  return sides;
}

std::span<const SkinSide> sides_at(std::span<const SkinSide> sides, std::array<NodeId, 2> edge) {
  const auto found = std::ranges::equal_range(sides, edge, {}, &SkinSide::edge);
  return {found.begin(), found.end()};
}

}  // namespace hiac
