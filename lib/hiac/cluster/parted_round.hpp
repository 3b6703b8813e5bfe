#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "hiac/cluster/communicator.hpp"
#include "hiac/render/runs/ray_runs.hpp"

namespace hiac {

/// The runs of a tile's parts, by ascending number of the part, as they come in.
struct PartedTile {
  std::vector<std::uint32_t> numbers;  // of the parts
  std::vector<TileRuns> runs;

  void add(std::uint32_t number, TileRuns of_part);
  /// Leaves out parts that begin behind `end` (end_of_tile); returns their segments.
  std::uint64_t drop_behind(double end);
};

/// Some tiles that are drawn together. Their parts are drawn layer by layer, the nearest first, so
/// that parts behind the end of a tile need not be.
struct PartedRound {
  explicit PartedRound(std::vector<std::uint32_t> of_tiles);

  std::vector<std::uint32_t> tiles;  ///< their numbers among those of the picture
  std::vector<double> ends;          ///< of each tile (end_of_tile), as far as it is drawn
  std::vector<PartedTile> received;  ///< of each tile; empty but for those that this process owns
  std::uint32_t layer = 0;           ///< the one to be drawn

  /// The rank that merges a tile.
  [[nodiscard]] static std::uint32_t owner(std::size_t place, const Communicator& all) {
    return static_cast<std::uint32_t>(place % all.size());
  }
  /// The places in `tiles` of those that this process owns.
  [[nodiscard]] std::vector<std::size_t> own_places(const Communicator& all) const;
};

/// A part and a ray parameter before which no ray meets it.
struct PartDepth {
  std::uint32_t number;
  double nearest;
};

/// The layer, of `count`, of each of this process's parts: all processes' parts by their nearest
/// points, as many in every layer.
std::vector<std::uint32_t> layers_of(Communicator& all, std::span<const PartDepth> own,
                                     std::uint32_t count);

}  // namespace hiac
