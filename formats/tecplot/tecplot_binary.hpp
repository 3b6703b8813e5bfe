#pragma once

#include "formats/tecplot/tecplot_zones.hpp"

namespace hiac::formats::tecplot {

/// Whether these are the first bytes of a binary data file.
bool is_tecplot_binary(std::string_view head);

/// Reads a binary data file of version 107 to 112 in either byte order (Tecplot 360 Data Format
/// Guide, Appendix "Binary data file format"): ordered and finite-element zones, shared and passive
/// variables (NaN where they are passive), shared connectivity, cell-centred variables, polygons
/// and polyhedra by their faces. Throws InputError naming file and byte.
TecplotFile read_tecplot_binary(const InputText& text);

}  // namespace hiac::formats::tecplot
