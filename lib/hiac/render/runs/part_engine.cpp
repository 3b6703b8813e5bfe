#include "hiac/render/runs/part_engine.hpp"

#include <algorithm>

#include "hiac/base/error.hpp"
#include "hiac/frame/tiles/picture.hpp"
#include "hiac/render/bounds/bounded_scene.hpp"
#include "hiac/render/runs/tile_runs.hpp"

namespace hiac {

PartEngine::PartEngine(const ZooMesh& part, const Scene& scene, std::span<const Channel> channels)
    : scene_(scene),
      projector_(scene.camera, scene.image),
      frame_(part, scene, projector_, details_for(channels)) {}

std::vector<TouchedFace> PartEngine::touched_faces() const {
  return touched_boundary_faces(frame_.mesh, frame_.isosurfaces);
}

void PartEngine::close_faces(std::span<const TouchedFace> faces) {
  for (const TouchedFace& face : faces) close_face(face, frame_.isosurfaces);
}

void PartEngine::set_whole(const MeshExtremes& extremes) {
  set_constants(frame_, scene_, extremes);
  splatted_.emplace(frame_, scene_.image, scene_.render.splat_below);
}

TileBins PartEngine::bins(const VisibilityOrder& order, const PixelRect& rect) const {
  return bin_cells(frame_, order, scene_.image, rect, splat_bounds(frame_, *splatted_));
}

TileRuns PartEngine::draw(const VisibilityOrder& order, const TileRect& tile,
                          std::span<const std::uint32_t> ranks) const {
  return draw_runs(frame_, *splatted_, order, tile, ranks);
}

void require_parted_scene(const Scene& scene, std::span<const Channel> channels) {
  if (scene.skin)
    throw UsageError("`skin`: is not drawn of a mesh in parts, which do not know its boundary");
  if (scene.edges)
    throw UsageError("`edges`: are not drawn of a mesh in parts, which do not know its boundary");
  if (details_for(channels) == Details::bounded) require_bounded_scene(scene);
}

}  // namespace hiac
