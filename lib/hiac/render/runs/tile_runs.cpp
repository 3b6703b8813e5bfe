#include "hiac/render/runs/tile_runs.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hiac/base/cancellation.hpp"
#include "hiac/frame/cell_groups.hpp"
#include "hiac/render/draw_cells.hpp"
#include "hiac/render/edges/tile_edges.hpp"
#include "hiac/render/pixels/sorted_segments.hpp"
#include "hiac/render/runs/run_folder.hpp"
#include "hiac/render/skin_painter.hpp"

namespace hiac {
namespace {

// The number of cells between two looks whether all pixels are opaque. Where segments are listed
// before they are folded, the list stays in a core's cache if cells are small.
constexpr std::size_t kCellsPerList = 256;

class RunPainter {
 public:
  RunPainter(const Frame& frame, const SplattedCells& splatted, const EdgesOfPart& edges,
             const VisibilityOrder& order, const TileRect& tile)
      : frame_(frame),
        splatted_(splatted),
        order_(order),
        tile_(tile),
        buffer_(std::make_unique_for_overwrite<TileBuffer>()),
        folder_(*buffer_, frame.witness_tolerance, frame.with_details, !splatted.none()),
        edges_(edges),
        none_(frame, no_edges_, tile),
        skin_(frame, no_edges_, none_) {
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
    TileRuns runs = folder_.take(counts_);
    runs.edged = std::move(edged_);
    add_covers(runs);
    return runs;
  }

 private:
  void add_splats(std::span<const std::uint32_t> ranks) {
    TileSplats splats(frame_, splatted_, order_.cells, ranks, tile_);
    if (splats.empty()) return;
    splats.append_rest(*buffer_, list_);
    for (std::size_t k = 0; k < list_.segments.size(); ++k) fold_one(k);
  }

  void draw_run(const CellRun& run) {
    if (!run.is_group && is_folded_by_kernels()) return draw_cells(run.ranks, nullptr);
    list_.clear();
    places_.clear();
    draw_cells(run.ranks, &list_);
    fold(run.is_group);
  }

  // Where nothing but the order of cells has to be known.
  [[nodiscard]] bool is_folded_by_kernels() const {
    return !frame_.with_details && splatted_.none() && frame_.skin.faces.empty() &&
           edges_.mask == nullptr;
  }

  // `list`: null where kernels fold by themselves.
  void draw_cells(std::span<const std::uint32_t> ranks, SegmentList* list) {
    const TileTarget to{frame_, tile_, *buffer_, list, counts_, &folder_.open()};
    // null for cells with skin or edges on them, which are drawn one by one
    const auto draw_of = [&](std::uint32_t rank) -> DrawCells {
      const CellId cell = order_.cells[rank];
      const bool alone = frame_.skin.on(cell) != 0 || edges_.may_touch(cell);
      return alone ? nullptr : draw_for(frame_, cell);
    };
    for (std::size_t i = 0; i < ranks.size();) {
      const DrawCells draw = draw_of(ranks[i]);
      if (draw == nullptr) {
        draw_alone(order_.cells[ranks[i++]]);
        continue;
      }
      cells_.clear();
      for (; i < ranks.size() && draw_of(ranks[i]) == draw; ++i)
        if (const CellId cell = order_.cells[ranks[i]]; !splatted_.holds(cell))
          cells_.push_back(cell);
      draw(to, cells_);
    }
  }

  // The skin lies at the very ends of the cell's segments, so that these and it are one run.
  void draw_alone(CellId cell) {
    of_cell_.clear();
    crossings_.clear();
    const SkinPainter::ListedSkin skin =
        skin_.list({frame_, tile_, *buffer_, &of_cell_, counts_}, cell, !splatted_.holds(cell),
                   [&](const CellCrossing& ray, double front, double back) {
                     if (is_edged(tile_.index(ray.x, ray.y))) add_crossing(cell, ray, front, back);
                   });
    places_.resize(list_.segments.size());
    for (const std::uint32_t k : sorted_segments(of_cell_)) {
      const EdgedPhase phase = k < skin.entered ? EdgedPhase::inside
                               : k < skin.left  ? EdgedPhase::skin_entered
                                                : EdgedPhase::skin_left;
      const ListedSegment& segment = of_cell_.segments[k];
      places_.push_back({middle_of_ray(segment), phase});
      list_.segments.push_back(segment);
      if (!of_cell_.details.empty()) list_.details.push_back(of_cell_.details[k]);
    }
  }

