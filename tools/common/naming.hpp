#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "hiac/base/error.hpp"

namespace hiac::tools {

/// What `work` returns. The library's messages on a mesh or a scene in memory do not know where it
/// came from: to an InputError that begins with none of the `files`, the name of the mesh is put
/// before it, or where it speaks of a scene's key that of the specification.
template <typename Work>
auto naming(const std::string& mesh, const std::string& specification,
            std::initializer_list<std::string_view> files, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const InputError& error) {
    const std::string_view text = error.what();
    const bool named = std::ranges::any_of(
        files, [&](std::string_view file) { return !file.empty() && text.starts_with(file); });
    if (named || text.starts_with(mesh) || text.starts_with(specification)) throw;
    const bool of_scene = text.starts_with("key `") || text.starts_with("transfer functions");
    throw InputError(of_scene ? specification : mesh, error.what());
  }
}

}  // namespace hiac::tools
