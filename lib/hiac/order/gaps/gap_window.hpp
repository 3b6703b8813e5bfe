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

/// Where a window has a face.
struct Outline {
  Interval x, y, depth;              ///< what of it is seen lies in there for sure
  std::array<double, 4> at_x, at_y;  ///< its corners, a triangle's last one twice; not in a pyramid
  double error;                      ///< what those may be off by
};

/// A plane to project on, through which part of the mesh is seen: x and y in it, depth along its
/// axis.
///
/// A wide window has all of the mesh before the eye. A pyramid is one of six that look out of a
/// cube around the eye: of a face only what lies inside |x|, |y| <= depth counts.
class Window {
 public:
  /// `axis` may have any length but 0.
  Window(const View& view, const std::array<double, 3>& axis, bool pyramid);

  [[nodiscard]] bool pyramid() const { return pyramid_; }

  /// +1 when what runs counter-clockwise as seen from the eye does so in x and y: always -1, since
  /// x, y and depth are right-handed.
  static constexpr int kWinding = -1;

  /// False when nothing of the face is seen here.
  bool place(const SeenFace& face, Outline& outline) const;
  /// The same for the convex hull of at least four points.
  bool place_hull(std::span<const Vector> points, Outline& outline) const;

 private:
  [[nodiscard]] Vector seen(const Vector& p, double& farthest) const;
  bool place_whole(std::span<const Vector> corners, double farthest, Outline& outline) const;

  View view_;
  Vector axis_, right_{}, up_{};
  bool pyramid_;
};

/// The windows that together see the whole mesh, and points besides: one when they lie on one side
/// of the eye, else the six sides of a cube around the eye.
std::vector<Window> windows_of(const ZooMesh& mesh, std::span<const Vector> points,
                               const View& view);

}  // namespace hiac
