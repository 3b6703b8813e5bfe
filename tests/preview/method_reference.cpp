#include "tests/preview/method_reference.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <vector>

#include "hiac/frame/projection.hpp"
#include "hiac/preview/methods/gaussian_tables.hpp"

namespace hiac::test {
namespace {

using Real = long double;
using Vec = std::array<Real, 3>;
using preview::Method;

Vec sub(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct Tetrahedron {
  std::array<Vec, 4> at;
  std::array<Real, 4> field;
};

// A stretch of a ray: field values at its ends, and, where it is all of the way through a
// tetrahedron, the faces (by the corner opposite) that it enters and leaves by.
struct Stretch {
  Real length = 0, front = 0, back = 0;
  std::size_t entered = 0, left = 0;
};

struct Ray {
  Vec origin, direction;
  Real scale;  // of the ray parameter to world units

  [[nodiscard]] Vec at(Real t) const {
    return {origin[0] + t * direction[0], origin[1] + t * direction[1],
            origin[2] + t * direction[2]};
  }
};

Ray ray_of(const Projector& projector, Real x, Real y) {
  const auto o = projector.origin(static_cast<double>(x), static_cast<double>(y));
  const auto d = projector.direction(static_cast<double>(x), static_cast<double>(y));
  return {{o[0], o[1], o[2]},
          {d[0], d[1], d[2]},
          projector.ray_scale(static_cast<double>(x), static_cast<double>(y))};
}

// Barycentric coordinates are ratios of volumes.
Real field_at(const Tetrahedron& tet, const Vec& p) {
  Real value = 0;
  for (std::size_t f = 0; f < 4; ++f) {
    const Vec &a = tet.at[(f + 1) % 4], &b = tet.at[(f + 2) % 4], &c = tet.at[(f + 3) % 4];
    const Vec n = cross(sub(b, a), sub(c, a));
    value += tet.field[f] * dot(n, sub(p, a)) / dot(n, sub(tet.at[f], a));
  }
  return value;
}

// Between the four planes; the field is linear between the ends.
std::optional<Stretch> meet(const Tetrahedron& tet, const Projector& projector, Real x, Real y) {
  const Ray ray = ray_of(projector, x, y);
  Real enter = projector.perspective() ? 0 : -1e9L, leave = 1e9L;
  Stretch stretch;
  for (std::size_t f = 0; f < 4; ++f) {
    const Vec &a = tet.at[(f + 1) % 4], &b = tet.at[(f + 2) % 4], &c = tet.at[(f + 3) % 4];
    Vec n = cross(sub(b, a), sub(c, a));
    if (dot(n, sub(tet.at[f], a)) < 0) n = {-n[0], -n[1], -n[2]};
    const Real along = dot(n, ray.direction), at = dot(n, sub(ray.origin, a));
    if (along > 0 && -at / along > enter) {
      enter = -at / along;
      stretch.entered = f;
    }
    if (along < 0 && -at / along < leave) {
      leave = -at / along;
      stretch.left = f;
    }
    if (along == 0 && at < 0) return std::nullopt;
  }
  if (!(leave > enter)) return std::nullopt;
  stretch.length = (leave - enter) * ray.scale;
  stretch.front = field_at(tet, ray.at(enter));
  stretch.back = field_at(tet, ray.at(leave));
  return stretch;
}

class Optics {
 public:
  explicit Optics(const Scene& scene)
      : color_(scene.volume.color->function()),
        extinction_(scene.volume.extinction->function()),
        emission_(scene.volume.glow == Glow::emission) {
    for (const double s : color_.breakpoints()) breaks_.insert(s);
    for (const double s : extinction_.breakpoints()) breaks_.insert(s);
  }

  [[nodiscard]] bool emission() const { return emission_; }
  // The breakpoints on both sides of a value; infinite where there is none.
  [[nodiscard]] std::array<Real, 2> around(Real value) const {
    const auto at = breaks_.upper_bound(static_cast<double>(value));
    return {at == breaks_.begin() ? -HUGE_VALL : Real(*std::prev(at)),
            at == breaks_.end() ? HUGE_VALL : Real(*at)};
  }
  // The linear pieces that hold at `inside`, at s.
  [[nodiscard]] Real tau(Real s, Real inside) const {
    return extinction_.piece(extinction_.interval_of(static_cast<double>(inside)))
        .channel(0, static_cast<double>(s));
  }
  [[nodiscard]] Real color(std::size_t c, Real s, Real inside) const {
    return color_.piece(color_.interval_of(static_cast<double>(inside)))
        .channel(c, static_cast<double>(s));
  }
  // Cut where the field has breakpoints, front to back.
  [[nodiscard]] std::vector<Stretch> pieces(const Stretch& whole) const {
    const Real low = std::min(whole.front, whole.back), high = std::max(whole.front, whole.back);
    std::vector<Real> values{whole.front};
    for (const double s : breaks_)
      if (s > low && s < high) values.push_back(s);
    if (whole.front > whole.back) std::sort(values.begin() + 1, values.end(), std::greater<>());
    values.push_back(whole.back);
    std::vector<Stretch> result;
    for (std::size_t k = 0; k + 1 < values.size(); ++k)
      result.push_back(
          {.length = high > low ? whole.length * std::abs(values[k + 1] - values[k]) / (high - low)
                                : whole.length,
           .front = values[k],
           .back = values[k + 1]});
    return result;
  }

 private:
  PiecewiseLinear<3> color_;
  PiecewiseLinear<1> extinction_;
  bool emission_;
  std::set<double> breaks_;
};

struct Piece {
  Real length, tau_front, tau_back;
  Vec front, back;

  [[nodiscard]] Real depth() const { return length * (tau_front + tau_back) / 2; }
};

// By the functions' pieces that hold at `inside`.
Piece piece_of(const Optics& optics, const Stretch& s, Real inside) {
  Piece piece{s.length, optics.tau(s.front, inside), optics.tau(s.back, inside), {}, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    piece.front[c] = optics.color(c, s.front, inside);
    piece.back[c] = optics.color(c, s.back, inside);
  }
  return piece;
}

// What a colour, the same along a piece, gives: chromaticity alpha C, emission l (1-e^-D)/D C.
Real weight(const Optics& optics, const Piece& piece) {
  const Real depth = piece.depth();
  if (!optics.emission()) return -std::expm1(-depth);
  return piece.length * (depth > 0 ? -std::expm1(-depth) / depth : 1);
}

Vec mean_color(const Piece& p) {
  return {(p.front[0] + p.back[0]) / 2, (p.front[1] + p.back[1]) / 2, (p.front[2] + p.back[2]) / 2};
}

// Radiance over the weight: of layers, each of its middle's extinction and colour.
Vec effective_color(const Optics& optics, const Piece& piece, Method method) {
  if (method == Method::interpolated_opacity || method == Method::mean_color)
    return mean_color(piece);
  if (method == Method::tables && piece.tau_front != piece.tau_back) {
    const Real root = std::sqrt(2 * std::abs(piece.tau_front - piece.tau_back) / piece.length);
    if (std::max(piece.tau_front, piece.tau_back) / root > preview::GaussianTables::kRange)
      return mean_color(piece);
  }
  if (!(weight(optics, piece) > 1e-12L)) return mean_color(piece);
  constexpr int kSteps = 100;
  Vec light{};
  Real depth = 0;
  for (int k = 0; k < kSteps; ++k) {
    const Real u = (k + 0.5L) / kSteps, step = piece.length / kSteps;
    const Real tau = piece.tau_front + u * (piece.tau_back - piece.tau_front);
    const Real opacity = -std::expm1(-tau * step);
    for (std::size_t c = 0; c < 3; ++c) {
      const Real color = piece.front[c] + u * (piece.back[c] - piece.front[c]);
      const Real share = optics.emission() && tau > 0 ? opacity / tau : opacity;
      light[c] += std::exp(-depth) * share * color;
    }
    depth += tau * step;
  }
  for (Real& l : light) l /= weight(optics, piece);
  return light;
}

using Point = std::array<Real, 2>;

Real area(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Shares of a triangle's corners in a point; none outside.
std::optional<std::array<Real, 3>> inside(const Point& a, const Point& b, const Point& c,
                                          const Point& p) {
  const Real whole = area(a, b, c);
  if (whole == 0) return std::nullopt;
  const std::array<Real, 3> s{area(p, b, c) / whole, area(a, p, c) / whole, area(a, b, p) / whole};
  if (std::ranges::min(s) < 0) return std::nullopt;
  return s;
}

// ---- the slab of a tetrahedron between two breakpoints, and the region around a pixel ----

struct Corner {
  Vec at;
  Real field;
};

// What of a polygon is where the field is at least `level` (`above`) or at most.
std::vector<Corner> kept(const std::vector<Corner>& polygon, Real level, bool above) {
  std::vector<Corner> result;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Corner &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const bool p_in = above ? p.field >= level : p.field <= level;
    const bool q_in = above ? q.field >= level : q.field <= level;
    if (p_in) result.push_back(p);
    if (p_in == q_in) continue;
    const Real u = (level - p.field) / (q.field - p.field);
    Corner cut{{}, level};
    for (std::size_t c = 0; c < 3; ++c) cut.at[c] = p.at[c] + u * (q.at[c] - p.at[c]);
    result.push_back(cut);
  }
  return result;
}

// The part of a tetrahedron's face that belongs to a slab.
std::vector<Corner> face_of_slab(const Tetrahedron& tet, std::size_t opposite,
                                 const std::array<Real, 2>& levels) {
  std::vector<Corner> face;
  for (std::size_t k = 1; k < 4; ++k)
    face.push_back({tet.at[(opposite + k) % 4], tet.field[(opposite + k) % 4]});
  return kept(kept(face, levels[0], true), levels[1], false);
}

// Where the field has a value: the points on the edges that it lies between the ends of.
std::vector<Corner> level_polygon(const Tetrahedron& tet, Real level) {
  std::vector<Corner> result;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = i + 1; k < 4; ++k) {
      const std::vector<Corner> edge{{tet.at[i], tet.field[i]}, {tet.at[k], tet.field[k]}};
      if ((edge[0].field < level) != (edge[1].field < level))
        for (const Corner& c : kept(edge, level, true))
          if (c.field == level) {
            result.push_back(c);
            break;
          }
    }
  return result;
}

// A convex polygon on the screen, counter-clockwise whatever the order of its points.
std::vector<Point> projected(const std::vector<Corner>& corners, const Projector& projector) {
  std::vector<Point> points;
  Point middle{0, 0};
  for (const Corner& corner : corners) {
    std::array<double, 3> at;
    std::ranges::transform(corner.at, at.begin(), [](Real x) { return static_cast<double>(x); });
    const auto s = projector.project_extended(at);
    points.push_back({s[0], s[1]});
    for (std::size_t c = 0; c < 2; ++c) middle[c] += s[c] / static_cast<Real>(corners.size());
  }
  std::ranges::sort(points, {},
                    [&](const Point& p) { return std::atan2(p[1] - middle[1], p[0] - middle[0]); });
  return points;
}

// What two convex polygons have in common.
std::vector<Point> intersection(std::vector<Point> region, const std::vector<Point>& other) {
  for (std::size_t k = 0; k < other.size(); ++k) {
    const Point &a = other[k], &b = other[(k + 1) % other.size()];
    std::vector<Point> inner;
    for (std::size_t n = 0; n < region.size(); ++n) {
      const Point &p = region[n], &q = region[(n + 1) % region.size()];
      const Real of_p = area(a, b, p), of_q = area(a, b, q);
      if (of_p >= 0) inner.push_back(p);
      if ((of_p >= 0) == (of_q >= 0)) continue;
      const Real u = of_p / (of_p - of_q);
      inner.push_back({p[0] + u * (q[0] - p[0]), p[1] + u * (q[1] - p[1])});
    }
    region = inner;
  }
  return region;
}

Real met_at(const Ray& ray, const std::vector<Corner>& plane) {
  const Vec n = cross(sub(plane[1].at, plane[0].at), sub(plane[2].at, plane[0].at));
  return dot(n, sub(plane[0].at, ray.origin)) / dot(n, ray.direction);
}

// A corner of a region: the ray's way through the slab there.
struct RegionCorner {
  Point at;
  Piece piece;
  Real thickness;  // of t or, in perspective, 1 / t
  Real w;          // the mean of 1 / t at the ends; 1 in parallel projection
};

struct Light {
  Vec rgb{};
  Real alpha = 0;
};

std::vector<RegionCorner> corners_of_region(const Tetrahedron& tet, const Optics& optics,
                                            const Projector& projector,
                                            const std::vector<Corner>& front,
                                            const std::vector<Corner>& back, Real inside) {
  std::vector<RegionCorner> corners;
  for (const Point& at : intersection(projected(front, projector), projected(back, projector))) {
    const Ray ray = ray_of(projector, at[0], at[1]);
    const Real enter = met_at(ray, front), leave = std::max(met_at(ray, back), enter);
    const Stretch stretch{.length = (leave - enter) * ray.scale,
                          .front = field_at(tet, ray.at(enter)),
                          .back = field_at(tet, ray.at(leave))};
    const bool perspective = projector.perspective();
    corners.push_back({at, piece_of(optics, stretch, inside),
                       perspective ? 1 / enter - 1 / leave : leave - enter,
                       perspective ? (1 / enter + 1 / leave) / 2 : 1});
  }
  return corners;
}

// Light of a triangle at a pixel with those shares of its corners, where the ray's way
// through the slab is `through`.
Light in_triangle(const Optics& optics, Method method,
                  const std::array<const RegionCorner*, 3>& corners,
                  const std::array<Real, 3>& shares, const Piece& through) {
  const bool m0 = method == Method::interpolated_opacity;
  Light light;
  Vec color{}, glow{};
  Real alpha = 0, sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const RegionCorner& corner = *corners[k];
    const Vec of_corner = effective_color(optics, corner.piece, method);
    // with perspective: colours over t are linear on the screen, but for M0's
    const Real share = m0 ? shares[k] : shares[k] * corner.w;
    sum += share;
    alpha += shares[k] * -std::expm1(-corner.piece.depth());
    for (std::size_t c = 0; c < 3; ++c) {
      color[c] += share * of_corner[c];
      glow[c] += shares[k] * weight(optics, corner.piece) * of_corner[c];
    }
  }
  light.alpha = m0 ? alpha : -std::expm1(-through.depth());
  for (std::size_t c = 0; c < 3; ++c) {
    if (m0)
      light.rgb[c] = optics.emission() ? glow[c] : alpha * color[c];
    else
      light.rgb[c] = weight(optics, through) * color[c] / sum;
  }
  return light;
}

// The region around the pixel, in triangles around the corner where the slab is thickest; of
// several the leftmost one.
Light in_region(const std::vector<RegionCorner>& corners, const Optics& optics, Method method,
                const Point& pixel, const Piece& through) {
  if (corners.size() < 3) return {};
  const Real most = std::ranges::max_element(corners, {}, &RegionCorner::thickness)->thickness;
  std::size_t thickest = corners.size();
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (corners[k].thickness >= (1 - 1e-6L) * most &&
        (thickest == corners.size() || corners[k].at[0] < corners[thickest].at[0]))
      thickest = k;
  const std::size_t count = corners.size();
  const RegionCorner& apex = corners[thickest];
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const RegionCorner &u = corners[(thickest + k) % count],
                       &v = corners[(thickest + k + 1) % count];
    if (const auto shares = inside(apex.at, u.at, v.at, pixel))
      return in_triangle(optics, method, {&apex, &u, &v}, *shares, through);
  }
  return {};
}

