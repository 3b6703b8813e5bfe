#include "tests/support/reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/support/extended_vectors.hpp"
#include "tests/support/phong.hpp"

namespace hiac::test {
namespace {

using Real = long double;
using Vec = ExtendedVec;

struct Ray {
  Vec origin, direction;  // direction of unit length
  Real from = 0, to = std::numeric_limits<Real>::infinity();
};

Ray pixel_ray(const Scene& scene, std::uint32_t x, std::uint32_t y) {
  const Camera& camera = scene.camera;
  const Vec eye = vec(camera.eye);
  Vec forward = vec(camera.look_at) - eye;
  forward = (1 / std::sqrt(dot(forward, forward))) * forward;
  Vec right = cross(forward, vec(camera.up));
  right = (1 / std::sqrt(dot(right, right))) * right;
  const Vec up = cross(right, forward);
  const Real a = x + 0.5L - scene.image.width / 2.0L, b = scene.image.height / 2.0L - y - 0.5L;
  Ray ray;
  Real along = 1;  // distance along the view direction per unit of length on the ray
  if (camera.projection == Projection::perspective) {
    const Real half = std::tan(camera.fov * std::numbers::pi_v<Real> / 360);
    const Real unit = half / (scene.image.height / 2.0L);
    const Vec direction = forward + (a * unit) * right + (b * unit) * up;
    along = 1 / std::sqrt(dot(direction, direction));
    ray.origin = eye;
    ray.direction = along * direction;
  } else {
    const Real unit = static_cast<Real>(camera.height) / scene.image.height;
    ray.origin = eye + (a * unit) * right + (b * unit) * up;
    ray.direction = forward;
    ray.from = -std::numeric_limits<Real>::infinity();
  }
  if (camera.clip) {
    ray.from = std::max(ray.from, (*camera.clip)[0] / along);
    ray.to = (*camera.clip)[1] / along;
  }
  return ray;
}

// A scalar along a ray: value + slope t.
struct Line {
  Real value, slope;
  [[nodiscard]] Real at(Real t) const { return value + slope * t; }
};

// An isosurface that a segment crosses.
struct Crossing {
  Real at;
  ReferenceShade shade;
};

struct Segment {
  Real from, to;
  Line color, extinction;
  std::vector<Crossing> crossings;
};

// Barycentric coordinates of the ray's points are linear in t; the cell is where none is negative.
bool cut(const ZooMesh& mesh, CellId cell, const Ray& ray, std::array<Line, 4>& barycentric,
         Real& from, Real& to) {
  std::array<Vec, 4> p;
  for (std::size_t k = 0; k < 4; ++k) p[k] = vec(mesh.position(mesh.cell_nodes(cell)[k]));
  from = ray.from;
  to = ray.to;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec &a = p[(k + 1) % 4], &b = p[(k + 2) % 4], &c = p[(k + 3) % 4];
    const Vec normal = cross(b - a, c - a);
    const Real height = dot(normal, p[k] - a);
    if (height == 0) return false;
    barycentric[k] = {dot(normal, ray.origin - a) / height, dot(normal, ray.direction) / height};
    const Line& l = barycentric[k];
    if (l.slope > 0) from = std::max(from, -l.value / l.slope);
    if (l.slope < 0) to = std::min(to, -l.value / l.slope);
    if (l.slope == 0 && l.value < 0) return false;
  }
  return from < to;
}

Line field_line(const ZooMesh& mesh, CellId cell, const std::string& name,
                const std::array<Line, 4>& barycentric) {
  const Field field = scalar_field(mesh, name);
  Line line{0, 0};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::uint64_t entry = mesh.elems[cell] + k;
    const std::size_t at = field.location == FieldLocation::node   ? mesh.nodes[entry]
                           : field.location == FieldLocation::cell ? cell
                                                                   : entry;
    line.value += field.values[at] * barycentric[k].value;
    line.slope += field.values[at] * barycentric[k].slope;
  }
  return line;
}

