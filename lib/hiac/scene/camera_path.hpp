#pragma once

#include <cstdint>

#include "hiac/scene/scene.hpp"

namespace hiac {

/// Returns the number of frames of a scene: 1 without a path, otherwise that of the last keyframe
/// plus 1, or the turntable's `frames`.
std::uint32_t frame_count(const Scene& scene);

/// Returns the camera at a frame below frame_count.
///
/// Keyframes: at a keyframe the camera equals the keyframe's camera bit for bit. Between two
/// keyframes eye and look_at follow a straight line, or a Catmull-Rom spline (E. Catmull, R. Rom,
/// "A Class of Local Interpolating Splines", 1974) over the frame numbers: cubic pieces whose
/// velocity at a keyframe is the mean velocity from the keyframe before it to the one after it, and
/// at either end the velocity of the straight line to its neighbour. The direction of `up`, fov,
/// height and clip change linearly; of `up`, only the part perpendicular to the view direction has
/// an effect.
///
/// Turntable: eye and up are turned about the axis through look_at, counter-clockwise as seen from
/// the axis' tip, by degrees * frame / frames; quarter turns are exact where coordinates allow it.
Camera camera_at(const Scene& scene, std::uint32_t frame);

/// Returns the scene of one frame: with the frame's camera and without a path.
Scene scene_of_frame(const Scene& scene, std::uint32_t frame);

}  // namespace hiac
