// Based on the Obstructs sequence of P. Williams, N. Max, C. Stein, "A High Accuracy Volume
// Renderer for Unstructured Data", 1998, section 6, for single faces and with exact predicates
// throughout: nothing is asked of projected coordinates.

#include "hiac/order/face_obstruction.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/order/eye_side.hpp"

namespace hiac {
namespace {

// The side of the plane through the eye, a and b on which p is seen: +1 to the left of the edge
// a -> b as seen from the eye.
int side_of_edge(Point3 a, Point3 b, Point3 p, const View& view) { return eye_side(a, b, p, view); }

// Whether an edge of `f` has all of `g` on its outer side or in its plane.
bool separated_by_edge(const SeenFace& f, const SeenFace& g, const View& view) {
  for (std::size_t k = 0; k < f.count; ++k) {
    bool outside = true;
    for (std::size_t j = 0; j < g.count && outside; ++j)
      outside = f.winding * side_of_edge(f.corner(k), f.corner(k + 1), g.corner(j), view) <= 0;
    if (outside) return true;
  }
  return false;
}

// Whether all of both faces surely lies before one plane through the eye. What rounding could turn
// counts as not.
bool in_one_hemisphere(const SeenFace& f, const SeenFace& g, const View& view) {
  constexpr double kSurely = 1e-9;
  if (!view.perspective) return true;
  std::array<std::array<double, 3>, 8> directions;
  std::array<double, 3> sum{};
  std::size_t count = 0;
  for (const SeenFace* face : {&f, &g})
    for (std::size_t k = 0; k < face->count; ++k) {
      const Point3 p = face->corner(k);
      std::array<double, 3> v{p[0] - view.eye[0], p[1] - view.eye[1], p[2] - view.eye[2]};
      const double length = std::hypot(v[0], v[1], v[2]);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += v[c] /= length;
      directions[count++] = v;
    }
  return std::all_of(directions.begin(), directions.begin() + static_cast<std::ptrdiff_t>(count),
                     [&](const std::array<double, 3>& v) {
                       return v[0] * sum[0] + v[1] * sum[1] + v[2] * sum[2] > kSurely;
                     });
}

// The sides of the plane through the eye, a and b on which a face has corners.
struct Span {
  bool left = false, right = false;
};

Span span_of(Point3 a, Point3 b, const SeenFace& face, const View& view) {
  Span span;
  for (std::size_t k = 0; k < face.count; ++k) {
    const int side = side_of_edge(a, b, face.corner(k), view);
    span.left = span.left || side > 0;
    span.right = span.right || side < 0;
  }
  return span;
}

// Whether a plane through the eye and a corner of each face has them on different sides. Faces that
// surround the eye can be apart by such planes alone.
bool separated_by_corners(const SeenFace& f, const SeenFace& g, const View& view) {
  for (std::size_t k = 0; k < f.count; ++k)
    for (std::size_t j = 0; j < g.count; ++j) {
      const Span of_f = span_of(f.corner(k), g.corner(j), f, view);
      const Span of_g = span_of(f.corner(k), g.corner(j), g, view);
      if (of_f.left != of_f.right && of_g.left != of_g.right && of_f.left != of_g.left) return true;
    }
  return false;
}

// How the corners of `face` lie to the plane of `plane`: on the eye's side, beyond, or in it.
struct Sides {
  bool any_nearer = false, any_beyond = false;
};

Sides sides_of(const SeenFace& plane, const SeenFace& face) {
  Sides sides;
  for (std::size_t k = 0; k < face.count; ++k) {
    const int side = orientation(plane.corner(0), plane.corner(1), plane.corner(2), face.corner(k));
    sides.any_nearer = sides.any_nearer || (side != 0 && side == plane.winding);
    sides.any_beyond = sides.any_beyond || (side != 0 && side != plane.winding);
  }
  return sides;
}

std::optional<bool> by_crossing_edges(const SeenFace& f, const SeenFace& g, const View& view) {
  for (std::size_t k = 0; k < f.count; ++k)
    for (std::size_t j = 0; j < g.count; ++j) {
      const auto nearer =
          nearer_edge(f.corner(k), f.corner(k + 1), g.corner(j), g.corner(j + 1), view);
      if (nearer && *nearer != 0) return *nearer < 0;
    }
  return std::nullopt;
}

bool strictly_covers(const SeenFace& face, Point3 p, const View& view) {
  for (std::size_t k = 0; k < face.count; ++k)
    if (face.winding * side_of_edge(face.corner(k), face.corner(k + 1), p, view) <= 0) return false;
  return true;
}

// Whether a corner of `face` that `cover` hides or is hidden by lies beyond the plane of `cover`.
std::optional<bool> corner_beyond(const SeenFace& cover, const SeenFace& face, const View& view) {
  for (std::size_t k = 0; k < face.count; ++k) {
    if (!strictly_covers(cover, face.corner(k), view)) continue;
    const int side = orientation(cover.corner(0), cover.corner(1), cover.corner(2), face.corner(k));
    if (side != 0) return side != cover.winding;
  }
  return std::nullopt;
}

std::array<double, 3> normal_of(const SeenFace& face) {
  const Point3 a = face.corner(0), b = face.corner(1), c = face.corner(2);
  const std::array<double, 3> u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const std::array<double, 3> v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

// Whether the eye sees both faces from the same side. Faces of one wall that rounding tilts, seen
// nearly edge-on, are seen from either side: they lie close to one plane, but touch nowhere.
bool face_alike(const SeenFace& f, const SeenFace& g) {
  const auto m = normal_of(f), n = normal_of(g);
  return f.winding * g.winding * (m[0] * n[0] + m[1] * n[1] + m[2] * n[2]) > 0;
}

// Distance of the corner of `face` that is farthest in front of the plane of `plane`.
double depth_in_front(const SeenFace& plane, const SeenFace& face) {
  const Point3 a = plane.corner(0);
  const auto n = normal_of(plane);
  const double length = std::hypot(n[0], n[1], n[2]);
  double most = 0;
  for (std::size_t k = 0; k < face.count; ++k) {
    const Point3 p = face.corner(k);
    const double height = (n[0] * (p[0] - a[0]) + n[1] * (p[1] - a[1]) + n[2] * (p[2] - a[2]));
    most = std::max(most, plane.winding * height / length);
  }
  return most;
}

}  // namespace

// With s the side of the line's wedge: c-d passes the triangle of the eye, a and b inside it, and
// so in front of a-b, exactly when it passes all three edges of that triangle on the same side.
std::optional<int> nearer_edge(Point3 a, Point3 b, Point3 c, Point3 d, const View& view) {
  const int c_side = side_of_edge(a, b, c, view), d_side = side_of_edge(a, b, d, view);
  const int a_side = side_of_edge(c, d, a, view), b_side = side_of_edge(c, d, b, view);
  if (c_side * d_side >= 0 || a_side * b_side >= 0) return std::nullopt;
  if (a_side != d_side) return std::nullopt;  // one passes the other's opposite, behind the eye
  // det[d-c, a-c, eye-c] = a_side: seen from the eye, a lies left of c -> d when it is positive
  return orientation(c, d, a, b) * a_side * -1;
}

bool projections_overlap(const SeenFace& f, const SeenFace& g, const View& view) {
  if (separated_by_edge(f, g, view) || separated_by_edge(g, f, view)) return false;
  return in_one_hemisphere(f, g, view) || !separated_by_corners(f, g, view);
}

bool reached_first(const SeenFace& f, const SeenFace& g, const View& view, double slack) {
  const Sides g_to_f = sides_of(f, g);
  if (!g_to_f.any_nearer) return true;  // all of g lies beyond the plane of f, or in it
  const Sides f_to_g = sides_of(g, f);
  if (!f_to_g.any_beyond) return true;  // all of f lies before the plane of g, or in it
  if (face_alike(f, g) && depth_in_front(f, g) <= slack) return true;
  if (!g_to_f.any_beyond || !f_to_g.any_nearer) return false;
  // each plane cuts the other face: a ray that crosses both must be asked
  if (const auto first = by_crossing_edges(f, g, view)) return *first;
  if (const auto beyond = corner_beyond(f, g, view)) return *beyond;
  if (const auto beyond = corner_beyond(g, f, view)) return !*beyond;
  return true;
}

}  // namespace hiac
