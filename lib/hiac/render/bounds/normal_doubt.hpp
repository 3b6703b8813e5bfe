#pragma once

#include <array>
#include <cstddef>

#include "hiac/frame/frame.hpp"

namespace hiac {

// How far the normals of the skin (CellSkin) may be off those of the true faces: angles, in
// radians. 2 or more where nothing is known.

/// Of a face that counts as planar. The normals of a bilinear face are combinations, with weights
/// >= 0, of those at its corners; inner nodes off their places by d add at most 2 n w d to a
/// derivative, with n the face's degree and w the largest sum of a control point's weights
/// (PatchWeights).
double planar_normal_doubt(const Frame& frame, CellId cell, std::size_t face);

/// Of a point of a curved face, given by reference coordinates, that may be `off` by this much from
/// the point that the ray meets, world units. Second derivatives in Bernstein form bound how the
/// face turns between the two.
double curved_normal_doubt(const Frame& frame, CellId cell, std::size_t face,
                           const std::array<double, 3>& reference, double off);

}  // namespace hiac
