#pragma once

#include <memory>

#include "formats/common/io/input_text.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::frd {

/// The contents of an .frd file. The values of a field are read on request; the fields share
/// ownership of the text. Throws InputError.
ForeignMesh read_frd(const std::shared_ptr<InputText>& text);

}  // namespace hiac::formats::frd
