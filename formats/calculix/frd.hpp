#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Results of CalculiX (.frd), text in both record lengths and binary.
Format frd_format();

}  // namespace hiac::formats
