#pragma once

#include <memory>

#include "formats/common/io/input_text.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::unv {

/// What a universal file holds. Values of results are read when they are asked for. Throws
/// InputError naming file and line.
ForeignMesh read_unv(const std::shared_ptr<InputText>& text);

}  // namespace hiac::formats::unv
