#include "hiac/render/edges/strip_coverage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace hiac {
namespace {

using PlanePoint = std::array<double, 2>;

// A convex polygon: a rectangle has four corners, and each of four cuts adds at most one.
struct Polygon {
  std::array<PlanePoint, 8> corners;
  std::size_t count = 0;

  void add(const PlanePoint& corner) { corners[count++] = corner; }
};

// The part in which `sign` times the coordinate is at most one half (Sutherland and Hodgman, CACM
// 17, 1974).
Polygon cut(const Polygon& polygon, std::size_t coordinate, double sign) {
  Polygon result;
  for (std::size_t k = 0; k < polygon.count; ++k) {
    const PlanePoint &a = polygon.corners[k], &b = polygon.corners[(k + 1) % polygon.count];
    const double out_a = sign * a[coordinate] - 0.5, out_b = sign * b[coordinate] - 0.5;
    if (out_a <= 0) result.add(a);
    if ((out_a <= 0) == (out_b <= 0)) continue;
    const double s = out_a / (out_a - out_b);
    result.add({a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])});
  }
  return result;
}

double area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t k = 0; k < polygon.count; ++k) {
    const PlanePoint &a = polygon.corners[k], &b = polygon.corners[(k + 1) % polygon.count];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return std::abs(twice) / 2;
}

// The share of the square around the origin in which a x + b y <= distance, of a unit vector (a,
// b): a trapezoid in the middle, triangles at the ends.
double half_plane_coverage(double a, double b, double distance) {
  const double least = std::min(std::abs(a), std::abs(b)),
               most = std::max(std::abs(a), std::abs(b));
  const double away = std::abs(distance), corner = (most + least) / 2 - away;
  if (away <= (most - least) / 2) return 0.5 + distance / most;
  const double cut = corner > 0 ? corner * corner / (2 * least * most) : 0;
  return distance < 0 ? cut : 1 - cut;
}

}  // namespace

double strip_coverage(const Strip& strip, double x, double y) {
  const double dx = strip.x1 - strip.x0, dy = strip.y1 - strip.y0;
  const double length = std::sqrt(dx * dx + dy * dy);
  if (!(length > 0)) return 0;
  const double half = strip.width / 2, nx = -dy / length, ny = dx / length;
  // relative to the pixel's centre
  const double x0 = strip.x0 - x, y0 = strip.y0 - y;
  constexpr double kReach = 0.7071067811865476;  // of the pixel's corners
  const double aside = nx * x0 + ny * y0, along = -(dx * x0 + dy * y0) / length;
  if (std::abs(aside) > half + kReach || along < -kReach || along > length + kReach) return 0;
  // between the strip's ends only its two sides count
  if (along >= kReach && along <= length - kReach)
    return half_plane_coverage(nx, ny, half - aside) - half_plane_coverage(nx, ny, -half - aside);
  // a strip far longer than the pixel keeps its digits: only its part near the pixel counts
  const double from = std::max(0.0, along - 1), to = std::min(length, along + 1);
  const double ux = dx / length, uy = dy / length;
  Polygon polygon;
  for (const auto& [s, side] : {PlanePoint{from, half}, PlanePoint{to, half}, PlanePoint{to, -half},
                                PlanePoint{from, -half}})
    polygon.add({x0 + s * ux + side * nx, y0 + s * uy + side * ny});
  for (const std::size_t coordinate : {0U, 1U})
    for (const double sign : {1.0, -1.0}) polygon = cut(polygon, coordinate, sign);
  return std::min(area(polygon), 1.0);
}

}  // namespace hiac
