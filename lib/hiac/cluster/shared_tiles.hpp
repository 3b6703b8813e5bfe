#pragma once

#include "hiac/cluster/communicator.hpp"
#include "hiac/frame/tiles/tile_crew.hpp"

namespace hiac {

/// A crew of processes that all have the whole mesh. Each takes the next tile as soon as one of its
/// threads is free; rank 0 gets the pixels.
class SharedTiles final : public TileCrew {
 public:
  /// `all` must outlive it.
  explicit SharedTiles(Communicator& all) : all_(all) {}

  void share(std::span<const std::size_t> tiles, const Finish& finish,
             const Take& take) const override;

 private:
  Communicator& all_;
};

}  // namespace hiac
