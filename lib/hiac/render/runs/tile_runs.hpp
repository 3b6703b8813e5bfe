#pragma once

#include <cstdint>
#include <span>

#include "hiac/frame/frame.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/render/runs/ray_runs.hpp"
#include "hiac/render/splatting.hpp"

namespace hiac {

/// Draws a part of a mesh in one tile: the cells at these positions of the part's own order, as
/// AccurateTile does, into runs. A ray ends where the part alone makes it opaque (Frame::
/// least_transparency): then nothing behind is seen in the whole mesh either.
TileRuns draw_runs(const Frame& frame, const SplattedCells& splatted, const VisibilityOrder& order,
                   const TileRect& tile, std::span<const std::uint32_t> ranks);

}  // namespace hiac
