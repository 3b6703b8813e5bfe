#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/frame/cell_groups.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/frame/tiles/drawn_tile.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/render/edges/screen_edges.hpp"
#include "hiac/render/edges/tile_edges.hpp"
#include "hiac/render/pixels/tile.hpp"
#include "hiac/render/refine/pixel_refinement.hpp"
#include "hiac/render/skin_painter.hpp"
#include "hiac/render/splatting.hpp"

namespace hiac {

/// One tile, drawn by the accurate engine (engine.hpp).
class AccurateTile final : public DrawnTile {
 public:
  /// Draws the cells at these positions of the order. All arguments must outlive this object.
  AccurateTile(const Frame& frame, const SplattedCells& splatted, const ScreenEdges& edges,
               const VisibilityOrder& order, const TileRect& tile,
               std::span<const std::uint32_t> ranks);

  [[nodiscard]] const TilePixels& pixels() const override { return buffer_; }
  [[nodiscard]] const TileCounts& counts() const override { return counts_; }
  [[nodiscard]] const PixelFacts& facts(std::size_t at) const override {
    return buffer_.details[at];
  }
  [[nodiscard]] double error(std::size_t at, double background) override {
    return refinement_.error(buffer_, at, background);
  }
  [[nodiscard]] double surface_transparency(std::size_t at) const override {
    return tile_edges_.transparency(at) * skin_.transparency(at);
  }

 private:
  void draw_all(std::span<const std::uint32_t> ranks);
  void draw_run(const CellRun& run);
  void draw_cells(std::span<const std::uint32_t> ranks, SegmentList* group);
  [[nodiscard]] bool is_opaque() const;

  const Frame& frame_;
  const SplattedCells& splatted_;
  const VisibilityOrder& order_;
  TileRect tile_;
  TileSplats splats_;
  TileBuffer buffer_;
  TileCounts counts_;
  PixelRefinement refinement_;
  TileEdges tile_edges_;
  SkinPainter skin_;
  // of the current run
  SegmentList segments_;
  std::vector<CellId> cells_;
};

}  // namespace hiac
