#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Gambit neutral files (.neu).
Format gambit_format();

}  // namespace hiac::formats
