#include "tests/render/truth/scene_truth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "hiac/mesh/shape_functions.hpp"
#include "tests/support/extended_vectors.hpp"
#include "tests/support/phong.hpp"

namespace hiac::test {
namespace {

using Real = SceneTruth::Real;
using Vec = ExtendedVec;

constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
// Of a field's values: Chebyshev coefficients below it are left out.
constexpr Real kNegligible = 1e-18L, kNegligibleInCurved = 1e-16L;
// Of a cell's size: faces that are as planar as this and edges as straight are taken so.
constexpr Real kPlanar = 1e-12L;

// To within little.
bool in_reference_cell(CellKind kind, const Vec& xi) {
  constexpr Real kMargin = 1e-6L;
  const auto& [x, y, z] = xi;
  Real outside = std::max({-x, -y, -z});
  switch (shape_of(kind)) {
    case CellShape::tetrahedron:
      outside = std::max(outside, x + y + z - 1);
      break;
    case CellShape::pyramid:
      outside = std::max(outside, std::max(x, y) + z - 1);
      break;
    case CellShape::prism:
      outside = std::max({outside, x + y - 1, z - 1});
      break;
    case CellShape::wedge:
      outside = std::max({outside, y - 1, z - 1, x + y + z - 2});
      break;
    case CellShape::brick:
      outside = std::max({outside, x - 1, y - 1, z - 1});
      break;
  }
  return outside <= kMargin;
}

}  // namespace

SceneTruth::SceneTruth(const ZooMesh& mesh, const Scene& scene)
    : mesh_(mesh), scene_(scene), volume_(scene.volume) {
  const Camera& camera = scene.camera;
  const bool perspective = camera.projection == Projection::perspective;
  eye_ = vec(camera.eye);
  forward_ = unit(vec(camera.look_at) - eye_);
  right_ = unit(cross(forward_, vec(camera.up)));
  up_ = cross(right_, forward_);
  const Real extent = perspective ? 2 * std::tan(camera.fov * std::numbers::pi_v<Real> / 360)
                                  : static_cast<Real>(camera.height);
  per_pixel_ = extent / scene.image.height;
  std::vector<std::string> names;
  const auto number = [&](const std::string& name) {
    const auto at = std::ranges::find(names, name);
    const auto result = static_cast<std::size_t>(at - names.begin());
    if (at == names.end()) {
      names.push_back(name);
      fields_.push_back(scalar_field(mesh, name));
    }
    return result;
  };
  if (scene.volume.color) color_field_ = number(scene.volume.color->field);
  if (scene.volume.extinction) extinction_field_ = number(scene.volume.extinction->field);
  for (const Isosurface& surface : scene.isosurfaces)
    surface_fields_.push_back(number(surface.field));
  in_pixel_.resize(std::size_t{scene.image.width} * scene.image.height);
  cells_.reserve(mesh.cell_count());
  for (CellId id = 0; id < mesh.cell_count(); ++id) add_cell(id);
}

bool SceneTruth::is_curved(const Cell& cell) {
  std::array<Real, kMaxNodesPerCell> shape;
  const auto reference = reference_nodes(cell.kind);
  const std::size_t corners = corner_count(cell.kind);
  for (std::size_t k = corners; k < cell.count; ++k) {
    shape_functions<Real>(kind_of(shape_of(cell.kind), CellOrder::linear), vec(reference[k]),
                          shape);
    Vec off = cell.nodes[k];
    for (std::size_t c = 0; c < corners; ++c) off = off - shape[c] * cell.nodes[c];
    if (norm(off) > kPlanar * cell.size) return true;
  }
  for (const ShapeFace& face : topology_of(cell.kind).faces) {
    if (face.corner_count == 3) continue;
    const auto at = [&](std::size_t k) { return cell.nodes[face.corners[k]]; };
    const Vec normal = cross(at(2) - at(0), at(3) - at(1));
    if (std::abs(dot(normal, at(1) - at(0))) > kPlanar * cell.size * norm(normal)) return true;
  }
  return false;
}

void SceneTruth::add_cell(CellId id) {
  Cell cell;
  cell.kind = mesh_.kinds[id];
  cell.count = node_count(cell.kind);
  Vec middle{};
  for (std::size_t k = 0; k < cell.count; ++k) {
    const Vec p = vec(mesh_.position(mesh_.cell_nodes(id)[k])) - eye_;
    cell.nodes[k] = {dot(p, right_), dot(p, up_), dot(p, forward_)};
    middle = middle + (1 / static_cast<Real>(cell.count)) * cell.nodes[k];
    cell.size = std::max(cell.size, norm(cell.nodes[k] - cell.nodes[0]));
  }
  if (is_curved(cell))
    cell.curved.emplace(cell.kind, std::span<const Vec>(cell.nodes).first(cell.count));
  for (const ShapeFace& face : topology_of(cell.kind).faces) {
    const auto at = [&](std::size_t k) { return cell.nodes[face.corners[k]]; };
    const std::size_t corners = face.corner_count;
    Vec normal =
        corners == 3 ? cross(at(1) - at(0), at(2) - at(0)) : cross(at(2) - at(0), at(3) - at(1));
    Vec center = at(0);
    if (corners == 4) center = 0.25L * (at(0) + at(1) + at(2) + at(3));
    if (dot(normal, middle - center) > 0) normal = Real(-1) * normal;
    const Plane& plane = cell.planes.emplace_back(Plane{normal, dot(normal, center)});
    cell.rough_planes.push_back({{static_cast<double>(normal[0]), static_cast<double>(normal[1]),
                                  static_cast<double>(normal[2])},
                                 static_cast<double>(plane.offset)});
  }
  for (const Field& field : fields_) {
    NodeValues& values = cell.fields.emplace_back();
    bool constant = true;
    for (std::size_t k = 0; k < cell.count; ++k) {
      const std::uint64_t entry = mesh_.elems[id] + k;
      values[k] = field.values[field.location == FieldLocation::node   ? mesh_.nodes[entry]
                               : field.location == FieldLocation::cell ? id
                                                                       : entry];
      constant = constant && values[k] == values[0];
    }
    cell.constant.push_back(constant ? 1 : 0);
  }
  if (cell.kind == CellKind::tetrahedron4)
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec& a = cell.nodes[(k + 1) % 4];
      const Vec n = cross(cell.nodes[(k + 2) % 4] - a, cell.nodes[(k + 3) % 4] - a);
      const Real height = dot(n, cell.nodes[k] - a);
      if (height == 0) return;  // no volume: nothing is seen of it
      cell.gradient[k] = (1 / height) * n;
      cell.value[k] = -dot(cell.gradient[k], a);
    }
  cells_.push_back(cell);
  add_to_pixels(static_cast<std::uint32_t>(cells_.size() - 1));
}

