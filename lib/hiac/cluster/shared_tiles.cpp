#include "hiac/cluster/shared_tiles.hpp"

#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "hiac/base/parallel.hpp"
#include "hiac/cluster/byte_stream.hpp"
#include "hiac/cluster/run_message.hpp"

namespace hiac {

void SharedTiles::share(std::span<const std::size_t> tiles, const Finish& finish,
                        const Take& take) const {
  all_.restart_numbers();
  std::vector<std::pair<std::size_t, FinishedTile>> own;
  std::mutex adding;
  parallel_for(thread_count(), 1, [&](IndexRange) {
    for (std::uint64_t k = all_.take_number(); k < tiles.size(); k = all_.take_number()) {
      FinishedTile finished = finish(tiles[k]);
      const std::scoped_lock lock(adding);
      own.emplace_back(tiles[k], std::move(finished));
    }
  });
  std::vector<Bytes> to(all_.size());
  for (std::uint32_t rank = 0; rank < to.size(); ++rank) {
    ByteWriter message(to[rank]);
    for (auto& [tile, finished] : own) {
      message.put(static_cast<std::uint64_t>(tile));
      put_finished(message, rank == 0 ? finished : FinishedTile{finished.summary, {}});
    }
  }
  own.clear();
  for (const Bytes& received : all_.exchange(std::move(to)))
    for (ByteReader message(received); !message.at_end();) {
      const auto tile = static_cast<std::size_t>(message.get<std::uint64_t>());
      take(tile, get_finished(message));
    }
}

}  // namespace hiac
