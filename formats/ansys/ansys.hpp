#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Ansys MAPDL archives (.cdb): blocked and unblocked, components.
Format ansys_format();

}  // namespace hiac::formats
