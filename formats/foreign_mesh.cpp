#include "formats/foreign_mesh.hpp"

#include <algorithm>
#include <memory>

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
  types.push_back({std::string(name), nodes, conversion});
  return static_cast<std::uint16_t>(types.size() - 1);
}

void ForeignMesh::add_last_to_block(std::string_view name) {
  const std::size_t cell = cell_count() - 1;
  // cells of a block come in runs: the latest is at the end of the list or near it
  auto known = std::find_if(blocks.rbegin(), blocks.rend(),
                            [&](const ForeignBlock& block) { return block.name == name; });
  if (known == blocks.rend()) {
    blocks.push_back({std::string(name), {}});
    known = blocks.rbegin();
  }
  if (!known->cells.empty() && known->cells.back().end == cell)
    ++known->cells.back().end;
  else
    known->cells.push_back({cell, cell + 1});
}

}  // namespace hiac::formats
