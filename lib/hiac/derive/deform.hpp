#pragma once

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Moves every node by `scale` times the field's vector there: the deformed shape of a
/// displacement. Kinds, cells and fields stay as they are; whether cells are inside out afterwards
/// is for judge_cells to say. Throws UsageError if the field is not one of nodes with three
/// components, InputError naming the first node whose new position is not finite.
void deform(ZooMesh& mesh, const Field& displacement, double scale);

}  // namespace hiac