  [[nodiscard]] bool is_edged(std::size_t at) const {
    return edges_.mask != nullptr && edges_.mask->holds(at);
  }

  // The middle of the ray's way through the cell at hand on which a segment lies.
  [[nodiscard]] std::optional<double> middle_of_ray(const ListedSegment& segment) const {
    const double at = segment.front + (segment.back - segment.front) / 2;
    std::optional<double> middle;
    double off = std::numeric_limits<double>::infinity();
    for (const Crossing& ray : crossings_) {
      if (ray.pixel != segment.pixel) continue;
      const double outside = std::max({ray.front - at, at - ray.back, 0.0});
      if (!(outside < off)) continue;
      off = outside;
      middle = ray.middle;
    }
    return middle;
  }

  void add_crossing(CellId cell, const CellCrossing& ray, double front, double back) {
    edged_.crossings.add(frame_, cell, ray, tile_, front, back, edges_.global_nodes);
    const EdgedCrossing& way = edged_.crossings.rays.back();
    crossings_.push_back({way.pixel, front, back, way.middle});
  }

  void add_covers(TileRuns& runs) const {
    if (frame_.skin.faces.empty()) return;
    for (int y = tile_.y0; y < tile_.y1; ++y)
      for (int x = tile_.x0; x < tile_.x1; ++x) {
        const std::size_t at = tile_.index(x, y);
        if (const double transparency = skin_.transparency(at); transparency != 1)
          runs.covers.push_back({static_cast<std::uint32_t>(at), transparency});
      }
  }

  void fold(bool is_group) {
    if (is_group) {
      for (const std::uint32_t k : sorted_segments(list_)) fold_one(k);
    } else {
      for (std::size_t k = 0; k < list_.segments.size(); ++k) fold_one(k);
    }
  }

  void fold_one(std::size_t k) {
    const ListedSegment& s = list_.segments[k];
    if (!is_edged(s.pixel)) return folder_.add(s, details_of(k));
    buffer_->transparency[s.pixel] *= s.light.transparency;
    const EdgedPlace place = k < places_.size() ? places_[k] : EdgedPlace{};
    edged_.segments.push_back(
        {.pixel = static_cast<std::uint32_t>(s.pixel),
         .phase = place.phase,
         .middle = place.middle.value_or(s.front + (s.back - s.front) / 2),
         .front = s.front,
         .back = s.back,
         .light = s.light,
         .details = list_.details.empty() ? SegmentDetails{} : list_.details[k]});
  }

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
  const EdgesOfPart& edges_;
  ScreenEdges no_edges_;
  TileEdges none_;
  SkinPainter skin_;
  EdgedTile edged_;
  SegmentList list_;
  // Of the list's segments: the middle of the ray in the cell, if another than that of the segment.
  struct EdgedPlace {
    std::optional<double> middle = {};
    EdgedPhase phase = EdgedPhase::inside;
  };
  std::vector<EdgedPlace> places_;  // none for the segments at the end
  // of the cell at hand, in pixels with edges
  struct Crossing {
    std::size_t pixel;
    double front, back, middle;
  };
  std::vector<Crossing> crossings_;
  SegmentList of_cell_;  // that is drawn alone
  std::vector<CellId> cells_;
  TileCounts counts_;
};

}  // namespace

TileRuns draw_runs(const Frame& frame, const SplattedCells& splatted, const EdgesOfPart& edges,
                   const VisibilityOrder& order, const TileRect& tile,
                   std::span<const std::uint32_t> ranks) {
  return RunPainter(frame, splatted, edges, order, tile).draw_all(ranks);
}

}  // namespace hiac
