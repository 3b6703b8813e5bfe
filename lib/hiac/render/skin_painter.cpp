#include "hiac/render/skin_painter.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "hiac/render/draw_cells.hpp"
#include "hiac/render/pixels/compositor.hpp"

namespace hiac {

namespace {

// Whether a place on an edge lies on a face of a cell: the face has both ends of the edge, or the
// place is an end that it has.
bool lies_on(const ZooMesh& mesh, CellId cell, std::size_t face, const TileEdges::Place& place) {
  const ShapeFace& shape = topology_of(mesh.kinds[cell]).faces[face];
  const auto nodes = mesh.cell_nodes(cell);
  const auto has = [&](NodeId node) {
    for (std::size_t k = 0; k < shape.corner_count; ++k)
      if (nodes[shape.corners[k]] == node) return true;
    return false;
  };
  return has(place.node) || (has(place.piece->edge[0]) && has(place.piece->edge[1]));
}

}  // namespace

SkinPainter::SkinPainter(const Frame& frame, TileEdges& edges)
    : frame_(frame), edges_(edges), skin_(frame) {
  if (!frame.skin.faces.empty()) transparency_.assign(kTileStride * kTileHeight, 1);
}

void SkinPainter::draw(const TileTarget& to, CellId cell, bool with_inside) {
  skin_.enter(cell, to.tile);
  if (to.group != nullptr) {
    draw_sorted(to, cell, with_inside);
  } else if (skin_.is_met_once()) {
    add_edges(to, cell, Which::entered);
    add_skin(to, Which::entered);
    if (with_inside) draw_for(frame_, cell)(to, {&cell, 1});
    add_edges(to, cell, Which::left);
    add_skin(to, Which::left);
  } else {
    list_.clear();
    draw_sorted({to.frame, to.tile, to.buffer, &list_, to.counts}, cell, with_inside);
    composite_sorted(list_, frame_.witness_tolerance, to.buffer, to.counts);
  }
}

// Where two entries have one place, the edge comes before the skin, as it is appended before it.
void SkinPainter::draw_sorted(const TileTarget& to, CellId cell, bool with_inside) {
  list_inside(to, cell, with_inside);
  add_edges(to, cell, Which::all);
  add_skin(to, Which::all);
  ends_.clear();
}

void SkinPainter::list_inside(const TileTarget& to, CellId cell, bool with_inside) {
  const std::size_t first = to.group->segments.size();
  if (with_inside) draw_for(frame_, cell)(to, {&cell, 1});
  note_ends(*to.group, first);
}

void SkinPainter::note_ends(const SegmentList& list, std::size_t first) {
  ends_.assign(kTileStride * kTileHeight, {0, 0, 0});
  for (const ListedSegment& segment : std::span(list.segments).subspan(first))
    ends_[segment.pixel] = {segment.front, segment.back, ends_[segment.pixel].count + 1};
}

// The end of the cell's segment for a crossing at t; t itself where there is no segment there, or
// where there are several: these begin and end at the crossings themselves.
double SkinPainter::end_at(std::size_t at, double t, bool enters) const {
  if (ends_.empty() || ends_[at].count != 1) return t;
  const double end = enters ? ends_[at].front : ends_[at].back;
  return std::abs(end - t) <= frame_.witness_tolerance ? end : t;
}

void SkinPainter::add_edges(const TileTarget& to, CellId cell, Which which) {
  if (edges_.empty()) return;
  for (const CellCrossing& ray : skin_.rays()) {
    const std::size_t at = to.tile.index(ray.x, ray.y);
    const auto is_left_with = [&](const TileEdges::Place& place) {
      return lies_on(frame_.mesh, cell, ray.back_face, place);
    };
    const double middle = 0.5 * (ray.front + ray.back);
    if (which != Which::left)
      edges_.take(to, at, end_at(at, ray.front, true), true, [&](const TileEdges::Place& place) {
        return lies_on(frame_.mesh, cell, ray.front_face, place) ||
               (place.t < middle && !is_left_with(place));
      });
    if (which != Which::entered)
      edges_.take(to, at, end_at(at, ray.back, false), false,
                  [&](const TileEdges::Place& place) { return is_left_with(place); });
  }
}

void SkinPainter::add_skin(const TileTarget& to, Which which) {
  for (const SkinCrossing& crossing : skin_.crossings()) {
    if (which != Which::all && crossing.enters != (which == Which::entered)) continue;
    const std::size_t at = to.tile.index(crossing.x, crossing.y);
    if (!to.is_seen(at)) continue;
    const auto [rgb, transparency] = skin_.shade(crossing);
    transparency_[at] *= transparency;
    const double t = end_at(at, crossing.t, crossing.enters);
    if (frame_.with_details) {
      SegmentDetails details;
      details.front = details.back = details.first = details.mean = t;
      details.light = std::ranges::max(rgb);
      details.transparency = transparency;
      details.part = RayPart::skin;
      describe(to, at, details);
    }
    composite(to, at, t, t, {rgb, transparency});
  }
}

}  // namespace hiac
