#include "tests/render/truth/polyhedron_reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "hiac/mesh/shape_functions.hpp"
#include "tests/support/extended_vectors.hpp"
#include "tests/support/phong.hpp"

namespace hiac::test {
namespace {

using Real = long double;
using Vec = ExtendedVec;

struct Ray {
  Vec origin, direction;  // direction of unit length
  Real from, to;
};

Ray ray_through(const Scene& scene, double x, double y) {
  const Camera& camera = scene.camera;
  const bool perspective = camera.projection == Projection::perspective;
  const Vec eye = vec(camera.eye), forward = unit(vec(camera.look_at) - eye);
  const Vec right = unit(cross(forward, vec(camera.up))), up = cross(right, forward);
  const Real height = scene.image.height, width = scene.image.width;
  const Real extent = perspective ? 2 * std::tan(camera.fov * std::numbers::pi_v<Real> / 360)
                                  : static_cast<Real>(camera.height);
  const Vec aside =
      (extent / height * (x - width / 2)) * right + (extent / height * (height / 2 - y)) * up;
  const Vec direction = perspective ? forward + aside : forward;
  Ray ray{perspective ? eye : eye + aside, unit(direction),
          perspective ? 0 : -std::numeric_limits<Real>::infinity(),
          std::numeric_limits<Real>::infinity()};
  if (camera.clip) {
    const Real length = norm(direction);
    ray.from = std::max(ray.from, (*camera.clip)[0] * length);
    ray.to = (*camera.clip)[1] * length;
  }
  return ray;
}

using NodeValues = std::array<Real, kMaxNodesPerCell>;

struct Cell {
  CellKind kind;
  std::size_t count;    // of nodes
  std::size_t corners;  // the first nodes
  std::array<Vec, kMaxNodesPerCell> nodes;
  NodeValues color{}, extinction{};
  Real from, to;                       // of the segment
  std::vector<NodeValues> surfaces{};  // fields of the scene's isosurfaces
};

bool clip(const Ray& ray, Cell& cell) {
  Vec middle{};
  for (std::size_t k = 0; k < cell.corners; ++k)
    middle = middle + (Real(1) / static_cast<Real>(cell.corners)) * cell.nodes[k];
  cell.from = ray.from;
  cell.to = ray.to;
  for (const ShapeFace& face : topology_of(cell.kind).faces) {
    const auto at = [&](std::size_t k) { return cell.nodes[face.corners[k]]; };
    const std::size_t last = face.corner_count - 1U;
    Vec normal =
        last == 2 ? cross(at(1) - at(0), at(2) - at(0)) : cross(at(2) - at(0), at(3) - at(1));
    Vec center{};
    for (std::size_t k = 0; k <= last; ++k) center = center + (Real(1) / (last + 1)) * at(k);
    if (dot(normal, middle - center) > 0) normal = Real(-1) * normal;
    const Real height = dot(normal, ray.origin - center), slope = dot(normal, ray.direction);
    if (slope > 0) cell.to = std::min(cell.to, -height / slope);
    if (slope < 0) cell.from = std::max(cell.from, -height / slope);
    if (slope == 0 && height > 0) return false;
  }
  return cell.from < cell.to;
}

NodeValues node_values(const ZooMesh& mesh, CellId cell, const Field& field) {
  NodeValues values{};
  for (std::size_t k = 0; k < node_count(mesh.kinds[cell]); ++k) {
    const std::uint64_t entry = mesh.elems[cell] + k;
    const std::size_t at = field.location == FieldLocation::node   ? mesh.nodes[entry]
                           : field.location == FieldLocation::cell ? cell
                                                                   : entry;
    values[k] = field.values[at];
  }
  return values;
}

// Shape functions at a point of the cell, by Newton's iteration halved as often as it must be.
NodeValues shape_at(const Cell& cell, const Vec& point, Vec& xi) {
  NodeValues shape;
  std::array<Vec, kMaxNodesPerCell> gradient;
  const auto residual_at = [&](const Vec& r) {
    shape_functions<Real>(cell.kind, r, shape);
    Vec residual = point;
    for (std::size_t k = 0; k < cell.count; ++k) residual = residual - shape[k] * cell.nodes[k];
    return residual;
  };
  Vec residual = residual_at(xi);
  for (int iteration = 0; iteration < 60; ++iteration) {
    shape_gradients<Real>(cell.kind, xi, gradient);
    std::array<Vec, 3> column{};
    for (std::size_t k = 0; k < cell.count; ++k)
      for (std::size_t a = 0; a < 3; ++a) column[a] = column[a] + gradient[k][a] * cell.nodes[k];
    const Real volume = dot(column[0], cross(column[1], column[2]));
    Vec step{dot(residual, cross(column[1], column[2])) / volume,
             dot(residual, cross(column[2], column[0])) / volume,
             dot(residual, cross(column[0], column[1])) / volume};
    Vec next = residual_at(xi + step);
    for (int halving = 0; halving < 30 && !(norm(next) < norm(residual)); ++halving) {
      step = 0.5L * step;
      next = residual_at(xi + step);
    }
    if (!(norm(next) < norm(residual))) break;
    xi = xi + step;
    residual = next;
    if (norm(step) < 1e-12L) break;  // quadratic: the next step would be 1e-24
  }
  residual_at(xi);
  return shape;
}

struct Optics {
  PiecewiseLinear<3> color;
  PiecewiseLinear<1> extinction;
  bool emission;
};

template <std::size_t N>
std::array<Real, N> value_at(const PiecewiseLinear<N>& function, Real s) {
  const auto& piece = function.piece(function.interval_of(static_cast<double>(s)));
  std::array<Real, N> value;
  for (std::size_t c = 0; c < N; ++c)
    value[c] = piece.value[c] + static_cast<Real>(piece.slope[c]) * (s - piece.anchor);
  return value;
}

// Eight Gauss-Legendre points on [-1, 1], their weights, and weights of the integral from -1 to
// each of them: exact for polynomials of degree 7.
struct Rule {
  std::array<Real, 8> x, w;
  std::array<std::array<Real, 8>, 8> to;

