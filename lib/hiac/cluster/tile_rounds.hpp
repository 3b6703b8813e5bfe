#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "hiac/cluster/communicator.hpp"

namespace hiac {

/// The rounds in which a picture's tiles are drawn: the tiles of a round lie all over the picture,
/// so that a round has about the same share of every part's work. The first round is small; the
/// next ones have as many tiles as the bytes of the round before allow.
class TileRounds {
 public:
  /// The bytes of runs that a process holds in a round as it sends or as it receives.
  static constexpr std::uint64_t kMostBytes = std::uint64_t{32} << 20;

  explicit TileRounds(std::size_t tiles);

  [[nodiscard]] bool at_end() const { return done_ == tiles_.size(); }
  /// The numbers of the round's tiles.
  std::vector<std::uint32_t> next();
  /// Notes the most bytes that any process held in the last round.
  void note_bytes(std::uint64_t bytes);
  /// Further rounds have at most so many tiles.
  void limit(std::size_t tiles) { limit_ = tiles; }

 private:
  std::vector<std::uint32_t> tiles_;  // in the order of the rounds
  std::size_t done_ = 0, count_;      // count_: of the next round
  std::size_t limit_ = std::numeric_limits<std::size_t>::max();
};

/// The bytes of all messages.
std::uint64_t total_size(const std::vector<Bytes>& messages);

}  // namespace hiac
