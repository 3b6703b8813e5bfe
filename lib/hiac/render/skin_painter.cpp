#include "hiac/render/skin_painter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

#include "hiac/base/special_values.hpp"
#include "hiac/render/draw_cells.hpp"
#include "hiac/render/edges/edge_place.hpp"
#include "hiac/render/pixels/compositor.hpp"

namespace hiac {

namespace {

// The corners of a cell's faces, in their order; those of triangles end with the first again.
std::array<std::array<NodeId, 4>, 6> corners_of_faces(const ZooMesh& mesh, CellId cell) {
  std::array<std::array<NodeId, 4>, 6> corners{};
  const auto nodes = mesh.cell_nodes(cell);
  const auto faces = topology_of(mesh.kinds[cell]).faces;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < 4; ++k)
      corners[f][k] = nodes[faces[f].corners[k < faces[f].corner_count ? k : 0]];
  return corners;
}

}  // namespace

SkinPainter::SkinPainter(const Frame& frame, const ScreenEdges& drawn, TileEdges& edges)
    : frame_(frame), drawn_(drawn), edges_(edges), skin_(frame), errors_(frame) {
  if (!frame.skin.faces.empty()) transparency_.assign(kTilePlane, 1);
}

void SkinPainter::draw(const TileTarget& to, CellId cell, bool with_inside) {
  // without skin only rays with edges to draw count
  const bool has_skin = frame_.skin.on(cell) != 0;
  skin_.enter(cell, to.tile, has_skin ? nullptr : &edges_.left());
  if (frame_.with_error && has_skin) {
    errors_.enter(cell, to.tile, skin_.rays());
    add_hidden(to);
  }
  if (to.group != nullptr) {
    list_inside(to, cell, with_inside);
    note_crossings(to.tile, cell);
    add_skin(to, Which::all);
    ends_.clear();
    return;
  }
  note_edged_rays(to.tile);
  if (skin_.is_met_once()) {
    add_edges(to, cell, Which::entered);
    add_skin(to, Which::entered);
    if (with_inside) draw_for(frame_, cell)(to, {&cell, 1});
    add_edges(to, cell, Which::left);
    add_skin(to, Which::left);
  } else {
    draw_sorted(to, cell, with_inside);
  }
}

// Where two entries have one place, the edge comes before the skin, as it is appended before it.
void SkinPainter::draw_sorted(const TileTarget& to, CellId cell, bool with_inside) {
  list_.clear();
  const TileTarget listed{to.frame, to.tile, to.buffer, &list_, to.counts};
  list_inside(listed, cell, with_inside);
  add_edges(listed, cell, Which::all);
  add_skin(listed, Which::all);
  ends_.clear();
  edges_.settle(listed);
  composite_sorted(list_, frame_.witness_tolerance, to.buffer, to.counts);
}

void SkinPainter::list_inside(const TileTarget& to, CellId cell, bool with_inside) {
  const std::size_t first = to.group->segments.size();
  if (with_inside) draw_for(frame_, cell)(to, {&cell, 1});
  note_ends(*to.group, first);
}

