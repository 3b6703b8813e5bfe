#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "formats/common/cells/cell_conversion.hpp"

namespace hiac::formats::cgns {

inline constexpr std::int64_t kMixed = 20;
inline constexpr std::int64_t kPolygons = 22;
inline constexpr std::int64_t kPolyhedra = 23;

/// An element of the standard by its number (ElementType_t).
struct ElementType {
  std::string name;
  std::size_t nodes;
  CellConversion conversion;
};

std::optional<ElementType> element_numbered(std::int64_t number);

}  // namespace hiac::formats::cgns
