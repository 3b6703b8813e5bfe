#include "formats/ansys/cdb_model.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "formats/ansys/cdb_elements.hpp"

namespace hiac::formats::ansys {

std::int64_t CdbModel::routine_of(std::int64_t type) const {
  const auto routine = routines.find(type);
  return routine == routines.end() ? type : routine->second;
}

std::int64_t CdbModel::shape_of(std::int64_t type) const {
  const auto shape = shapes.find(type);
  return shape == shapes.end() ? 0 : shape->second;
}

void CdbModel::add_element(std::int64_t type, std::int64_t number, std::span<std::int64_t> nodes) {
  // an element ends with its last existing node: missing mid-side nodes after it are not counted
  std::array<std::int64_t, 20> whole{};
  const std::size_t own = library_nodes(routine_of(type), shape_of(type));
  const std::size_t corners = own == 10 ? 4 : 8;
  if ((own == 10 || own == 20) && nodes.size() > corners && nodes.size() < own) {
    const auto end = std::ranges::copy(nodes, whole.begin()).out;
    std::fill(end, whole.end(), kLeftOutNode);
    nodes = std::span(whole).first(own);
  }
  const auto key = std::pair(type, nodes.size());
  auto found = places.find(key);
  if (found == places.end()) {
    mesh.types.push_back(element_type(routine_of(type), nodes.size(), shape_of(type)));
    found = places.emplace(key, static_cast<std::uint16_t>(mesh.types.size() - 1)).first;
  }
  const CellConversion& conversion = mesh.types[found->second].conversion;
  if (conversion.fate == CellFate::converted && conversion.kind == CellKind::brick20)
    settle_collapsed_edges(nodes);
  mesh.cell_types.push_back(found->second);
  mesh.cell_numbers.push_back(number);
  mesh.cell_nodes.insert(mesh.cell_nodes.end(), nodes.begin(), nodes.end());
}

}  // namespace hiac::formats::ansys
