#pragma once

#include <functional>
#include <vector>

namespace hiac::preview {

/// A corner of a triangle of a homogeneous region (Williams, Max, Stein 1998, section 7): a part of
/// a cell's projection that no projected edge of the cell crosses, so that a ray in it enters by
/// one face and leaves by one.
struct RegionVertex {
  float x, y;            ///< pixel coordinates of the frame (frame/projection.hpp), y down
  float length;          ///< of the ray in the cell, world units
  float tau_front;       ///< extinction where the ray enters, per world unit
  float tau_back;        ///< ... and where it leaves
  float kappa_front[3];  ///< colour there: chromaticity, or emission per world unit
  float kappa_back[3];
};
static_assert(sizeof(RegionVertex) == 11 * sizeof(float), "what the vertex layout describes");

/// Appends whole triangles (three vertices each) of the next cells, back to front, to a vector that
/// is empty when it is called: as many as it likes, some ten thousand cells a call. Returns false,
/// and appends nothing, when there are no more. Called from one thread.
using RegionFill = std::function<bool(std::vector<RegionVertex>& triangles)>;

}  // namespace hiac::preview
