#include "hiac/element/face_interpolant.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "hiac/mesh/interpolant_range.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

// A point of the face's plane, in the two coordinates in which the face is widest.
struct Planar {
  double x, y;
};

Planar operator+(const Planar& a, const Planar& b) { return {a.x + b.x, a.y + b.y}; }
Planar operator-(const Planar& a, const Planar& b) { return {a.x - b.x, a.y - b.y}; }
Planar operator*(double s, const Planar& a) { return {s * a.x, s * a.y}; }
double planar_cross(const Planar& a, const Planar& b) { return a.x * b.y - a.y * b.x; }

// A kind whose face z = 0 has the face's interpolant, and its nodes there.
struct Carrier {
  CellKind kind;
  std::array<std::size_t, FaceOffsets::kMostNodes> nodes;

  explicit Carrier(const FaceOffsets& face)
      : kind(face.centred      ? CellKind::tetrahedron20
             : face.count == 3 ? kind_of(CellShape::prism, face.order)
                               : kind_of(CellShape::brick, face.order)) {
    const std::size_t n = face.count, per_edge = static_cast<std::size_t>(face.order) - 1;
    for (std::size_t k = 0; k < n; ++k) nodes[k] = k;
    // the kind's first edges go around that face
    for (std::size_t k = 0; k < n * per_edge; ++k) nodes[n + k] = corner_count(kind) + k;
    if (face.centred) nodes[n + n * per_edge] = hiac::node_count(kind) - 1;
  }
};

double on_triangle(std::span<const Planar> p, std::span<const double> g) {
  const double a = planar_cross(p[1], p[2]), b = planar_cross(p[2], p[0]),
               c = planar_cross(p[0], p[1]);
  const double sum = a + b + c;
  return sum == 0 ? g[0] : (a * g[0] + b * g[1] + c * g[2]) / sum;
}

// The offset on a quadrilateral, by Newton's iteration for the bilinear map's inverse. The number
// of steps is fixed at the largest that is ever needed.
double on_quadrilateral(std::span<const Planar> p, std::span<const double> g) {
  constexpr int kSteps = 16;
  const Planar pu = p[1] - p[0], pv = p[3] - p[0], puv = (p[2] - p[1]) - pv;
  double u = 0.5, v = 0.5;
  for (int step = 0; step < kSteps; ++step) {
    const Planar residual = p[0] + u * pu + v * pv + (u * v) * puv;
    const Planar du = pu + v * puv, dv = pv + u * puv;
    const double determinant = planar_cross(du, dv);
    if (determinant == 0) break;
    u = std::clamp(u - planar_cross(residual, dv) / determinant, 0.0, 1.0);
    v = std::clamp(v - planar_cross(du, residual) / determinant, 0.0, 1.0);
  }
  return (1 - v) * ((1 - u) * g[0] + u * g[1]) + v * ((1 - u) * g[3] + u * g[2]);
}

// The offset on a face of higher order: the isoparametric interpolant, by the same iteration.
double on_higher_order(const FaceOffsets& face,
                       const std::array<Planar, FaceOffsets::kMostNodes>& p) {
  constexpr int kSteps = 16;
  const Carrier carrier(face);
  std::array<double, kMaxNodesPerCell> shape;
  std::array<std::array<double, 3>, kMaxNodesPerCell> gradient;
  std::array<double, 3> xi{0.3, 0.3, 0};
  const auto sum = [&](const auto& weight) {
    Planar point{0, 0};
    for (std::size_t k = 0; k < face.node_count(); ++k)
      point = point + weight(carrier.nodes[k]) * p[k];
    return point;
  };
  for (int step = 0; step < kSteps; ++step) {
    shape_functions<double>(carrier.kind, xi, shape);
    shape_gradients<double>(carrier.kind, xi, gradient);
    const Planar residual = sum([&](std::size_t k) { return shape[k]; });
    const Planar du = sum([&](std::size_t k) { return gradient[k][0]; });
    const Planar dv = sum([&](std::size_t k) { return gradient[k][1]; });
    const double determinant = planar_cross(du, dv);
    if (determinant == 0) break;
    xi[0] = std::clamp(xi[0] - planar_cross(residual, dv) / determinant, 0.0, 1.0);
    xi[1] = std::clamp(xi[1] - planar_cross(du, residual) / determinant, 0.0, 1.0);
  }
  shape_functions<double>(carrier.kind, xi, shape);
  double value = 0;
  for (std::size_t k = 0; k < face.node_count(); ++k)
    value += shape[carrier.nodes[k]] * face.offsets[k];
  return value;
}

