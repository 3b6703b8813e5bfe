#include "hiac/render/engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "hiac/base/cancellation.hpp"
#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/base/progress.hpp"
#include "hiac/base/seconds.hpp"
#include "hiac/frame/background.hpp"
#include "hiac/frame/cell_groups.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/render/draw_cells.hpp"
#include "hiac/render/pixels/tile.hpp"
#include "hiac/render/pixels/tile_bins.hpp"
#include "hiac/render/refine/pixel_refinement.hpp"
#include "hiac/render/splatting.hpp"

namespace hiac {
namespace {

// Between two looks at whether a tile's pixels are all opaque.
constexpr std::size_t kCellsPerLook = 256;
// The order leads all over the arrays of cells: their kernels are fetched this many cells before
// they are asked for.
constexpr std::size_t kFetchAhead = 16;

bool all_opaque(const TileBuffer& buffer, const TileRect& tile, double least) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    const double* row =
        buffer.transparency.data() + static_cast<std::size_t>(y - tile.y0) * kTileStride;
    for (int x = 0; x < tile.x1 - tile.x0; ++x)
      if (row[x] > least) return false;
  }
  return true;
}

// Renders one tile from its cells.
class TileRenderer {
 public:
  TileRenderer(const Frame& frame, const SplattedCells& splatted, const VisibilityOrder& order,
               const TileRect& tile, std::span<const std::uint32_t> ranks)
      : frame_(frame),
        splatted_(splatted),
        order_(order),
        tile_(tile),
        ranks_(ranks),
        splats_(frame, splatted, order.cells, ranks, tile) {
    buffer_.reset(tile, frame.projector, frame.with_details);
  }

  void render() {
    std::size_t begin = 0;
    while (begin < ranks_.size()) {
      check_cancelled();
      const CellGroup* group = group_of(order_, ranks_[begin]);
      const std::uint32_t stop =
          group != nullptr ? group->first + group->count : next_group_first(order_, ranks_[begin]);
      std::size_t end = begin;
      while (end < ranks_.size() && ranks_[end] < stop &&
             (group != nullptr || end - begin < kCellsPerLook))
        ++end;
      segments_.clear();
      const bool sorted = group != nullptr || !splats_.empty();
      render_run(ranks_.subspan(begin, end - begin), sorted ? &segments_ : nullptr);
      if (sorted) {
        splats_.append_before(buffer_, segments_);
        composite_sorted(segments_, frame_.witness_tolerance, buffer_, counts_);
      }
      if (all_opaque(buffer_, tile_, frame_.least_transparency)) return;
      begin = end;
    }
    if (splats_.empty()) return;
    segments_.clear();
    splats_.append_rest(buffer_, segments_);
    composite_sorted(segments_, frame_.witness_tolerance, buffer_, counts_);
  }

  [[nodiscard]] const TileBuffer& buffer() const { return buffer_; }
  [[nodiscard]] const TileCounts& counts() const { return counts_; }

 private:
  [[nodiscard]] DrawCells draw_for_rank(std::uint32_t rank) const {
    return draw_for(frame_, order_.cells[rank]);
  }

  void render_run(std::span<const std::uint32_t> ranks, SegmentList* group) {
    std::size_t begin = 0;
    while (begin < ranks.size()) {
      const DrawCells draw = draw_for_rank(ranks[begin]);
      cells_.clear();
      for (; begin < ranks.size() && draw_for_rank(ranks[begin]) == draw; ++begin) {
        if (begin + kFetchAhead < ranks.size())
          __builtin_prefetch(&frame_.kernel_cells[order_.cells[ranks[begin + kFetchAhead]]]);
        if (const CellId cell = order_.cells[ranks[begin]]; !splatted_.holds(cell))
          cells_.push_back(cell);
      }
      draw(frame_, cells_, tile_, buffer_, group, counts_);
    }
  }

  const Frame& frame_;
  const SplattedCells& splatted_;
  const VisibilityOrder& order_;
  TileRect tile_;
  std::span<const std::uint32_t> ranks_;
  TileSplats splats_;
  TileBuffer buffer_;
  SegmentList segments_;
  std::vector<CellId> cells_;
  TileCounts counts_;
};

// One channel of a finished pixel. `background`: the largest channel behind it.
double channel_value(Channel channel, const PixelRefinement::Drawn& drawn, const Frame& frame,
                     double background, PixelRefinement& refinement) {
  const PixelDetails& pixel = *drawn.details;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  switch (channel) {
    case Channel::depth:
      return frame.projector.distance(pixel.first);
    case Channel::mean_depth:
      return pixel.weight > 0 ? frame.projector.distance(pixel.weighted_depth / pixel.weight)
                              : kInfinity;
    case Channel::transparency:
      return drawn.transparency;
    case Channel::cells:
      return pixel.cells;
    case Channel::witness:
      return pixel.violations;
    case Channel::error:
      break;
  }
  const double error = refinement.error(drawn, background);
  return std::isnan(error) ? kInfinity : error;  // nothing is known
}

// What a tile leaves behind besides its pixels.
struct TileSummary {
  TileCounts counts;
  double optical_depth_sum = 0, optical_depth_most = 0;
  std::uint64_t covered = 0;
};

