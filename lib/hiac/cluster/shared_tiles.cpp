#include "hiac/cluster/shared_tiles.hpp"

#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "hiac/base/parallel.hpp"
#include "hiac/cluster/byte_stream.hpp"
#include "hiac/cluster/run_message.hpp"

namespace hiac {
namespace {

using Summaries = std::vector<std::pair<std::size_t, TileSummary>>;

void append_tile(ByteWriter& message, std::size_t tile, const FinishedTile& finished) {
  message.put(static_cast<std::uint64_t>(tile));
  put_finished(message, finished);
}

Bytes message_of(const Summaries& tiles) {
  Bytes bytes;
  ByteWriter message(bytes);
  for (const auto& [tile, summary] : tiles) append_tile(message, tile, {summary, {}});
  return bytes;
}

}  // namespace

IndexRange SharedTiles::own_part(std::size_t count) const {
  const auto begin_of = [&](std::size_t rank) { return count * rank / all_.size(); };
  return {begin_of(all_.rank()), begin_of(std::size_t{all_.rank()} + 1)};
}

std::vector<Bytes> SharedTiles::of_all(std::span<const std::byte> own) const {
  return all_gather(all_, Bytes(own.begin(), own.end()));
}

void SharedTiles::share(std::span<const std::size_t> tiles, const Finish& finish,
                        const Take& take) const {
  all_.restart_numbers();
  // a process that does not write appends a tile to its message while the caches hold it
  Summaries summaries;
  Bytes pixels;
  ByteWriter to_writer(pixels);
  std::mutex adding;
  parallel_for(thread_count(), 1, [&](IndexRange) {
    for (std::uint64_t k = all_.take_number(); k < tiles.size(); k = all_.take_number()) {
      const FinishedTile finished = finish(tiles[k]);
      const std::scoped_lock lock(adding);
      summaries.emplace_back(tiles[k], finished.summary);
      if (!writes()) {
        append_tile(to_writer, tiles[k], finished);
        // room for twice its share of the tiles: other processes may be slower
        if (summaries.size() == 1) pixels.reserve(2 * pixels.size() * tiles.size() / all_.size());
      }
      take(tiles[k], {finished.summary, {}});
    }
  });
  std::vector<Bytes> to(all_.size(), message_of(summaries));
  if (!writes()) to[0] = std::move(pixels);
  to[all_.rank()].clear();
  for (const Bytes& message : all_.exchange(std::move(to)))
    for (ByteReader from(message); !from.at_end();) {
      const auto tile = static_cast<std::size_t>(from.get<std::uint64_t>());
      take(tile, get_finished(from));
    }
}

}  // namespace hiac
