#include "hiac/check/interfaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "hiac/base/parallel.hpp"
#include "hiac/check/box_tree.hpp"
#include "hiac/geometry/predicates.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/order/behind_relation.hpp"

namespace hiac {
namespace {

constexpr std::size_t kInterfacesGrain = 1 << 9;

// How a face lies on another, the closest fit first.
enum class Fit : std::uint8_t { torn, hanging, sliding, none };

// A free face as a polygon in world coordinates, with the corner of its cell farthest from its
// plane.
struct Polygon {
  std::array<const double*, 4> corners{};
  std::size_t count = 0;
  const double* inner = nullptr;
  double size = 0, deviation = 0;
  Vector normal{};  // of length 1, or 0

  [[nodiscard]] Point3 at(std::size_t k) const { return Point3(corners[k % count], 3); }
  [[nodiscard]] Point3 inside() const { return Point3(inner, 3); }
};

// Returns none for a face without area or of a cell without volume, as neither lies on anything.
std::optional<Polygon> polygon_of(const ZooMesh& mesh, const FreeFace& face) {
  Polygon p;
  p.count = face.corner_count;
  for (std::size_t k = 0; k < p.count; ++k) p.corners[k] = mesh.position(face.nodes[k]).data();
  for (std::size_t k = 1; k < p.count; ++k)
    for (std::size_t j = 0; j < k; ++j) p.size = std::max(p.size, length(minus(p.at(k), p.at(j))));
  const Vector across = cross(minus(p.at(2), p.at(0)), minus(p.at(p.count - 1), p.at(1)));
  const double area = length(across);
  if (!(area > 0)) return std::nullopt;
  p.normal = {across[0] / area, across[1] / area, across[2] / area};
  if (p.count == 4) p.deviation = quadrilateral_deviation(p.at(0), p.at(1), p.at(2), p.at(3));
  const auto nodes = mesh.cell_nodes(face.cell).first(corner_count(mesh.kinds[face.cell]));
  double deepest = 0;
  for (const NodeId node : nodes) {
    const double depth = std::abs(dot(p.normal, minus(mesh.position(node), p.at(0))));
    // a triangle's fourth node is none
    const auto corners = std::span(face.nodes).first(p.count);
    if (depth <= deepest || std::ranges::find(corners, node) != corners.end()) continue;
    deepest = depth;
    p.inner = mesh.position(node).data();
  }
  if (p.inner == nullptr) return std::nullopt;
  return p;
}

bool same_places(const Polygon& f, const Polygon& g) {
  if (f.count != g.count) return false;
  for (std::size_t k = 0; k < f.count; ++k) {
    bool found = false;
    for (std::size_t j = 0; j < g.count; ++j) found = found || std::ranges::equal(f.at(k), g.at(j));
    if (!found) return false;
  }
  return true;
}

// Compares two polygons. Distances below `tolerated` are negligible; with 0, determinants decide.
class Lying {
 public:
  Lying(const Polygon& f, const Polygon& g, double planarity)
      : f_(f),
        g_(g),
        tolerated_(planarity == 0 ? 0 : planarity * std::max(f.size, g.size)),
        off_plane_(planarity == 0 ? 0 : tolerated_ + f.deviation * f.size + g.deviation * g.size) {}

  // Returns how f lies on g, whose cell must be on the other side of it.
  [[nodiscard]] Fit fit() const {
    if (!opposite_sides()) return Fit::none;
    if (same_places(f_, g_)) return Fit::torn;
    if (!in_plane(f_, g_) || !in_plane(g_, f_) || apart(f_, g_) || apart(g_, f_)) return Fit::none;
    return contains(f_, g_) || contains(g_, f_) ? Fit::hanging : Fit::sliding;
  }

 private:
  // Returns whether the inner corners lie on different sides of f's plane.
  [[nodiscard]] bool opposite_sides() const {
    const int own = orientation(f_.at(0), f_.at(1), f_.at(2), f_.inside());
    const int other = orientation(f_.at(0), f_.at(1), f_.at(2), g_.inside());
    return own * other < 0;
  }

  [[nodiscard]] bool in_plane(const Polygon& plane, const Polygon& polygon) const {
    for (std::size_t k = 0; k < polygon.count; ++k) {
      const Point3 q = polygon.at(k);
      if (orientation(plane.at(0), plane.at(1), plane.at(2), q) != 0 &&
          !(std::abs(dot(plane.normal, minus(q, plane.at(0)))) <= off_plane_ && off_plane_ > 0))
        return false;
    }
    return true;
  }

