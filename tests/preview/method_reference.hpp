#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/preview/methods/method.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::test {

/// Light and alpha of one pixel by a method of the paper's section 7, slowly and to the letter, in
/// extended precision. Every linear tetrahedron is met by the ray in world space, and its slabs
/// between breakpoints are taken one by one. The region around the pixel is what the polygons by
/// which the ray enters and leaves the slab have in common on the screen; light at its corners is
/// found by quadrature, and interpolated in the triangle around the corner where the slab is
/// thickest that holds the pixel. Opacity, but for M0's, is that of the pixel's own way.
/// Shares no code with the preview. One field at the nodes; no isosurfaces, no clipping.
std::array<double, 4> method_pixel(const ZooMesh& mesh, const Scene& scene, preview::Method method,
                                   std::span<const CellId> back_to_front, std::uint32_t x,
                                   std::uint32_t y);

}  // namespace hiac::test
