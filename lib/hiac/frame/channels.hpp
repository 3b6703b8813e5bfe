#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hiac {

/// The further channels of a picture, besides "R" "G" "B" "A".
///
/// Depths are distances from the eye plane along the view direction, infinite where nothing is
/// visible.
enum class Channel : std::uint8_t {
  depth,         ///< of the start of the first ray segment that emits or absorbs, or of the first
                 ///< isosurface, whichever is nearer
  mean_depth,    ///< mean depth of everything on the ray, weighted by its share of the
                 ///< opacity; a ray segment lies at its middle
  transparency,  ///< 1 - A, without the rounding of the difference
  cells,         ///< cells that the ray met before it ended, and splats that reached it
  witness,       ///< of those, the ones that were met out of order (section 4)
  error,         ///< bound of the absolute error of R, G, B and A (error_bound.hpp)
};

/// "depth", "mean_depth", "transparency", "cells", "witness", "error".
std::string_view channel_name(Channel channel);

/// The names of all channels of the image: "R" "G" "B" "A", and the given ones.
std::vector<std::string> image_channels(std::span<const Channel> channels);

/// The names of all further channels, separated by commas, for messages and help.
std::string channel_names();

/// The channels named in a list such as "depth,error"; throws UsageError if one does not exist or
/// occurs twice.
std::vector<Channel> parse_channels(std::string_view list);

}  // namespace hiac
