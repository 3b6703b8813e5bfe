#pragma once

#include "formats/common/io/printable.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {

/// The result of `work`; names from the file in its errors are made printable on one line.
template <typename Work>
auto with_errors_of_one_line(const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError(printable(error.what()));
  }
}

}  // namespace hiac::formats