void SceneTruth::add_to_pixels(std::uint32_t cell) {
  const Cell& c = cells_[cell];
  const Real width = scene_.image.width, height = scene_.image.height;
  Real x0 = kInfinity, y0 = kInfinity, x1 = -kInfinity, y1 = -kInfinity;
  Real nearest = kInfinity, farthest = -kInfinity, widest = 0;
  for (std::size_t k = 0; k < c.count; ++k) {
    const Vec& p = c.nodes[k];
    nearest = std::min(nearest, p[2]);
    farthest = std::max(farthest, p[2]);
    widest = std::max(widest, norm(p));
    const Real reach = scene_.camera.projection == Projection::perspective ? p[2] : 1;
    const Real x = width / 2 + p[0] / (reach * per_pixel_);
    const Real y = height / 2 - p[1] / (reach * per_pixel_);
    x0 = std::min(x0, x);
    x1 = std::max(x1, x);
    y0 = std::min(y0, y);
    y1 = std::max(y1, y);
  }
  if (scene_.camera.projection == Projection::perspective) {
    if (farthest <= 0) return;
    if (nearest <= (c.curved ? 0.3L : 1e-3L) * widest) {
      x0 = y0 = 0;
      x1 = width;
      y1 = height;
    }
  }
  if (c.curved) {  // bulges no farther than its nodes are apart
    const Real x = x1 - x0, y = y1 - y0;
    x0 -= x;
    x1 += x;
    y0 -= y;
    y1 += y;
  }
  const auto pixel = [](Real at, Real size) {
    return static_cast<std::size_t>(std::clamp<Real>(at, 0, size));
  };
  for (std::size_t y = pixel(std::floor(y0) - 1, height); y < pixel(std::ceil(y1) + 1, height); ++y)
    for (std::size_t x = pixel(std::floor(x0) - 1, width); x < pixel(std::ceil(x1) + 1, width); ++x)
      in_pixel_[y * scene_.image.width + x].push_back(cell);
}

SceneTruth::Ray SceneTruth::ray_of(std::uint32_t x, std::uint32_t y) const {
  const Camera& camera = scene_.camera;
  const Real a = per_pixel_ * (x + 0.5L - scene_.image.width / 2.0L);
  const Real b = per_pixel_ * (scene_.image.height / 2.0L - y - 0.5L);
  Ray ray{{0, 0, 0}, {a, b, 1}, 0, kInfinity, std::sqrt(1 + a * a + b * b)};
  if (camera.projection == Projection::orthographic)
    ray = {{a, b, 0}, {0, 0, 1}, -kInfinity, kInfinity, 1};
  if (camera.clip) {
    ray.from = std::max<Real>(ray.from, (*camera.clip)[0]);
    ray.to = (*camera.clip)[1];
  }
  return ray;
}

