#include "hiac/render/engine.hpp"

#include <optional>
#include <vector>

#include "hiac/base/error.hpp"
#include "hiac/base/seconds.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/frame/tiles/tile_bins.hpp"
#include "hiac/render/accurate_tile.hpp"
#include "hiac/render/edges/screen_edges.hpp"
#include "hiac/render/splatting.hpp"

namespace hiac {

struct PartRenderer::Prepared {
  const VisibilityOrder& order;
  const Scene& scene;
  std::vector<Channel> channels;
  double start;
  Projector projector;
  Frame frame;
  SplattedCells splatted;
  ScreenEdges edges;
  double seconds = 0;

  Prepared(const ZooMesh& mesh, const VisibilityOrder& visibility, const Scene& what,
           std::span<const Channel> wanted)
      : order(visibility),
        scene(what),
        channels(wanted.begin(), wanted.end()),
        start(seconds_now()),
        projector(scene.camera, scene.image),
        frame(mesh, scene, projector, details_for(channels)),
        splatted(frame, scene.image, scene.render.splat_below),
        edges(frame, scene) {
    require_bound();
    seconds = seconds_now() - start;
  }

  void require_bound() const {
    if (!frame.with_error) return;
    if (frame.optics.rule != PieceRule::exact)
      throw UsageError(
          "channel 'error': no bound is claimed of integrations other than \"exact\" "
          "(`render.integration`)");
    if (scene.render.interpolation != Interpolation::isoparametric)
      throw UsageError(
          "channel 'error': no bound is claimed of interpolations other than \"isoparametric\" "
          "(`render.interpolation`)");
    if (scene.render.splat_below > 0)
      throw UsageError("channel 'error': no bound is claimed of splats (`render.splat_below`)");
    if (scene.skin) throw UsageError("channel 'error': no bound is claimed of the skin (`skin`)");
  }
};

PartRenderer::PartRenderer(const ZooMesh& mesh, const VisibilityOrder& order, const Scene& scene,
                           std::span<const Channel> channels)
    : prepared_(std::make_unique<const Prepared>(mesh, order, scene, channels)) {}

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
      frame, scene, bins, {part, with_background, prepared_->channels},
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
