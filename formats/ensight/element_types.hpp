#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::ensight {

struct Element {
  std::size_t nodes;
  CellConversion conversion;
};

/// Elements by name. Mid-edge nodes: round the bottom, round the top, up the sides, as in the zoo;
/// the pentahedra are right-handed.
const std::map<std::string, Element>& elements();

/// The manual's order of a symmetric tensor is 11 22 33 12 13 23, the zoo's 11 22 33 12 23 13: the
/// place of component c.
std::size_t component_place(std::size_t c, std::size_t width);

}  // namespace hiac::formats::ensight
