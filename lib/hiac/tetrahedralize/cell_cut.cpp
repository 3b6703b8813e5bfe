#include "hiac/tetrahedralize/cell_cut.hpp"

#include <algorithm>

namespace hiac {
namespace {

std::uint8_t least_corner(CellKind kind, std::span<const NodeId> names) {
  const auto corners = names.first(corner_count(kind));
  return static_cast<std::uint8_t>(std::ranges::min_element(corners) - corners.begin());
}

// Returns a face's corners, still counter-clockwise from outside, such that a quadrilateral's
// diagonal runs from the first to the third.
std::array<std::uint8_t, 4> diagonal_first(const ShapeFace& face, std::span<const NodeId> names,
                                           bool other) {
  const std::size_t count = face.corner_count;
  std::size_t first = 0;
  for (std::size_t k = 1; k < count; ++k)
    if (names[face.corners[k]] < names[face.corners[first]]) first = k;
  first += other ? 1 : 0;
  std::array<std::uint8_t, 4> corners{};
  for (std::size_t k = 0; k < count; ++k) corners[k] = face.corners[(first + k) % count];
  return corners;
}

}  // namespace

CellCut cut_cell(CellKind kind, std::span<const NodeId> names) {
  if (shape_of(kind) != CellShape::tetrahedron)
    return *cut_cell_at(least_corner(kind, names), kind, names, {});
  CellCut cut;
  cut.tetrahedra[cut.count++] = {0, 1, 2, 3};
  return cut;
}

std::optional<CellCut> cut_cell_at(std::uint8_t apex, CellKind kind, std::span<const NodeId> names,
                                   OtherDiagonals other) {
  CellCut cut;
  const auto faces = topology_of(kind).faces;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const bool quadrilateral = faces[f].corner_count == 4;
    const std::array<std::uint8_t, 4> c =
        diagonal_first(faces[f], names, quadrilateral && other[f]);
    if (quadrilateral && (c[1] == apex || c[3] == apex)) return std::nullopt;
    const auto corners = std::span(c).first(faces[f].corner_count);
    if (std::ranges::find(corners, apex) != corners.end()) continue;
    // the triangles run clockwise as seen from the apex inside
    cut.tetrahedra[cut.count++] = {c[0], c[2], c[1], apex};
    if (quadrilateral) cut.tetrahedra[cut.count++] = {c[0], c[3], c[2], apex};
  }
  return cut;
}

}  // namespace hiac
