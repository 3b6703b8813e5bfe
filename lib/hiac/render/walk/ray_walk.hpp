#pragma once

#include "hiac/render/edges/tile_edges.hpp"
#include "hiac/render/pixels/tile.hpp"
#include "hiac/render/walk/ray_scene.hpp"
#include "hiac/render/walk/ray_starts.hpp"

namespace hiac {

/// Follows the rays of a tile's pixels from cell to cell and composites their segments, front to
/// back, with the edges on their faces (SkinPainter says which edges lie where), into the tile's
/// buffer, which has been reset. The method is that of M. P. Garrity, "Raytracing Irregular Volume
/// Data", 1990, with faces projected as by P. Bunyk, A. Kaufman and C. Silva, 1997.
///
/// A ray's way is decided by is_left alone, which is exact: rays neither leak through edges and
/// nodes nor end between cells. The depth at a face is computed once and serves both cells. A ray
/// that enters the mesh several times takes its ways through it in the order of the depths at which
/// they begin. The scene must be walkable.
///
/// The machine's best instruction set is chosen at run time.
void follow_rays(const RayScene& scene, const RayStarts& starts, const TileTarget& to,
                 TileEdges& edges);

}  // namespace hiac
