#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "hiac/base/loop_crew.hpp"
#include "hiac/frame/tiles/finished_tile.hpp"

namespace hiac {

/// Several processes that draw the tiles of one picture: each has the same mesh and calls
/// draw_picture with the same arguments.
class TileCrew : public LoopCrew {
 public:
  using Finish = std::function<FinishedTile(std::size_t tile)>;
  using Take = std::function<void(std::size_t tile, FinishedTile finished)>;
  /// Whether this process gets the pixels of the others; one does.
  [[nodiscard]] virtual bool writes() const = 0;
  /// Hands the tiles out in this order, one at a time. Every tile is drawn by one process, by a
  /// call of `finish` from any of its threads. Calls `take` for all tiles in every process, in any
  /// order and from any thread, but never twice at a time. It gets the summaries alone, and the
  /// values too of tiles that other processes have drawn where `writes` is true.
  virtual void share(std::span<const std::size_t> tiles, const Finish& finish,
                     const Take& take) const = 0;
};

}  // namespace hiac
