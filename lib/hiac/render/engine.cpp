#include "hiac/render/engine.hpp"

#include <optional>
#include <vector>

#include "hiac/base/seconds.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/frame/tiles/tile_bins.hpp"
#include "hiac/render/accurate_tile.hpp"
#include "hiac/render/bounds/bounded_scene.hpp"
#include "hiac/render/edges/screen_edges.hpp"
#include "hiac/render/splatting.hpp"

namespace hiac {

struct PartRenderer::Prepared {
  const VisibilityOrder& order;
  const Scene& scene;
  std::vector<Channel> channels;
  const TileCrew* crew;
  double start;
  Projector projector;
  Frame frame;
  SplattedCells splatted;
  ScreenEdges edges;
  double seconds = 0;

  Prepared(const ZooMesh& mesh, const VisibilityOrder& visibility, const Scene& what,
           std::span<const Channel> wanted, const TileCrew* sharing)
      : order(visibility),
        scene(what),
        channels(wanted.begin(), wanted.end()),
        crew(sharing),
        start(seconds_now()),
        projector(scene.camera, scene.image),
        frame(mesh, scene, projector, details_for(channels)),
        splatted(frame, scene.image, scene.render.splat_below),
        edges(frame, scene) {
    if (frame.with_error) require_bounded_scene(scene);
    seconds = seconds_now() - start;
  }
};

PartRenderer::PartRenderer(const ZooMesh& mesh, const VisibilityOrder& order, const Scene& scene,
                           std::span<const Channel> channels, const TileCrew* crew)
    : prepared_(std::make_unique<const Prepared>(mesh, order, scene, channels, crew)) {}

PartRenderer::~PartRenderer() = default;

double PartRenderer::prepare_seconds() const { return prepared_->seconds; }

RenderResult PartRenderer::render(const PixelRect& part, bool with_background,
                                  Progress* progress) const {
  const Frame& frame = prepared_->frame;
  const SplattedCells& splatted = prepared_->splatted;
  const VisibilityOrder& order = prepared_->order;
  const Scene& scene = prepared_->scene;
  require_inside(part, scene.image);
  const double start = seconds_now();
  const TileBins bins = bin_cells(frame, order, scene.image, part, splat_bounds(frame, splatted));
  const double prepared = seconds_now() - start;
  RenderResult result = draw_picture(
      frame, scene, bins, {part, with_background, prepared_->channels, prepared_->crew},
      [&](const TileRect& tile, std::span<const std::uint32_t> ranks, const TakeTile& take) {
        AccurateTile drawn(frame, splatted, prepared_->edges, order, tile, ranks);
        take(drawn);
      },
      progress);
  result.statistics.splatted_cells = splatted.count();
  result.statistics.prepare_seconds = prepared;
  return result;
}

RenderResult render(const ZooMesh& mesh, const VisibilityOrder& order, const Scene& scene,
                    bool with_background, Progress* progress, std::span<const Channel> channels) {
  const PartRenderer renderer(mesh, order, scene, channels);
  RenderResult result = renderer.render(whole_picture(scene.image), with_background, progress);
  result.statistics.prepare_seconds += renderer.prepare_seconds();
  return result;
}

}  // namespace hiac
