#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "hiac/base/error.hpp"

namespace hiac::tools {

/// What `work` returns. The library's messages do not know how its user gave a value: where it
/// throws UsageError, `prefix`, the name of the option, is put before the message.
template <typename Work>
auto as_option(std::string_view prefix, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const UsageError& error) {
    throw UsageError(std::string(prefix) + error.what());
  }
}

}  // namespace hiac::tools
