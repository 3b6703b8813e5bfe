#pragma once

#include <memory>

#include "formats/foreign_mesh.hpp"
#include "formats/input_text.hpp"

namespace hiac::formats::frd {

/// What an .frd file holds. Values of fields are read when they are asked for; the fields keep the
/// text. Throws InputError.
ForeignMesh read_frd(const std::shared_ptr<InputText>& text);

}  // namespace hiac::formats::frd
