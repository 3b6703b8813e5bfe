#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hiac {

/// The parts of a key such as `camera.fov` or `isosurface.0.value`: names of keys, and numbers of
/// lists' elements, counted from 0.
using SpecPath = std::vector<std::string>;

/// Returns the parts of a key, or nothing if it is malformed: empty parts, blanks, quotes,
/// brackets, or more parts than any key of a specification has.
std::optional<SpecPath> spec_path(std::string_view key);

/// Returns the number of an element if a part is one.
std::optional<std::size_t> as_index(std::string_view part);

}  // namespace hiac