void SkinPainter::note_ends(const SegmentList& list, std::size_t first) {
  ends_.assign(kTilePlane, {0, 0, 0});
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

void SkinPainter::note_edged_rays(const TileRect& tile) {
  edged_.clear();
  if (edges_.empty()) return;
  for (const CellCrossing& ray : skin_.rays())
    if (edges_.left().holds(ray.x - tile.x0, ray.y - tile.y0)) edged_.push_back(&ray);
}

void SkinPainter::add_edges(const TileTarget& to, CellId cell, Which which) {
  if (edged_.empty()) return;
  const CellKind kind = frame_.mesh.kinds[cell];
  const auto corners = corners_of_faces(frame_.mesh, cell);
  for (const CellCrossing* crossing : edged_) {
    const CellCrossing& ray = *crossing;
    const std::size_t at = to.tile.index(ray.x, ray.y);
    // whether a place on an edge is met where the ray enters or leaves the cell
    const auto lies_on = [&](std::uint8_t face, const std::array<double, 3>& crossed,
                             const TileEdges::Place& on_edge) {
      const EdgePlace<NodeId> place{on_edge.piece->edge, on_edge.along, on_edge.node};
      if (!lies_on_face(corners[face], place)) return false;
      return std::isnan(crossed[0]) ||
             skin_.is_one_side(face, crossed, reference_on(kind, face, corners[face], place), ray.x,
                               ray.y);
    };
    const auto is_left_with = [&](const TileEdges::Place& place) {
      return lies_on(ray.back_face, ray.back_reference, place);
    };
    const double middle = 0.5 * (ray.front + ray.back);
    if (which != Which::left)
      edges_.take(to, at, end_at(at, ray.front, true), true, [&](const TileEdges::Place& place) {
        return lies_on(ray.front_face, ray.front_reference, place) ||
               (place.t < middle && !is_left_with(place));
      });
    if (which != Which::entered)
      edges_.take(to, at, end_at(at, ray.back, false), false, is_left_with);
  }
}

void SkinPainter::note_crossings(const TileRect& tile, CellId cell) {
  note_edged_rays(tile);
  for (const CellCrossing* crossing : edged_) {
    const CellCrossing& ray = *crossing;
    const std::size_t at = tile.index(ray.x, ray.y);
    crossings_.add(frame_, cell, ray, tile, end_at(at, ray.front, true),
                   end_at(at, ray.back, false), {});
    crossed_.push_back(cell);
  }
}

std::vector<CellId> SkinPainter::settle(const TileTarget& to) {
  std::vector<CellId> met_at;
  if (crossed_.empty()) return met_at;
  std::vector<std::uint32_t> order(crossed_.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, {}, [&](std::uint32_t k) {
    return std::tuple(crossings_.rays[k].pixel, crossings_.rays[k].middle, crossed_[k]);
  });
  list_.clear();
  const TileTarget listed{to.frame, to.tile, to.buffer, &list_, to.counts};
  for (const std::uint32_t k : order) {
    const EdgedCrossing& ray = crossings_.rays[k];
    const auto is_met_at = [&](const EdgeStop& stop, const TileEdges::Place& place) {
      return hiac::lies_on(crossings_, ray, stop,
                           {{place.piece->edge[0], place.piece->edge[1]}, place.along, place.node},
                           frame_.projector, to.tile);
    };
    edges_.take(listed, ray.pixel, ray.front.t, true, [&](const TileEdges::Place& place) {
      return is_met_at(ray.front, place) || (place.t < ray.middle && !is_met_at(ray.back, place));
    });
    edges_.take(listed, ray.pixel, ray.back.t, false,
                [&](const TileEdges::Place& place) { return is_met_at(ray.back, place); });
    met_at.resize(list_.segments.size(), crossed_[k]);
  }
  edges_.settle(listed);
  to.group->prepend(list_);
  crossings_ = {};
  crossed_.clear();
  return met_at;
}

void SkinPainter::add_skin(const TileTarget& to, Which which) {
  const auto crossings = skin_.crossings();
  seen_.clear();
  ray_scales_.clear();
  for (std::uint32_t k = 0; k < crossings.size(); ++k) {
    const SkinCrossing& crossing = crossings[k];
    if (which != Which::all && crossing.enters != (which == Which::entered)) continue;
    const std::size_t at = to.tile.index(crossing.x, crossing.y);
    if (!to.is_seen(at)) continue;
    seen_.push_back(k);
    ray_scales_.push_back(to.buffer.ray_scale[at]);
  }
  const auto shaded = skin_.shade(seen_, ray_scales_);
  for (std::size_t k = 0; k < seen_.size(); ++k) add_point(to, crossings[seen_[k]], shaded[k]);
}

void SkinPainter::add_point(const TileTarget& to, const SkinCrossing& crossing,
                            const ShadedPoint& seen) {
  const std::size_t at = to.tile.index(crossing.x, crossing.y);
  const auto& [rgb, transparency] = seen.shade;
  transparency_[at] *= transparency;
  const double t = end_at(at, crossing.t, crossing.enters);
  if (frame_.with_details) {
    SegmentDetails details;
    details.front = details.back = details.first = details.mean = t;
    details.light = std::ranges::max(rgb);
    details.transparency = transparency;
    details.part = RayPart::skin;
    if (frame_.with_error)
      errors_.add(crossing, at, seen, frame_.skin.field ? skin_.value_at(crossing) : kNaN, details);
    describe(to, at, details);
  }
  composite(to, at, t, t, {rgb, transparency});
}

// Skin that a ray of exact arithmetic might meet where the engine's meets none, in front of all
// that the cell, or its group, shows.
void SkinPainter::add_hidden(const TileTarget& to) {
  for (const std::size_t at : errors_.hidden()) {
    const bool is_met = std::ranges::any_of(skin_.crossings(), [&](const SkinCrossing& crossing) {
      return to.tile.index(crossing.x, crossing.y) == at;
    });
    if (!is_met)
      to.buffer.details[at].add_missing(frame_.skin.largest_light, 1, to.buffer.transparency[at]);
  }
}

}  // namespace hiac
