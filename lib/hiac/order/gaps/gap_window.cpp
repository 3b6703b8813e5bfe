#include "hiac/order/gaps/gap_window.hpp"

#include <cmath>
#include <utility>

#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

// A bound of the rounding error of a window coordinate, relative to the largest coordinate from
// which it is computed: one difference, three products and two sums and, along the rays of an
// orthographic view, the rounding of the window's own axes; twice that in a quotient.
constexpr double kOutlineRounding = 32 * std::numeric_limits<double>::epsilon();

// Keeps the part of a polygon inside a pyramid, slightly widened.
void clip(std::vector<Vector>& polygon) {
  constexpr double kOpening = 1 + 1e-9;
  for (std::size_t side = 0; side < 4; ++side) {
    const auto inside = [side](const Vector& p) {
      const double coordinate = side < 2 ? p[0] : p[1];
      return kOpening * p[2] - (side % 2 == 0 ? coordinate : -coordinate);
    };
    std::vector<Vector> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vector &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
      const double p_in = inside(p), q_in = inside(q);
      if (p_in >= 0) kept.push_back(p);
      if ((p_in < 0) == (q_in < 0)) continue;
      const double u = p_in / (p_in - q_in);
      kept.push_back(
          {p[0] + u * (q[0] - p[0]), p[1] + u * (q[1] - p[1]), p[2] + u * (q[2] - p[2])});
    }
    polygon = std::move(kept);
  }
  std::erase_if(polygon, [](const Vector& p) { return !(p[2] > 0); });
}

}  // namespace

Window::Window(const View& view, const Vector& axis, bool pyramid)
    : view_(view), axis_(unit(axis)), pyramid_(pyramid) {
  const std::size_t least = std::abs(axis[0]) <= std::abs(axis[1])
                                ? (std::abs(axis[0]) <= std::abs(axis[2]) ? 0U : 2U)
                                : (std::abs(axis[1]) <= std::abs(axis[2]) ? 1U : 2U);
  Vector other{};
  other[least] = 1;
  right_ = unit(cross(axis_, other));
  up_ = cross(axis_, right_);
}

bool Window::place_whole(std::span<const Vector> corners, double farthest, Outline& outline) const {
  outline.x = outline.y = outline.depth = {};
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector& p = corners[k];
    const double scale = view_.perspective ? p[2] : 1;
    const double x = p[0] / scale, y = p[1] / scale;
    if (k < 4) outline.at_x[k] = x, outline.at_y[k] = y;
    outline.x.include(x);
    outline.y.include(y);
    outline.depth.include(p[2]);
    nearest = std::min(nearest, scale);
  }
  if (corners.empty()) return false;
  if (corners.size() == 3) outline.at_x[3] = outline.at_x[2], outline.at_y[3] = outline.at_y[2];
  const double spread = 1 + std::max({std::abs(outline.x.low), std::abs(outline.x.high),
                                      std::abs(outline.y.low), std::abs(outline.y.high)});
  outline.error = kOutlineRounding * farthest / nearest * (view_.perspective ? spread : 1);
  outline.x.widen(outline.error);
  outline.y.widen(outline.error);
  outline.depth.widen(kOutlineRounding * farthest);
  return true;
}

Vector Window::seen(const Vector& p, double& farthest) const {
  const Vector v = view_.perspective ? minus(p, view_.eye) : p;
  farthest = std::max(farthest, largest(v));
  return {dot(v, right_), dot(v, up_), dot(v, axis_)};
}

bool Window::place_hull(std::span<const Vector> points, Outline& outline) const {
  std::vector<Vector> seen_points;
  double farthest = 0;
  for (const Vector& p : points) seen_points.push_back(seen(p, farthest));
  if (!pyramid_) return place_whole(seen_points, farthest, outline);
  // the hull may fill the whole pyramid, unless it lies outside one of its sides
  constexpr double kOpening = 1 + 1e-9;
  Interval depth;
  std::array<bool, 5> outside;
  outside.fill(true);
  for (const Vector& p : seen_points) {
    depth.include(p[2]);
    const double opening = kOpening * p[2];
    const std::array<double, 5> within{opening - p[0], opening + p[0], opening - p[1],
                                       opening + p[1], p[2]};
    for (std::size_t k = 0; k < 5; ++k) outside[k] = outside[k] && within[k] < 0;
  }
  if (std::ranges::find(outside, true) != outside.end()) return false;
  depth.low = std::max(depth.low, 0.0);
  depth.widen(kOutlineRounding * farthest);
  outline = {{-kOpening, kOpening}, {-kOpening, kOpening}, depth, {}, {}, 0};
  return true;
}

bool Window::place(const SeenFace& face, Outline& outline) const {
  std::array<Vector, 4> corners;
  double farthest = 0;
  for (std::size_t k = 0; k < face.count; ++k) {
    const Point3 p = face.corner(k);
    Vector v{p[0], p[1], p[2]};
    if (view_.perspective)
      for (std::size_t c = 0; c < 3; ++c) v[c] -= view_.eye[c];
    farthest = std::max({farthest, std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
    corners[k] = {dot(v, right_), dot(v, up_), dot(v, axis_)};
  }
  if (!pyramid_) return place_whole(std::span(corners).first(face.count), farthest, outline);
  std::vector<Vector> seen(corners.begin(),
                           corners.begin() + static_cast<std::ptrdiff_t>(face.count));
  clip(seen);
  return place_whole(seen, farthest, outline);
}

std::vector<Window> windows_of(const ZooMesh& mesh, std::span<const Vector> points,
                               const View& view) {
  if (!view.perspective) return {Window(view, view.direction, false)};
  std::array<Interval, 3> box;
  for (std::size_t i = 0; i < mesh.xyz.size(); i += 3)
    for (std::size_t c = 0; c < 3; ++c) box[c].include(mesh.xyz[i + c]);
  for (const Vector& p : points)
    for (std::size_t c = 0; c < 3; ++c) box[c].include(p[c]);
  Vector axis;
  for (std::size_t c = 0; c < 3; ++c)
    axis[c] = std::clamp(view.eye[c], box[c].low, box[c].high) - view.eye[c];
  if (dot(axis, axis) > 0) return {Window(view, axis, false)};
  std::vector<Window> sides;
  for (std::size_t c = 0; c < 3; ++c)
    for (const double sign : {-1.0, 1.0}) {
      Vector towards{};
      towards[c] = sign;
      sides.emplace_back(view, towards, true);
    }
  return sides;
}

}  // namespace hiac
