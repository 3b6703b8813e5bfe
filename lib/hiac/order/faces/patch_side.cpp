#include "hiac/order/faces/patch_side.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/geometry/patch_facing.hpp"
#include "hiac/order/faces/eye_side.hpp"

namespace hiac {
namespace {

// Right-handed axes of which the third points along a parallel view's rays.
std::array<Vector, 3> axes_along(const Vector& direction) {
  const Vector forward = unit(direction);
  std::size_t least = 0;
  for (std::size_t c = 1; c < 3; ++c)
    if (std::abs(forward[c]) < std::abs(forward[least])) least = c;
  Vector other{};
  other[least] = 1;
  const Vector right = unit(cross(forward, other));
  return {right, cross(forward, right), forward};
}

std::array<PatchNet<double>, 3> nets_of(const PatchShape& shape, const PatchNet<Vector>& points) {
  std::array<PatchNet<double>, 3> nets;
  for (std::size_t k = 0; k < shape.control_count(); ++k)
    for (std::size_t c = 0; c < 3; ++c) nets[c][k] = points[k][c];
  return nets;
}

// The control points relative to the eye or, in a parallel view, in coordinates across the rays.
PatchNet<Vector> as_seen(const PatchShape& shape, const PatchNet<Vector>& points,
                         const View& view) {
  PatchNet<Vector> seen;
  if (view.perspective) {
    for (std::size_t k = 0; k < shape.control_count(); ++k) seen[k] = minus(points[k], view.eye);
    return seen;
  }
  const auto axes = axes_along(view.direction);
  for (std::size_t k = 0; k < shape.control_count(); ++k) {
    const Vector from = minus(points[k], points[0]);
    seen[k] = {dot(from, axes[0]), dot(from, axes[1]), 1};
  }
  return seen;
}

// Returns whether a face's corners run in the direction in which the kind's table lists them.
bool runs_as_listed(const ShapeFace& face, const std::array<std::uint8_t, 4>& corners) {
  const auto* const end = face.corners.begin() + face.corner_count;
  const auto first = std::find(face.corners.begin(), end, corners[0]) - face.corners.begin();
  return face.corners[(static_cast<std::size_t>(first) + 1) % face.corner_count] == corners[1];
}

}  // namespace

int eye_side_of_patch(const std::array<Point3, 4>& p, const View& view, double planarity) {
  bool positive = false, negative = false;
  for (std::size_t k = 1; k < 5; ++k) {
    const int side = eye_side(p[(k + 3) % 4], p[k % 4], p[(k + 1) % 4], view);
    positive = positive || side > 0;
    negative = negative || side < 0;
  }
  if (positive != negative) return positive ? 1 : -1;
  if (!positive) return 0;
  return quadrilateral_deviation(p[0], p[1], p[2], p[3]) > planarity ? kBothSides : 0;
}

// With a, b, c the corners around a point of the face, eye_side is -sign det[a - e, b - a, c - a],
// or -sign det[v, b - a, c - a] for rays of direction v.
int eye_side_of_curved_face(const ZooMesh& mesh, CellId cell, std::size_t face,
                            const FaceForm& form, const View& view) {
  const PatchNet<Vector> seen = as_seen(form.shape, control_points(mesh, cell, face, form), view);
  const int facing = patch_facing(form.shape, nets_of(form.shape, seen));
  if (facing == 0) return kBothSides;
  const bool listed = runs_as_listed(topology_of(mesh.kinds[cell]).faces[face], form.corners);
  return listed ? -facing : facing;
}

}  // namespace hiac
