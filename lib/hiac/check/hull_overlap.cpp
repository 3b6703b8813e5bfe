#include "hiac/check/hull_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hiac/geometry/interval.hpp"
#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

using NodeTriple = std::array<std::uint8_t, 3>;
using NodePair = std::array<std::uint8_t, 2>;

// Tables of shapes and of faces -------------------------------------------------------------------

struct Spanning {
  std::vector<NodeTriple> triples;  // counter-clockwise as seen from outside a right cell
  std::vector<NodePair> pairs;
};

void add_face(const ShapeFace& face, Spanning& spanning) {
  const auto& c = face.corners;
  if (face.corner_count == 3) {
    spanning.triples.push_back({c[0], c[1], c[2]});
    return;
  }
  for (std::size_t k = 0; k < 4; ++k)
    spanning.triples.push_back({c[k], c[(k + 1) % 4], c[(k + 2) % 4]});
  spanning.pairs.push_back({c[0], c[2]});
  spanning.pairs.push_back({c[1], c[3]});
}

Spanning spanning_of_shape(CellShape shape) {
  Spanning spanning;
  for (const ShapeEdge& edge : topology_of(shape).edges) spanning.pairs.push_back(edge);
  for (const ShapeFace& face : topology_of(shape).faces) add_face(face, spanning);
  return spanning;
}

Spanning spanning_of_polygon(std::uint8_t count) {
  Spanning spanning;
  add_face({count, {0, 1, 2, 3}}, spanning);
  for (std::uint8_t k = 0; k < count; ++k)
    spanning.pairs.push_back({k, static_cast<std::uint8_t>((k + 1) % count)});
  return spanning;
}

const Spanning& spanning_of(CellShape shape) {
  static const std::array<Spanning, kShapeCount> kTable = [] {
    std::array<Spanning, kShapeCount> table;
    for (std::size_t s = 0; s < kShapeCount; ++s)
      table[s] = spanning_of_shape(static_cast<CellShape>(s));
    return table;
  }();
  return kTable[static_cast<std::size_t>(shape)];
}

// Separating planes -------------------------------------------------------------------------------

// Returns the side of a plane on which a hull's corners off the plane lie: -1 or 1; 0 if all are on
// it; 2 if they are on both sides.
int side_of(const Hull& hull, Point3 a, Point3 b, Point3 c) {
  int side = 0;
  for (std::size_t k = 0; k < hull.count; ++k) {
    const double* const at = hull.corners[k];
    if (at == a.data() || at == b.data() || at == c.data()) continue;
    const int here = orientation(a, b, c, hull.at(k));
    if (here == 0) continue;
    if (side == -here) return 2;
    side = here;
  }
  return side;
}

// `first` is the hull that the plane is more likely to cut. A hull that lies in the plane is on
// neither side of it.
bool separates(Point3 a, Point3 b, Point3 c, const Hull& first, const Hull& second) {
  const int s = side_of(first, a, b, c);
  return s != 2 && s != 0 && side_of(second, a, b, c) == -s;
}

bool separated_by_a_face(const Hull& p, const Hull& q) {
  return std::ranges::any_of(p.triples, [&](const NodeTriple& t) {
    return separates(p.at(t[0]), p.at(t[1]), p.at(t[2]), q, p);
  });
}

bool separated_by_an_edge(const Hull& p, const Hull& q) {
  return std::ranges::any_of(p.pairs, [&](const NodePair& e) {
    for (std::size_t k = 0; k < q.count; ++k) {
      if (q.corners[k] == p.corners[e[0]] || q.corners[k] == p.corners[e[1]]) continue;
      if (separates(p.at(e[0]), p.at(e[1]), q.at(k), p, q)) return true;
    }
    return false;
  });
}

// Depth -------------------------------------------------------------------------------------------

Interval along(const Hull& hull, const Vector& n, Point3 from) {
  Interval interval;
  for (std::size_t k = 0; k < hull.count; ++k) {
    interval.include(dot(n, minus(hull.at(k), from)));
  }
  return interval;
}

// Returns the gap between the hulls along u x v; minus infinity if u and v are parallel.
double gap_across(const Hull& p, const Hull& q, const Vector& u, const Vector& v) {
  constexpr double kNearlyParallel = 1e-6;
  const Vector normal = cross(u, v);
  const double size = length(normal);
  if (!(size > kNearlyParallel * length(u) * length(v)))
    return -std::numeric_limits<double>::infinity();
  const Interval a = along(p, normal, p.at(0)), b = along(q, normal, p.at(0));
  return std::max(b.low - a.high, a.low - b.high) / size;
}

// Planes of faces ---------------------------------------------------------------------------------

struct Plane {
  Vector point, inwards;  // inwards of length 1
  double away;
};

