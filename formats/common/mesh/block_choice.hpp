#pragma once

#include <span>
#include <string>

#include "hiac/base/error.hpp"

namespace hiac::formats {

/// What is thrown where a file has not got the block that --block names; tells which it has.
UsageError no_such_block(const std::string& block, std::span<const std::string> names,
                         const std::string& subject);

}  // namespace hiac::formats
