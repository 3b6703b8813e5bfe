#pragma once

#include <array>
#include <optional>

#include "hiac/scene/scene.hpp"

namespace hiac {

/// Movements of a camera, as a hand makes them. Every one returns a camera that a specification may
/// have: `eye` and `look_at` differ, and `up` is not parallel to the view direction.

/// The camera's orthonormal directions: right and up in the picture, and ahead.
struct CameraAxes {
  std::array<double, 3> right, up, ahead;
};
CameraAxes axes_of(const Camera& camera);

/// Turns the camera about look_at: by `across` degrees about the picture's vertical axis, and then
/// by `down` degrees about its horizontal one, so that what is in front of look_at moves to the
/// right, and down. The distance from look_at stays.
Camera orbited(const Camera& camera, double across, double down);

/// Turns the camera about its line of sight: the picture turns counter-clockwise by `degrees`.
Camera rolled(const Camera& camera, double degrees);

/// Moves eye and look_at together, so that the plane through look_at moves by these shares of the
/// picture's height: to the right, and up.
Camera panned(const Camera& camera, double right, double up);

/// Enlarges what is at look_at by a positive factor: perspective: the eye approaches, and a
/// clipping slab stays where it is in the world, as far as near may not be negative; orthographic:
/// the picture's height shrinks.
Camera zoomed(const Camera& camera, double factor);

/// Sees `factor` times as much across and down, from the same eye; what is at the centre stays
/// there. The factor is positive.
Camera widened(const Camera& camera, double factor);

/// Moves eye and look_at together, so that `point` is at the picture's centre.
Camera centred(const Camera& camera, const std::array<double, 3>& point);

/// Looks along a direction, from the same distance. `up` is not parallel to it.
Camera looking_along(const Camera& camera, const std::array<double, 3>& ahead,
                     const std::array<double, 3>& up);

/// The other projection, with the same size of what is at look_at. `fov`: of a perspective camera,
/// degrees; its eye moves to the distance that keeps the size.
Camera with_projection(const Camera& camera, Projection projection, double fov);

/// Looks in the same direction, at the middle of a box, from where all of a sphere around the box
/// is seen in a picture of that size. The radius is positive.
Camera framing(const Camera& camera, const std::array<double, 3>& middle, double radius,
               ImageSize size);

/// The point of the world that is seen at a place of a picture at a depth (the distance from the
/// eye plane along the view direction). `x` and `y`: pixels from the top left corner, centres of
/// pixels at halves.
std::array<double, 3> point_at(const Camera& camera, ImageSize size, double x, double y,
                               double depth);

}  // namespace hiac
