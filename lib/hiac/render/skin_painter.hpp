#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/render/bounds/skin_errors.hpp"
#include "hiac/render/cells/cell_skin.hpp"
#include "hiac/render/edges/edged_crossings.hpp"
#include "hiac/render/edges/tile_edges.hpp"
#include "hiac/render/pixels/tile.hpp"

namespace hiac {

/// Draws cells with the skin and the edges on them.
///
/// A boundary face belongs to one cell. Where a ray enters the cell through it, the skin lies
/// directly in front of the cell's segment, and where the ray leaves, directly behind it: the
/// visibility order of the cells is that of their skin, and no depths are compared. Only where a
/// ray crosses a curved cell several times, and in groups, the skin is sorted with the segments: at
/// the very end of the cell's segment that it lies at, since two computations of one depth may
/// differ in the last bit.
///
/// An edge lies on faces of cells, and its line covers rays beside it, which meet these faces a
/// little nearer or farther. So the faces decide, not the depths: a ray that enters a cell through
/// a face of the edge meets the edge first, then the skin on that face; one that leaves through a
/// face of the edge meets it directly before the skin on that one. Near an edge's end, as
/// near as half the line's width and half a pixel, a face that has the end is enough: lines run on
/// from edge to edge. A curved face may bend back, so that a ray meets it twice: an edge is met
/// where the face does not turn its other side to the eye on the way to it. A ray that passes no
/// face of the
/// edge meets it in front of the first cell whose middle is farther than the edge.
class SkinPainter {
 public:
  /// `edges`: those of the tile, `drawn` for the whole picture. All must outlive this object.
  SkinPainter(const Frame& frame, const ScreenEdges& drawn, TileEdges& edges);

  /// Whether a cell has skin, or edges that are yet to be drawn may lie on it.
  [[nodiscard]] bool concerns(CellId cell) const {
    return frame_.skin.on(cell) != 0 || (drawn_.may_touch(cell) && edges_.may_meet(cell));
  }

  /// Draws one cell. `with_inside`: else only its skin and edges. In a group the edges wait for
  /// settle().
  void draw(const TileTarget& to, CellId cell, bool with_inside);

  /// Draws the edges on the cells of a group, once all of these are drawn: which cell an edge is
  /// met at depends on the order of all. They become the first entries of the group's list, so that
  /// an edge comes before the skin that it lies on. Returns the cells at which each is met.
  std::vector<CellId> settle(const TileTarget& to);

  /// Where a cell's own segments end in a list, and the skin begins that rays enter the cell
  /// through; where that begins that they leave it through, up to the end of the list.
  struct ListedSkin {
    std::size_t entered, left;
  };
  /// Appends a cell and its skin to the list of `to`, and calls on_crossing(ray, front, back) for
  /// every ray through the cell with the places at which edges on it lie. No edges are drawn.
  template <typename OnCrossing>
  ListedSkin list(const TileTarget& to, CellId cell, bool with_inside,
                  const OnCrossing& on_crossing) {
    skin_.enter(cell, to.tile);
    list_inside(to, cell, with_inside);
    for (const CellCrossing& ray : skin_.rays()) {
      const std::size_t at = to.tile.index(ray.x, ray.y);
      on_crossing(ray, end_at(at, ray.front, true), end_at(at, ray.back, false));
    }
    ListedSkin listed{to.group->segments.size(), 0};
    add_skin(to, Which::entered);
    listed.left = to.group->segments.size();
    add_skin(to, Which::left);
    ends_.clear();
    return listed;
  }

  /// The transparency of all that has been composited of the skin in a pixel.
  [[nodiscard]] double transparency(std::size_t at) const {
    return transparency_.empty() ? 1 : transparency_[at];
  }

 private:
  enum class Which : std::uint8_t { entered, left, all };
  void draw_sorted(const TileTarget& to, CellId cell, bool with_inside);
  void list_inside(const TileTarget& to, CellId cell, bool with_inside);
  void note_ends(const SegmentList& list, std::size_t first);
  [[nodiscard]] double end_at(std::size_t at, double t, bool enters) const;
  void add_skin(const TileTarget& to, Which which);
  void add_point(const TileTarget& to, const SkinCrossing& crossing, const ShadedPoint& seen);
  void add_hidden(const TileTarget& to);
  void note_edged_rays(const TileRect& tile);
  void add_edges(const TileTarget& to, CellId cell, Which which);
  void note_crossings(const TileRect& tile, CellId cell);

  const Frame& frame_;
  const ScreenEdges& drawn_;
  TileEdges& edges_;
  CellSkin skin_;
  SkinErrors errors_;
  std::vector<double> transparency_;
  std::vector<const CellCrossing*> edged_;  // rays of the cell at hand with edges not drawn yet
  std::vector<std::uint32_t> seen_;         // crossings of the skin; scratch
  std::vector<double> ray_scales_;          // of these
  SegmentList list_;                        // of a cell that is crossed several times
  // Where the segment of the cell at hand begins and ends in each pixel; used in lists.
  struct Ends {
    double front, back;
    std::size_t count;  // of the pixel's segments
  };
  std::vector<Ends> ends_;
  // Of the group at hand, in pixels with edges that are yet to be drawn.
  EdgedCrossings crossings_;
  std::vector<CellId> crossed_;  // by each of the rays
};

}  // namespace hiac
