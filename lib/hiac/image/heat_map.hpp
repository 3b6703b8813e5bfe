#pragma once

#include <array>

#include "hiac/image/image.hpp"

namespace hiac {

/// Seven equally spaced colours of matplotlib's viridis in sRGB, from dark blue over green to
/// yellow.
inline constexpr std::array<std::array<int, 3>, 7> kViridis{{{0x44, 0x01, 0x54},
                                                             {0x44, 0x39, 0x83},
                                                             {0x31, 0x68, 0x8e},
                                                             {0x21, 0x91, 0x8c},
                                                             {0x35, 0xb7, 0x79},
                                                             {0x90, 0xd7, 0x43},
                                                             {0xfd, 0xe7, 0x25}}};

/// Converts a map of errors (its first channel) into colours: kViridis from 0 to `largest`, its
/// last colour beyond; red for values that are not finite. Channels R G B, linear.
Image heat_map(const Image& map, double largest);

}  // namespace hiac
