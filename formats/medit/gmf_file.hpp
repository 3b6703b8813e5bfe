#pragma once

#include "formats/common/io/input_text.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::medit {

/// Whether these are the first bytes of a text or binary Gamma Mesh Format file.
bool looks_like_gmf(std::string_view head);

/// Reads a Gamma Mesh Format file: text, or binary of versions 1 to 4 and either byte order.
/// References become the fields "ref". Throws InputError.
ForeignMesh read_gmf(const InputText& text);

}  // namespace hiac::formats::medit
