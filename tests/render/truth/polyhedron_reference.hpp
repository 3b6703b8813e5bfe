#pragma once

#include <array>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::test {

/// Red, green, blue (without background) and alpha of one pixel by brute force: every cell
/// of any kind with straight edges against the ray (clipped by the planes of its faces), segments
/// sorted by depth, the fields by Newton's inverse map wherever they are needed, adaptive
/// quadrature of the radiance integral (5), (6) to 1e-16, isosurfaces by bisection, all in extended
/// precision. Shares nothing with the engine but the shape functions. Steps in transfer functions
/// are located to 1e-10 only.
std::array<double, 4> polyhedron_reference(const ZooMesh& mesh, const Scene& scene, double x,
                                           double y);

}  // namespace hiac::test
