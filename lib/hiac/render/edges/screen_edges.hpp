#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/frame/tiles/tile.hpp"
#include "hiac/geometry/face_form.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// No node of the mesh.
inline constexpr NodeId kNoNode = std::numeric_limits<NodeId>::max();

/// A straight piece of a mesh's edge on the screen, from one end to the other.
struct EdgePiece {
  double x0, y0, depth0;  ///< ProjectedNode
  double x1, y1, depth1;
  double from, to;             ///< where it begins and ends along the whole edge, from 0 to 1
  std::array<NodeId, 2> edge;  ///< the edge's ends
  std::array<NodeId, 2> ends;  ///< the piece's ends; kNoNode where these are no ends of the edge
};

/// The edges that a scene draws, on the screen. A curved edge is drawn as sixteen straight pieces.
/// What lies outside the clipping slab or behind the eye is left out; in perspective, so is what is
/// nearer to the eye plane than a millionth of the piece's farther end.
class ScreenEdges {
 public:
  /// No edges.
  ScreenEdges() = default;
  ScreenEdges(const Frame& frame, const Scene& scene);
  /// These edges alone, of a mesh with this boundary (boundary_faces.hpp). The scene draws edges.
  ScreenEdges(const Frame& frame, const Scene& scene, std::vector<std::uint8_t> boundary,
              std::span<const EdgeNodes> edges);

  [[nodiscard]] bool none() const { return pieces_.empty(); }
  /// Whether drawn edges may lie on a cell: on all cells, or on those of the boundary.
  [[nodiscard]] bool may_touch(CellId cell) const {
    return !none() && (look_.show == EdgeChoice::all || boundary_[cell] != 0);
  }
  [[nodiscard]] const Edges& look() const { return look_; }

  /// Calls visit(piece) for the pieces that may reach a tile.
  template <typename Visit>
  void visit_in(const TileRect& tile, const Visit& visit) const {
    if (none()) return;
    const std::size_t at = tile_at(tile.x0, tile.y0);
    for (std::uint64_t k = first_[at]; k < first_[at + 1]; ++k) visit(pieces_[in_tile_[k]]);
  }

 private:
  void add_all(const Frame& frame, std::span<const EdgeNodes> edges);
  void add(const Frame& frame, std::span<const std::array<double, 3>> nodes, double from, double to,
           const std::array<NodeId, 2>& edge);
  void deal_out(ImageSize size);
  template <typename Visit>
  void visit_tiles(const EdgePiece& piece, ImageSize size, const Visit& visit) const;
  [[nodiscard]] std::size_t tile_at(int x, int y) const {
    return static_cast<std::size_t>(y) / kTileHeight * columns_ +
           static_cast<std::size_t>(x) / kTileWidth;
  }

  Edges look_;
  std::vector<std::uint8_t> boundary_;  // boundary_faces
  std::vector<EdgePiece> pieces_;
  // of the whole picture's tiles, row by row
  std::size_t columns_ = 0;
  std::vector<std::uint64_t> first_;
  std::vector<std::uint32_t> in_tile_;  // pieces
};

}  // namespace hiac
