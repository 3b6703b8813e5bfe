#pragma once

#include "hiac/cluster/byte_stream.hpp"
#include "hiac/render/runs/edged_pixels.hpp"

namespace hiac {

/// Pixels with edges, as bytes between processes.
void put_edged(ByteWriter& to, const EdgedTile& tile);
EdgedTile get_edged(ByteReader& from);

}  // namespace hiac