// Writes what of a tile lies in the part of the picture that the image shows.
TileSummary write_tile(const TileBuffer& buffer, const TileRect& tile, const Frame& frame,
                       const Scene& scene, bool with_background, std::span<const Channel> channels,
                       const PixelRect& part, PixelRefinement& refinement, Image& image) {
  TileSummary summary;
  const int left = static_cast<int>(part.x), top = static_cast<int>(part.y);
  const int x0 = std::max(tile.x0, left), y0 = std::max(tile.y0, top);
  const int x1 = std::min(tile.x1, left + static_cast<int>(part.width));
  const int y1 = std::min(tile.y1, top + static_cast<int>(part.height));
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const std::size_t at = static_cast<std::size_t>(y - tile.y0) * kTileStride +
                             static_cast<std::size_t>(x - tile.x0);
      const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
      const double transparency = buffer.transparency[at];
      const auto pixel = image.pixel(column - part.x, row - part.y);
      const Color behind =
          with_background ? background_at(scene.background, scene.image, column, row) : Color{};
      pixel[0] = buffer.red[at] + transparency * behind[0];
      pixel[1] = buffer.green[at] + transparency * behind[1];
      pixel[2] = buffer.blue[at] + transparency * behind[2];
      pixel[3] = 1 - transparency;
      for (std::size_t c = 0; c < channels.size(); ++c)
        pixel[4 + c] = channel_value(channels[c],
                                     {x,
                                      y,
                                      {buffer.red[at], buffer.green[at], buffer.blue[at]},
                                      transparency,
                                      &buffer.details[at]},
                                     frame, std::ranges::max(behind), refinement);
      if (buffer.last[at] == -std::numeric_limits<double>::infinity()) continue;
      const double depth = -std::log(std::max(transparency, std::numeric_limits<double>::min()));
      summary.optical_depth_sum += depth;
      summary.optical_depth_most = std::max(summary.optical_depth_most, depth);
      ++summary.covered;
    }
  }
  return summary;
}

Details details_for(std::span<const Channel> channels) {
  if (channels.empty()) return Details::none;
  return std::ranges::find(channels, Channel::error) == channels.end() ? Details::described
                                                                       : Details::bounded;
}

}  // namespace

RenderStatistics& RenderStatistics::operator+=(const RenderStatistics& other) {
  segments += other.segments;
  violations += other.violations;
  const auto pixels = static_cast<double>(covered_pixels),
             more = static_cast<double>(other.covered_pixels);
  if (more > 0)
    mean_optical_depth =
        (mean_optical_depth * pixels + other.mean_optical_depth * more) / (pixels + more);
  largest_optical_depth = std::max(largest_optical_depth, other.largest_optical_depth);
  covered_pixels += other.covered_pixels;
  splatted_cells = std::max(splatted_cells, other.splatted_cells);
  prepare_seconds += other.prepare_seconds;
  tile_seconds += other.tile_seconds;
  return *this;
}

struct PartRenderer::Prepared {
  const VisibilityOrder& order;
  const Scene& scene;
  std::vector<Channel> channels;
  double start;
  Projector projector;
  Frame frame;
  SplattedCells splatted;
  double seconds = 0;

  Prepared(const ZooMesh& mesh, const VisibilityOrder& visibility, const Scene& what,
           std::span<const Channel> wanted)
      : order(visibility),
        scene(what),
        channels(wanted.begin(), wanted.end()),
        start(seconds_now()),
        projector(scene.camera, scene.image),
        frame(mesh, scene, projector, details_for(channels)),
        splatted(frame, scene.image, scene.render.splat_below) {
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
  const VisibilityOrder& order = prepared_->order;
  const Scene& scene = prepared_->scene;
  require_inside(part, scene.image);
  const double start = seconds_now();
  const TileBins bins = bin_cells(frame, prepared_->splatted, order, scene.image, part);
  std::vector<std::string> names = rgba_channels();
  for (const Channel channel : prepared_->channels) names.emplace_back(channel_name(channel));
  RenderResult result{Image(part.width, part.height, std::move(names)), {}};
  const double prepared = seconds_now();
  if (progress != nullptr) progress->begin("tiles", bins.tiles.size());

  std::vector<TileSummary> summaries(bins.tiles.size());
  parallel_for(bins.tiles.size(), 1, [&](IndexRange range) {
    const std::size_t tile = range.begin;
    TileRenderer renderer(frame, prepared_->splatted, order, bins.tiles[tile], bins.cells_of(tile));
    renderer.render();
    PixelRefinement refinement(frame, order, bins.tiles[tile], bins.cells_of(tile));
    summaries[tile] = write_tile(renderer.buffer(), bins.tiles[tile], frame, scene, with_background,
                                 prepared_->channels, part, refinement, result.image);
    summaries[tile].counts = renderer.counts();
    if (progress != nullptr) progress->advance();
  });

  RenderStatistics& statistics = result.statistics;
  for (const TileSummary& summary : summaries) {
    statistics.segments += summary.counts.segments;
    statistics.violations += summary.counts.violations;
    statistics.covered_pixels += summary.covered;
    statistics.mean_optical_depth += summary.optical_depth_sum;
    statistics.largest_optical_depth =
        std::max(statistics.largest_optical_depth, summary.optical_depth_most);
  }
  if (statistics.covered_pixels > 0)
    statistics.mean_optical_depth /= static_cast<double>(statistics.covered_pixels);
  statistics.splatted_cells = prepared_->splatted.count();
  statistics.prepare_seconds = prepared - start;
  statistics.tile_seconds = seconds_now() - prepared;
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
