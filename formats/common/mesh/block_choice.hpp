#pragma once

#include <span>
#include <string>

#include "hiac/base/error.hpp"

namespace hiac::formats {

/// The error for a file that does not have the block named by --block; it lists the file's blocks.
UsageError no_such_block(const std::string& block, std::span<const std::string> names,
                         const std::string& subject);

}  // namespace hiac::formats
