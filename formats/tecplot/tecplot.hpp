#pragma once

#include "formats/format.hpp"

namespace hiac::formats {

/// Tecplot ASCII data: ordered and finite-element zones.
Format tecplot_format();

}  // namespace hiac::formats
