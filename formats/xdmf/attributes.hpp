#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include "formats/xdmf/data_items.hpp"
#include "formats/xdmf/grids.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats::xdmf {

/// One attribute on some of the grids.
struct FieldParts {
  std::string name;
  FieldLocation location;
  std::uint32_t components;
  std::string type;
  std::vector<pugi::xml_node> items;  ///< one per grid; null when the grid has none
};

/// Gathers the attributes of all grids, which become fields in the order in which they first occur.
class Attributes {
 public:
  Attributes(const std::vector<UniformGrid>& grids, DataItems& items,
             std::vector<std::string>& notes)
      : grids_(grids), items_(items), notes_(notes) {}

  /// Adds the attributes of a grid, whose points and cells have been counted. One that lies on
  /// neither is left out, with a note. Throws InputError naming the file and the element.
  void add_all(std::size_t grid);

  [[nodiscard]] const std::vector<FieldParts>& fields() const { return fields_; }

 private:
  void add(std::size_t grid, const pugi::xml_node& attribute);

  const std::vector<UniformGrid>& grids_;
  DataItems& items_;
  std::vector<std::string>& notes_;
  std::vector<FieldParts> fields_;
};

}  // namespace hiac::formats::xdmf
