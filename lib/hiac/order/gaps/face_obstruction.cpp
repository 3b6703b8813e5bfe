// Based on the Obstructs sequence of P. Williams, N. Max, C. Stein, "A High Accuracy Volume
// Renderer for Unstructured Data", 1998, section 6, for single faces. All predicates are exact;
// none uses projected coordinates.

#include "hiac/order/gaps/face_obstruction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/geometry/vector.hpp"
#include "hiac/order/faces/eye_side.hpp"

namespace hiac {
namespace {

// Returns the side of the plane through the eye, a and b on which p lies: +1 to the left of the
// edge a -> b as seen from the eye.
int side_of_edge(Point3 a, Point3 b, Point3 p, const View& view) { return eye_side(a, b, p, view); }

// Returns whether an edge of `f` has all of `g` on its outer side or in its plane.
bool separated_by_edge(const SeenFace& f, const SeenFace& g, const View& view) {
  for (std::size_t k = 0; k < f.count; ++k) {
    bool outside = true;
    for (std::size_t j = 0; j < g.count && outside; ++j)
      outside = f.winding * side_of_edge(f.corner(k), f.corner(k + 1), g.corner(j), view) <= 0;
    if (outside) return true;
  }
  return false;
}

// Returns whether both faces surely lie in front of one plane through the eye. Where rounding could
// change the answer, it is false.
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

// Returns whether a plane through the eye and a corner of each face has them on different sides.
// Faces that surround the eye may be separated only by such planes.
bool separated_by_corners(const SeenFace& f, const SeenFace& g, const View& view) {
  for (std::size_t k = 0; k < f.count; ++k)
    for (std::size_t j = 0; j < g.count; ++j) {
      const Span of_f = span_of(f.corner(k), g.corner(j), f, view);
      const Span of_g = span_of(f.corner(k), g.corner(j), g, view);
      if (of_f.left != of_f.right && of_g.left != of_g.right && of_f.left != of_g.left) return true;
    }
  return false;
}

// Where the corners of `face` lie relative to the plane of `plane`: on the eye's side, beyond it.
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

Vector normal_of(const SeenFace& face) {
  const Point3 a = face.corner(0);
  return cross(minus(face.corner(1), a), minus(face.corner(2), a));
}

// The distance of a point from a face's plane, positive on the plane's positive side.
double height_over(const SeenFace& plane, Point3 p) {
  const Vector n = normal_of(plane);
  return dot(n, minus(p, plane.corner(0))) / length(n);
}

double distance_of_lines(Point3 a, Point3 b, Point3 c, Point3 d) {
  const Vector n = cross(minus(b, a), minus(d, c));
  return std::abs(dot(n, minus(c, a))) / length(n);
}

// Returns whether the eye sees both faces from the same side. Faces of one wall that rounding has
// tilted, seen nearly edge-on, are seen from different sides: they lie close to one plane, but do
// not touch.
bool face_alike(const SeenFace& f, const SeenFace& g) {
  const auto m = normal_of(f), n = normal_of(g);
  return f.winding * g.winding * dot(m, n) > 0;
}

// Returns how far the farthest corner of `face` lies in front of the plane of `plane`.
double depth_in_front(const SeenFace& plane, const SeenFace& face) {
  double most = 0;
  for (std::size_t k = 0; k < face.count; ++k)
    most = std::max(most, plane.winding * height_over(plane, face.corner(k)));
  return most;
}

bool covers(const SeenFace& face, Point3 p, const View& view) {
  for (std::size_t k = 0; k < face.count; ++k)
    if (face.winding * side_of_edge(face.corner(k), face.corner(k + 1), p, view) < 0) return false;
  return true;
}

// The largest distance by which each of two faces lies in front of the other where both are seen. 0
// is exact and means nowhere; other values are rounded, in world units.
struct Ahead {
  double first = 0, second = 0;

  // Includes one place; `nearer` is -1 if the first face is nearer there, +1 if the second is.
  void include(int nearer, double distance) {
    if (nearer == 0) return;
    double& most = nearer < 0 ? first : second;
    most = std::max({most, distance, std::numeric_limits<double>::min()});
  }
};

// Includes the corners of `face` that are seen within `cover`; `nearer` is the value for those on
// the eye's side of its plane.
void include_corners(const SeenFace& face, const SeenFace& cover, const View& view, int nearer,
                     Ahead& ahead) {
  for (std::size_t k = 0; k < face.count; ++k) {
    const Point3 p = face.corner(k);
    const int side = orientation(cover.corner(0), cover.corner(1), cover.corner(2), p);
    if (side != 0 && covers(cover, p, view))
      ahead.include(side == cover.winding ? nearer : -nearer, std::abs(height_over(cover, p)));
  }
}

// Both faces are seen together in a polygon, where a line divides the parts in which one or the
// other is nearer. The polygon's corners, which are crossings of edges or corners of the faces, are
// therefore all that need be compared.
Ahead ahead_of_one_another(const SeenFace& f, const SeenFace& g, const View& view) {
  Ahead ahead;
  for (std::size_t k = 0; k < f.count; ++k)
    for (std::size_t j = 0; j < g.count; ++j) {
      const Point3 a = f.corner(k), b = f.corner(k + 1), c = g.corner(j), d = g.corner(j + 1);
      if (const auto nearer = nearer_edge(a, b, c, d, view))
        ahead.include(*nearer, distance_of_lines(a, b, c, d));
    }
  include_corners(f, g, view, -1, ahead);
  include_corners(g, f, view, +1, ahead);
  return ahead;
}

}  // namespace

// c-d passes through the triangle of the eye, a and b, and so in front of a-b, exactly if it passes
// all three edges of that triangle on the same side.
std::optional<int> nearer_edge(Point3 a, Point3 b, Point3 c, Point3 d, const View& view) {
  const int c_side = side_of_edge(a, b, c, view), d_side = side_of_edge(a, b, d, view);
  const int a_side = side_of_edge(c, d, a, view), b_side = side_of_edge(c, d, b, view);
  if (c_side * d_side >= 0 || a_side * b_side >= 0) return std::nullopt;
  if (a_side != d_side) return std::nullopt;  // one passes behind the eye, opposite the other
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
  if (!f_to_g.any_beyond) return true;  // all of f lies in front of the plane of g, or in it
  if (face_alike(f, g) && depth_in_front(f, g) <= slack) return true;
  if (!g_to_f.any_beyond || !f_to_g.any_nearer) return false;
  // each plane cuts the other face: the places where rays cross both must be compared
  const Ahead ahead = ahead_of_one_another(f, g, view);
  const bool pierce = std::min(ahead.first, ahead.second) > slack;
  return pierce || ahead.first >= ahead.second;
}

}  // namespace hiac
