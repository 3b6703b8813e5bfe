#pragma once

#include <cstdint>
#include <optional>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::unv {

/// The element with an FE descriptor (universal file datasets 780 and 2412, appendix). Parabolic
/// solids list the nodes of an edge between its corners, round the bottom, then the vertical edges,
/// then the top.
struct UnvElement {
  ForeignType type;
  bool is_beam = false;  ///< it has a record of orientations before its nodes
};
std::optional<UnvElement> unv_element(std::int64_t descriptor);

}  // namespace hiac::formats::unv
