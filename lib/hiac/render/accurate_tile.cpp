#include "hiac/render/accurate_tile.hpp"

#include "hiac/base/cancellation.hpp"
#include "hiac/render/draw_cells.hpp"

namespace hiac {
namespace {

// The number of cells between two tests whether a tile's pixels are all opaque.
constexpr std::size_t kCellsPerLook = 256;
// The order accesses the arrays of cells at random: kernels are prefetched this many cells ahead.
constexpr std::size_t kCellsAhead = 16;

}  // namespace

AccurateTile::AccurateTile(const Frame& frame, const SplattedCells& splatted,
                           const ScreenEdges& edges, const VisibilityOrder& order,
                           const TileRect& tile, std::span<const std::uint32_t> ranks)
    : frame_(frame),
      splatted_(splatted),
      order_(order),
      tile_(tile),
      splats_(frame, splatted, order.cells, ranks, tile),
      refinement_(frame, order, tile, ranks),
      tile_edges_(frame, edges, tile),
      skin_(frame, edges, tile_edges_) {
  buffer_.reset(tile, frame.projector, frame.with_details);
  draw_all(ranks);
}

void AccurateTile::draw_all(std::span<const std::uint32_t> ranks) {
  while (!ranks.empty()) {
    check_cancelled();
    const CellRun run = first_run(order_, ranks, kCellsPerLook);
    draw_run(run);
    if (is_opaque()) return;
    ranks = ranks.subspan(run.ranks.size());
  }
  if (splats_.empty() && tile_edges_.empty()) return;
  segments_.clear();
  tile_edges_.append_rest({frame_, tile_, buffer_, &segments_, counts_});
  splats_.append_rest(buffer_, segments_);
  composite_sorted(segments_, frame_.witness_tolerance, buffer_, counts_);
}

void AccurateTile::draw_run(const CellRun& run) {
  if (!run.is_group && splats_.empty()) return draw_cells(run.ranks, nullptr);
  segments_.clear();
  draw_cells(run.ranks, &segments_);
  skin_.settle({frame_, tile_, buffer_, &segments_, counts_});
  splats_.append_before(buffer_, segments_);
  composite_sorted(segments_, frame_.witness_tolerance, buffer_, counts_);
}

void AccurateTile::draw_cells(std::span<const std::uint32_t> ranks, SegmentList* group) {
  const TileTarget to{frame_, tile_, buffer_, group, counts_};
  // null for cells with skin or edges on them, which are drawn one by one
  const auto draw_of = [&](std::uint32_t rank) -> DrawCells {
    const CellId cell = order_.cells[rank];
    return skin_.concerns(cell) ? nullptr : draw_for(frame_, cell);
  };
  for (std::size_t i = 0; i < ranks.size();) {
    const DrawCells draw = draw_of(ranks[i]);
    if (draw == nullptr) {
      const CellId cell = order_.cells[ranks[i++]];
      skin_.draw(to, cell, !splatted_.holds(cell));
      continue;
    }
    cells_.clear();
    for (; i < ranks.size() && draw_of(ranks[i]) == draw; ++i) {
      if (i + kCellsAhead < ranks.size())
        __builtin_prefetch(&frame_.kernel_cells[order_.cells[ranks[i + kCellsAhead]]]);
      if (const CellId cell = order_.cells[ranks[i]]; !splatted_.holds(cell))
        cells_.push_back(cell);
    }
    draw(to, cells_);
  }
}

bool AccurateTile::is_opaque() const {
  for (int y = tile_.y0; y < tile_.y1; ++y) {
    const double* row = buffer_.transparency.data() + tile_.index(tile_.x0, y);
    for (int x = 0; x < tile_.x1 - tile_.x0; ++x)
      if (row[x] > frame_.least_transparency) return false;
  }
  return true;
}

}  // namespace hiac