// Quickly, whether the cell is far from the ray.
bool SceneTruth::misses(const Cell& cell, const Ray& ray) {
  double from = -std::numeric_limits<double>::infinity(), to = -from;
  for (const RoughPlane& plane : cell.rough_planes) {
    double height = -plane.offset, slope = 0, size = std::abs(plane.offset);
    for (std::size_t c = 0; c < 3; ++c) {
      height += plane.normal[c] * static_cast<double>(ray.origin[c]);
      slope += plane.normal[c] * static_cast<double>(ray.direction[c]);
      size += std::abs(plane.normal[c] * static_cast<double>(ray.origin[c]));
    }
    height -= 1e-9 * size;
    if (slope > 0) to = std::min(to, -height / slope);
    if (slope < 0) from = std::max(from, -height / slope);
  }
  return from > to + 1e-6 * (std::abs(from) + std::abs(to));
}

bool SceneTruth::clip(const Cell& cell, const Ray& ray, Real& from, Real& to) const {
  if (misses(cell, ray)) return false;
  from = ray.from;
  to = ray.to;
  for (const Plane& plane : cell.planes) {
    const Real height = dot(plane.normal, ray.origin) - plane.offset;
    const Real slope = dot(plane.normal, ray.direction);
    if (slope > 0) to = std::min(to, -height / slope);
    if (slope < 0) from = std::max(from, -height / slope);
    if (slope == 0 && height > 0) return false;
    if (!(from < to)) return false;
  }
  return true;
}

// False where it does not come to the point.
bool SceneTruth::newton(const Cell& cell, const Vec& point, Vec& guess) {
  NodeValues shape;
  std::array<Vec, kMaxNodesPerCell> gradient;
  const auto residual_at = [&](const Vec& xi) {
    shape_functions<Real>(cell.kind, xi, shape);
    Vec residual = point;
    for (std::size_t k = 0; k < cell.count; ++k) residual = residual - shape[k] * cell.nodes[k];
    return residual;
  };
  Vec residual = residual_at(guess);
  for (int iteration = 0; iteration < 60; ++iteration) {
    shape_gradients<Real>(cell.kind, guess, gradient);
    std::array<Vec, 3> column{};
    for (std::size_t k = 0; k < cell.count; ++k)
      for (std::size_t a = 0; a < 3; ++a) column[a] = column[a] + gradient[k][a] * cell.nodes[k];
    const Vec bc = cross(column[1], column[2]);
    const Real volume = dot(column[0], bc);
    Vec step{dot(residual, bc) / volume, dot(residual, cross(column[2], column[0])) / volume,
             dot(residual, cross(column[0], column[1])) / volume};
    Vec next = residual_at(guess + step);
    for (int halving = 0; halving < 30 && !(norm(next) < norm(residual)); ++halving) {
      step = 0.5L * step;
      next = residual_at(guess + step);
    }
    if (!(norm(next) < norm(residual))) break;
    guess = guess + step;
    residual = next;
    if (norm(step) < 1e-11L) break;  // quadratic: the next step would be 1e-22
  }
  return norm(residual) <= 1e-15L * cell.size;
}

// From the guess; in curved cells, where that leads to no place of the cell, from its nodes.
void SceneTruth::fields_at(const Cell& cell, const Vec& point, Vec& guess,
                           std::vector<Real>& values) const {
  const Vec before = guess;
  bool found = newton(cell, point, guess) && in_reference_cell(cell.kind, guess);
  if (!found && cell.curved) {
    const auto nodes = reference_nodes(cell.kind);
    for (std::size_t k = 0; k < nodes.size() && !found; ++k) {
      for (std::size_t a = 0; a < 3; ++a) guess[a] = 0.1L * before[a] + 0.9L * Real(nodes[k][a]);
      found = newton(cell, point, guess) && in_reference_cell(cell.kind, guess);
    }
    if (!found) newton(cell, point, guess = before);
  }
  NodeValues shape;
  shape_functions<Real>(cell.kind, guess, shape);
  for (std::size_t f = 0; f < values.size(); ++f) {
    values[f] = 0;
    for (std::size_t k = 0; k < cell.count; ++k) values[f] += shape[k] * cell.fields[f][k];
  }
}

