#pragma once

#include <memory>

#include "formats/common/io/input_text.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::frd {

/// What an .frd file holds. Values of fields are read when they are asked for; the fields keep the
/// text. Throws InputError.
ForeignMesh read_frd(const std::shared_ptr<InputText>& text);

}  // namespace hiac::formats::frd
