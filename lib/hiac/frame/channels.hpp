#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hiac {

/// What a picture may say of its pixels besides "R" "G" "B" "A".
///
/// Depths are distances from the eye plane along the view direction, infinite where nothing is
/// seen.
enum class Channel : std::uint8_t {
  depth,         ///< where the first ray segment begins that shines or absorbs, or of the first
                 ///< isosurface, whichever is nearer
  mean_depth,    ///< mean depth of what makes the pixel opaque, weighted by its share of the
                 ///< opacity; a ray segment lies at its middle
  transparency,  ///< 1 - A, without the rounding of that difference
  cells,         ///< cells that the ray met before it ended, splats that reached it included
  witness,       ///< of those, the ones that were met out of order (section 4)
  error,         ///< bound of the absolute error of R, G, B and A (error_bound.hpp)
};

/// "depth", "mean_depth", "transparency", "cells", "witness", "error".
std::string_view channel_name(Channel channel);

/// The names of the image's channels: "R" "G" "B" "A", and these.
std::vector<std::string> image_channels(std::span<const Channel> channels);

/// The channels' names, with commas between, for messages and help.
std::string channel_names();

/// The channels named in a list, as "depth,error"; throws UsageError when one does not exist or is
/// there twice.
std::vector<Channel> parse_channels(std::string_view list);

}  // namespace hiac