  Rule() {
    constexpr std::array<Real, 4> kNodes{
        0.18343464249564980493947614236018398L, 0.52553240991632898581773904918924635L,
        0.79666647741362673959155393647583044L, 0.96028985649753623168356086856947299L};
    constexpr std::array<Real, 4> kWeights{
        0.36268378337836198296515044927719561L, 0.31370664587788728733796220198660131L,
        0.22238103445337447054435599442624088L, 0.10122853629037625915253135430996219L};
    for (std::size_t k = 0; k < 4; ++k) {
      x[3 - k] = -kNodes[k];
      x[4 + k] = kNodes[k];
      w[3 - k] = w[4 + k] = kWeights[k];
    }
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t j = 0; j < 8; ++j) {
        to[i][j] = 0;
        for (std::size_t k = 0; k < 8; ++k) {
          const Real half = (x[i] + 1) / 2, at = -1 + half * (1 + x[k]);
          Real lagrange = half * w[k];
          for (std::size_t m = 0; m < 8; ++m)
            if (m != j) lagrange *= (at - x[m]) / (x[j] - x[m]);
          to[i][j] += lagrange;
        }
      }
  }
};

struct Light {
  std::array<Real, 3> rgb{};
  Real depth = 0;
};

class Integrator {
 public:
  Integrator(const Ray& ray, const Cell& cell, const Optics& optics, const Scene& scene)
      : ray_(ray), cell_(cell), optics_(optics), scene_(scene) {
    for (const auto& node : reference_nodes(cell.kind).first(cell.corners))
      xi_ = xi_ + (Real(1) / static_cast<Real>(cell.corners)) * vec(node);
  }

