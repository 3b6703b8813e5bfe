#pragma once

#include <memory>

#include "formats/common/io/input_text.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::unv {

/// The contents of a universal file. The values of results are read on request. Throws InputError
/// naming file and line.
ForeignMesh read_unv(const std::shared_ptr<InputText>& text);

}  // namespace hiac::formats::unv
