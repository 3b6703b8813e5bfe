#include "hiac/render/runs/part_engine.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "hiac/base/error.hpp"
#include "hiac/frame/tiles/picture.hpp"
#include "hiac/frame/tiles/screen_bounds.hpp"
#include "hiac/render/bounds/bounded_scene.hpp"
#include "hiac/render/edges/tile_edges.hpp"
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

double PartEngine::nearest(const VisibilityOrder& order,
                           std::span<const std::uint32_t> ranks) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t rank : ranks)
    nearest = std::min(nearest, screen_bounds(frame_, order.cells[rank]).nearest);
  return nearest - frame_.witness_tolerance;  // of which depths that are computed may be off
}

TileRuns PartEngine::draw(const VisibilityOrder& order, const TileRect& tile,
                          std::span<const std::uint32_t> ranks, const PixelMask* mask) const {
  const bool on_all_cells = scene_.edges && scene_.edges->show == EdgeChoice::all;
  const bool any = mask != nullptr && mask->any();
  const EdgesOfPart edges{any ? mask : nullptr, on_all_cells, boundary_, global_nodes_};
  TileRuns runs = draw_runs(frame_, *splatted_, edges, order, tile, ranks);
  if (any) add_fragments(tile, runs.edged.fragments);
  return runs;
}

void PartEngine::set_edges(std::span<const EdgeNodes> edges, std::vector<std::uint8_t> boundary,
                           std::span<const std::uint64_t> global_nodes) {
  edges_ = ScreenEdges(frame_, scene_, boundary, edges);
  boundary_ = std::move(boundary);
  global_nodes_ = global_nodes;
}

bool PartEngine::mark_edges(const TileRect& tile, PixelMask& mask) const {
  const TileEdges edges(frame_, edges_, tile);
  edges.visit_all([&](std::size_t at, double, const TileEdges::Place&) { mask.add(at); });
  return !edges.empty();
}

void PartEngine::add_fragments(const TileRect& tile, std::vector<EdgeFragment>& fragments) const {
  const auto global = [&](NodeId node) {
    return node == kNoNode ? kNoGlobalNode : global_nodes_[node];
  };
  const TileEdges edges(frame_, edges_, tile);
  edges.visit_all([&](std::size_t at, double share, const TileEdges::Place& place) {
    const EdgePiece& piece = *place.piece;
    fragments.push_back(
        {static_cast<std::uint32_t>(at),
         share,
         place.t,
         {piece.x0, piece.y0, piece.x1, piece.y1, scene_.edges->width},
         {{global(piece.edge[0]), global(piece.edge[1])}, place.along, global(place.node)}});
  });
}

void require_parted_scene(const Scene& scene, std::span<const Channel> channels) {
  if (details_for(channels) != Details::bounded) return;
  require_bounded_scene(scene);
  if (scene.skin)
    throw UsageError(
        "channel 'error': no bound is claimed of the skin of a mesh in parts (`skin`)");
}

}  // namespace hiac
