#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// I-DEAS universal files (.unv): nodes 15, 781, 2411; elements 780, 2412; groups; results 55,
/// 2414.
Format unv_format();

}  // namespace hiac::formats
