#pragma once

#include <string>

#include "hiac/scene/scene.hpp"

namespace hiac::tools {

/// WxH, as --size has it; each within what an image may have. Throws UsageError for anything else.
ImageSize parse_size(const std::string& text);

}  // namespace hiac::tools
