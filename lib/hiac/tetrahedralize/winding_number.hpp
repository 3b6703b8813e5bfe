#pragma once

#include <array>
#include <cstddef>

#include "hiac/tetrahedralize/surface.hpp"

namespace hiac {

/// How the triangles of a surface are joined and oriented. Edges are pairs of Surface::points.
struct SurfaceOrientation {
  /// Edges along which triangles do not run equally often in both directions: where there is one,
  /// the triangles do not agree on what is inside, as at a triangle turned over, or at a wall
  /// between two parts.
  std::size_t opposed_edges = 0;
  /// Every edge has two triangles, and edges connect all triangles: one part of space is enclosed.
  bool single_shell = true;
};

/// Requires surface.triangulated().
SurfaceOrientation surface_orientation(const Surface& surface);

/// How often a surface winds around a point: the number of its triangles that a ray from the point
/// leaves through (seen from ahead they turn counter-clockwise), less the number of those that it
/// enters through. It is 1 inside a shell that is oriented outwards, -1 inside one that is oriented
/// inwards, 0 outside, and their sum inside several shells.
///
/// Exact for the coordinates as given: the ray is that along x from a point that is moved by an
/// infinitesimal along y and by its square along z (H. Edelsbrunner, E. P. Mücke, "Simulation of
/// Simplicity", 1990), so that it meets no edge. Requires surface.triangulated(), no opposed edges,
/// and a point that is not on the surface. Takes time in proportion to the triangles.
int winding_number(const Surface& surface, const std::array<double, 3>& point);

}  // namespace hiac
