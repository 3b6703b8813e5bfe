#include "hiac/order/gaps/ray_precedence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include <CGAL/Mpzf.h>

// CGAL's kernel and number types are LGPL; nothing of its GPL parts is used here.

#include "hiac/base/special_values.hpp"
#include "hiac/geometry/face_form.hpp"
#include "hiac/geometry/predicates.hpp"

namespace hiac {
namespace {

template <typename Number>
using Vector = std::array<Number, 3>;
using Real = Vector<double>;
using Exact = CGAL::Mpzf;  // a ring: sums, differences and products of doubles without rounding

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

template <typename Number>
Vector<Number> minus(const Vector<Number>& a, const Vector<Number>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <typename Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <typename Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(const Real& v) { return std::hypot(v[0], v[1], v[2]); }

// Making cells --------------------------------------------------------------------------------

// A face, with the control points of its patch if it may be curved; their convex hull contains it.
struct HullFace {
  ShapeFace shape;
  std::vector<Real> controls;
};

// A plane close to a face: through the mean of its corners, parallel to both diagonals.
struct MeanPlane {
  Real point, normal;  // normal of length 1, or 0 for a face without area
  double deviation;    // the face's largest distance from it
};

MeanPlane mean_plane(const HullCell& cell, const HullFace& hull) {
  const ShapeFace& face = hull.shape;
  const std::size_t n = face.corner_count;
  const auto at = [&](std::size_t k) { return cell.corners[face.corners[k]]; };
  MeanPlane plane{{}, cross(minus(at(2), at(0)), minus(at(n - 1), at(1))), 0};
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t c = 0; c < 3; ++c) plane.point[c] += at(k)[c] / static_cast<double>(n);
  const double area = length(plane.normal);
  for (double& x : plane.normal) x = area > 0 ? x / area : 0;
  for (std::size_t k = 0; k < n; ++k)
    plane.deviation =
        std::max(plane.deviation, std::abs(dot(plane.normal, minus(at(k), plane.point))));
  for (const Real& p : hull.controls)
    plane.deviation = std::max(plane.deviation, std::abs(dot(plane.normal, minus(p, plane.point))));
  return plane;
}

// Returns the fraction of the way to its middle by which the cell must be shrunk so that every face
// moves inwards by `distance` plus twice its deviation; nothing if no cell would remain or if it is
// not convex to within that. Sets the cell's deviation.
//
// A curved face lies between two planes parallel to that of its corners, and so does every face of
// a deformation from the straight cell to the curved one. The shrunk cell lies inside all of these
// planes: no face passes through it during the deformation, so that it lies inside the curved cell
// as it does inside the straight one.
// inside the straight one.
std::optional<double> shrink_of(HullCell& cell, std::span<const HullFace> faces, double distance) {
  double shrink = 0;
  for (const HullFace& face : faces) {
    const MeanPlane plane = mean_plane(cell, face);
    if (length(plane.normal) == 0) continue;  // a face without area bounds nothing
    const double height = dot(plane.normal, minus(cell.middle, plane.point));
    const double inwards = distance + 2 * plane.deviation;
    cell.deviation = std::max(cell.deviation, plane.deviation);
    for (const Real& corner : cell.corners)
      if (dot(plane.normal, minus(corner, plane.point)) * (height < 0 ? -1 : 1) <
          -inwards - 64 * kEpsilon * (length(corner) + length(plane.point)))
        return std::nullopt;
    if (distance > 0) shrink = std::max(shrink, inwards / std::abs(height));
  }
  if (!(shrink < 1)) return std::nullopt;
  return shrink;
}

std::vector<HullFace> hull_faces(const ZooMesh& mesh, CellId cell) {
  std::vector<HullFace> faces;
  for (const ShapeFace& shape : topology_of(mesh.kinds[cell]).faces) {
    const std::size_t number = faces.size();
    faces.push_back({shape, {}});
    if (order_of(mesh.kinds[cell]) == CellOrder::linear) continue;
    const FaceForm form = face_form(mesh, cell, number, 0);
    if (form.shape.degree == 1) continue;
    const PatchNet<Real> net = control_points(mesh, cell, number, form);
    faces.back().controls.assign(
        net.begin(), net.begin() + static_cast<std::ptrdiff_t>(form.shape.control_count()));
  }
  return faces;
}

// Returns whether the corners do not all lie in one plane.
bool has_inside(const std::vector<Real>& corners) {
  for (std::size_t i = 1; i < corners.size(); ++i)
    for (std::size_t j = i + 1; j < corners.size(); ++j)
      for (std::size_t k = j + 1; k < corners.size(); ++k)
        if (orientation(corners[0], corners[i], corners[j], corners[k]) != 0) return true;
  return false;
}

bool is_planar(const HullCell& cell, const ShapeFace& face) {
  const auto& c = face.corners;
  return face.corner_count == 3 || orientation(cell.corners[c[0]], cell.corners[c[1]],
                                               cell.corners[c[2]], cell.corners[c[3]]) == 0;
}

// Returns the largest triangle of three neighbouring corners, which spans the plane of a planar
// face.
std::array<std::uint8_t, 3> spanning(const HullCell& cell, const ShapeFace& face) {
  const auto& c = face.corners;
  if (face.corner_count == 3) return {c[0], c[1], c[2]};
  const std::array<std::array<std::uint8_t, 3>, 4> triangles{
      {{c[0], c[1], c[2]}, {c[1], c[2], c[3]}, {c[2], c[3], c[0]}, {c[3], c[0], c[1]}}};
  return *std::ranges::max_element(triangles, {}, [&](const std::array<std::uint8_t, 3>& t) {
    const Real& at = cell.corners[t[0]];
    return length(cross(minus(cell.corners[t[1]], at), minus(cell.corners[t[2]], at)));
  });
}

// Adds the cell's own edges and planes if all its faces are planar, else all that its corners span.
void add_edges_and_planes(const ShapeTopology& topology, HullCell& cell) {
  const auto& faces = topology.faces;
  if (std::ranges::all_of(faces, [&](const ShapeFace& f) { return is_planar(cell, f); })) {
    cell.edges.assign(topology.edges.begin(), topology.edges.end());
    for (const ShapeFace& face : faces) cell.planes.push_back(spanning(cell, face));
    return;
  }
  const auto count = static_cast<std::uint8_t>(cell.corners.size());
  for (std::uint8_t i = 0; i < count; ++i)
    for (auto j = static_cast<std::uint8_t>(i + 1); j < count; ++j) {
      cell.edges.push_back({i, j});
      for (auto k = static_cast<std::uint8_t>(j + 1); k < count; ++k)
        cell.planes.push_back({i, j, k});
    }
}

void add_ball(HullCell& cell, const View& view) {
  constexpr double kSlack = 1e-9;  // larger than any rounding error here
  Real middle{};
  for (const Real& p : cell.seen)
    for (std::size_t c = 0; c < 3; ++c) middle[c] += p[c] / static_cast<double>(cell.seen.size());
  double radius = 0, largest = 0;
  for (const Real& p : cell.seen) {
    radius = std::max(radius, length(minus(p, middle)));
    largest = std::max(largest, length(p));
  }
  radius += kSlack * (radius + largest);
  if (view.perspective) {
    const double distance = length(middle);
    cell.nearest = distance - radius;
    cell.farthest = distance + radius;
    cell.half_angle = distance > radius ? std::asin(radius / distance) + kSlack : std::numbers::pi;
    for (std::size_t c = 0; c < 3; ++c) cell.towards[c] = middle[c] / distance;
  } else {
    const double depth = dot(middle, view.direction) / length(view.direction);
    cell.nearest = depth - radius;
    cell.farthest = depth + radius;
    cell.half_angle = radius;
    cell.towards = middle;
  }
}

// Returns whether surely no ray that meets p meets q behind its first point in p.
bool surely_apart(const HullCell& p, const HullCell& q, const View& view) {
  if (p.nearest > q.farthest) return true;
  if (view.perspective) {
    const double across = p.half_angle + q.half_angle;
    if (!(across < std::numbers::pi)) return false;
    return std::acos(std::clamp(dot(p.towards, q.towards), -1.0, 1.0)) > across;
  }
  const Real between = minus(q.towards, p.towards);
  return length(cross(between, view.direction)) >
         (p.half_angle + q.half_angle) * length(view.direction);
}

// Testing pairs of cells -----------------------------------------------------------------------

// A direction from one point to another. The points are the corners of p, then those of q, then the
// eye; kRays denotes the direction of all rays of a parallel view.
struct Direction {
  std::uint8_t from, to;
};
constexpr std::uint8_t kRays = 255;

enum class Answer : std::uint8_t { no, yes, unknown };

// The range of a linear function on some points.
template <typename Number>
struct Range {  // NOLINT(bugprone-exception-escape): exact numbers' move says so
  Number low, high;

