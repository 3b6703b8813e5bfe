#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hiac/cluster/communicator.hpp"
#include "hiac/frame/tiles/pixel_mask.hpp"
#include "hiac/render/runs/part_engine.hpp"

namespace hiac {

/// The pixels of every tile through which edges of any part pass, and which of this process's parts
/// have some in a tile.
class EdgedTiles {
 public:
  /// All processes call it. `engines`: of this process's parts. `any`: whether the scene has edges.
  EdgedTiles(Communicator& all, std::span<const std::unique_ptr<PartEngine>> engines, bool any,
             std::span<const TileRect> tiles);

  /// Null where the scene has no edges.
  [[nodiscard]] const PixelMask* mask(std::uint32_t tile) const {
    return masks_.empty() ? nullptr : &masks_[tile];
  }
  [[nodiscard]] bool has(std::size_t part, std::uint32_t tile) const {
    return !masks_.empty() && has_own_[part][tile] != 0;
  }

 private:
  std::vector<PixelMask> masks_;                    // empty where the scene has no edges
  std::vector<std::vector<std::uint8_t>> has_own_;  // by part and tile
};

}  // namespace hiac
