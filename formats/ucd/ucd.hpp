#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// AVS unstructured cell data (.inp, .ucd, .avs), text and binary.
Format ucd_format();

}  // namespace hiac::formats
