#pragma once

#include "formats/common/io/input_text.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::ucd {

/// Whether a file that begins so may be a UCD file: comments, then five counts, then a node.
bool looks_like_ucd(std::string_view head);

/// Reads text (comments, then the counts of nodes, cells, node, cell and model data) or binary (a
/// byte 7, then the same as 32-bit integers of either byte order).
///
/// AVS draws hexahedra, prisms and tetrahedra with the top first; many programs write the bottom
/// first. The two differ in orientation alone: of each kind the order is taken in which most cells
/// of the file are positively oriented, with a note where that is not AVS's own. Of pyramids the
/// apex is first. Throws InputError.
ForeignMesh read_ucd(const InputText& text);

}  // namespace hiac::formats::ucd