  void include(const Number& x) {
    if (x < low) low = x;
    if (high < x) high = x;
  }
};

class Separation {
 public:
  Separation(const HullCell& p, const HullCell& q, const View& view)
      : p_(p),
        q_(q),
        view_(view),
        p_count_(p.seen.size()),
        eye_(static_cast<std::uint8_t>(p_count_ + q.seen.size())) {
    points_.insert(points_.end(), p.seen.begin(), p.seen.end());
    points_.insert(points_.end(), q.seen.begin(), q.seen.end());
    points_.push_back({});
    for (const Real& x : points_) largest_ = std::max(largest_, length(x));
    for (const Real& x : points_) {
      if (&x == &points_.back()) break;
      reach_ = std::max(reach_, length(minus(x, points_[0])));
    }
  }

  // Returns whether a plane separates q from the shadow of p.
  bool found() {
    for_each_candidate([&](Direction a, Direction b) {
      const Answer answer = by_rounded(a, b);
      if (answer == Answer::unknown) unknown_.push_back({a, b});
      return answer == Answer::yes;
    });
    if (found_) return true;
    return std::ranges::any_of(unknown_, [&](const auto& c) { return by_exact(c[0], c[1]); });
  }

 private:
  template <typename Try>
  void for_each_candidate(const Try& attempt) {
    const auto put = [&](Direction a, Direction b) { return found_ = found_ || attempt(a, b); };
    const auto base = static_cast<std::uint8_t>(p_count_);
    const auto shifted = [](std::uint8_t by, auto corners) {
      for (auto& c : corners) c = static_cast<std::uint8_t>(c + by);
      return corners;
    };
    for (const HullCell* cell : {&q_, &p_})
      for (const auto& t : cell->planes) {
        const auto c = shifted(cell == &q_ ? base : std::uint8_t{0}, t);
        if (put({c[0], c[1]}, {c[0], c[2]})) return;
      }
    std::vector<Direction> rays{{0, kRays}}, q_edges;
    if (view_.perspective) rays.clear();
    for (std::uint8_t k = 0; view_.perspective && k < p_count_; ++k) rays.push_back({eye_, k});
    for (const auto& e : p_.edges)
      if (put(view_.perspective ? Direction{eye_, e[0]} : rays[0], {e[0], e[1]})) return;
    for (const auto& e : q_.edges) {
      const auto c = shifted(base, e);
      q_edges.push_back({c[0], c[1]});
    }
    for (const Direction ray : rays)
      for (const Direction edge : q_edges)
        if (put(ray, edge)) return;
    for (const auto& e : p_.edges)
      for (const Direction edge : q_edges)
        if (put({e[0], e[1]}, edge)) return;
  }

