#include "hiac/render/face_value.hpp"

#include <algorithm>
#include <cmath>

namespace hiac {
namespace {

// A point of the face's plane in the two coordinates in which the face is widest.
struct Planar {
  double x, y;
};

Planar operator+(const Planar& a, const Planar& b) { return {a.x + b.x, a.y + b.y}; }
Planar operator-(const Planar& a, const Planar& b) { return {a.x - b.x, a.y - b.y}; }
Planar operator*(double s, const Planar& a) { return {s * a.x, s * a.y}; }
double cross(const Planar& a, const Planar& b) { return a.x * b.y - a.y * b.x; }

// The corners from the smallest node on, towards the smaller of its neighbours.
FaceOffsets canonical(const FaceOffsets& face) {
  const std::size_t n = face.count;
  const auto smallest = static_cast<std::size_t>(
      std::min_element(face.nodes.begin(), face.nodes.begin() + static_cast<std::ptrdiff_t>(n)) -
      face.nodes.begin());
  const bool forward = face.nodes[(smallest + 1) % n] < face.nodes[(smallest + n - 1) % n];
  FaceOffsets result;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t at = (smallest + (forward ? k : n - k)) % n;
    result.add(face.nodes[at], face.offsets[at]);
  }
  return result;
}

double on_triangle(const std::array<Planar, 4>& p, const std::array<double, 4>& g) {
  const double a = cross(p[1], p[2]), b = cross(p[2], p[0]), c = cross(p[0], p[1]);
  const double sum = a + b + c;
  return sum == 0 ? g[0] : (a * g[0] + b * g[1] + c * g[2]) / sum;
}

// The bilinear map's inverse by Newton's iteration: as many steps as it ever needs, always.
double on_quadrilateral(const std::array<Planar, 4>& p, const std::array<double, 4>& g) {
  constexpr int kSteps = 16;
  const Planar pu = p[1] - p[0], pv = p[3] - p[0], puv = (p[2] - p[1]) - pv;
  double u = 0.5, v = 0.5;
  for (int step = 0; step < kSteps; ++step) {
    const Planar residual = p[0] + u * pu + v * pv + (u * v) * puv;
    const Planar du = pu + v * puv, dv = pv + u * puv;
    const double determinant = cross(du, dv);
    if (determinant == 0) break;
    u = std::clamp(u - cross(residual, dv) / determinant, 0.0, 1.0);
    v = std::clamp(v - cross(du, residual) / determinant, 0.0, 1.0);
  }
  return (1 - v) * ((1 - u) * g[0] + u * g[1]) + v * ((1 - u) * g[3] + u * g[2]);
}

}  // namespace

double FaceOffsets::sign(bool& mixed) const {
  const auto [least, most] =
      std::minmax_element(offsets.begin(), offsets.begin() + static_cast<std::ptrdiff_t>(count));
  mixed = *least < 0 && *most > 0;
  if (mixed) return 0;
  if (*least < 0) return -1;
  return *most > 0 ? 1 : 0;
}

double face_value(const ZooMesh& mesh, const Projector& projector, const FaceOffsets& face,
                  double x, double y, double t) {
  const FaceOffsets ordered = canonical(face);
  const auto [right, up] = projector.slopes(x, y);
  const double reach = projector.perspective() ? t : 1;
  // corners from the ray's point
  std::array<std::array<double, 3>, 4> from;
  for (std::size_t k = 0; k < ordered.count; ++k) {
    const auto c = projector.camera_coordinates(mesh.position(ordered.nodes[k]));
    from[k] = {c[0] - right * reach, c[1] - up * reach, c[2] - t};
  }
  std::array<Planar, 4> best{};
  double widest = -1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<Planar, 4> points{};
    for (std::size_t k = 0; k < ordered.count; ++k)
      points[k] = {from[k][(axis + 1) % 3], from[k][(axis + 2) % 3]};
    const double width = std::abs(cross(points[1] - points[0], points[2] - points[0]));
    if (!(width > widest)) continue;
    widest = width;
    best = points;
  }
  return ordered.count == 3 ? on_triangle(best, ordered.offsets)
                            : on_quadrilateral(best, ordered.offsets);
}

}  // namespace hiac
