#include "hiac/render/cells/curved_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/frame/screen_rounding.hpp"
#include "hiac/frame/tiles/curved_outline.hpp"
#include "hiac/geometry/patch_facing.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/render/bounds/ray_displacement.hpp"
#include "hiac/render/cells/patch_curvature.hpp"

namespace hiac {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double at_place(std::size_t degree, const std::array<double, 4>& controls, double s) {
  const BernsteinValues b(degree, s);
  double sum = 0;
  for (std::size_t k = 0; k <= degree; ++k) sum += b.value[k] * controls[k];
  return sum;
}

double slope_at(std::size_t degree, const std::array<double, 4>& controls, double s) {
  const BernsteinValues b(degree, s);
  double sum = 0;
  for (std::size_t k = 0; k <= degree; ++k) sum += b.derivative[k] * controls[k];
  return sum;
}

// Writes the parameters in (0, 1), ascending, at which a curve's height has an extremum, and
// returns how many there are: at most two.
std::size_t turning_places(std::size_t degree, const std::array<double, 4>& h,
                           std::array<double, 2>& places) {
  const double d0 = h[1] - h[0], d1 = h[2] - h[1], d2 = h[3] - h[2];
  std::size_t count = 0;
  const auto add = [&](double place) {
    if (place > 0 && place < 1) places[count++] = place;
  };
  if (degree == 2) {
    add(d0 / (d0 - d1));
    return count;
  }
  const double discriminant = d1 * d1 - d0 * d2;
  if (discriminant <= 0) return 0;
  const double q = -(d1 + (d1 < 0 ? -1 : 1) * std::sqrt(discriminant));
  add(q / (q + d2));
  add(d0 / (d0 + q));
  if (count == 2 && places[0] > places[1]) std::swap(places[0], places[1]);
  return count;
}

}  // namespace

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
    Curve& curve = curves_[curve_count_++];
    curve.degree = static_cast<std::uint8_t>(edge.count - 1);
    const auto controls = edge_controls(frame, edge);
    curve.x = controls[0];
    curve.y = controls[1];
    curve.w = controls[2];
  }
}

void CurvedFaces::add_face(const Frame& frame, CellId cell, const CellSurface& surface,
                           std::size_t number) {
  const FaceForm form = face_form(frame.mesh, cell, number, frame.straightness);
  if (!form.curved) return;
  held_ |= 1U << number;
  Face& face = faces_[count_++];
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
  for (const Face& face : std::span(faces_).first(count_))
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
    if (curve_of_[e] == kStraight) continue;
    Curve& curve = curves_[curve_of_[e]];
    for (std::size_t k = 0; k <= curve.degree; ++k)
      curve.height[k] = center * curve.w[k] - curve.y[k];
    cut_curve(curve, tile, above[a], above[b]);
  }
  columns_ = {tile.x1, tile.x0};
  for (std::size_t f = 0; f < count_; ++f) {
    Face& face = faces_[f];
    for (std::size_t k = 0; k < face.shape.control_count(); ++k)
      face.height[k] = center * face.w[k] - face.y[k];
    set_columns(face, tile);
    columns_[0] = std::min(columns_[0], face.first);
    columns_[1] = std::max(columns_[1], face.last);
  }
}

// Finds where a curve changes sides of the row: between two extrema it does so at most once.
void CurvedFaces::cut_curve(Curve& curve, const TileRect& tile, bool begins_above,
                            bool ends_above) const {
  curve.cut_count = 0;
  const std::size_t n = curve.degree;
  std::array<double, 2> turns;
  const std::size_t turn_count = turning_places(n, curve.height, turns);
  double from = 0;
  bool is_above = begins_above;
  for (std::size_t k = 0; k <= turn_count; ++k) {
    const bool last = k == turn_count;
    const double to = last ? 1 : turns[k];
    const bool then_above = last ? ends_above : at_place(n, curve.height, to) >= 0;
    if (then_above != is_above) {
      // the sides of both ends are known; two steps of regula falsi alternate with one bisection
      double low = from, high = to;
      double h_low = at_place(n, curve.height, low), h_high = at_place(n, curve.height, high);
      for (int step = 0; step < 100 && low < high; ++step) {
        const double secant = low - h_low * ((high - low) / (h_high - h_low));
        const double middle = 0.5 * (low + high);
        const double s = step % 3 != 2 && secant > low && secant < high ? secant : middle;
        if (s <= low || s >= high) break;
        const double h = at_place(n, curve.height, s);
        ((h >= 0) == is_above ? low : high) = s;
        ((h >= 0) == is_above ? h_low : h_high) = h;
        if (h == 0) low = high = s;
      }
      add_cut(curve, tile, std::abs(h_low) < std::abs(h_high) ? low : high, then_above);
    }
    from = to;
    is_above = then_above;
  }
}

// How far right of a pixel centre a point of a curve still counts as on it (on_crossing). The
// curve's direction matters only for a point that is nearly on a pixel centre.
double CurvedFaces::slack_at(const Curve& curve, double s, double x) const {
  const double right = x - 0.5 - std::floor(x - 0.5);
  if (right > kMostOnCrossing) return 0;
  // slopes of x W - X and y W - Y, which both vanish at s
  const std::size_t n = curve.degree;
  const double w = slope_at(n, curve.w, s);
  return on_crossing((slope_at(n, curve.x, s) - x * w) / (slope_at(n, curve.y, s) - row_ * w));
}