// The gradient of a linear field: by its differences along the cell's edges (Cramer's rule).
Vec field_gradient(const ZooMesh& mesh, CellId cell, const std::string& name) {
  const Field field = scalar_field(mesh, name);
  std::array<Vec, 4> p;
  std::array<Real, 4> f;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::uint64_t entry = mesh.elems[cell] + k;
    p[k] = vec(mesh.position(mesh.nodes[entry]));
    f[k] = field.values[field.location == FieldLocation::node   ? mesh.nodes[entry]
                        : field.location == FieldLocation::cell ? cell
                                                                : entry];
  }
  const Vec a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
  return (1 / dot(a, cross(b, c))) *
         ((f[1] - f[0]) * cross(b, c) + (f[2] - f[0]) * cross(c, a) + (f[3] - f[0]) * cross(a, b));
}

void add_crossings(const ZooMesh& mesh, CellId cell, const Scene& scene, const Ray& ray,
                   const std::array<Line, 4>& barycentric, Segment& segment) {
  for (const Isosurface& surface : scene.isosurfaces) {
    const Line line = field_line(mesh, cell, surface.field, barycentric);
    const Real t = (surface.value - line.value) / line.slope;
    if (line.slope != 0 && t > segment.from && t <= segment.to)
      segment.crossings.push_back(
          {t, reference_shade(surface, scene.lights, field_gradient(mesh, cell, surface.field),
                              ray.direction)});
  }
  std::stable_sort(segment.crossings.begin(), segment.crossings.end(),
                   [](const Crossing& a, const Crossing& b) { return a.at < b.at; });
}

// Eight-point Gauss-Legendre rule on [-1, 1]: positive nodes and weights.
constexpr std::array<Real, 4> kNodes{
    0.18343464249564980493947614236018398L, 0.52553240991632898581773904918924635L,
    0.79666647741362673959155393647583044L, 0.96028985649753623168356086856947299L};
constexpr std::array<Real, 4> kWeights{
    0.36268378337836198296515044927719561L, 0.31370664587788728733796220198660131L,
    0.22238103445337447054435599442624088L, 0.10122853629037625915253135430996219L};

template <typename Function>
Real gauss(const Function& f, Real a, Real b) {
  const Real middle = (a + b) / 2, half = (b - a) / 2;
  Real sum = 0;
  for (std::size_t k = 0; k < 4; ++k)
    sum += kWeights[k] * (f(middle - half * kNodes[k]) + f(middle + half * kNodes[k]));
  return half * sum;
}

template <typename Function>
Real adaptive(const Function& f, Real a, Real b, Real whole, int depth) {
  const Real middle = (a + b) / 2;
  const Real left = gauss(f, a, middle), right = gauss(f, middle, b);
  if (depth == 0 || std::abs(left + right - whole) <= 1e-17L + 1e-16L * std::abs(whole))
    return left + right;
  return adaptive(f, a, middle, left, depth - 1) + adaptive(f, middle, b, right, depth - 1);
}

void cut_at(const Line& line, std::span<const double> values, const Segment& s,
            std::vector<Real>& cuts) {
  if (line.slope == 0) return;
  for (const double value : values) {
    const Real t = (value - line.value) / line.slope;
    if (t > s.from && t < s.to) cuts.push_back(t);
  }
}

// A transfer function on one piece, by its scalar in the middle: linear in t.
template <std::size_t N>
Line on_piece(const PiecewiseLinear<N>& function, std::size_t channel, const Line& scalar,
              Real middle) {
  const auto& piece = function.piece(function.interval_of(static_cast<double>(scalar.at(middle))));
  const Real slope = piece.slope[channel];
  return {piece.value[channel] + slope * (scalar.value - piece.anchor), slope * scalar.slope};
}

struct Optics {
  PiecewiseLinear<3> color;
  PiecewiseLinear<1> extinction;
  bool emission;
  Integration integration;
};

// Five points of the Gauss-Legendre rule on [-1, 1] and their weights, in closed form.
template <typename Function>
Real five_points(const Function& f, Real a, Real b) {
  const Real root = 2 * std::sqrt(10.0L / 7), more = 13 * std::sqrt(70.0L);
  const Real inner = std::sqrt(5 - root) / 3, outer = std::sqrt(5 + root) / 3;
  const Real middle = (a + b) / 2, half = (b - a) / 2;
  return half * (128.0L / 225 * f(middle) +
                 (322 + more) / 900 * (f(middle - half * inner) + f(middle + half * inner)) +
                 (322 - more) / 900 * (f(middle - half * outer) + f(middle + half * outer)));
}

