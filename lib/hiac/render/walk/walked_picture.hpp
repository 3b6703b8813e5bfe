#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "hiac/frame/tiles/picture.hpp"
#include "hiac/render/edges/chosen_edges.hpp"
#include "hiac/render/walk/walkable_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// The picture of a scene as render() makes it, to within rounding, without an order of the cells:
/// the ray of every pixel is followed from cell to cell (ray_walk.hpp). What it takes grows with
/// the number of cells that rays meet, not with that of all cells, which makes it the faster way
/// where a pixel has several cells. None for scenes that are not walkable (RayScene). Mesh and
/// scene must pass check_renderable. `edges`: mesh_edges if the scene draws edges, otherwise null.
std::optional<RenderResult> walked_picture(const WalkableMesh& mesh, const Scene& scene,
                                           const MeshEdges* edges, bool with_background);

/// Whether following rays takes less time than making an order and drawing in it. With random
/// tetrahedra it does up to 64 pixels for each cell of a cross-section (cells^(2/3)).
bool is_faster_walked(std::size_t cells, std::uint64_t pixels);

}  // namespace hiac
