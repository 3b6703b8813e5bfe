#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "hiac/frame/projection.hpp"
#include "hiac/frame/tiles/tile.hpp"
#include "hiac/mesh/parted/whole_corners.hpp"
#include "hiac/optics/piece_rule.hpp"
#include "hiac/render/edges/edge_place.hpp"
#include "hiac/render/edges/edged_crossings.hpp"
#include "hiac/render/edges/strip_coverage.hpp"
#include "hiac/render/pixels/pixel_details.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

// Edges of a mesh in parts. An edge covers pixels beside it, and lies on faces of cells that may be
// of other parts: where it is met along a ray is known only where all parts come together. So in
// pixels through which edges pass, parts send their segments one by one, and the ends of the rays'
// ways through cells, at which edges may lie (SkinPainter says which).

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

/// The part of an edge that covers a pixel (TileEdges).
struct EdgeFragment {
  std::uint32_t pixel;
  double share;                    ///< of the pixel
  double t;                        ///< ray parameter
  Strip strip;                     ///< of the edge's straight piece
  EdgePlace<std::uint64_t> place;  ///< nodes of the whole mesh; kNoGlobalNode for none
};

/// What one part of a mesh contributes to the pixels of a tile that have edges.
struct EdgedTile {
  std::vector<EdgedSegment> segments;
  EdgedCrossings crossings;  ///< of cells on which edges may lie; nodes are those of the whole mesh
  std::vector<EdgeFragment> fragments;  ///< of the edges that the part draws
};

/// Where and how edges are drawn.
struct EdgedView {
  const Edges& look;
  const Projector& projector;
  TileRect tile;
};

/// Calls composite(segment) for all segments of all parts in pixels with edges, and the edges among
/// them, pixel by pixel and front to back; where it returns false, the rest of the pixel is not
/// seen. The order depends on nothing but the parts' contributions.
void visit_edged(std::span<const EdgedTile* const> parts, const EdgedView& view,
                 const std::function<bool(const EdgedSegment&)>& composite);

}  // namespace hiac