// Light of the slabs of a tetrahedron, front to back.
std::vector<Light> slabs_of(const Tetrahedron& tet, const Optics& optics,
                            const Projector& projector, Method method, const Point& pixel,
                            const Stretch& stretch) {
  std::vector<Light> lights;
  const auto pieces = optics.pieces(stretch);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Real inside = (pieces[k].front + pieces[k].back) / 2;
    const Piece through = piece_of(optics, pieces[k], inside);
    const std::array<Real, 2> levels = optics.around(inside);
    const auto front =
        k == 0 ? face_of_slab(tet, stretch.entered, levels) : level_polygon(tet, pieces[k].front);
    const auto back = k + 1 == pieces.size() ? face_of_slab(tet, stretch.left, levels)
                                             : level_polygon(tet, pieces[k].back);
    if (front.size() < 3 || back.size() < 3) continue;
    lights.push_back(in_region(corners_of_region(tet, optics, projector, front, back, inside),
                               optics, method, pixel, through));
  }
  return lights;
}

}  // namespace

std::array<double, 4> method_pixel(const ZooMesh& mesh, const Scene& scene, Method method,
                                   std::span<const CellId> back_to_front, std::uint32_t x,
                                   std::uint32_t y) {
  const Projector projector(scene.camera, scene.image);
  const Optics optics(scene);
  const Field field = scalar_field(mesh, scene.volume.color->field);
  const Point pixel{x + 0.5L, y + 0.5L};
  Light total;
  const auto over = [&](const Light& light) {
    for (std::size_t c = 0; c < 3; ++c)
      total.rgb[c] = light.rgb[c] + (1 - light.alpha) * total.rgb[c];
    total.alpha = light.alpha + (1 - light.alpha) * total.alpha;
  };
  for (const CellId cell : back_to_front) {
    Tetrahedron tet{};
    for (std::size_t k = 0; k < 4; ++k) {
      const NodeId node = mesh.cell_nodes(cell)[k];
      const auto p = mesh.position(node);
      tet.at[k] = {p[0], p[1], p[2]};
      tet.field[k] = field.values[node];
    }
    const auto stretch = meet(tet, projector, pixel[0], pixel[1]);
    if (!stretch) continue;
    const auto lights = slabs_of(tet, optics, projector, method, pixel, *stretch);
    for (std::size_t k = lights.size(); k-- > 0;) over(lights[k]);
  }
  return {static_cast<double>(total.rgb[0]), static_cast<double>(total.rgb[1]),
          static_cast<double>(total.rgb[2]), static_cast<double>(total.alpha)};
}

}  // namespace hiac::test