// Returns false if a face has no area.
bool add_planes(const Hull& hull, int turn, double away, std::vector<Plane>& planes) {
  for (const NodeTriple& t : hull.triples) {
    const Point3 a = hull.at(t[0]);
    Vector n = cross(minus(hull.at(t[1]), a), minus(hull.at(t[2]), a));
    const double size = length(n) * -turn;
    if (size == 0) return false;
    for (double& x : n) x /= size;
    planes.push_back({{a[0], a[1], a[2]}, n, away});
  }
  return true;
}

bool is_inside(const Hull& hull, int turn, Point3 x) {
  return std::ranges::all_of(hull.triples, [&](const NodeTriple& t) {
    return orientation(hull.at(t[0]), hull.at(t[1]), hull.at(t[2]), x) == -turn;
  });
}

Vector middle_of(const Hull& hull) {
  Vector middle{};
  for (std::size_t k = 0; k < hull.count; ++k)
    for (std::size_t c = 0; c < 3; ++c)
      middle[c] += hull.at(k)[c] / static_cast<double>(hull.count);
  return middle;
}

}  // namespace

Hull hull_of_cell(const ZooMesh& mesh, CellId cell) {
  const CellShape shape = shape_of(mesh.kinds[cell]);
  const auto nodes = mesh.cell_nodes(cell);
  Hull hull;
  hull.count = topology_of(shape).corner_count;
  for (std::size_t k = 0; k < hull.count; ++k) hull.corners[k] = mesh.position(nodes[k]).data();
  hull.triples = spanning_of(shape).triples;
  hull.pairs = spanning_of(shape).pairs;
  return hull;
}

Hull hull_of_face(const ZooMesh& mesh, CellId cell, std::size_t face) {
  static const std::array<Spanning, 2> kTable{spanning_of_polygon(3), spanning_of_polygon(4)};
  const ShapeFace& shape = topology_of(mesh.kinds[cell]).faces[face];
  const auto nodes = mesh.cell_nodes(cell);
  Hull hull;
  hull.count = shape.corner_count;
  for (std::size_t k = 0; k < hull.count; ++k)
    hull.corners[k] = mesh.position(nodes[shape.corners[k]]).data();
  hull.triples = kTable[hull.count - 3].triples;
  hull.pairs = kTable[hull.count - 3].pairs;
  return hull;
}

bool are_separated(const Hull& p, const Hull& q) {
  return separated_by_a_face(p, q) || separated_by_a_face(q, p) || separated_by_an_edge(p, q) ||
         separated_by_an_edge(q, p);
}

double gap_between(const Hull& p, const Hull& q) {
  double gap = -std::numeric_limits<double>::infinity();
  for (const Hull* hull : {&p, &q})
    for (const NodeTriple& t : hull->triples)
      gap = std::max(gap, gap_across(p, q, minus(hull->at(t[1]), hull->at(t[0])),
                                     minus(hull->at(t[2]), hull->at(t[0]))));
  for (const NodePair& e : p.pairs)
    for (const NodePair& f : q.pairs)
      gap = std::max(
          gap, gap_across(p, q, minus(p.at(e[1]), p.at(e[0])), minus(q.at(f[1]), q.at(f[0]))));
  return gap;
}

std::optional<Vector> common_point(const Hull& p, int turn_p, double away_p, const Hull& q,
                                   int turn_q, double away_q) {
  std::vector<Plane> planes;
  if (!add_planes(p, turn_p, away_p, planes) || !add_planes(q, turn_q, away_q, planes))
    return std::nullopt;
  // each step crosses the most violated plane, by its violation and a margin that shrinks
  constexpr int kSteps = 200;
  const Vector from = middle_of(p), to = middle_of(q);
  Vector x;
  for (std::size_t c = 0; c < 3; ++c) x[c] = 0.5 * from[c] + 0.5 * to[c];
  double step = 0.05 * std::max(length(minus(p.at(1), p.at(0))), length(minus(q.at(1), q.at(0))));
  std::optional<Vector> best;
  double best_height = 0;
  for (int i = 0; i < kSteps; ++i) {
    const Plane* worst = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Plane& plane : planes) {
      const double height = dot(plane.inwards, minus(x, plane.point)) - plane.away;
      if (height < least) least = height, worst = &plane;
    }
    if (worst == nullptr || !std::isfinite(least)) return std::nullopt;
    if (least > best_height && is_inside(p, turn_p, x) && is_inside(q, turn_q, x))
      best = x, best_height = least;
    const double by = std::max(-least, 0.0) + step;
    for (std::size_t c = 0; c < 3; ++c) x[c] += by * worst->inwards[c];
    step *= 0.97;
  }
  return best;
}

}  // namespace hiac
