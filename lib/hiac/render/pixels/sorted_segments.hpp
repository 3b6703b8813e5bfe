#pragma once

#include <cstdint>
#include <vector>

#include "hiac/render/pixels/tile.hpp"

namespace hiac {

/// The numbers of a list's segments, pixel by pixel, those of a pixel by depth (nearer).
std::vector<std::uint32_t> sorted_segments(const SegmentList& list);

}  // namespace hiac
