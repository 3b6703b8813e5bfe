#include "hiac/session/histogram/cell_pieces.hpp"

#include <cstddef>
#include <map>
#include <span>

#include "hiac/mesh/shape_functions.hpp"
#include "hiac/tetrahedralize/tetrahedron_lattice.hpp"

namespace hiac {
namespace {

using Point = std::array<double, 3>;

/// The tetrahedra between the reference cell's centre and the triangles of its faces.
std::vector<std::array<Point, 4>> fans(CellKind kind) {
  const std::span<const Point> nodes = reference_nodes(kind);
  const std::size_t corners = corner_count(kind);
  Point center{};
  for (std::size_t i = 0; i < corners; ++i)
    for (std::size_t c = 0; c < 3; ++c) center[c] += nodes[i][c] / static_cast<double>(corners);
  std::vector<std::array<Point, 4>> tetrahedra;
  for (const ShapeFace& face : topology_of(kind).faces)
    for (std::size_t i = 2; i < face.corner_count; ++i)
      tetrahedra.push_back(
          {center, nodes[face.corners[0]], nodes[face.corners[i - 1]], nodes[face.corners[i]]});
  return tetrahedra;
}

CellPieces make_pieces(CellKind kind) {
  CellPieces result;
  std::map<Point, std::uint16_t> known;
  const auto number_of = [&](const Point& point) {
    const auto [entry, is_new] =
        known.try_emplace(point, static_cast<std::uint16_t>(result.points.size()));
    if (is_new) shape_functions<double>(kind, point, result.points.emplace_back(node_count(kind)));
    return entry->second;
  };
  if (kind == CellKind::tetrahedron4) {
    std::array<std::uint16_t, 4>& whole = result.pieces.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) whole[i] = number_of(reference_nodes(kind)[i]);
    return result;
  }
  constexpr unsigned kLevels = 1;
  for (const std::array<Point, 4>& tetrahedron : fans(kind))
    for (const LatticeTetrahedron& part : halved(kLevels)) {
      std::array<std::uint16_t, 4>& piece = result.pieces.emplace_back();
      for (std::size_t i = 0; i < 4; ++i) {
        Point point{};
        for (std::size_t j = 0; j < 4; ++j)
          for (std::size_t c = 0; c < 3; ++c)
            point[c] += part[i][j] * tetrahedron[j][c] / (1U << kLevels);
        piece[i] = number_of(point);
      }
    }
  return result;
}

}  // namespace

const CellPieces& cell_pieces(CellKind kind) {
  static const std::array<CellPieces, kKindCount> all = [] {
    std::array<CellPieces, kKindCount> made;
    for (std::size_t k = 0; k < kKindCount; ++k) made[k] = make_pieces(static_cast<CellKind>(k));
    return made;
  }();
  return all[static_cast<std::size_t>(kind)];
}

}  // namespace hiac
