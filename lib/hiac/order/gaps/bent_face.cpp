#include "hiac/order/gaps/bent_face.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hiac/geometry/interval.hpp"
#include "hiac/order/faces/eye_side.hpp"
#include "hiac/order/faces/patch_side.hpp"

namespace hiac {
namespace {

// A bound of the rounding error of a product of three differences, relative to their sizes.
constexpr double kHullRounding = 64 * std::numeric_limits<double>::epsilon();

Interval range_along(const Vector& normal, std::span<const Vector> points, const Vector& from) {
  Interval range;
  for (const Vector& p : points) {
    range.include(dot(normal, minus(p, from)));
  }
  return range;
}

// Tests for planes that separate two hulls.
class Parting {
 public:
  Parting(std::span<const Vector> f, std::span<const Vector> g, const View& view, double slack)
      : f_(f), g_(g), view_(view), from_(f[0]), slack_(slack) {
    double reach = 0;
    for (const auto points : {f, g})
      for (const Vector& p : points) reach = std::max(reach, length(minus(p, from_)));
    if (view.perspective) reach = std::max(reach, length(minus(view.eye, from_)));
    rounding_ = kHullRounding * reach;
  }

  // Returns whether a plane through the eye and two points has the hulls on different sides.
  [[nodiscard]] bool beside(const Vector& a, const Vector& b) const {
    const Vector normal = view_.perspective ? cross(minus(a, view_.eye), minus(b, view_.eye))
                                            : cross(view_.direction, minus(b, a));
    const double size = length(normal);
    if (!(size > 0)) return false;
    const Interval f = range_along(normal, f_, a), g = range_along(normal, g_, a);
    const double zero = rounding_ * size;
    return (f.high <= zero && g.low >= -zero) || (g.high <= zero && f.low >= -zero);
  }

  // Returns whether both hulls lie within the slack of a plane with this normal.
  [[nodiscard]] bool in_one_plane(const Vector& normal) const {
    const double size = length(normal);
    if (!(size > 0)) return false;
    const Interval f = range_along(normal, f_, from_), g = range_along(normal, g_, from_);
    return std::max(f.high, g.high) - std::min(f.low, g.low) <= 2 * (slack_ + rounding_) * size;
  }

  // Returns whether a plane with this normal has g and the eye on one side, and f on the other.
  [[nodiscard]] bool beyond(const Vector& normal) const {
    const double size = length(normal);
    if (!(size > 0)) return false;
    return beyond_along(normal, size) || beyond_along({-normal[0], -normal[1], -normal[2]}, size);
  }

 private:
  [[nodiscard]] bool beyond_along(const Vector& normal, double size) const {
    const Interval f = range_along(normal, f_, from_), g = range_along(normal, g_, from_);
    const double zero = rounding_ * size;
    if (g.high > f.low + slack_ * size + zero) return false;
    if (view_.perspective) return dot(normal, minus(view_.eye, from_)) <= f.low + zero;
    return dot(normal, view_.direction) >= -kHullRounding * size * length(view_.direction);
  }

  std::span<const Vector> f_, g_;
  const View& view_;
  Vector from_;
  double slack_, rounding_ = 0;
};

// Returns the corners, in order around the face, of a net of 3, 4, 9 or 16 points. The net of a
// triangle with curved edges is a square, of which the triangle is one half.
std::vector<Vector> corners_of(std::span<const Vector> hull) {
  const std::size_t n = hull.size();
  if (n <= 4) return {hull.begin(), hull.end()};
  const std::size_t side = n == 9 ? 3 : 4;
  return {hull[0], hull[side - 1], hull[n - 1], hull[n - side]};
}

}  // namespace

BentFace bent_face(const ZooMesh& mesh, const UnmatchedFace& face, const View& view,
                   double planarity) {
  BentFace bent;
  if (order_of(mesh.kinds[face.cell]) != CellOrder::linear) {
    const FaceForm form = face_form(mesh, face.cell, face.face, planarity);
    if (form.shape.degree > 1) {
      const PatchNet<Vector> hull = control_points(mesh, face.cell, face.face, form);
      bent.hull.assign(hull.begin(),
                       hull.begin() + static_cast<std::ptrdiff_t>(form.shape.control_count()));
      bent.eye = eye_side_of_curved_face(mesh, face.cell, face.face, form, view);
      return bent;
    }
  }
  if (face.corner_count != 4 || !(face.deviation > planarity)) return bent;
  const auto at = [&](std::size_t k) { return mesh.position(face.nodes[k]); };
  for (std::size_t k = 0; k < 4; ++k) {
    const Point3 p = at(k);
    bent.hull.push_back({p[0], p[1], p[2]});
  }
  bent.eye = eye_side_of_patch({at(0), at(1), at(2), at(3)}, view, planarity);
  return bent;
}

bool may_be_met_first(std::span<const Vector> f, std::span<const Vector> g, const View& view,
                      double slack) {
  const Parting parting(f, g, view, slack);
  std::array<std::vector<Vector>, 2> edges;
  std::vector<Vector> normals;
  for (const bool second : {false, true}) {
    const std::vector<Vector> c = corners_of(second ? g : f);
    const std::size_t n = c.size();
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t j = 0; j < k; ++j)
        if (parting.beside(c[j], c[k])) return false;
    for (std::size_t k = 0; k < n; ++k) edges[second].push_back(minus(c[(k + 1) % n], c[k]));
    for (std::size_t k = 0; k < (n == 3 ? 1 : n); ++k)
      normals.push_back(cross(edges[second][k], minus(c[(k + 2) % n], c[k])));
    if (n == 4) normals.push_back(cross(minus(c[2], c[0]), minus(c[3], c[1])));
  }
  const auto touching = [&](const Vector& normal) { return parting.in_one_plane(normal); };
  const auto beyond = [&](const Vector& normal) { return parting.beyond(normal); };
  if (std::ranges::any_of(normals, touching)) return true;
  if (std::ranges::any_of(normals, beyond)) return false;
  // where the hulls touch along edges, a plane parallel to an edge of each may separate them
  return std::ranges::none_of(edges[0], [&](const Vector& along_f) {
    return std::ranges::any_of(
        edges[1], [&](const Vector& along_g) { return beyond(cross(along_f, along_g)); });
  });
}

}  // namespace hiac