void SceneTruth::append_segments(const Cell& cell, const Ray& ray,
                                 std::vector<Segment>& segments) const {
  Segment segment{&cell, 0, 0, {}};
  if (!cell.curved) {
    for (const auto& node : reference_nodes(cell.kind))
      segment.guess = segment.guess + (1 / static_cast<Real>(cell.count)) * vec(node);
    if (clip(cell, ray, segment.from, segment.to)) segments.push_back(segment);
    return;
  }
  const auto crossings = cell.curved->crossings(ray.origin, ray.direction);
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
    segment.from = std::max(ray.from, crossings[k].t);
    segment.to = std::min(ray.to, crossings[k + 1].t);
    segment.guess = crossings[k].reference;
    if (segment.from < segment.to) segments.push_back(segment);
  }
  if (crossings.size() % 2 != 0)  // nothing is known of the pixel
    segments.push_back({&cell, std::numeric_limits<Real>::quiet_NaN(), 0, {}});
}

void SceneTruth::append_stretches(const Cell& cell, const Ray& ray, Real from, Real to,
                                  int halvings, Vec& guess, std::vector<Stretch>& stretches) const {
  const auto at = [&](Real t) { return ray.origin + t * ray.direction; };
  const std::size_t count = fields_.size();
  Stretch stretch{&cell, from, to, std::vector<ChebyshevSeries>(count), guess};
  if (cell.kind == CellKind::tetrahedron4) {
    std::array<std::array<Real, 4>, 2> barycentric;
    for (std::size_t k = 0; k < 4; ++k) {
      barycentric[0][k] = dot(cell.gradient[k], at(from)) + cell.value[k];
      barycentric[1][k] = dot(cell.gradient[k], at(to)) + cell.value[k];
    }
    for (std::size_t f = 0; f < count; ++f) {
      const NodeValues& v = cell.fields[f];
      std::array<Real, 2> ends{v[0], v[0]};
      for (std::size_t k = 1; k < 4; ++k)
        for (std::size_t e = 0; e < 2; ++e) ends[e] += (v[k] - v[0]) * barycentric[e][k];
      stretch.fields[f].degree = cell.constant[f] != 0 ? 0 : 1;
      stretch.fields[f].c[0] = (ends[0] + ends[1]) / 2;
      stretch.fields[f].c[1] = (ends[1] - ends[0]) / 2;
      if (cell.constant[f] != 0) stretch.fields[f].c[0] = v[0];
    }
    stretches.push_back(std::move(stretch));
    return;
  }
  std::vector<std::array<Real, ChebyshevSeries::kMostDegree + 1>> samples(count);
  std::vector<Real> values(count);
  for (const std::size_t degree : {4U, 10U, 20U}) {
    for (std::size_t j = 0; j <= degree; ++j) {
      const Real x = ChebyshevSeries::place(degree, j);
      fields_at(cell, at((from + to) / 2 + (to - from) / 2 * x), guess, values);
      for (std::size_t f = 0; f < count; ++f) samples[f][j] = values[f];
    }
    bool resolved = true;
    const Real negligible = cell.curved ? kNegligibleInCurved : kNegligible;
    for (std::size_t f = 0; f < count; ++f) {
      Real largest = 0;
      for (std::size_t k = 0; k < cell.count; ++k)
        largest = std::max(largest, std::abs(cell.fields[f][k]));
      stretch.fields[f] = ChebyshevSeries::through(degree, samples[f].data());
      resolved = resolved && std::abs(stretch.fields[f].c[degree]) +
                                     std::abs(stretch.fields[f].c[degree - 1]) <=
                                 negligible * largest;
      while (stretch.fields[f].degree > 0 &&
             std::abs(stretch.fields[f].c[stretch.fields[f].degree]) <=
                 0.01L * negligible * largest)
        --stretch.fields[f].degree;
      if (cell.constant[f] == 0) continue;
      stretch.fields[f].degree = 0;
      stretch.fields[f].c[0] = cell.fields[f][0];
    }
    if (!resolved && (degree < 20 || halvings > 0)) continue;
    stretches.push_back(std::move(stretch));
    return;
  }
  const Real middle = (from + to) / 2;
  append_stretches(cell, ray, from, middle, halvings - 1, guess, stretches);
  append_stretches(cell, ray, middle, to, halvings - 1, guess, stretches);
}

// from and to: in [-1, 1] of the stretch.
void SceneTruth::add_piece(const Stretch& stretch, const Ray& ray, Real from, Real to,
                           Light& light) const {
  const Real length = (stretch.to - stretch.from) / 2 * (to - from) * ray.unit;
  VolumeTruth::PieceFields fields;
  if (scene_.volume.color) fields.color = &stretch.fields[color_field_];
  if (scene_.volume.extinction) fields.extinction = &stretch.fields[extinction_field_];
  if (stretch.cell->kind == CellKind::tetrahedron4)
    volume_.add_linear_piece(fields, from, to, length, light);
  else
    volume_.add_piece(fields, from, to, length, light);
}

