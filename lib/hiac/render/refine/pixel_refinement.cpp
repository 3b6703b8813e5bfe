#include "hiac/render/refine/pixel_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hiac/base/cancellation.hpp"
#include "hiac/base/rounding.hpp"
#include "hiac/base/special_values.hpp"
#include "hiac/frame/cell_groups.hpp"
#include "hiac/render/bounds/error_bound.hpp"

namespace hiac {
namespace {

using Real = long double;

// Relative to the tolerance: pixels with larger bounds are recomputed.
constexpr double kLargeBound = 0.1;
// Relative to the transparency at which the engine ends a ray: recomputation ends its rays at this
// transparency.
constexpr double kEndSooner = 0x1p-10;

}  // namespace

PixelRefinement::PixelRefinement(const Frame& frame, const VisibilityOrder& order,
                                 const TileRect& tile, std::span<const std::uint32_t> ranks)
    : frame_(frame),
      order_(order),
      tile_(tile),
      ranks_(ranks),
      segments_(frame),
      cell_segments_(frame) {}

void PixelRefinement::set_boxes() {
  boxes_.reserve(ranks_.size());
  for (const std::uint32_t rank : ranks_) {
    const CellId cell = order_.cells[rank];
    Box box{kInfinity, kInfinity, -kInfinity, -kInfinity};
    bool bounded = order_of(frame_.mesh.kinds[cell]) == CellOrder::linear;
    for (const NodeId id : frame_.mesh.cell_nodes(cell)) {
      const ProjectedNode& p = frame_.nodes[id];
      bounded = bounded && !std::isnan(p.depth);
      box = {std::min(box.x0, p.x), std::min(box.y0, p.y), std::max(box.x1, p.x),
             std::max(box.y1, p.y)};
    }
    if (!bounded) box = {-kInfinity, -kInfinity, kInfinity, kInfinity};
    boxes_.push_back(box);
  }
}

bool PixelRefinement::may_meet(std::size_t i, int x, int y) const {
  constexpr double kSlack = 0x1p-20;  // pixels; ample
  const Box& box = boxes_[i];
  const double column = pixel_center(x), row = pixel_center(y);
  return column >= box.x0 - kSlack && column <= box.x1 + kSlack && row >= box.y0 - kSlack &&
         row <= box.y1 + kSlack;
}

PixelRefinement::Met PixelRefinement::find(CellId cell, int x, int y, ExtendedSegment& segment) {
  const CellKind kind = frame_.mesh.kinds[cell];
  if (kind == CellKind::tetrahedron4) return segments_.find(cell, x, y, segment);
  return order_of(kind) == CellOrder::linear ? cell_segments_.find(cell, x, y, segment)
                                             : Met::doubtful;
}

void PixelRefinement::composite(const ExtendedSegment& segment, Again& pixel) const {
  if (pixel.ended) return;
  const auto light = static_cast<double>(std::ranges::max(pixel.light.rgb));
  pixel.details.add(segment.details, static_cast<double>(pixel.light.transparency), light);
  pixel.light.add_behind(segment.light);
  pixel.ended = pixel.light.transparency <= kEndSooner * frame_.least_transparency;
}

std::optional<PixelRefinement::Again> PixelRefinement::compute_again(int x, int y) {
  if (boxes_.empty()) set_boxes();
  Again pixel;
  std::vector<ExtendedSegment> in_group;
  std::size_t i = 0;
  for (auto left = ranks_; !left.empty() && !pixel.ended;) {
    const CellRun run = first_run(order_, left, left.size());
    in_group.clear();
    for (const std::uint32_t rank : run.ranks) {
      if (!may_meet(i++, x, y)) continue;
      ExtendedSegment segment;
      const Met met = find(order_.cells[rank], x, y, segment);
      if (met == Met::doubtful) return std::nullopt;
      if (met == Met::no) continue;
      if (run.is_group)
        in_group.push_back(segment);
      else
        composite(segment, pixel);
      if (pixel.ended) break;
    }
    std::ranges::stable_sort(in_group, {},
                             [](const ExtendedSegment& s) { return std::pair(s.front, s.back); });
    for (const ExtendedSegment& segment : in_group) composite(segment, pixel);
    left = left.subspan(run.ranks.size());
  }
  return pixel;
}

double PixelRefinement::error(const TileBuffer& drawn, std::size_t at, double background) {
  check_cancelled();
  const double left = drawn.transparency[at];
  const double bound =
      pixel_error(frame_, drawn.details[at], left, left <= frame_.least_transparency, background);
  // arithmetic no finer than the engine's reveals nothing about its rounding
  if (drawn.details[at].met > 0) return bound;  // only cells are met again
  if (!kExtendedIsFiner || bound <= kLargeBound * frame_.tolerance) return bound;
  const auto again = compute_again(tile_.column(at), tile_.row(at));
  if (!again) return bound;
  const Real light = std::max({std::abs(again->light.rgb[0] - drawn.red[at]),
                               std::abs(again->light.rgb[1] - drawn.green[at]),
                               std::abs(again->light.rgb[2] - drawn.blue[at])});
  const Real shade = std::abs(again->light.transparency - left);
  const auto difference = static_cast<double>(std::max(light + shade * background, shade));
  const auto transparency = static_cast<double>(again->light.transparency);
  return std::min(bound, difference + pixel_error(frame_, again->details, transparency,
                                                  again->ended, background));
}

}  // namespace hiac
