#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hiac/cluster/communicator.hpp"
#include "hiac/frame/tiles/tile_crew.hpp"

namespace hiac {

/// A crew of processes that all have the whole mesh. Each takes the next tile as soon as one of its
/// threads is free; rank 0 gets the pixels.
class SharedTiles final : public TileCrew {
 public:
  /// `all` must outlive it.
  explicit SharedTiles(Communicator& all) : all_(all) {}

  [[nodiscard]] IndexRange own_part(std::size_t count) const override;
  [[nodiscard]] std::vector<Bytes> of_all(std::span<const std::byte> own) const override;
  [[nodiscard]] bool writes() const override { return all_.rank() == 0; }
  void share(std::span<const std::size_t> tiles, const Finish& finish,
             const Take& take) const override;

 private:
  Communicator& all_;
};

}  // namespace hiac
