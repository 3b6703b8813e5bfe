#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/common/mesh/foreign_mesh.hpp"
#include "formats/silo/blocks.hpp"
#include "formats/silo/silo_file.hpp"

namespace hiac::formats::silo {

/// The variables with one name.
struct Variable {
  std::string name;
  std::vector<std::pair<std::size_t, Place>> parts;  ///< block and place
};

/// A variable of the first file whose parts belong to the blocks of a multi-block mesh, `blocks` of
/// them, one after the other; nothing, with a note, when it does not name its parts.
std::optional<Variable> multi_block_variable(SiloFiles& files, const std::string& name,
                                             std::size_t blocks, std::vector<std::string>& notes);

/// The name of the mesh that a variable of the first file lies on; empty when it names none.
std::string mesh_of_variable(SiloFiles& files, const std::string& name);

/// A variable with at least one part as a field of `mesh`, NaN in the blocks where it has none. Its
/// values are read when they are asked for; what is read here, and then, throws InputError naming
/// the file and the variable.
ForeignField field_of(const std::shared_ptr<SiloFiles>& files,
                      const std::shared_ptr<const std::vector<Block>>& blocks,
                      const Variable& variable, const ForeignMesh& mesh);

}  // namespace hiac::formats::silo
