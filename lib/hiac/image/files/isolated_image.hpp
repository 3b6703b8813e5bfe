#pragma once

#include <functional>
#include <string>

#include "hiac/image/image_io.hpp"

namespace hiac::image_files {

/// What `read` returns or throws, called in a process of its own (IsolatedProcess): for images that
/// a library reads which a damaged file may lead astray. Messages name the file `path` and
/// `library`.
ImageFile read_isolated_image(const std::string& path, const std::string& library,
                              const std::function<ImageFile()>& read);

}  // namespace hiac::image_files
