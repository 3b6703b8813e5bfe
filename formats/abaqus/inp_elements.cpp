#include "formats/abaqus/inp_elements.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "formats/common/cells/solid_orders.hpp"

namespace hiac::formats::abaqus {
namespace {

/// Families of solids, all with the nodes of C3D: stress, heat, coupled, acoustic, electromagnetic,
/// pore pressure, Eulerian, fluid, continuum shells.
constexpr std::array<std::string_view, 12> kSolids{"C3D",   "DC3D", "DCC3D", "AC3D", "Q3D", "EC3D",
                                                   "EMC3D", "FC3D", "F3D",   "PC3D", "SC",  "CSS"};

std::optional<CellKind> solid_of(std::size_t nodes) {
  switch (nodes) {
    case 4:
      return CellKind::tetrahedron4;
    case 5:
      return CellKind::pyramid5;
    case 6:
      return CellKind::prism6;
    case 8:
      return CellKind::brick8;
    case 10:
      return CellKind::tetrahedron10;
    case 15:
      return CellKind::prism15;
    case 20:
      return CellKind::brick20;
    default:
      return std::nullopt;
  }
}

/// Solids with nodes in their faces and interior, some of which may be left out.
std::optional<CellShape> unsupported_of(std::size_t nodes, std::string_view suffix) {
  if (nodes == 15 && suffix.starts_with('V')) return CellShape::prism;
  if (nodes == 27) return CellShape::brick;
  return std::nullopt;
}

}  // namespace

InpElement inp_element(std::string_view type) {
  InpElement element{{std::string(type), 0, kNoVolume}, 0};
  for (const std::string_view family : kSolids) {
    if (!type.starts_with(family)) continue;
    const std::string_view rest = type.substr(family.size());
    const auto digits = static_cast<std::size_t>(
        std::find_if_not(rest.begin(), rest.end(),
                         [](unsigned char c) { return std::isdigit(c) != 0; }) -
        rest.begin());
    if (digits == 0 || digits > 2) continue;
    const std::size_t nodes = std::stoul(std::string(rest.substr(0, digits)));
    if (const auto shape = unsupported_of(nodes, rest.substr(digits))) {
      element.type.conversion = unsupported_with_corners(*shape);
      element.type.nodes = topology_of(*shape).corner_count;
      return element;
    }
    if (const auto kind = solid_of(nodes)) {
      element.type.conversion = solid_conversion(*kind);
      element.type.nodes = element.nodes_in_file = nodes;
      return element;
    }
    // a solid element type that does not exist, or is newer than this list
    element.type.conversion = {};
    return element;
  }
  return element;
}

}  // namespace hiac::formats::abaqus
