#pragma once

#include <optional>
#include <string>

#include "hiac/image/image.hpp"

namespace hiac {

/// Composites `front` over `back`: R, G, B and A of each pixel become front + (1 - front's A) back,
/// in linear values premultiplied by alpha (Porter and Duff's over, "Compositing Digital Images",
/// SIGGRAPH 1984). A `back` without A is opaque; one with only Y is grey. Other channels of `front`
/// stay as they are.
///
/// Throws std::invalid_argument if the sizes differ, `front` lacks one of R G B A, or `back` has no
/// colour.
void composite_over(Image& front, const Image& back);

/// What keeps `back` from being put behind: its first pixel whose colour or alpha is no finite
/// number, in words ("pixel 3,1: ..."), without its name. None where all are, or there is no
/// colour.
std::optional<std::string> not_finite_in(const Image& back);

}  // namespace hiac
