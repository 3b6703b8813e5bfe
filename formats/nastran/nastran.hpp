#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Nastran bulk data: small, large and free field; the grid points, their coordinate systems, and
/// the solids.
Format nastran_format();

}  // namespace hiac::formats
