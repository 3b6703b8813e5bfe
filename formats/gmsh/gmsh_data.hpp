#pragma once

#include <memory>
#include <vector>

#include "formats/gmsh/gmsh_sections.hpp"

namespace hiac::formats::gmsh {

/// Adds the times and the fields of the data sections to the mesh. Sections with the same name,
/// location and step are parts of one field. Values are read from `text` when a field is requested;
/// the fields share its ownership.
void add_data(std::vector<DataSection>&& sections, const std::shared_ptr<InputText>& text,
              ForeignMesh& mesh);

}  // namespace hiac::formats::gmsh