  /// Over the cell's segment, cut where transfer functions bend: a bend close to the end of a
  /// panel is one that its points do not see.
  Light integrate() {
    std::vector<Real> cuts{cell_.from, cell_.to};
    add_cuts(cell_.color, optics_.color.breakpoints(), cuts);
    add_cuts(cell_.extinction, optics_.extinction.breakpoints(), cuts);
    std::vector<std::pair<Real, Light>> surfaces;
    for (std::size_t s = 0; s < cell_.surfaces.size(); ++s) {
      std::vector<Real> places;
      const std::array value{scene_.isosurfaces[s].value};
      add_cuts(cell_.surfaces[s], value, places);
      for (const Real t : places) surfaces.emplace_back(t, shaded(s, t));
      cuts.insert(cuts.end(), places.begin(), places.end());
    }
    std::sort(cuts.begin(), cuts.end());
    Light light;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      light = joined(light, refined(cuts[i], cuts[i + 1], panel(cuts[i], cuts[i + 1]), 34));
      for (const auto& [t, surface] : surfaces)
        if (t == cuts[i + 1]) light = joined(light, surface);
    }
    return light;
  }

 private:
  Real field_at(const NodeValues& values, Real t) {
    const auto shape = shape_at(cell_, ray_.origin + t * ray_.direction, xi_);
    Real f = 0;
    for (std::size_t k = 0; k < cell_.count; ++k) f += shape[k] * values[k];
    return f;
  }

  // A surface as a piece of volume: its light, and the depth that lets as much through.
  Light shaded(std::size_t s, Real t) {
    const Vec point = ray_.origin + t * ray_.direction;
    std::array<Vec, kMaxNodesPerCell> gradient;
    shape_at(cell_, point, xi_);
    shape_gradients<Real>(cell_.kind, xi_, gradient);
    std::array<Vec, 3> column{};
    Vec slope{};
    for (std::size_t k = 0; k < cell_.count; ++k)
      for (std::size_t a = 0; a < 3; ++a) {
        column[a] = column[a] + gradient[k][a] * cell_.nodes[k];
        slope[a] += gradient[k][a] * cell_.surfaces[s][k];
      }
    // J^-T slope, up to a factor
    const Vec normal = slope[0] * cross(column[1], column[2]) +
                       slope[1] * cross(column[2], column[0]) +
                       slope[2] * cross(column[0], column[1]);
    const ReferenceShade shade =
        reference_shade(scene_.isosurfaces[s], scene_.lights, normal, ray_.direction);
    return {shade.rgb, -std::log(shade.transparency)};
  }

  // Where the field takes one of the values, by bisection between points on an even grid.
  void add_cuts(const NodeValues& values, std::span<const double> at, std::vector<Real>& cuts) {
    constexpr int kGrid = 200;
    const auto place = [&](int i) { return cell_.from + (cell_.to - cell_.from) * i / kGrid; };
    std::array<Real, kGrid + 1> f;
    for (int i = 0; i <= kGrid; ++i) f[static_cast<std::size_t>(i)] = field_at(values, place(i));
    for (const double s : at)
      for (int i = 0; i < kGrid; ++i) {
        const Real before = f[static_cast<std::size_t>(i)] - s;
        const Real after = f[static_cast<std::size_t>(i) + 1] - s;
        if (before * after >= 0) continue;
        Real low = place(i), high = place(i + 1);
        for (int k = 0; k < 62; ++k) {
          const Real middle = (low + high) / 2;
          ((field_at(values, middle) - s > 0) == (before > 0) ? low : high) = middle;
        }
        cuts.push_back(low);
      }
  }

  Light refined(Real from, Real to, const Light& whole, int levels) {
    const Real middle = (from + to) / 2;
    const Light front = panel(from, middle), back = panel(middle, to);
    const Light both = joined(front, back);
    Real difference = std::abs(both.depth - whole.depth);
    for (std::size_t c = 0; c < 3; ++c)
      difference = std::max(difference, std::abs(both.rgb[c] - whole.rgb[c]));
    if (difference <= 1e-16L || levels == 0) return both;
    return joined(refined(from, middle, front, levels - 1), refined(middle, to, back, levels - 1));
  }

