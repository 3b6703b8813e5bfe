#pragma once

#include <optional>
#include <string>

#include "hiac/image/image.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::tools {

/// Reads the picture of --under, which is put behind a new one of this size; none where `path` is
/// empty. Throws InputError if it has another size, no colour, or a value that is no finite number.
std::optional<Image> read_picture_behind(const std::string& path, const ImageSize& size);

}  // namespace hiac::tools
