#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "hiac/geometry/inverse_map.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// A node as the scan converter sees it.
///
/// `x`, `y`: pixel coordinates, x to the right, y down, the centre of pixel (i, j) at
/// (i + 0.5, j + 0.5). `depth`: affine on the projection of every plane and increasing along rays:
/// the ray parameter t itself in orthographic, -1 / t in perspective.
struct ProjectedNode {
  double x, y, depth;
};

/// The map from the world to the screen, and the rays of pixels in the world (sections 4, 5.1).
///
/// The ray through the screen point (x, y) is origin(x, y) + t direction(x, y). The parameter t is
/// the distance from the eye plane along the view direction in perspective, and from the plane
/// through `look_at` in orthographic (where the eye's distance would only cost precision).
class Projector {
 public:
  /// Throws InputError if the camera is impossible (the scene's parser excludes that).
  Projector(const Camera& camera, ImageSize size);

  [[nodiscard]] bool perspective() const { return perspective_; }
  /// The picture's, in pixels.
  [[nodiscard]] ImageSize size() const { return size_; }
  /// Range of t that z-clipping leaves; in perspective never below 0.
  [[nodiscard]] double near() const { return near_; }
  [[nodiscard]] double far() const { return far_; }

  /// Projects a point in extended precision, rounding once: projected nodes are then as accurate as
  /// doubles allow, however far away the eye is. Returns false if the point cannot be projected,
  /// because it lies beside or behind the eye.
  bool project(std::span<const double, 3> point, ProjectedNode& node) const;
  /// The point's x, y and depth (ProjectedNode) without that rounding.
  [[nodiscard]] std::array<long double, 3> project_extended(std::span<const double, 3> point) const;
  /// The ray parameter of the plane parallel to the screen through a point.
  [[nodiscard]] double parameter(std::span<const double, 3> point) const;
  /// Camera coordinates (right, up, forward), relative to the eye or, orthographic, look_at.
  [[nodiscard]] std::array<double, 3> camera_coordinates(std::span<const double, 3> point) const;
  /// The same of a vector: its components along right, up and forward.
  [[nodiscard]] std::array<double, 3> camera_vector(const std::array<double, 3>& v) const;

  [[nodiscard]] std::array<double, 3> origin(double x, double y) const;
  /// A point, and the origin of a ray, in world axes relative to the eye or, orthographic, to
  /// look_at: this preserves the digits that coordinates far from zero would lose.
  [[nodiscard]] std::array<double, 3> relative(std::span<const double, 3> point) const;
  [[nodiscard]] std::array<double, 3> relative_origin(double x, double y) const;
  [[nodiscard]] std::array<double, 3> direction(double x, double y) const;
  /// Perspective: the direction's components along right and up, where that along forward is 1.
  /// Orthographic: those of the origin, relative to look_at.
  [[nodiscard]] std::array<double, 2> slopes(double x, double y) const {
    return {(x - center_x_) / scale_, (center_y_ - y) / scale_};
  }
  /// The slopes, and the range of t that z-clipping leaves, in extended precision.
  [[nodiscard]] std::array<long double, 2> extended_slopes(double x, double y) const;
  [[nodiscard]] long double extended_near() const { return extended_near_; }
  [[nodiscard]] long double extended_far() const { return extended_far_; }
  /// camera_coordinates and camera_vector in extended precision.
  [[nodiscard]] std::array<long double, 3> extended_camera_coordinates(
      std::span<const double, 3> point) const;
  [[nodiscard]] std::array<long double, 3> extended_camera_vector(
      const std::array<long double, 3>& v) const;
  /// The vectors from which rays are computed, for many at a time: with a = (x - center_x) /
  /// pixels_per_unit() and b = (center_y - y) / pixels_per_unit(), relative_origin(x, y) is 0 and
  /// direction(x, y) is forward + a right + b up in perspective; a right + b up and forward in
  /// orthographic.
  struct Axes {
    std::array<double, 3> right, up, forward;
    double center_x, center_y;
  };
  [[nodiscard]] Axes axes() const { return {right_, up_, forward_, center_x_, center_y_}; }
  /// Distance from the eye plane along the view direction at the ray parameter t.
  [[nodiscard]] double distance(double t) const { return t + offset_; }
  /// Pixels per world unit, parallel to the screen; in perspective at t = 1.
  [[nodiscard]] double pixels_per_unit() const { return scale_; }
  /// World length per unit of t on the ray through (x, y).
  [[nodiscard]] double ray_scale(double x, double y) const {
    if (!perspective_) return 1;
    const auto [a, b] = slopes(x, y);
    return std::sqrt(a * a + b * b + 1);  // section 5.1: the slanted distance
  }

 private:
  using Extended = std::array<long double, 3>;

  bool perspective_;
  ImageSize size_;
  std::array<double, 3> anchor_;  // the eye, or look_at
  std::array<double, 3> right_, up_, forward_;
  Extended extended_right_, extended_up_, extended_forward_;  // the same
  long double extended_scale_;
  double scale_;  // pixels per unit of x / z, or per world unit
  double center_x_, center_y_;
  double near_, far_;
  long double extended_near_, extended_far_;
  double offset_;  // distance from the eye plane at t = 0
};

/// All nodes of a mesh. Nodes that cannot be projected have depth NaN.
std::vector<ProjectedNode> project_nodes(const ZooMesh& mesh, const Projector& projector);

/// The positions of a cell's nodes in the frame of Projector::relative; entries beyond them are not
/// set.
std::array<CellMap::Point, CellMap::kMostNodes> relative_positions(const ZooMesh& mesh, CellId cell,
                                                                   const Projector& projector);

}  // namespace hiac
