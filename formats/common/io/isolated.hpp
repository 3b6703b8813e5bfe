#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// What a file holds according to `open`, found out in a process of its own, which lives on to read
/// the fields' values when they are asked for.
///
/// For libraries that are not safe against damaged files (HDF5 1.10 writes out of its bounds on a
/// few in ten thousand) and that print what they think on stderr: here they can do neither harm.
/// Errors that `open` and the fields throw come through. Of a crash, or when more than ten minutes
/// + 1 s a megabyte of processor time are spent, an InputError naming `path` and `library` is made.
/// `open` runs in a fork of this thread alone: it and its fields must not use threads.
ForeignMesh read_isolated(const std::string& path, std::string_view library,
                          const std::function<ForeignMesh(const std::string& path)>& open);

}  // namespace hiac::formats