void SceneTruth::add_surface(const Stretch& stretch, const Ray& ray, std::size_t surface, Real t,
                             Light& light) const {
  const Cell& cell = *stretch.cell;
  const NodeValues& values = cell.fields[surface_fields_[surface]];
  Vec normal{};
  if (cell.kind == CellKind::tetrahedron4) {
    for (std::size_t k = 1; k < 4; ++k)
      normal = normal + (values[k] - values[0]) * cell.gradient[k];
  } else {
    Vec xi = stretch.guess;
    std::vector<Real> unused(fields_.size());
    fields_at(cell, ray.origin + t * ray.direction, xi, unused);
    std::array<Vec, kMaxNodesPerCell> gradient;
    shape_gradients<Real>(cell.kind, xi, gradient);
    std::array<Vec, 3> column{};
    Vec slope{};
    for (std::size_t k = 0; k < cell.count; ++k)
      for (std::size_t a = 0; a < 3; ++a) {
        column[a] = column[a] + gradient[k][a] * cell.nodes[k];
        slope[a] += gradient[k][a] * values[k];
      }
    normal = slope[0] * cross(column[1], column[2]) + slope[1] * cross(column[2], column[0]) +
             slope[2] * cross(column[0], column[1]);
  }
  const auto to_world = [&](const Vec& v) { return v[0] * right_ + v[1] * up_ + v[2] * forward_; };
  const ReferenceShade shade = reference_shade(scene_.isosurfaces[surface], scene_.lights,
                                               to_world(normal), to_world(ray.direction));
  for (std::size_t c = 0; c < 3; ++c) light.rgb[c] += light.transparency * shade.rgb[c];
  light.transparency *= shade.transparency;
}

void SceneTruth::add(const Stretch& stretch, const Ray& ray, Light& light) const {
  struct Place {
    Real x;
    std::size_t surface;
  };
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<Place> cuts{{-1, kNone}, {1, kNone}};
  std::vector<Real> places;
  const auto cut_at = [&](std::size_t field, Real value, std::size_t surface) {
    places.clear();
    stretch.fields[field].append_crossings(value, places);
    for (const Real x : places) cuts.push_back({x, surface});
  };
  if (scene_.volume.color)
    for (const double s : volume_.color().breakpoints()) cut_at(color_field_, s, kNone);
  if (scene_.volume.extinction)
    for (const double s : volume_.extinction().breakpoints()) cut_at(extinction_field_, s, kNone);
  for (std::size_t s = 0; s < surface_fields_.size(); ++s)
    cut_at(surface_fields_[s], scene_.isosurfaces[s].value, s);
  std::ranges::stable_sort(cuts, {}, &Place::x);
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    if (cuts[i].surface != kNone)
      add_surface(stretch, ray, cuts[i].surface,
                  (stretch.from + stretch.to) / 2 + (stretch.to - stretch.from) / 2 * cuts[i].x,
                  light);
    if (i + 1 < cuts.size() && cuts[i].x < cuts[i + 1].x)
      add_piece(stretch, ray, cuts[i].x, cuts[i + 1].x, light);
    if (light.transparency < VolumeTruth::kOpaque) return;
  }
}

std::array<Real, 4> SceneTruth::pixel(std::uint32_t x, std::uint32_t y) const {
  const Ray ray = ray_of(x, y);
  std::vector<Segment> segments;
  for (const std::uint32_t number : in_pixel_[std::size_t{y} * scene_.image.width + x])
    append_segments(cells_[number], ray, segments);
  constexpr Real kUnknown = std::numeric_limits<Real>::quiet_NaN();
  for (const Segment& s : segments)
    if (std::isnan(s.from)) return {kUnknown, kUnknown, kUnknown, kUnknown};
  std::ranges::sort(segments, {}, [](const Segment& s) { return s.from + s.to; });
  Light light;
  std::vector<Stretch> stretches;
  for (const Segment& s : segments) {
    if (light.transparency < VolumeTruth::kOpaque) break;
    stretches.clear();
    Vec guess = s.guess;
    append_stretches(*s.cell, ray, s.from, s.to, s.cell->curved ? 10 : 40, guess, stretches);
    for (const Stretch& stretch : stretches) add(stretch, ray, light);
  }
  return {light.rgb[0], light.rgb[1], light.rgb[2], light.transparency};
}

}  // namespace hiac::test
