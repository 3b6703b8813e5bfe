#pragma once

#include "formats/format.hpp"

namespace hiac::formats {

/// Ansys MAPDL archives (.cdb): NBLOCK, EBLOCK, components.
Format ansys_format();

}  // namespace hiac::formats
