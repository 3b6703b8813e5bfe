#pragma once

#include <functional>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::starter {

/// What the rays of a coarse grid over a picture meet.
struct MeasuredDepth {
  double coverage = 0;  ///< the share of the rays that meet cells
  double mean = 0;      ///< of the integral of the extinction along these rays
};

/// Follows 96 x 72 rays of a perspective camera through the mesh. A cell counts as the tetrahedra
/// between its corners' mean and triangles of its faces, with extinctions that are linear in each:
/// `extinction(cell, corner)` at its corners.
MeasuredDepth measure_depth(const ZooMesh& mesh, const Camera& camera, const ImageSize& size,
                            const std::function<double(CellId, std::size_t)>& extinction);

}  // namespace hiac::starter
