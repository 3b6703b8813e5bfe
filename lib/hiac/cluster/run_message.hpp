#pragma once

#include <cstdint>

#include "hiac/cluster/byte_stream.hpp"
#include "hiac/frame/tiles/finished_tile.hpp"
#include "hiac/render/runs/ray_runs.hpp"

namespace hiac {

/// The runs of one part in one tile, on their way to the tile's owner: 50 bytes a run, and 56 more
/// where channels need its facts.
void put_runs(ByteWriter& to, const TileRuns& runs);
TileRuns get_runs(ByteReader& from);

/// A finished tile on its way into the picture, with or without its pixels.
void put_summary(ByteWriter& to, const TileSummary& summary);
TileSummary get_summary(ByteReader& from);
void put_finished(ByteWriter& to, const FinishedTile& tile);
FinishedTile get_finished(ByteReader& from);

}  // namespace hiac
