#pragma once

#include "formats/common/io/input_text.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::ucd {

/// Whether a file with these first bytes may be a UCD file: comments, then five counts, then a
/// node.
bool looks_like_ucd(std::string_view head);

/// Reads text (comments, then the counts of nodes, cells, node, cell and model data) or binary (a
/// byte 7, then the same as 32-bit integers of either byte order).
///
/// AVS lists the top of hexahedra, prisms and tetrahedra first; many programs list the bottom
/// first. The two differ only in orientation: for each kind, the order is chosen in which most
/// cells of the file are positively oriented, with a note when it is not AVS's own. The apex of
/// pyramids comes first. Throws InputError.
ForeignMesh read_ucd(const InputText& text);

}  // namespace hiac::formats::ucd
