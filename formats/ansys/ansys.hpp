#pragma once

#include "formats/format.hpp"

namespace hiac::formats {

/// Ansys MAPDL archives (.cdb): blocked and unblocked, components.
Format ansys_format();

}  // namespace hiac::formats
