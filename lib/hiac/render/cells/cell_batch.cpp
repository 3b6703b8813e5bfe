#include "hiac/render/cells/cell_batch.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/render/integrate/cell_integrals.hpp"

namespace hiac {

void CellBatch::enter(CellKind kind, bool curved,
                      std::span<const CellMap::Point, CellMap::kMostNodes> nodes,
                      const CellMap& map) {
  kind_ = kind;
  curved_ = curved;
  nodes_ = nodes;
  map_ = &map;
}

void CellBatch::append_runs(const CrossingRuns& runs) {
  collect_runs(to_, runs, allowed(), segments_);
}

void CellBatch::append_crossings(std::span<const CellCrossing> crossings) {
  kept_.clear();
  const Projector& projector = to_.frame.projector;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    const CellCrossing& crossing = crossings[i];
    const double front = std::max(crossing.front, projector.near());
    const double back = std::min(crossing.back, projector.far());
    if (!to_.is_seen(to_.tile.index(crossing.x, crossing.y)) || !(front < back)) continue;
    kept_.push_back(i);
    append(crossing, front, back);
  }
}

void CellBatch::append(const CellCrossing& crossing, double front, double back) {
  const std::size_t k = segments_.count++, at = to_.tile.index(crossing.x, crossing.y);
  segments_.at[k] = static_cast<std::uint32_t>(at);
  segments_.x[k] = pixel_center(crossing.x);
  segments_.y[k] = pixel_center(crossing.y);
  segments_.front[k] = front;
  segments_.back[k] = back;
  segments_.length[k] = (back - front) * to_.buffer.ray_scale[at];
  segments_.allowed[k] = allowed() * (back - front) / to_.visible(at);
  if (!curved_) return;
  const auto reference = place_of(crossing);
  const auto known =
      collapsed(shape_of(kind_), std::isnan(reference[0]) ? map_->middle() : reference);
  segments_.known_u[k] = known[0];
  segments_.known_v[k] = known[1];
  segments_.known_w[k] = known[2];
}

void CellBatch::integrate() {
  const CellPolynomials polynomials(kind_, nodes_, *map_, volume_.fields());
  integrate_cell_segments(to_.frame, polynomials, volume_.color().intervals,
                          volume_.extinction().intervals, segments_);
}

}  // namespace hiac