  [[nodiscard]] Real rounded(Direction d) const {
    return d.to == kRays ? view_.direction : minus(points_[d.to], points_[d.from]);
  }

  // Returns whether planes with the normal a x b separate, from its products with the points.
  template <typename Number>
  static bool separates(const Range<Number>& p, const Range<Number>& q, const Range<Number>& cone,
                        const Number& slack, const Number& cone_slack) {
    return (cone.high <= cone_slack && p.high - q.low <= slack) ||
           (-cone_slack <= cone.low && q.high - p.low <= slack);
  }

  // The error of a point is a few rounding errors of the largest one, that of an edge twice as
  // large; the rest is a forward analysis with generous factors. Underflow adds far less than
  // kTiny.
  [[nodiscard]] Answer by_rounded(Direction da, Direction db) const {
    constexpr double kTiny = 1e-280;
    const Real a = rounded(da), b = rounded(db);
    const Real n = cross(a, b);
    const double size_a = length(a), size_b = length(b), off = 4 * kEpsilon * largest_;
    const double n_off = 4 * off * (size_a + size_b + off) + 8 * kEpsilon * size_a * size_b;
    const double n_size = length(n) + 2 * n_off;
    const double slack = 4 * (n_off * reach_ + n_size * (off + 8 * kEpsilon * reach_)) + kTiny;
    double cone_slack = 4 * (n_off * largest_ + n_size * (off + 8 * kEpsilon * largest_)) + kTiny;
    Range<double> p{0, 0}, q{kInfinity, -kInfinity}, cone{kInfinity, -kInfinity};
    for (std::size_t k = 0; k < eye_; ++k) {
      const double x = dot(n, minus(points_[k], points_[0]));
      (k < p_count_ ? p : q).include(x);
      if (k < p_count_ && view_.perspective) cone.include(dot(n, points_[k]));
    }
    if (!view_.perspective) {
      const double size = length(view_.direction);
      cone.include(dot(n, view_.direction));
      cone_slack = 4 * (n_off * size + 8 * kEpsilon * n_size * size) + kTiny;
    }
    if (!std::isfinite(slack) || !std::isfinite(cone_slack)) return Answer::unknown;
    if (length(n) > 2 * n_off + kTiny && separates(p, q, cone, -slack, -cone_slack))
      return Answer::yes;
    return separates(p, q, cone, slack, cone_slack) ? Answer::unknown : Answer::no;
  }

