#include "hiac/render/bounds/skin_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "hiac/base/rounding.hpp"
#include "hiac/base/special_values.hpp"
#include "hiac/frame/screen_rounding.hpp"
#include "hiac/frame/tiles/curved_outline.hpp"
#include "hiac/frame/tiles/screen_bounds.hpp"
#include "hiac/geometry/extended_vector.hpp"
#include "hiac/geometry/patch_facing.hpp"
#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

// Parts of edges and faces are halved so often at most, and then count as touched.
constexpr int kMostHalvings = 48;
// Of a face and a ray so many parts are looked at, at most; then the ray counts as grazing the
// face. A face seen edge-on passes a ray in its line at many places.
constexpr int kMostParts = 4096;
// Two planar faces are seen from one side if both cosines exceed this.
constexpr double kLeastCosine = 1e-6;

// The range of a few numbers.
struct ControlRange {
  double least = kInfinity, most = -kInfinity;

  void include(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
  [[nodiscard]] bool is_near_zero(double slack) const { return least <= slack && most >= -slack; }
};

ControlRange product_of_ranges(const ControlRange& a, const ControlRange& b) {
  ControlRange result;
  for (const double x : {a.least, a.most})
    for (const double y : {b.least, b.most}) result.include(x * y);
  return result;
}

// A curve, by control points relative to a pixel's centre: X - x W and Y - y W.
struct OutlineCurve {
  std::size_t degree;
  std::array<double, 4> a, b;
};

std::array<OutlineCurve, 2> curve_halves(const OutlineCurve& curve) {
  std::array<OutlineCurve, 2> result{curve, curve};
  const auto halve = [&](const std::array<double, 4>& from, std::array<double, 4>& low,
                         std::array<double, 4>& high) {
    std::array<double, 4> p = from;
    for (std::size_t step = 0; step <= curve.degree; ++step) {
      low[step] = p[0];
      high[curve.degree - step] = p[curve.degree - step];
      for (std::size_t k = 0; k + step < curve.degree; ++k) p[k] = 0.5 * (p[k] + p[k + 1]);
    }
  };
  halve(curve.a, result[0].a, result[1].a);
  halve(curve.b, result[0].b, result[1].b);
  return result;
}

// Whether a part of a curve may be as near to the pixel's centre as `slack`.
bool is_curve_near(const OutlineCurve& curve, double slack, int halvings = 0) {
  const std::size_t n = curve.degree;
  const double along_a = curve.a[n] - curve.a[0], along_b = curve.b[n] - curve.b[0];
  const double size = std::hypot(along_a, along_b);
  ControlRange a, b, aside;
  for (std::size_t k = 0; k <= n; ++k) {
    a.include(curve.a[k]);
    b.include(curve.b[k]);
    if (size > 0) aside.include((curve.a[k] * along_b - curve.b[k] * along_a) / size);
  }
  if (!a.is_near_zero(slack) || !b.is_near_zero(slack)) return false;
  if (size > 0 && !aside.is_near_zero(2 * slack)) return false;
  if (halvings == kMostHalvings || std::max(a.most - a.least, b.most - b.least) <= slack)
    return true;
  const auto [low, high] = curve_halves(curve);
  return is_curve_near(low, slack, halvings + 1) || is_curve_near(high, slack, halvings + 1);
}

// A face relative to a pixel's centre, and where its part begins in the parameters.
struct FacePart {
  std::size_t degree;
  PatchNet<double> a, b;
  double u, v, side_u, side_v;
};

PatchNet<double> half_net(std::size_t degree, const PatchNet<double>& net, bool of_u, bool upper) {
  PatchNet<double> result = net;
  const std::size_t side = degree + 1, step = of_u ? 1 : side, line = of_u ? side : 1;
  for (std::size_t j = 0; j < side; ++j) {
    std::array<double, 4> p{};
    for (std::size_t i = 0; i < side; ++i) p[i] = net[j * line + i * step];
    for (std::size_t k = 0; k < side; ++k) {
      result[j * line + (upper ? degree - k : k) * step] = upper ? p[degree - k] : p[0];
      for (std::size_t i = 0; i + k < degree; ++i) p[i] = 0.5 * (p[i] + p[i + 1]);
    }
  }
  return result;
}

FacePart half_of(const FacePart& part, bool of_u, bool upper) {
  FacePart half = part;
  half.a = half_net(part.degree, part.a, of_u, upper);
  half.b = half_net(part.degree, part.b, of_u, upper);
  (of_u ? half.side_u : half.side_v) /= 2;
  if (upper) (of_u ? half.u : half.v) += of_u ? half.side_u : half.side_v;
  return half;
}

ControlRange range_of(std::size_t degree, const PatchNet<double>& net) {
  ControlRange range;
  for (std::size_t k = 0; k < (degree + 1) * (degree + 1); ++k) range.include(net[k]);
  return range;
}

// The differences of neighbouring control points: the derivative, but for a factor.
ControlRange range_of_differences(std::size_t degree, const PatchNet<double>& net, bool by_u) {
  ControlRange range;
  const std::size_t side = degree + 1, step = by_u ? 1 : side, line = by_u ? side : 1;
  for (std::size_t j = 0; j < side; ++j)
    for (std::size_t i = 0; i < degree; ++i)
      range.include(net[j * line + (i + 1) * step] - net[j * line + i * step]);
  return range;
}

// Whether a part of a face may be as near to the ray as `slack` where it may turn over.
bool may_graze(const FacePart& part, bool triangle, double slack, int& parts, int halvings = 0) {
  if (++parts > kMostParts) return true;
  if (triangle && part.u + part.v > 1) return false;
  const ControlRange a = range_of(part.degree, part.a), b = range_of(part.degree, part.b);
  if (!a.is_near_zero(slack) || !b.is_near_zero(slack)) return false;
  const ControlRange first = product_of_ranges(range_of_differences(part.degree, part.a, true),
                                               range_of_differences(part.degree, part.b, false)),
                     second = product_of_ranges(range_of_differences(part.degree, part.a, false),
                                                range_of_differences(part.degree, part.b, true));
  if (first.least > second.most || first.most < second.least) return false;
  if (halvings == kMostHalvings) return true;
  const bool of_u = part.side_u >= part.side_v;
  return may_graze(half_of(part, of_u, false), triangle, slack, parts, halvings + 1) ||
         may_graze(half_of(part, of_u, true), triangle, slack, parts, halvings + 1);
}

class CellOutline {
 public:
  CellOutline(const Frame& frame, CellId cell, const TileRect& tile, double displaced)
      : frame_(frame),
        cell_(cell),
        kind_(frame.mesh.kinds[cell]),
        tile_(tile),
        displaced_(displaced) {}

