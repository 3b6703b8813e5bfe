#pragma once

#include <memory>
#include <vector>

#include "formats/gmsh/gmsh_sections.hpp"

namespace hiac::formats::gmsh {

/// Adds the times and the fields of the data sections to the mesh. Sections of one name, place and
/// step are parts of one field. Values are read when a field is asked for, from `text`, which the
/// fields keep.
void add_data(std::vector<DataSection>&& sections, const std::shared_ptr<InputText>& text,
              ForeignMesh& mesh);

}  // namespace hiac::formats::gmsh
