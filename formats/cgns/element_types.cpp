#include "formats/cgns/element_types.hpp"

#include <map>
#include <vector>

#include "formats/common/cells/cell_conversion.hpp"
#include "formats/common/cells/edge_order.hpp"
#include "formats/common/cells/upright_edges.hpp"

namespace hiac::formats::cgns {
namespace {

/// Tables of node orders, which conversions refer to.
struct Orders {
  std::vector<std::uint8_t> penta15 =
      permutation_by_edges(CellKind::prism15, kRightHandedPrism, kUprightPrism);
  std::vector<std::uint8_t> penta24 =
      permutation_by_edges(CellKind::prism24, kRightHandedPrism, kUprightPrism);
  std::vector<std::uint8_t> hexa20 = permutation_by_edges(CellKind::brick20, {}, kUprightBrick);
  std::vector<std::uint8_t> hexa32 = permutation_by_edges(CellKind::brick32, {}, kUprightBrick);
  std::vector<std::uint8_t> pyra21 = permutation_by_edges(CellKind::pyramid21, {}, kUprightPyramid);
  // the nodes of the edges are followed by those of the faces 1 2 3, 1 2 4, 2 3 4, 3 1 4
  std::vector<std::uint8_t> tetra20 = permutation_by_edges(
      CellKind::tetrahedron20, {}, kUprightTetrahedron, std::vector<std::uint8_t>{1, 2, 3, 0});
};

std::map<std::int64_t, ElementType> make_elements() {
  static const Orders orders;
  const auto flat = [](const char* name, std::size_t nodes) {
    return ElementType{name, nodes, kNoVolume};
  };
  return {{2, flat("NODE", 1)},
          {3, flat("BAR_2", 2)},
          {4, flat("BAR_3", 3)},
          {5, flat("TRI_3", 3)},
          {6, flat("TRI_6", 6)},
          {7, flat("QUAD_4", 4)},
          {8, flat("QUAD_8", 8)},
          {9, flat("QUAD_9", 9)},
          {10, {"TETRA_4", 4, converted_to(CellKind::tetrahedron4)}},
          {11, {"TETRA_10", 10, converted_to(CellKind::tetrahedron10)}},
          {12, {"PYRA_5", 5, converted_to(CellKind::pyramid5)}},
          {13, {"PYRA_14", 14, unsupported_with(CellKind::pyramid5)}},
          {14, {"PENTA_6", 6, converted_to(CellKind::prism6, kRightHandedPrism)}},
          {15, {"PENTA_15", 15, converted_to(CellKind::prism15, orders.penta15)}},
          {16, {"PENTA_18", 18, unsupported_with(CellKind::prism6, kRightHandedPrism)}},
          {17, {"HEXA_8", 8, converted_to(CellKind::brick8)}},
          {18, {"HEXA_20", 20, converted_to(CellKind::brick20, orders.hexa20)}},
          {19, {"HEXA_27", 27, unsupported_with(CellKind::brick8)}},
          {21, {"PYRA_13", 13, converted_to(CellKind::pyramid13)}},
          {24, flat("BAR_4", 4)},
          {25, flat("TRI_9", 9)},
          {26, flat("TRI_10", 10)},
          {27, flat("QUAD_12", 12)},
          {28, flat("QUAD_16", 16)},
          {29, {"TETRA_16", 16, unsupported_with(CellKind::tetrahedron4)}},
          {30, {"TETRA_20", 20, converted_to(CellKind::tetrahedron20, orders.tetra20)}},
          {31, {"PYRA_21", 21, converted_to(CellKind::pyramid21, orders.pyra21)}},
          {32, {"PYRA_29", 29, unsupported_with(CellKind::pyramid5)}},
          {33, {"PYRA_30", 30, unsupported_with(CellKind::pyramid5)}},
          {34, {"PENTA_24", 24, converted_to(CellKind::prism24, orders.penta24)}},
          {35, {"PENTA_38", 38, unsupported_with(CellKind::prism6, kRightHandedPrism)}},
          {36, {"PENTA_40", 40, unsupported_with(CellKind::prism6, kRightHandedPrism)}},
          {37, {"HEXA_32", 32, converted_to(CellKind::brick32, orders.hexa32)}},
          {38, {"HEXA_56", 56, unsupported_with(CellKind::brick8)}},
          {39, {"HEXA_64", 64, unsupported_with(CellKind::brick8)}},
          {40, flat("BAR_5", 5)},
          {41, flat("TRI_12", 12)},
          {42, flat("TRI_15", 15)},
          {43, flat("QUAD_P4_16", 16)},
          {44, flat("QUAD_25", 25)},
          {45, {"TETRA_22", 22, unsupported_with(CellKind::tetrahedron4)}},
          {46, {"TETRA_34", 34, unsupported_with(CellKind::tetrahedron4)}},
          {47, {"TETRA_35", 35, unsupported_with(CellKind::tetrahedron4)}},
          {48, {"PYRA_P4_29", 29, unsupported_with(CellKind::pyramid5)}},
          {49, {"PYRA_50", 50, unsupported_with(CellKind::pyramid5)}},
          {50, {"PYRA_55", 55, unsupported_with(CellKind::pyramid5)}},
          {51, {"PENTA_33", 33, unsupported_with(CellKind::prism6, kRightHandedPrism)}},
          {52, {"PENTA_66", 66, unsupported_with(CellKind::prism6, kRightHandedPrism)}},
          {53, {"PENTA_75", 75, unsupported_with(CellKind::prism6, kRightHandedPrism)}},
          {54, {"HEXA_44", 44, unsupported_with(CellKind::brick8)}},
          {55, {"HEXA_98", 98, unsupported_with(CellKind::brick8)}},
          {56, {"HEXA_125", 125, unsupported_with(CellKind::brick8)}}};
}

}  // namespace

std::optional<ElementType> element_numbered(std::int64_t number) {
  static const std::map<std::int64_t, ElementType> elements = make_elements();
  const auto found = elements.find(number);
  if (found == elements.end()) return std::nullopt;
  return found->second;
}

}  // namespace hiac::formats::cgns
