#pragma once

namespace hiac {

// Keys of a mesh's metadata that programs look for.

/// How cells differ from those of the file that they were read from, and by how much at most; one
/// entry for each kind of cell.
inline constexpr const char* kApproximated = "approximated";

}  // namespace hiac
