#include "hiac/render/runs/tile_runs.hpp"

#include <memory>
#include <vector>

#include "hiac/base/cancellation.hpp"
#include "hiac/frame/cell_groups.hpp"
#include "hiac/render/draw_cells.hpp"
#include "hiac/render/pixels/sorted_segments.hpp"
#include "hiac/render/runs/run_folder.hpp"

namespace hiac {
namespace {

// The number of cells between two looks whether all pixels are opaque. Where segments are listed
// before they are folded, the list stays in a core's cache if cells are small.
constexpr std::size_t kCellsPerList = 256;

class RunPainter {
 public:
  RunPainter(const Frame& frame, const SplattedCells& splatted, const VisibilityOrder& order,
             const TileRect& tile)
      : frame_(frame),
        splatted_(splatted),
        order_(order),
        tile_(tile),
        buffer_(std::make_unique_for_overwrite<TileBuffer>()),
        folder_(*buffer_, frame.witness_tolerance, frame.with_details, !splatted.none()) {
    buffer_->reset(tile, frame.projector, false);
  }

  TileRuns draw_all(std::span<const std::uint32_t> ranks) {
    add_splats(ranks);
    while (!ranks.empty()) {
      check_cancelled();
      const CellRun run = first_run(order_, ranks, kCellsPerList);
      draw_run(run);
      if (is_opaque()) break;
      ranks = ranks.subspan(run.ranks.size());
    }
    return folder_.take(counts_);
  }

 private:
  void add_splats(std::span<const std::uint32_t> ranks) {
    TileSplats splats(frame_, splatted_, order_.cells, ranks, tile_);
    if (splats.empty()) return;
    splats.append_rest(*buffer_, list_);
    for (std::size_t k = 0; k < list_.segments.size(); ++k) fold_one(k);
  }

  void draw_run(const CellRun& run) {
    // kernels fold by themselves where nothing but the order of cells has to be known
    if (!run.is_group && !frame_.with_details && splatted_.none())
      return draw_cells(run.ranks, nullptr);
    list_.clear();
    draw_cells(run.ranks, &list_);
    fold(run.is_group);
  }

  void draw_cells(std::span<const std::uint32_t> ranks, SegmentList* list) {
    const TileTarget to{frame_, tile_, *buffer_, list, counts_, &folder_.open()};
    for (std::size_t i = 0; i < ranks.size();) {
      const DrawCells draw = draw_for(frame_, order_.cells[ranks[i]]);
      cells_.clear();
      for (; i < ranks.size() && draw_for(frame_, order_.cells[ranks[i]]) == draw; ++i)
        if (const CellId cell = order_.cells[ranks[i]]; !splatted_.holds(cell))
          cells_.push_back(cell);
      draw(to, cells_);
    }
  }

  void fold(bool is_group) {
    if (is_group) {
      for (const std::uint32_t k : sorted_segments(list_)) fold_one(k);
    } else {
      for (std::size_t k = 0; k < list_.segments.size(); ++k) fold_one(k);
    }
  }

  void fold_one(std::size_t k) { folder_.add(list_.segments[k], details_of(k)); }

  [[nodiscard]] const SegmentDetails* details_of(std::size_t k) const {
    return list_.details.empty() ? nullptr : &list_.details[k];
  }

  [[nodiscard]] bool is_opaque() const {
    for (int y = tile_.y0; y < tile_.y1; ++y) {
      const double* row = buffer_->transparency.data() + tile_.index(tile_.x0, y);
      for (int x = 0; x < tile_.x1 - tile_.x0; ++x)
        if (row[x] > frame_.least_transparency) return false;
    }
    return true;
  }

  const Frame& frame_;
  const SplattedCells& splatted_;
  const VisibilityOrder& order_;
  TileRect tile_;
  std::unique_ptr<TileBuffer> buffer_;  // of the part alone: transparency, and where it ended
  RunFolder folder_;
  SegmentList list_;
  std::vector<CellId> cells_;
  TileCounts counts_;
};

}  // namespace

TileRuns draw_runs(const Frame& frame, const SplattedCells& splatted, const VisibilityOrder& order,
                   const TileRect& tile, std::span<const std::uint32_t> ranks) {
  return RunPainter(frame, splatted, order, tile).draw_all(ranks);
}

}  // namespace hiac
