#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "formats/common/cells/cell_conversion.hpp"

namespace hiac::formats::med {

/// An element of MED by the name of its group: "TE4", "H20", ...
struct ElementType {
  std::string_view name;
  std::size_t nodes;
  CellConversion conversion;
};

/// The element of that name; nothing for polygons, polyhedra and structural elements.
std::optional<ElementType> element_named(std::string_view name);

}  // namespace hiac::formats::med
