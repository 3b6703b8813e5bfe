#include "hiac/cluster/parted_round.hpp"

#include <algorithm>
#include <map>

#include "hiac/cluster/byte_stream.hpp"
#include "hiac/render/runs/runs_by_depth.hpp"

namespace hiac {

void PartedTile::add(std::uint32_t number, TileRuns of_part) {
  const auto at = std::ranges::lower_bound(numbers, number) - numbers.begin();
  numbers.insert(numbers.begin() + at, number);
  runs.insert(runs.begin() + at, std::move(of_part));
}

std::uint64_t PartedTile::drop_behind(double end) {
  std::uint64_t segments = 0;
  for (std::size_t k = runs.size(); k-- > 0;) {
    if (!(first_entry(runs[k]) > end)) continue;
    segments += runs[k].counts.segments;
    numbers.erase(numbers.begin() + static_cast<std::ptrdiff_t>(k));
    runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return segments;
}

PartedRound::PartedRound(std::vector<std::uint32_t> of_tiles)
    : tiles(std::move(of_tiles)),
      ends(tiles.size(), std::numeric_limits<double>::infinity()),
      received(tiles.size()) {}

std::vector<std::size_t> PartedRound::own_places(const Communicator& all) const {
  std::vector<std::size_t> places;
  for (std::size_t place = 0; place < tiles.size(); ++place)
    if (owner(place, all) == all.rank()) places.push_back(place);
  return places;
}

std::vector<std::uint32_t> layers_of(Communicator& all, std::span<const PartDepth> own,
                                     std::uint32_t count) {
  Bytes mine;
  ByteWriter message(mine);
  for (const PartDepth& part : own) {
    message.put(part.nearest);
    message.put(part.number);
  }
  std::vector<std::pair<double, std::uint32_t>> parts;
  for (const Bytes& received : all_gather(all, mine))
    for (ByteReader from(received); !from.at_end();) {
      const auto nearest = from.get<double>();
      parts.emplace_back(nearest, from.get<std::uint32_t>());
    }
  std::ranges::sort(parts);
  std::map<std::uint32_t, std::uint32_t> layers;
  for (std::size_t k = 0; k < parts.size(); ++k)
    layers[parts[k].second] = static_cast<std::uint32_t>(k * count / parts.size());
  std::vector<std::uint32_t> result;
  for (const PartDepth& part : own) result.push_back(layers.at(part.number));
  return result;
}

}  // namespace hiac