// The range of the face's interpolant.
ValueRange range_of(const FaceOffsets& face) {
  const auto [least, most] = std::ranges::minmax(std::span(face.offsets).first(face.node_count()));
  if (face.order == CellOrder::linear || least == most) return {least, most};
  const Carrier carrier(face);
  std::array<double, kMaxNodesPerCell> values{};
  for (std::size_t k = 0; k < face.node_count(); ++k) values[carrier.nodes[k]] = face.offsets[k];
  const InterpolantCoefficients b = interpolant_coefficients(carrier.kind, values);
  const std::size_t n = static_cast<std::size_t>(face.order) + 1;
  const auto coefficients = std::ranges::minmax(std::span(b.c).first(n * n));
  return {coefficients.min - b.rounding, coefficients.max + b.rounding};
}

// The node of a cell that is number j of `per_edge` on the way from one corner to another.
std::size_t node_between(CellKind kind, std::size_t from, std::size_t to, std::size_t j,
                         std::size_t per_edge) {
  const auto edges = topology_of(kind).edges;
  std::size_t edge = 0;
  while (!(edges[edge][0] == from && edges[edge][1] == to) &&
         !(edges[edge][0] == to && edges[edge][1] == from))
    ++edge;
  const bool forward = edges[edge][0] == from;
  return corner_count(kind) + edge * per_edge + (forward ? j : per_edge - 1 - j);
}

}  // namespace

double sign_between(double least, double most, bool& mixed) {
  mixed = least < 0 && most > 0;
  if (mixed) return 0;
  if (least < 0) return -1;
  return most > 0 ? 1 : 0;
}

double FaceOffsets::sign(bool& mixed) const {
  const auto [least, most] = range_of(*this);
  return sign_between(least, most, mixed);
}

std::size_t tetrahedron_face_without(std::size_t corner) {
  const auto faces = topology_of(CellShape::tetrahedron).faces;
  std::size_t face = 0;
  const auto has_corner = [&](const ShapeFace& f) {
    return std::find(f.corners.begin(), f.corners.begin() + 3, corner) != f.corners.begin() + 3;
  };
  while (has_corner(faces[face])) ++face;
  return face;
}

FaceOffsets face_offsets(CellKind kind, std::size_t face, std::span<const NodeId> nodes,
                         std::span<const double> offsets) {
  FaceOffsets result;
  result.order = order_of(kind);
  const std::size_t per_edge = static_cast<std::size_t>(result.order) - 1;
  const ShapeFace& corners = topology_of(kind).faces[face];
  const std::size_t n = corners.corner_count;
  for (std::size_t k = 0; k < n; ++k)
    result.add(nodes[corners.corners[k]], offsets[corners.corners[k]]);
  const auto take = [&](std::size_t to, std::size_t from) {
    result.nodes[to] = nodes[from];
    result.offsets[to] = offsets[from];
  };
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < per_edge; ++j)
      take(n + k * per_edge + j,
           node_between(kind, corners.corners[k], corners.corners[(k + 1) % n], j, per_edge));
  result.centred = kind == CellKind::tetrahedron20;
  if (result.centred) take(n + n * per_edge, node_count(kind) - face_count(kind) + face);
  return result;
}

FaceOffsets canonical_face(const FaceOffsets& face) {
  const std::size_t n = face.count;
  const auto smallest = static_cast<std::size_t>(
      std::min_element(face.nodes.begin(), face.nodes.begin() + static_cast<std::ptrdiff_t>(n)) -
      face.nodes.begin());
  const bool forward = face.nodes[(smallest + 1) % n] < face.nodes[(smallest + n - 1) % n];
  FaceOffsets result = face;
  const auto take = [&](std::size_t to, std::size_t from) {
    result.nodes[to] = face.nodes[from];
    result.offsets[to] = face.offsets[from];
  };
  const std::size_t per_edge = static_cast<std::size_t>(face.order) - 1;
  for (std::size_t k = 0; k < n; ++k) {
    take(k, (smallest + (forward ? k : n - k)) % n);
    // edge k, from there to the next corner
    const std::size_t edge = (smallest + (forward ? k : n - k - 1)) % n;
    for (std::size_t j = 0; j < per_edge; ++j)
      take(n + k * per_edge + j, n + edge * per_edge + (forward ? j : per_edge - 1 - j));
  }
  return result;
}

double face_value_at(const FaceOffsets& canonical, std::span<const std::array<double, 3>> from) {
  const std::size_t count = canonical.node_count();
  std::array<Planar, FaceOffsets::kMostNodes> best{};
  double widest = -1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<Planar, FaceOffsets::kMostNodes> points{};
    for (std::size_t k = 0; k < count; ++k)
      points[k] = {from[k][(axis + 1) % 3], from[k][(axis + 2) % 3]};
    const double width = std::abs(planar_cross(points[1] - points[0], points[2] - points[0]));
    if (!(width > widest)) continue;
    widest = width;
    best = points;
  }
  if (canonical.order != CellOrder::linear) return on_higher_order(canonical, best);
  return canonical.count == 3 ? on_triangle(best, canonical.offsets)
                              : on_quadrilateral(best, canonical.offsets);
}

}  // namespace hiac
