#pragma once

#include <cstdint>

#include "hiac/scene/scene.hpp"

namespace hiac {

/// The number of frames of a scene: 1 without a path; to the last keyframe; the turntable's.
std::uint32_t frame_count(const Scene& scene);

/// The camera at a frame below frame_count.
///
/// Keyframes: at a keyframe it is that one's, to the bit. Between two of them eye and look_at run
/// along a straight line, or along a Catmull-Rom spline (E. Catmull, R. Rom, "A Class of Local
/// Interpolating Splines", 1974) over the frame numbers: cubic pieces whose velocity at a keyframe
/// is that from the keyframe before it to the one after it, and at either end that of the straight
/// line to the next. All else (the direction of `up`, fov, height, clip) runs linearly; like every
/// camera's, `up` counts by its part perpendicular to the view direction.
///
/// Turntable: eye and up are turned about the axis through look_at, counter-clockwise as seen from
/// the axis' tip, by degrees * frame / frames; quarter turns are exact where coordinates allow it.
Camera camera_at(const Scene& scene, std::uint32_t frame);

/// The scene of one frame alone: with its camera, and without a path.
Scene scene_of_frame(const Scene& scene, std::uint32_t frame);

}  // namespace hiac
