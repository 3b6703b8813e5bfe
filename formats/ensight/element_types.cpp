#include "formats/ensight/element_types.hpp"

#include <array>
#include <vector>

#include "formats/common/cells/edge_order.hpp"

namespace hiac::formats::ensight {

const std::map<std::string, Element>& elements() {
  static const std::vector<std::uint8_t> penta15 = permutation_by_edges(
      CellKind::prism15, kRightHandedPrism,
      std::array<ShapeEdge, 9>{
          {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}});
  static const std::map<std::string, Element> all{
      {"point", {1, kNoVolume}},
      {"bar2", {2, kNoVolume}},
      {"bar3", {3, kNoVolume}},
      {"tria3", {3, kNoVolume}},
      {"tria6", {6, kNoVolume}},
      {"quad4", {4, kNoVolume}},
      {"quad8", {8, kNoVolume}},
      {"tetra4", {4, converted_to(CellKind::tetrahedron4)}},
      {"tetra10", {10, converted_to(CellKind::tetrahedron10)}},
      {"pyramid5", {5, converted_to(CellKind::pyramid5)}},
      {"pyramid13", {13, converted_to(CellKind::pyramid13)}},
      {"penta6", {6, converted_to(CellKind::prism6, kRightHandedPrism)}},
      {"penta15", {15, converted_to(CellKind::prism15, penta15)}},
      {"hexa8", {8, converted_to(CellKind::brick8)}},
      {"hexa20", {20, converted_to(CellKind::brick20)}}};
  return all;
}

std::size_t component_place(std::size_t c, std::size_t width) {
  constexpr std::array<std::size_t, 6> kSymmetric{0, 1, 2, 3, 5, 4};
  return width == kSymmetric.size() ? kSymmetric[c] : c;
}

}  // namespace hiac::formats::ensight
