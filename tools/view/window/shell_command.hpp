#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tools/common/picture/picture_command.hpp"

namespace hiac::view {

/// A word as a shell reads it: as it is, or between single quotes.
std::string shell_word(const std::string& word);

/// The line for a shell that makes the picture which the window shows. `command`: how the mesh was
/// read; `view`: the specification's file; `frame`: of its camera path; `skips_invalid`: cells are
/// left out.
std::string shell_command(const tools::PictureCommand& command, const std::string& view,
                          std::optional<std::uint32_t> frame, std::uint32_t samples,
                          bool skips_invalid);

}  // namespace hiac::view
