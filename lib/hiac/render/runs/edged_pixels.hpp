#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "hiac/frame/tiles/tile.hpp"
#include "hiac/mesh/parted/whole_corners.hpp"
#include "hiac/optics/piece_rule.hpp"
#include "hiac/render/pixels/pixel_details.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

// Edges of a mesh in parts. An edge covers pixels beside it, and lies on faces of cells that may be
// of other parts: where it is met along a ray is known only where all parts come together. So in
// pixels through which edges pass, parts send their segments one by one, and between them the stops
// at which edges may lie (SkinPainter says which).

/// The pixels of a tile through which an edge of any part passes.
class EdgedMask {
 public:
  static constexpr std::size_t kWords = kTileStride * kTileHeight / 64;

  void set(std::size_t at) { words_[at / 64] |= std::uint64_t{1} << at % 64; }
  [[nodiscard]] bool test(std::size_t at) const { return (words_[at / 64] >> at % 64 & 1U) != 0; }
  [[nodiscard]] bool any() const { return words_ != std::array<std::uint64_t, kWords>{}; }
  /// `other`: as words().
  void add(std::span<const std::uint64_t> other) {
    for (std::size_t k = 0; k < kWords; ++k) words_[k] |= other[k];
  }
  [[nodiscard]] std::span<const std::uint64_t> words() const { return words_; }

 private:
  std::array<std::uint64_t, kWords> words_{};
};

/// What a ray meets of one cell, in this order.
enum class EdgedPhase : std::uint8_t { stop_entered, skin_entered, inside, stop_left, skin_left };

/// A segment of a pixel with edges: of the medium, of the skin, or an edge.
struct EdgedSegment {
  std::uint32_t pixel;  ///< index into the tile's planes
  EdgedPhase phase = EdgedPhase::inside;
  bool is_edge = false;
  double middle;       ///< of the ray in its cell: cells do not overlap, so it sorts them,
                       ///< whatever rounding does to the ends at which they touch
  double front, back;  ///< ray parameters
  PlainRadiance light;
  SegmentDetails details;  ///< where a channel needs them
};

/// Where a ray enters or leaves a cell on which edges may lie. Nodes are those of the whole mesh.
struct EdgeStop {
  std::uint32_t pixel;
  bool enters;
  double t;                                            ///< ray parameter
  double middle;                                       ///< of the ray in the cell
  std::array<std::uint64_t, 4> front_face, back_face;  ///< corners; the last may be kNoCorner
};

/// The part of an edge that covers a pixel (TileEdges).
struct EdgeFragment {
  std::uint32_t pixel;
  double share;                       ///< of the pixel
  double t;                           ///< ray parameter
  std::array<std::uint64_t, 2> edge;  ///< its ends
  std::uint64_t node;                 ///< an end that is near, or kNoGlobalNode
};

/// What one part of a mesh contributes to the pixels of a tile that have edges.
struct EdgedTile {
  std::vector<EdgedSegment> segments;
  std::vector<EdgeStop> stops;
  std::vector<EdgeFragment> fragments;  ///< of the edges that the part draws
};

/// Calls composite(segment) for all segments of all parts in pixels with edges, and the edges among
/// them, pixel by pixel and front to back; where it returns false, the rest of the pixel is not
/// seen. The order depends on nothing but the parts' contributions.
void visit_edged(std::span<const EdgedTile* const> parts, const Edges& look,
                 const std::function<bool(const EdgedSegment&)>& composite);

}  // namespace hiac
