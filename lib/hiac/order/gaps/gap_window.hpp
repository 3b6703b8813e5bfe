#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "hiac/geometry/interval.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/geometry/view.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/gaps/face_obstruction.hpp"

namespace hiac {

/// The place of a face in a window.
struct Outline {
  Interval x, y, depth;              ///< bounds of its visible part
  std::array<double, 4> at_x, at_y;  ///< its corners, a triangle's last one twice; not in a pyramid
  double error;                      ///< error bound of the corners
};

/// A projection plane through which a part of the mesh is seen: x and y are coordinates in the
/// plane, depth is along its axis.
///
/// A wide window has all of the mesh in front of the eye. A pyramid is one of six that look out of
/// a cube around the eye: only the part of a face inside |x|, |y| <= depth counts.
class Window {
 public:
  /// `axis` may have any length but 0.
  Window(const View& view, const std::array<double, 3>& axis, bool pyramid);

  [[nodiscard]] bool pyramid() const { return pyramid_; }

  /// +1 if an order that is counter-clockwise as seen from the eye is so in x and y: always -1,
  /// since x, y and depth are right-handed.
  static constexpr int kWinding = -1;

  /// Returns false if no part of the face is seen here.
  bool place(const SeenFace& face, Outline& outline) const;
  /// Does the same for the convex hull of at least four points.
  bool place_hull(std::span<const Vector> points, Outline& outline) const;

 private:
  [[nodiscard]] Vector seen(const Vector& p, double& farthest) const;
  bool place_whole(std::span<const Vector> corners, double farthest, Outline& outline) const;

  View view_;
  Vector axis_, right_{}, up_{};
  bool pyramid_;
};

/// Returns the windows that together see the whole mesh and the given points: one if they all lie
/// on one side of the eye, otherwise the six sides of a cube around the eye.
std::vector<Window> windows_of(const ZooMesh& mesh, std::span<const Vector> points,
                               const View& view);

}  // namespace hiac