  static Light joined(const Light& front, const Light& back) {
    Light light{front.rgb, front.depth + back.depth};
    for (std::size_t c = 0; c < 3; ++c) light.rgb[c] += std::exp(-front.depth) * back.rgb[c];
    return light;
  }

  Light panel(Real from, Real to) {
    static const Rule rule;
    const Real half = (to - from) / 2;
    std::array<Real, 8> tau;
    std::array<std::array<Real, 3>, 8> color;
    for (std::size_t i = 0; i < 8; ++i) {
      const Real t = from + half * (1 + rule.x[i]);
      const auto shape = shape_at(cell_, ray_.origin + t * ray_.direction, xi_);
      Real s = 0, e = 0;
      for (std::size_t k = 0; k < cell_.count; ++k) {
        s += shape[k] * cell_.color[k];
        e += shape[k] * cell_.extinction[k];
      }
      tau[i] = value_at(optics_.extinction, e)[0];
      color[i] = value_at(optics_.color, s);
    }
    Light light;
    for (std::size_t i = 0; i < 8; ++i) {
      Real depth = 0;
      for (std::size_t j = 0; j < 8; ++j) depth += half * rule.to[i][j] * tau[j];
      light.depth += half * rule.w[i] * tau[i];
      const Real weight = half * rule.w[i] * std::exp(-depth) * (optics_.emission ? 1 : tau[i]);
      for (std::size_t c = 0; c < 3; ++c) light.rgb[c] += weight * color[i][c];
    }
    return light;
  }

  const Ray& ray_;
  const Cell& cell_;
  const Optics& optics_;
  const Scene& scene_;
  Vec xi_{};  // of the last point: the next one's first guess
};

}  // namespace

std::array<double, 4> polyhedron_reference(const ZooMesh& mesh, const Scene& scene, double x,
                                           double y) {
  const Ray ray = ray_through(scene, x, y);
  const auto& volume = scene.volume;
  const Optics optics{volume.color ? volume.color->function() : PiecewiseLinear<3>(),
                      volume.extinction ? volume.extinction->function() : PiecewiseLinear<1>(),
                      volume.glow == Glow::emission};
  Field color, extinction;
  if (volume.color) color = scalar_field(mesh, volume.color->field);
  if (volume.extinction) extinction = scalar_field(mesh, volume.extinction->field);
  std::vector<Field> surfaces;
  for (const Isosurface& surface : scene.isosurfaces)
    surfaces.push_back(scalar_field(mesh, surface.field));
  std::vector<Cell> segments;
  for (CellId id = 0; id < mesh.cell_count(); ++id) {
    Cell cell{mesh.kinds[id],
              node_count(mesh.kinds[id]),
              corner_count(mesh.kinds[id]),
              {},
              {},
              {},
              0,
              0,
              {}};
    for (std::size_t k = 0; k < cell.count; ++k)
      cell.nodes[k] = vec(mesh.position(mesh.cell_nodes(id)[k]));
    if (!clip(ray, cell)) continue;
    if (volume.color) cell.color = node_values(mesh, id, color);
    if (volume.extinction) cell.extinction = node_values(mesh, id, extinction);
    for (const Field& field : surfaces) cell.surfaces.push_back(node_values(mesh, id, field));
    segments.push_back(cell);
  }
  std::sort(segments.begin(), segments.end(),
            [](const Cell& a, const Cell& b) { return a.from + a.to < b.from + b.to; });
  std::array<Real, 3> rgb{};
  Real depth = 0;
  for (const Cell& segment : segments) {
    const Light light = Integrator(ray, segment, optics, scene).integrate();
    for (std::size_t c = 0; c < 3; ++c) rgb[c] += std::exp(-depth) * light.rgb[c];
    depth += light.depth;
  }
  return {static_cast<double>(rgb[0]), static_cast<double>(rgb[1]), static_cast<double>(rgb[2]),
          static_cast<double>(-std::expm1(-depth))};
}

}  // namespace hiac::test
