#include "formats/common/mesh/block_choice.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hiac::formats {
namespace {

/// Error messages name at most so many blocks.
constexpr std::size_t kNamedBlocks = 20;

}  // namespace

UsageError no_such_block(const std::string& block, std::span<const std::string> names,
                         const std::string& subject) {
  if (names.empty())
    return UsageError(fmt::format("block {}: {} has no named blocks", block, subject));
  return UsageError(fmt::format("block {}: {} has no such block (one of {}{} expected)", block,
                                subject,
                                fmt::join(names.first(std::min(names.size(), kNamedBlocks)), ", "),
                                names.size() > kNamedBlocks ? ", ..." : ""));
}

}  // namespace hiac::formats
