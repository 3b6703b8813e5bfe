#include "hiac/order/published/face_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/geometry/box.hpp"
#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

// A bound, larger than necessary, of the forward error of a determinant of rounded differences, for
// the norms below (J. R. Shewchuk, 1997, section 4.3).
constexpr double kPlaneError = 8 * std::numeric_limits<double>::epsilon() / 2;

// Times a distance, this is far more than underflow may add to such a determinant.
constexpr double kPlaneUnderflow = std::numeric_limits<double>::min();

}  // namespace

MeshScale::MeshScale(const ZooMesh& mesh) {
  extent = rounding = 0;
  if (mesh.xyz.empty()) return;
  const Box box = box_of_nodes(mesh);
  extent = taxicab(minus(Point3(box.high), Point3(box.low)));
  rounding = std::numeric_limits<double>::epsilon() * std::max(largest(box.low), largest(box.high));
}

FacePlane plane_of_face(const CellCorners& cell, const ShapeFace& face, const MeshScale& scale) {
  const auto corner = [&](std::size_t k) { return cell.at(face.corners[k]); };
  const bool triangle = face.corner_count == 3;
  // the diagonals of a quadrilateral span Newell's plane
  const Vector u = triangle ? minus(corner(1), corner(0)) : minus(corner(2), corner(0));
  const Vector v = triangle ? minus(corner(2), corner(0)) : minus(corner(3), corner(1));
  FacePlane plane{};
  plane.normal = cross(u, v);
  const double u_size = taxicab(u), v_size = taxicab(v);
  plane.size = std::max(u_size, v_size);
  plane.certain_slope = kPlaneError * u_size * v_size;
  plane.touching = 4 * scale.rounding * u_size * v_size;
  plane.touching_slope = plane.certain_slope + 4 * scale.rounding * (u_size + v_size);
  for (std::size_t c = 0; c < 3; ++c)
    plane.point[c] =
        triangle ? corner(0)[c]
                 : corner(0)[c] / 4 + corner(1)[c] / 4 + corner(2)[c] / 4 + corner(3)[c] / 4;
  if (!triangle) {
    for (std::size_t k = 0; k < 4; ++k)
      plane.deviation =
          std::max(plane.deviation, std::abs(plane.value(minus(corner(k), Point3(plane.point)))));
    plane.touching += plane.deviation;
  }
  plane.certain = plane.certain_slope * scale.extent + kPlaneUnderflow * (scale.extent + 1);
  plane.apart = plane.touch(scale.extent) + kPlaneUnderflow * (scale.extent + 1);
  return plane;
}

}  // namespace hiac
