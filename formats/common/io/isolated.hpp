#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// Runs `open` in a separate process and returns the file's contents. The process lives on to read
/// the fields' values on request.
///
/// For libraries that are not safe against damaged files (HDF5 1.10 writes out of bounds on a few
/// in ten thousand) and that print to stderr: a separate process contains both. Exceptions of
/// `open` and of the fields are passed on. A crash, or more than ten minutes + 1 s a megabyte of
/// processor time, becomes an InputError naming `path` and `library`. `open` runs in a fork of this
/// thread alone: it and its fields must not use threads.
ForeignMesh read_isolated(const std::string& path, std::string_view library,
                          const std::function<ForeignMesh(const std::string& path)>& open);

}  // namespace hiac::formats