  void append(std::vector<OutlineDoubt>& doubts) const {
    const ShapeTopology& topology = topology_of(kind_);
    const unsigned skin = frame_.skin.on(cell_);
    for (std::size_t e = 0; e < topology.edges.size(); ++e)
      for (std::size_t f = 0; f < topology.faces.size(); ++f)
        if ((skin >> f & 1U) != 0 && has(topology.faces[f], topology.edges[e])) {
          append_edge(e, doubts);
          break;
        }
    for (std::size_t f = 0; f < topology.faces.size(); ++f)
      if ((skin >> f & 1U) != 0) append_face(f, doubts);
  }

 private:
  static bool has(const ShapeFace& face, const ShapeEdge& edge) {
    const auto corners = std::span(face.corners).first(face.corner_count);
    return std::ranges::find(corners, edge[0]) != corners.end() &&
           std::ranges::find(corners, edge[1]) != corners.end();
  }

  // How far control points may be off relative to a ray, in their unit; `most`: the largest of
  // their coordinates in pixels, `farthest`: W.
  [[nodiscard]] double slack_at(double x, double y, double most, double farthest) const {
    const Projector& projector = frame_.projector;
    return displaced_ * projector.pixels_per_unit() * projector.ray_scale(x, y) +
           kBesideCrossing * farthest + 16 * kUnit * (most + (x + y) * farthest);
  }

  // Calls visit(column, row) for the pixels whose centres may be within the bounds.
  template <typename Visit>
  void visit_pixels(const ScreenBounds& bounds, const Visit& visit) const {
    int x0 = tile_.x0, x1 = tile_.x1, y0 = tile_.y0, y1 = tile_.y1;
    if (bounds.in_front) {
      constexpr double kMargin = 1;
      x0 = first_center(bounds.x0 - kMargin, tile_.x0, tile_.x1);
      x1 = first_center(bounds.x1 + kMargin, tile_.x0, tile_.x1);
      y0 = first_center(bounds.y0 - kMargin, tile_.y0, tile_.y1);
      y1 = first_center(bounds.y1 + kMargin, tile_.y0, tile_.y1);
    }
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) visit(x, y);
  }

  void append_edge(std::size_t number, std::vector<OutlineDoubt>& doubts) const {
    EdgeNodes edge = edge_nodes(kind_, frame_.mesh.cell_nodes(cell_), number);
    if (!is_curved(frame_.mesh, edge, frame_.straightness))
      edge = {2, {edge.nodes[0], edge.nodes[edge.count - 1]}};
    const EdgeControls controls = edge_controls(frame_, edge);
    const std::size_t degree = edge.count - 1;
    ScreenBounds bounds;
    double most = 0, farthest = 0;
    for (std::size_t k = 0; k <= degree; ++k) {
      bounds.include(controls[0][k], controls[1][k], controls[2][k], controls[3][k]);
      most = std::max({most, std::abs(controls[0][k]), std::abs(controls[1][k])});
      farthest = std::max(farthest, std::abs(controls[2][k]));
    }
    visit_pixels(bounds, [&](int column, int row) {
      const double x = pixel_center(column), y = pixel_center(row);
      OutlineCurve curve{degree, {}, {}};
      for (std::size_t k = 0; k <= degree; ++k) {
        curve.a[k] = controls[0][k] - x * controls[2][k];
        curve.b[k] = controls[1][k] - y * controls[2][k];
      }
      const double slack = slack_at(x, y, most, farthest);
      if (!is_curve_near(curve, slack)) return;
      const auto is_at = [&](std::size_t k) {
        return std::max(std::abs(curve.a[k]), std::abs(curve.b[k])) <= 4 * slack;
      };
      const std::size_t at = tile_.index(column, row);
      if (is_at(0) || is_at(degree))
        doubts.push_back({at, kInfinity, nullptr});
      else
        doubts.push_back(between_faces(edge, at, x, y));
    });
  }

