#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Tecplot ASCII data: ordered and finite-element zones.
Format tecplot_format();

}  // namespace hiac::formats
