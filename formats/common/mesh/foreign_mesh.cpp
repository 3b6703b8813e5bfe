#include "formats/common/mesh/foreign_mesh.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "hiac/base/error.hpp"

namespace hiac::formats {

ForeignField field_of(std::string name, FieldLocation location, std::uint32_t components,
                      std::vector<double>&& values) {
  ForeignField field;
  field.name = std::move(name);
  field.location = location;
  field.components = components;
  field.values = [kept = std::make_shared<const std::vector<double>>(std::move(values))] {
    return *kept;
  };
  return field;
}

std::uint16_t ForeignMesh::type_place(std::string_view name, std::size_t nodes,
                                      const CellConversion& conversion) {
  const auto known = std::find_if(types.begin(), types.end(), [&](const ForeignType& type) {
    return type.name == name && type.nodes == nodes;
  });
  if (known != types.end()) return static_cast<std::uint16_t>(known - types.begin());
  if (types.size() > std::numeric_limits<std::uint16_t>::max())
    throw InputError(std::string(name), "one cell type too many (65536 at most expected)");
  types.push_back({std::string(name), nodes, conversion});
  return static_cast<std::uint16_t>(types.size() - 1);
}

void ForeignMesh::add_polyhedron(std::string_view type_name,
                                 const std::vector<std::vector<std::int64_t>>& faces) {
  polyhedra.cells.push_back(cell_types.size());
  cell_types.push_back(type_place(type_name, 0, kUnsupported));
  for (const std::vector<std::int64_t>& face : faces) {
    polyhedra.faces.push_back(static_cast<std::int64_t>(face.size()));
    polyhedra.faces.insert(polyhedra.faces.end(), face.begin(), face.end());
  }
  polyhedra.ends.push_back(polyhedra.faces.size());
}

}  // namespace hiac::formats
