#pragma once

#include "formats/format.hpp"

namespace hiac::formats::vtk {

/// Reads a .vtu file, all its pieces as one mesh, which may be empty (see finish_reading,
/// gate.hpp).
Reading read_vtu(const std::string& path, const ReadOptions& options);

/// What a .vtu file holds.
Inventory inspect_vtu(const std::string& path);

}  // namespace hiac::formats::vtk
