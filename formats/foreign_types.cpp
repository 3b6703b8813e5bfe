#include "formats/foreign_types.hpp"

#include <limits>

#include "hiac/base/error.hpp"

namespace hiac::formats {

std::uint16_t type_index(ForeignMesh& mesh, const std::string& name, std::size_t nodes,
                         const CellConversion& conversion) {
  std::size_t at = 0;
  while (at < mesh.types.size() && (mesh.types[at].name != name || mesh.types[at].nodes != nodes))
    ++at;
  if (at > std::numeric_limits<std::uint16_t>::max())
    throw InputError(name, "one cell type too many (65536 at most expected)");
  if (at == mesh.types.size()) mesh.types.push_back({name, nodes, conversion});
  return static_cast<std::uint16_t>(at);
}

}  // namespace hiac::formats