  // The doubt at a pixel on an edge.
  [[nodiscard]] OutlineDoubt between_faces(const EdgeNodes& edge, std::size_t at, double x,
                                           double y) const {
    const NodeId a = edge.nodes[0], b = edge.nodes[edge.count - 1];
    const auto sides = sides_at(frame_.skin.sides, {std::min(a, b), std::max(a, b)});
    const OutlineDoubt unknown{at, kInfinity, nullptr};
    if (sides.size() != 2) return unknown;
    for (const SkinSide& side : sides)
      if (face_form(frame_.mesh, side.cell, side.face, frame_.straightness).curved) return unknown;
    ExtendedVector first = normal_of(sides[0]), second = normal_of(sides[1]);
    if (!(length(first) > 0) || !(length(second) > 0)) return unknown;
    first = unit(first);
    second = unit(second);
    // passed in one direction by both, one face is turned inside out
    if (sides[0].ascending == sides[1].ascending)
      for (long double& c : second) c = -c;
    const Vector direction = unit(frame_.projector.direction(x, y));
    const ExtendedVector ray{direction[0], direction[1], direction[2]};
    const long double of_first = dot(first, ray), of_second = dot(second, ray);
    if (!(of_first * of_second > 0) ||
        !(std::min(std::abs(of_first), std::abs(of_second)) > kLeastCosine))
      return unknown;
    const auto angle =
        static_cast<double>(std::atan2(length(cross(first, second)), dot(first, second)));
    const SkinSide* other = sides[0].cell != cell_ ? &sides[0] : &sides[1];
    return {at, angle, other->cell != cell_ ? other : nullptr};
  }

  [[nodiscard]] ExtendedVector normal_of(const SkinSide& side) const {
    const ShapeFace& face = topology_of(frame_.mesh.kinds[side.cell]).faces[side.face];
    const auto nodes = frame_.mesh.cell_nodes(side.cell);
    const auto at = [&](std::size_t k) -> ExtendedVector {
      const auto p = frame_.mesh.position(nodes[face.corners[k]]);
      return {p[0], p[1], p[2]};
    };
    return face.corner_count == 3 ? cross(minus(at(1), at(0)), minus(at(2), at(0)))
                                  : cross(minus(at(2), at(0)), minus(at(3), at(1)));
  }

  void append_face(std::size_t number, std::vector<OutlineDoubt>& doubts) const {
    const FaceForm form = face_form(frame_.mesh, cell_, number, frame_.straightness);
    if (!form.curved) return;
    const FaceNets nets = face_nets(frame_, cell_, number, form);
    const std::size_t count = form.shape.control_count();
    ScreenBounds bounds;
    double most = 0, farthest = 0;
    for (std::size_t k = 0; k < count; ++k) {
      bounds.include(nets[0][k], nets[1][k], nets[2][k], nets[3][k]);
      most = std::max({most, std::abs(nets[0][k]), std::abs(nets[1][k])});
      farthest = std::max(farthest, std::abs(nets[2][k]));
    }
    if (bounds.in_front && patch_facing(form.shape, {nets[0], nets[1], nets[2]}) != 0) return;
    visit_pixels(bounds, [&](int column, int row) {
      const double x = pixel_center(column), y = pixel_center(row);
      FacePart face{form.shape.degree, {}, {}, 0, 0, 1, 1};
      for (std::size_t k = 0; k < count; ++k) {
        face.a[k] = nets[0][k] - x * nets[2][k];
        face.b[k] = nets[1][k] - y * nets[2][k];
      }
      int parts = 0;
      if (may_graze(face, form.shape.triangle, slack_at(x, y, most, farthest), parts))
        doubts.push_back({tile_.index(column, row), kInfinity, nullptr});
    });
  }

  const Frame& frame_;
  CellId cell_;
  CellKind kind_;
  const TileRect& tile_;
  double displaced_;
};

}  // namespace

void append_outline_doubts(const Frame& frame, CellId cell, const TileRect& tile, double displaced,
                           std::vector<OutlineDoubt>& doubts) {
  CellOutline(frame, cell, tile, displaced).append(doubts);
}

}  // namespace hiac