// A point lies left of the ray of pixel x if X - x W <= 0, in front of the eye and behind it.
void CurvedFaces::add_cut(Curve& curve, const TileRect& tile, double s, bool comes_up) const {
  const double x = at_place(curve.degree, curve.x, s), w = at_place(curve.degree, curve.w, s);
  Cut& cut = curve.cuts[curve.cut_count++];
  cut.sign = comes_up ? 1 : -1;
  cut.from_column_on = w > 0 || (w == 0 && x <= 0);
  if (w == 0)
    cut.column = tile.x0;
  else
    cut.column = first_center(x / w, tile.x0, tile.x1, slack_at(curve, s, x / w));
}

// Sets the columns that the convex hull of the face's control points covers in the row. If control
// points lie behind the eye, the face may cover any column.
void CurvedFaces::set_columns(Face& face, const TileRect& tile) const {
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
                    (curve == kStraight ? crossed_[face.edges[k]] : curves_[curve].cut_count > 0);
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
    for (std::size_t i = 0; i < curves_[c].cut_count; ++i) {
      least = std::min(least, pixel_center(curves_[c].cuts[i].column));
      most = std::max(most, pixel_center(curves_[c].cuts[i].column));
    }
  }
  if (!(least <= most)) return;
  face.first = first_center(least - 1, tile.x0, tile.x1);
  face.last = first_center(most + 1, tile.x0, tile.x1);
}

PatchZeros CurvedFaces::crossings(Face& face, int x, int winding) const {
  PatchNet<double> aside;
  const double center = pixel_center(x);
  for (std::size_t k = 0; k < face.shape.control_count(); ++k)
    aside[k] = face.x[k] - center * face.w[k];
  const PatchZeros zeros = patch_zeros({.shape = face.shape,
                                        .a = aside,
                                        .b = face.height,
                                        .depth = face.t,
                                        .winding = winding,
                                        .one_way = face.turns != 0,
                                        .rounding = face.rounding,
                                        .guess = face.guess});
  if (zeros.size() == 1) face.guess = {zeros[0].u, zeros[0].v};
  return zeros;
}

double CurvedFaces::parameter(const Face& face, const PatchZero& zero) const {
  const std::size_t n = face.shape.degree;
  return evaluate_patch(n, face.t, BernsteinValues(n, zero.u), BernsteinValues(n, zero.v)).value;
}

const CurvedFaces::Face& CurvedFaces::face_of(std::size_t number) const {
  return *std::find_if(faces_.begin(), faces_.begin() + static_cast<std::ptrdiff_t>(count_),
                       [&](const Face& face) { return face.number == number; });
}

double CurvedFaces::doubt(std::size_t number, double u, double v, int x, double displaced) const {
  const Face& face = face_of(number);
  const std::size_t n = face.shape.degree, count = face.shape.control_count();
  const double center = pixel_center(x);
  PatchNet<double> aside;
  for (std::size_t k = 0; k < count; ++k) aside[k] = face.x[k] - center * face.w[k];
  const BernsteinValues bu(n, u), bv(n, v);
  const PatchValue a = evaluate_patch(n, aside, bu, bv), b = evaluate_patch(n, face.height, bu, bv),
                   t = evaluate_patch(n, face.t, bu, bv);
  const double determinant = a.by_u * b.by_v - a.by_v * b.by_u;
  const double unit = projector_.ray_scale(center, row_);
  // bounds of |a| and |b| with the displacement, in their units
  const double moved = displaced * projector_.pixels_per_unit() * unit;
  const double off_a = std::abs(a.value) + moved, off_b = std::abs(b.value) + moved;
  // the rows of J^-1
  const double u_a = b.by_v / determinant, u_b = -a.by_v / determinant;
  const double v_a = -b.by_u / determinant, v_b = a.by_u / determinant;
  const double step_u = std::abs(u_a) * off_a + std::abs(u_b) * off_b;
  const double step_v = std::abs(v_a) * off_a + std::abs(v_b) * off_b;
  const double side_u = 2 * step_u, side_v = 2 * step_v;
  if (!(std::max(side_u, side_v) <= PatchCurvature::kBorder)) return kInfinity;
  PatchNet<double> p, q;
  for (std::size_t k = 0; k < count; ++k) {
    p[k] = u_a * aside[k] + u_b * face.height[k];
    q[k] = v_a * aside[k] + v_b * face.height[k];
  }
  const double bent_u = PatchCurvature(n, p).within(side_u, side_v),
               bent_v = PatchCurvature(n, q).within(side_u, side_v);
  // 0.9 leaves a tenth for the rounding of J^-1
  if (!(bent_u <= 0.9 * step_u && bent_v <= 0.9 * step_v)) return kInfinity;
  const double by_a = std::abs(t.by_u * u_a + t.by_v * v_a) * off_a,
               by_b = std::abs(t.by_u * u_b + t.by_v * v_b) * off_b;
  const double bent_t = std::abs(t.by_u) * bent_u + std::abs(t.by_v) * bent_v +
                        PatchCurvature(n, face.t).within(side_u, side_v);
  return unit * (1.01 * (by_a + by_b) + bent_t + displaced);
}

std::array<double, 3> CurvedFaces::reference(std::size_t number, double u, double v) const {
  const Face& face = face_of(number);
  const auto& at = face.reference;
  std::array<double, 3> point;
  for (std::size_t c = 0; c < 3; ++c)
    point[c] = face.shape.triangle
                   ? at[0][c] + u * (at[1][c] - at[0][c]) + v * (at[2][c] - at[0][c])
                   : (1 - v) * (at[0][c] + u * (at[1][c] - at[0][c])) +
                         v * (at[3][c] + u * (at[2][c] - at[3][c]));
  return point;
}

}  // namespace hiac
