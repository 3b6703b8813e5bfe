#pragma once

#include <cstdint>
#include <string>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::test {

/// A mesh and a picture of it, made of a seed.
struct RandomScene {
  ZooMesh mesh;
  Scene scene;
};

/// Cells of what a random scene is made of: Delaunay and structured tetrahedra, with slivers; or
/// bricks, prisms, pyramids, wedges and all in one mesh, affine images or tapered; or cells of any
/// kind and order with twisted faces and curved edges.
enum class SceneCells : std::uint8_t { tetrahedra, other_kinds, curved };

/// Everything that changes what a pixel's error is: both projections, from outside and from within;
/// models of 1e-3 to 1e3 world units, up to 1e6 times their size away from the origin; flat ones;
/// node, cell and corner fields, some far from zero, the same or different ones for colour,
/// extinction and up to five isosurfaces; transfer functions with bends and jumps; thin to opaque
/// volumes of either glow; clipping slabs; lights; tolerances. Images are of about `side` x `side`
/// pixels.
RandomScene random_scene(SceneCells cells, std::uint64_t seed, std::uint32_t side);

}  // namespace hiac::test
