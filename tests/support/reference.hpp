#pragma once

#include <array>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::test {

/// Red, green, blue (without background) and alpha of one pixel by brute force: every linear
/// tetrahedron against the ray, segments sorted by depth, adaptive Gauss-Legendre quadrature of the
/// radiance integral (5), (6) to 1e-15, isosurfaces where the linear field takes their values, all
/// in extended precision. With an integration other than exact, each piece by its definition.
/// Shares no code with the engine.
std::array<double, 4> reference_pixel(const ZooMesh& mesh, const Scene& scene, std::uint32_t x,
                                      std::uint32_t y);

}  // namespace hiac::test
