#include "hiac/render/cells/curved/curved_faces.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/base/special_values.hpp"
#include "hiac/frame/screen_rounding.hpp"
#include "hiac/frame/tiles/curved_outline.hpp"
#include "hiac/geometry/patch_facing.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/render/bounds/ray_displacement.hpp"

namespace hiac {
namespace {}  // namespace

CurvedFaces::CurvedFaces(const Frame& frame, CellId cell, const CellSurface& surface)
    : surface_(surface),
      projector_(frame.projector),
      displaced_(frame.with_error ? displacement_in_world(frame, cell).at_ends : 0) {
  curve_of_.fill(kStraight);
  if (order_of(frame.mesh.kinds[cell]) != CellOrder::linear) add_curves(frame, cell, surface);
  for (std::size_t f = 0; f < face_count(frame.mesh.kinds[cell]); ++f)
    add_face(frame, cell, surface, f);
}

void CurvedFaces::add_curves(const Frame& frame, CellId cell, const CellSurface& surface) {
  const CellKind kind = frame.mesh.kinds[cell];
  const auto nodes = frame.mesh.cell_nodes(cell);
  for (std::size_t e = 0; e < edge_count(kind); ++e) {
    const EdgeNodes edge = edge_nodes(kind, nodes, e);
    if (!is_curved(frame.mesh, edge, frame.straightness)) continue;
    const auto [a, b] = topology_of(kind).edges[e];
    curve_of_[surface.edge_between(surface.ranks[a], surface.ranks[b])] =
        static_cast<std::uint8_t>(curve_count_);
    curves_[curve_count_++] = CurvedEdge(edge.count - 1, edge_controls(frame, edge));
  }
}

void CurvedFaces::add_face(const Frame& frame, CellId cell, const CellSurface& surface,
                           std::size_t number) {
  const FaceForm form = face_form(frame.mesh, cell, number, frame.straightness);
  if (!form.curved) return;
  held_ |= 1U << number;
  CurvedFace& face = faces_[count_++];
  face.shape = form.shape;
  face.number = static_cast<std::uint8_t>(number);
  const CellKind kind = frame.mesh.kinds[cell];
  const std::size_t n = form.shape.corner_count();
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint8_t corner = form.corners[k];
    face.reference[k] = reference_nodes(kind)[corner];
    const std::uint8_t rank = surface.ranks[corner],
                       next = surface.ranks[form.corners[(k + 1) % n]];
    face.edges[k] = surface.edge_between(rank, next);
    face.along[k] = rank < next;
  }
  const auto nets = face_nets(frame, cell, number, form);
  face.x = nets[0];
  face.y = nets[1];
  face.w = nets[2];
  face.t = nets[3];
  // a face with parts in front of and behind the eye may be crossed on both sides, and the windings
  // may cancel
  const bool in_front = std::all_of(
      face.w.begin(), face.w.begin() + static_cast<std::ptrdiff_t>(form.shape.control_count()),
      [](double w) { return w > 0; });
  face.turns = in_front ? patch_facing(form.shape, {face.x, face.y, face.w}) : 0;
  face.rounding = 0;
  for (std::size_t k = 0; k < form.shape.control_count(); ++k)
    face.rounding = std::max(face.rounding, kCornerOnRay * std::abs(face.w[k]));
  face.guess = form.shape.triangle ? std::array{1.0 / 3, 1.0 / 3} : std::array{0.5, 0.5};
}

ScreenBounds CurvedFaces::bounds() const {
  ScreenBounds box;
  for (const CurvedFace& face : std::span(faces_).first(count_))
    for (std::size_t k = 0; k < face.shape.control_count(); ++k)
      box.include(face.x[k], face.y[k], face.w[k], face.t[k]);
  return box;
}

void CurvedFaces::begin_row(double center, const TileRect& tile, const bool* above) {
  row_ = center;
  for (std::size_t e = 0; e < surface_.edge_count; ++e) {
    const auto [a, b] = surface_.edges[e];
    crossed_[e] = above[a] != above[b];
    comes_up_[e] = above[b];
    if (curve_of_[e] != kStraight)
      curves_[curve_of_[e]].begin_row(center, tile, above[a], above[b]);
  }
  columns_ = {tile.x1, tile.x0};
  for (std::size_t f = 0; f < count_; ++f) {
    CurvedFace& face = faces_[f];
    for (std::size_t k = 0; k < face.shape.control_count(); ++k)
      face.height[k] = center * face.w[k] - face.y[k];
    set_columns(face, tile);
    columns_[0] = std::min(columns_[0], face.first);
    columns_[1] = std::max(columns_[1], face.last);
  }
}

// Sets the columns that the convex hull of the face's control points covers in the row. If control
// points lie behind the eye, the face may cover any column.
void CurvedFaces::set_columns(CurvedFace& face, const TileRect& tile) const {
  const std::size_t count = face.shape.control_count();
  bool in_front = true, above = false, below = false;
  for (std::size_t k = 0; k < count; ++k) {
    in_front = in_front && face.w[k] > 0;
    above = above || face.height[k] >= 0;
    below = below || !(face.height[k] > 0);
  }
  face.first = tile.x1;
  face.last = tile.x0;
  // whether a border that only touches the row crosses it is decided by the edges
  face.in_row = (above && below) || !in_front;
  if (!face.in_row) {
    for (std::size_t k = 0; k < face.shape.corner_count(); ++k) {
      const std::uint8_t curve = curve_of_[face.edges[k]];
      face.in_row = face.in_row ||
                    (curve == kStraight ? crossed_[face.edges[k]] : !curves_[curve].cuts().empty());
    }
  }
  if (!face.in_row) return;
  if (!in_front) {
    face.first = tile.x0;
    face.last = tile.x1;
    return;
  }
  double least = kInfinity, most = -kInfinity;
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < k; ++i) {
      if ((face.height[k] >= 0) == (face.height[i] >= 0)) continue;
      const double s = face.height[k] / (face.height[k] - face.height[i]);
      const double x =
          (face.x[k] + s * (face.x[i] - face.x[k])) / (face.w[k] + s * (face.w[i] - face.w[k]));
      least = std::min(least, x);
      most = std::max(most, x);
    }
  for (std::size_t k = 0; k < face.shape.corner_count(); ++k) {
    const std::uint8_t c = curve_of_[face.edges[k]];
    if (c == kStraight) continue;
    for (const CurvedEdge::Cut& cut : curves_[c].cuts()) {
      least = std::min(least, pixel_center(cut.column));
      most = std::max(most, pixel_center(cut.column));
    }
  }
  if (!(least <= most)) return;
  face.first = first_center(least - 1, tile.x0, tile.x1);
  face.last = first_center(most + 1, tile.x0, tile.x1);
}

const CurvedFace& CurvedFaces::face_of(std::size_t number) const {
  return *std::find_if(faces_.begin(), faces_.begin() + static_cast<std::ptrdiff_t>(count_),
                       [&](const CurvedFace& face) { return face.number == number; });
}

double CurvedFaces::doubt(std::size_t number, double u, double v, int x, double displaced) const {
  const double center = pixel_center(x);
  const double unit = projector_.ray_scale(center, row_);
  const double moved = displaced * projector_.pixels_per_unit() * unit;
  return unit * (face_of(number).moved_along(u, v, center, moved) + displaced);
}

std::array<double, 3> CurvedFaces::reference(std::size_t number, double u, double v) const {
  return face_of(number).reference_at(u, v);
}

}  // namespace hiac