  // Returns the side of a polygon's edge on which a point of its plane lies: +1 inside, 0 on the
  // edge's line, -1 outside. It is the side of the plane through the edge and the cell's inner
  // corner.
  [[nodiscard]] int side_of_edge(const Polygon& p, std::size_t edge, Point3 q) const {
    const Point3 a = p.at(edge), b = p.at(edge + 1);
    const int side = orientation(a, b, p.inside(), q);
    if (side == 0) return 0;
    const int inwards = orientation(a, b, p.inside(), p.at(edge + 2));
    const Vector across = cross(p.normal, minus(b, a));
    const double distance = std::abs(dot(across, minus(q, a)));
    return distance <= tolerated_ * length(across) && tolerated_ > 0 ? 0 : side * inwards;
  }

  // Returns whether an edge of p has all of q on its outer side.
  [[nodiscard]] bool apart(const Polygon& p, const Polygon& q) const {
    for (std::size_t e = 0; e < p.count; ++e) {
      bool reached = false;
      for (std::size_t k = 0; k < q.count; ++k)
        reached = reached || side_of_edge(p, e, q.at(k)) > 0;
      if (!reached) return true;
    }
    return false;
  }

  [[nodiscard]] bool contains(const Polygon& p, const Polygon& q) const {
    for (std::size_t e = 0; e < p.count; ++e)
      for (std::size_t k = 0; k < q.count; ++k)
        if (side_of_edge(p, e, q.at(k)) < 0) return false;
    return true;
  }

  const Polygon& f_;
  const Polygon& g_;
  double tolerated_, off_plane_;
};

// Returns a box that contains every face that counts as lying on the polygon.
Box box_of(const std::optional<Polygon>& polygon, double planarity) {
  Box box = Box::empty();
  if (!polygon) return box;
  for (std::size_t k = 0; k < polygon->count; ++k) box.include(polygon->at(k));
  const double reach = planarity == 0 ? 0 : polygon->size * (planarity + polygon->deviation);
  for (std::size_t c = 0; c < 3; ++c) {
    box.low[c] -= reach;
    box.high[c] += reach;
  }
  return box;
}

bool same_nodes(const FreeFace& f, const FreeFace& g) {
  const auto of = [](const FreeFace& face) {
    return std::span(face.nodes).first(face.corner_count);
  };
  return f.corner_count == g.corner_count && std::ranges::is_permutation(of(f), of(g));
}

// Returns the closest fit of every polygon with those of other cells.
std::vector<Fit> fits_of(const std::vector<FreeFace>& faces,
                         const std::vector<std::optional<Polygon>>& polygons, double planarity) {
  std::vector<Box> boxes(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) boxes[i] = box_of(polygons[i], planarity);
  const BoxTree tree(std::move(boxes));
  std::vector<Fit> fits(faces.size(), Fit::none);
  parallel_for(faces.size(), kInterfacesGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (!polygons[i]) continue;
      tree.for_each_meeting(tree.box(static_cast<std::uint32_t>(i)), [&](std::uint32_t j) {
        if (faces[j].cell == faces[i].cell || fits[i] == Fit::torn) return;
        if (same_nodes(faces[i], faces[j])) return;  // overshared, not an interface
        fits[i] = std::min(fits[i], Lying(*polygons[i], *polygons[j], planarity).fit());
      });
    }
  });
  return fits;
}

}  // namespace

std::vector<Finding> find_interfaces(const ZooMesh& mesh, const std::vector<FreeFace>& faces,
                                     double planarity) {
  std::vector<std::optional<Polygon>> polygons(faces.size());
  parallel_for(faces.size(), kInterfacesGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) polygons[i] = polygon_of(mesh, faces[i]);
  });
  const std::vector<Fit> fits = fits_of(faces, polygons, planarity);
  std::array<std::vector<Offender>, 3> found;
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (fits[i] != Fit::none)
      found[static_cast<std::size_t>(fits[i])].push_back({faces[i].cell, faces[i].face});
  std::vector<Finding> findings;
  add_finding(findings, Defect::torn_interface, std::move(found[0]));
  add_finding(findings, Defect::hanging_interface, std::move(found[1]));
  add_finding(findings, Defect::sliding_interface, std::move(found[2]));
  return findings;
}

}  // namespace hiac
