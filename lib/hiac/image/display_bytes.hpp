#pragma once

#include <cstdint>
#include <vector>

#include "hiac/image/image.hpp"

namespace hiac {

/// The picture's R G B as a screen shows them: three bytes a pixel, rows from the top, the same
/// that write_image stores in a .png of 8 bits with `background_included`.
///
/// Throws UsageError if the image has no colour.
std::vector<std::uint8_t> display_bytes(const Image& image);

}  // namespace hiac
