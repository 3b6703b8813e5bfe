#pragma once

#include <array>

#include "hiac/image/image.hpp"

namespace hiac {

/// Dark blue over green to yellow, equally spaced: seven colours of matplotlib's viridis, sRGB.
inline constexpr std::array<std::array<int, 3>, 7> kViridis{{{0x44, 0x01, 0x54},
                                                             {0x44, 0x39, 0x83},
                                                             {0x31, 0x68, 0x8e},
                                                             {0x21, 0x91, 0x8c},
                                                             {0x35, 0xb7, 0x79},
                                                             {0x90, 0xd7, 0x43},
                                                             {0xfd, 0xe7, 0x25}}};

/// A map of errors (its first channel) as colours: kViridis from 0 to `largest`, the last one
/// beyond; red where a value is not finite. Channels R G B, linear.
Image heat_map(const Image& map, double largest);

}  // namespace hiac
