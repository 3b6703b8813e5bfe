#include "hiac/cluster/edged_tiles.hpp"

#include "hiac/base/parallel.hpp"
#include "hiac/cluster/byte_stream.hpp"

namespace hiac {

EdgedTiles::EdgedTiles(Communicator& all, std::span<const std::unique_ptr<PartEngine>> engines,
                       bool any, std::span<const TileRect> tiles) {
  if (!any) return;
  masks_.resize(tiles.size());
  has_own_.assign(engines.size(), std::vector<std::uint8_t>(tiles.size()));
  parallel_for(tiles.size(), 1, [&](IndexRange range) {
    for (std::size_t k = 0; k < engines.size(); ++k)
      has_own_[k][range.begin] =
          engines[k]->mark_edges(tiles[range.begin], masks_[range.begin]) ? 1 : 0;
  });
  Bytes mine;
  ByteWriter message(mine);
  for (const PixelMask& mask : masks_) message.put_all(std::span<const std::uint64_t>(mask.rows()));
  for (const Bytes& received : all_gather(all, mine)) {
    ByteReader from(received);
    for (PixelMask& mask : masks_) mask.add_rows(from.get_all<std::uint64_t>(kTileHeight));
  }
}

}  // namespace hiac
