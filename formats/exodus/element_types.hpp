#pragma once

#include <string>

#include "formats/common/cells/cell_conversion.hpp"

namespace hiac::formats::exodus {

/// How an element of that name ("HEX", "hex20", "TETRA10", ...) with that many nodes is converted.
/// Names are free in their case and in their numbers: the letters and the number of nodes count.
CellConversion conversion_of(const std::string& name, std::size_t nodes);

}  // namespace hiac::formats::exodus
