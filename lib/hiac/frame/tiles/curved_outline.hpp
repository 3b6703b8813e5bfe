#pragma once

#include <array>
#include <cstddef>

#include "hiac/frame/frame.hpp"
#include "hiac/geometry/face_form.hpp"

namespace hiac {

// Curved edges and faces on the screen, in homogeneous coordinates X, Y, W: a point lies at (X / W,
// Y / W), in front of the eye where W > 0. Projected nodes (ProjectedNode) are the source of these
// coordinates, so that edges and faces agree about which side of a pixel centre they lie on.

/// The control points of an edge of degree 1 to 3: their X, Y, W and ray parameters t.
using EdgeControls = std::array<std::array<double, 4>, 4>;
EdgeControls edge_controls(const Frame& frame, const EdgeNodes& edge);

/// The control points of a face: their X, Y, W and ray parameters t. Nodes of edges that count as
/// straight are moved onto these edges.
using FaceNets = std::array<PatchNet<double>, 4>;
FaceNets face_nets(const Frame& frame, CellId cell, std::size_t face, const FaceForm& form);

}  // namespace hiac
