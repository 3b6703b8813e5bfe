#include "tests/preview/method_reference.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
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
  std::array<std::array<Real, 2>, 4> screen;
  std::array<Real, 4> w;  // 1 / t; 1 in parallel projection
};

// A stretch of a ray: field values at its ends, and the mean of 1 / t there.
struct Stretch {
  Real length = 0, front = 0, back = 0, w = 1;
};

// Between the four planes; the field is linear between the ends.
std::optional<Stretch> meet(const Tetrahedron& tet, const Projector& projector, Real x, Real y) {
  const auto o = projector.origin(static_cast<double>(x), static_cast<double>(y));
  const auto d = projector.direction(static_cast<double>(x), static_cast<double>(y));
  const Vec origin{o[0], o[1], o[2]}, direction{d[0], d[1], d[2]};
  Real enter = projector.perspective() ? 0 : -1e9L, leave = 1e9L;
  for (std::size_t f = 0; f < 4; ++f) {
    const Vec &a = tet.at[(f + 1) % 4], &b = tet.at[(f + 2) % 4], &c = tet.at[(f + 3) % 4];
    Vec n = cross(sub(b, a), sub(c, a));
    if (dot(n, sub(tet.at[f], a)) < 0) n = {-n[0], -n[1], -n[2]};
    const Real along = dot(n, direction), at = dot(n, sub(origin, a));
    if (along > 0) enter = std::max(enter, -at / along);
    if (along < 0) leave = std::min(leave, -at / along);
    if (along == 0 && at < 0) return std::nullopt;
  }
  if (!(leave > enter)) return std::nullopt;
  // the field at a point: barycentric coordinates are ratios of volumes
  const auto field = [&](Real t) {
    Vec p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = origin[k] + t * direction[k];
    Real value = 0;
    for (std::size_t f = 0; f < 4; ++f) {
      const Vec &a = tet.at[(f + 1) % 4], &b = tet.at[(f + 2) % 4], &c = tet.at[(f + 3) % 4];
      const Vec n = cross(sub(b, a), sub(c, a));
      value += tet.field[f] * dot(n, sub(p, a)) / dot(n, sub(tet.at[f], a));
    }
    return value;
  };
  return Stretch{
      (leave - enter) * projector.ray_scale(static_cast<double>(x), static_cast<double>(y)),
      field(enter), field(leave), projector.perspective() ? (1 / enter + 1 / leave) / 2 : 1};
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
  [[nodiscard]] bool has_break(Real low, Real high) const {
    const auto at = breaks_.upper_bound(static_cast<double>(low));
    return at != breaks_.end() && *at < high;
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
      result.push_back({high > low
                            ? whole.length * std::abs(values[k + 1] - values[k]) / (high - low)
                            : whole.length,
                        values[k], values[k + 1]});
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

Piece piece_of(const Optics& optics, const Stretch& s) {
  const Real inside = (s.front + s.back) / 2;
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
  if (method == Method::tables && piece.tau_front != piece.tau_back) {
    const Real root = std::sqrt(2 * std::abs(piece.tau_front - piece.tau_back) / piece.length);
    if (std::max(piece.tau_front, piece.tau_back) / root > preview::GaussianTables::kRange)
      return mean_color(piece);
  }
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

// The thickest point of the projection.
Point thickest(const Tetrahedron& tet) {
  const auto& p = tet.screen;
  for (std::size_t k = 0; k < 4; ++k)
    if (inside(p[(k + 1) % 4], p[(k + 2) % 4], p[(k + 3) % 4], p[k])) return p[k];
  constexpr std::size_t kPairs[3][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}};
  for (const auto& [a, b, c, d] : kPairs) {
    if (area(p[a], p[b], p[c]) * area(p[a], p[b], p[d]) > 0 ||
        area(p[c], p[d], p[a]) * area(p[c], p[d], p[b]) > 0)
      continue;
    const Real t = area(p[c], p[d], p[a]) / (area(p[c], p[d], p[a]) - area(p[c], p[d], p[b]));
    return {p[a][0] + t * (p[b][0] - p[a][0]), p[a][1] + t * (p[b][1] - p[a][1])};
  }
  throw std::logic_error("four points have no thickest point");
}

struct Light {
  Vec rgb{};
  Real alpha = 0;
};

// M0, M2, M3: the triangle of the region around the pixel.
Light in_region(const Tetrahedron& tet, const Optics& optics, const Projector& projector,
                Method method, const Point& pixel, const Piece& through) {
  const Point thick = thickest(tet);
  const auto at_thick = meet(tet, projector, thick[0], thick[1]);
  if (!at_thick) return {};
  const Piece piece = piece_of(optics, *at_thick);
  for (std::size_t u = 0; u < 4; ++u)
    for (std::size_t v = u + 1; v < 4; ++v) {
      const auto shares = inside(thick, tet.screen[u], tet.screen[v], pixel);
      if (!shares) continue;
      const bool m0 = method == Method::interpolated_opacity;
      const Vec color = m0 ? mean_color(piece) : effective_color(optics, piece, method);
      Light light;
      light.alpha = m0 ? (*shares)[0] * -std::expm1(-piece.depth()) : -std::expm1(-through.depth());
      // with perspective: colours over t are linear on the screen, but for M0's
      std::array<Real, 3> part = *shares;
      if (!m0) part = {part[0] * at_thick->w, part[1] * tet.w[u], part[2] * tet.w[v]};
      for (std::size_t c = 0; c < 3; ++c) {
        const Real interpolated =
            (part[0] * color[c] + part[1] * optics.color(c, tet.field[u], tet.field[u]) +
             part[2] * optics.color(c, tet.field[v], tet.field[v])) /
            (part[0] + part[1] + part[2]);
        if (!m0)
          light.rgb[c] = weight(optics, through) * interpolated;
        else if (optics.emission())
          light.rgb[c] = (*shares)[0] * weight(optics, piece) * color[c];
        else
          light.rgb[c] = light.alpha * interpolated;
      }
      return light;
    }
  return {};
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
      const auto s = projector.project_extended(p);
      tet.screen[k] = {s[0], s[1]};
      tet.w[k] = projector.perspective() ? -s[2] : 1;
    }
    const auto stretch = meet(tet, projector, pixel[0], pixel[1]);
    if (!stretch) continue;
    if (method != Method::mean_color) {
      if (optics.has_break(std::ranges::min(tet.field), std::ranges::max(tet.field)))
        throw std::invalid_argument("only M1 is known for slabs");
      over(in_region(tet, optics, projector, method, pixel, piece_of(optics, *stretch)));
      continue;
    }
    const auto pieces = optics.pieces(*stretch);
    for (std::size_t k = pieces.size(); k-- > 0;) {
      const Piece piece = piece_of(optics, pieces[k]);
      Light light;
      light.alpha = -std::expm1(-piece.depth());
      for (std::size_t c = 0; c < 3; ++c)
        light.rgb[c] = weight(optics, piece) * mean_color(piece)[c];
      over(light);
    }
  }
  return {static_cast<double>(total.rgb[0]), static_cast<double>(total.rgb[1]),
          static_cast<double>(total.rgb[2]), static_cast<double>(total.alpha)};
}

}  // namespace hiac::test