  // The exact position of a point relative to the eye: p + shrink (middle - p).
  [[nodiscard]] Vector<Exact> exact_point(std::size_t k) const {
    Vector<Exact> x{Exact(0), Exact(0), Exact(0)};
    if (k == eye_) return x;
    const HullCell& cell = k < p_count_ ? p_ : q_;
    const Real& corner = cell.corners[k < p_count_ ? k : k - p_count_];
    for (std::size_t c = 0; c < 3; ++c) {
      x[c] = Exact(corner[c]) + Exact(cell.shrink) * (Exact(cell.middle[c]) - Exact(corner[c]));
      if (view_.perspective) x[c] = x[c] - Exact(view_.eye[c]);
    }
    return x;
  }

  [[nodiscard]] Vector<Exact> exact(Direction d) const {
    const Real& v = view_.direction;
    return d.to == kRays ? Vector<Exact>{Exact(v[0]), Exact(v[1]), Exact(v[2])}
                         : minus(exact_points_[d.to], exact_points_[d.from]);
  }

  bool by_exact(Direction da, Direction db) {
    if (exact_points_.empty())
      for (std::size_t k = 0; k <= eye_; ++k) exact_points_.push_back(exact_point(k));
    const Exact zero(0);
    const Vector<Exact> n = cross(exact(da), exact(db));
    if (n[0] == zero && n[1] == zero && n[2] == zero) return false;
    const auto range = [&](std::size_t begin, std::size_t end) {
      const Exact first = dot(n, exact_points_[begin]);
      Range<Exact> values{first, first};
      for (std::size_t k = begin + 1; k < end; ++k) values.include(dot(n, exact_points_[k]));
      return values;
    };
    const Range<Exact> p = range(0, p_count_), q = range(p_count_, eye_);
    if (view_.perspective) return separates(p, q, p, zero, zero);
    const Exact along = dot(n, exact({0, kRays}));
    return separates(p, q, {along, along}, zero, zero);
  }

  const HullCell& p_;
  const HullCell& q_;
  const View& view_;
  std::size_t p_count_;
  std::uint8_t eye_;
  std::vector<Real> points_;
  std::vector<Vector<Exact>> exact_points_;
  double largest_ = 0, reach_ = 0;
  bool found_ = false;
  std::vector<std::array<Direction, 2>> unknown_;
};

}  // namespace

std::optional<HullCell> hull_cell(const ZooMesh& mesh, CellId cell, const View& view,
                                  double inset) {
  HullCell hull{};
  const CellKind kind = mesh.kinds[cell];
  // the hull of its corners is not a curved cell
  if (inset == 0 && order_of(kind) != CellOrder::linear && has_curved_faces(mesh, cell, 1e-14))
    return std::nullopt;
  const auto nodes = mesh.cell_nodes(cell);
  const std::size_t count = corner_count(kind);
  for (std::size_t k = 0; k < count; ++k) {
    const auto p = mesh.position(nodes[k]);
    hull.corners.push_back({p[0], p[1], p[2]});
    for (std::size_t c = 0; c < 3; ++c) hull.middle[c] += p[c] / static_cast<double>(count);
  }
  if (!has_inside(hull.corners)) return std::nullopt;
  double size = 0;
  for (const Real& corner : hull.corners)
    size = std::max(size, 2 * length(minus(corner, hull.middle)));
  const auto shrink = shrink_of(hull, hull_faces(mesh, cell), inset * size);
  if (!shrink) return std::nullopt;
  hull.shrink = *shrink;
  hull.deviation /= size;
  add_edges_and_planes(topology_of(kind), hull);
  for (const Real& corner : hull.corners) {
    Real& seen = hull.seen.emplace_back();
    for (std::size_t c = 0; c < 3; ++c)
      seen[c] = (corner[c] - (view.perspective ? view.eye[c] : 0)) +
                hull.shrink * (hull.middle[c] - corner[c]);
  }
  add_ball(hull, view);
  return hull;
}

bool met_first(const HullCell& p, const HullCell& q, const View& view) {
  return !surely_apart(p, q, view) && !Separation(p, q, view).found();
}

}  // namespace hiac
