#pragma once

#include <string>

#include "formats/common/cells/cell_conversion.hpp"

namespace hiac::formats::exodus {

/// How an element with that name ("HEX", "hex20", "TETRA10", ...) and number of nodes is converted.
/// The case of a name and the digits in it vary: only its letters and the number of nodes matter.
CellConversion conversion_of(const std::string& name, std::size_t nodes);

}  // namespace hiac::formats::exodus
