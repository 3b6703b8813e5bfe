#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/preview/methods/method.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::test {

/// Light and alpha of one pixel by a method of the paper's section 7, slowly and to the letter, in
/// extended precision. Every linear tetrahedron is met by the ray in world space. M1: each slab
/// between breakpoints by itself. M0, M2 and M3, for tetrahedra without a breakpoint: the thickest
/// point is a corner in front of the others or the crossing of two edges, found by trying all; the
/// triangle with two corners that holds the pixel is the region; light at its corners by
/// quadrature. Shares no code with the preview. One field at the nodes; no isosurfaces, no
/// clipping. Throws std::invalid_argument for breakpoints with M0, M2 and M3.
std::array<double, 4> method_pixel(const ZooMesh& mesh, const Scene& scene, preview::Method method,
                                   std::span<const CellId> back_to_front, std::uint32_t x,
                                   std::uint32_t y);

}  // namespace hiac::test