void composite(const ReferenceShade& shade, std::array<Real, 3>& light, Real& transparency) {
  for (std::size_t c = 0; c < 3; ++c) light[c] += transparency * shade.rgb[c];
  transparency *= shade.transparency;
}

void composite(const Segment& s, const Optics& optics, std::array<Real, 3>& light,
               Real& transparency) {
  std::vector<Real> cuts{s.from, s.to};
  const bool unsliced = optics.integration == Integration::approximate_unsliced;
  if (!unsliced) {
    cut_at(s.color, optics.color.breakpoints(), s, cuts);
    cut_at(s.extinction, optics.extinction.breakpoints(), s, cuts);
  }
  for (const Crossing& crossing : s.crossings) cuts.push_back(crossing.at);
  std::sort(cuts.begin(), cuts.end());
  auto crossing = s.crossings.begin();
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    for (; crossing != s.crossings.end() && crossing->at <= cuts[i]; ++crossing)
      composite(crossing->shade, light, transparency);
    const Real from = cuts[i], to = cuts[i + 1], middle = (from + to) / 2;
    const auto line_of = [&](const auto& function, std::size_t c, const Line& scalar) {
      if (!unsliced) return on_piece(function, c, scalar, middle);
      const Real front = on_piece(function, c, scalar, from).at(from);
      const Real back = on_piece(function, c, scalar, to).at(to);
      const Real slope = (back - front) / (to - from);
      return Line{front - slope * from, slope};
    };
    const Line tau = line_of(optics.extinction, 0, s.extinction);
    const auto depth = [&](Real t) {
      return (t - from) * (tau.value + tau.slope * (t + from) / 2);
    };
    for (std::size_t c = 0; c < 3; ++c) {
      const Line color = line_of(optics.color, c, s.color);
      const bool mean = unsliced || optics.integration == Integration::approximate;
      const auto integrand = [&](Real t) {
        const Real here = mean ? (color.at(from) + color.at(to)) / 2 : color.at(t);
        return (optics.emission ? here : here * tau.at(t)) * std::exp(-depth(t));
      };
      light[c] +=
          transparency * (optics.integration == Integration::gauss5
                              ? five_points(integrand, from, to)
                              : adaptive(integrand, from, to, gauss(integrand, from, to), 40));
    }
    transparency *= std::exp(-depth(to));
  }
  for (; crossing != s.crossings.end(); ++crossing) composite(crossing->shade, light, transparency);
}

}  // namespace

std::array<double, 4> reference_pixel(const ZooMesh& mesh, const Scene& scene, std::uint32_t x,
                                      std::uint32_t y) {
  const Ray ray = pixel_ray(scene, x, y);
  const auto& volume = scene.volume;
  const Optics optics{volume.color ? volume.color->function() : PiecewiseLinear<3>(),
                      volume.extinction ? volume.extinction->function() : PiecewiseLinear<1>(),
                      volume.glow == Glow::emission, scene.render.integration};
  std::vector<Segment> segments;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    std::array<Line, 4> barycentric;
    Segment segment{};
    if (!cut(mesh, cell, ray, barycentric, segment.from, segment.to)) continue;
    if (volume.color) segment.color = field_line(mesh, cell, volume.color->field, barycentric);
    if (volume.extinction)
      segment.extinction = field_line(mesh, cell, volume.extinction->field, barycentric);
    add_crossings(mesh, cell, scene, ray, barycentric, segment);
    segments.push_back(segment);
  }
  std::sort(segments.begin(), segments.end(),
            [](const Segment& a, const Segment& b) { return a.from + a.to < b.from + b.to; });
  std::array<Real, 3> light{};
  Real transparency = 1;
  for (const Segment& segment : segments) composite(segment, optics, light, transparency);
  return {static_cast<double>(light[0]), static_cast<double>(light[1]),
          static_cast<double>(light[2]), static_cast<double>(1 - transparency)};
}

}  // namespace hiac::test
