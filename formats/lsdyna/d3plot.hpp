#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// LS-DYNA's d3plot and the d3plot01, d3plot02, ... that follow it: solids with their results.
Format d3plot_format();

}  // namespace hiac::formats
