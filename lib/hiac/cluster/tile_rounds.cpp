#include "hiac/cluster/tile_rounds.hpp"

#include <algorithm>
#include <cmath>

namespace hiac {
namespace {

constexpr std::size_t kFirst = 16, kGrowth = 4;

// The fraction of a whole, k times the golden ratio without its integer part: successive ones lie
// far apart, and any number of them fills the whole evenly.
double spread(std::size_t k) {
  constexpr double kGolden = 0.6180339887498949;
  const double turns = static_cast<double>(k) * kGolden;
  return turns - std::floor(turns);
}

}  // namespace

TileRounds::TileRounds(std::size_t tiles) : count_(kFirst) {
  std::vector<std::pair<double, std::uint32_t>> places;
  for (std::size_t k = 0; k < tiles; ++k) places.emplace_back(spread(k), k);
  std::ranges::sort(places);
  for (const auto& [place, tile] : places) tiles_.push_back(tile);
}

std::vector<std::uint32_t> TileRounds::next() {
  const std::size_t count = std::min({count_, limit_, tiles_.size() - done_});
  const auto first = tiles_.begin() + static_cast<std::ptrdiff_t>(done_);
  done_ += count;
  count_ = count;
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}

void TileRounds::note_bytes(std::uint64_t bytes) {
  const double fits =
      static_cast<double>(kMostBytes) / static_cast<double>(std::max<std::uint64_t>(bytes, 1));
  const double most = fits * static_cast<double>(count_);
  count_ = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::min(most, static_cast<double>(kGrowth * count_))), 1,
      std::min(kGrowth * count_, limit_));
}

std::uint64_t total_size(const std::vector<Bytes>& messages) {
  std::uint64_t size = 0;
  for (const Bytes& message : messages) size += message.size();
  return size;
}

}  // namespace hiac
