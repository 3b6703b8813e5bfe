#include "formats/med/element_types.hpp"

#include <array>
#include <vector>

#include "formats/common/cells/cell_conversion.hpp"
#include "formats/common/cells/edge_order.hpp"

namespace hiac::formats::med {
namespace {

// The normal of MED's first face points out of the cell: tetrahedra, pyramids and bricks have the
// opposite orientation to the zoo's, prisms the same. Mid-edge nodes: round the bottom, round the
// top, up the sides, as in the zoo.
constexpr std::array<std::uint8_t, 4> kTetra{0, 2, 1, 3};
constexpr std::array<std::uint8_t, 5> kPyramid{0, 3, 2, 1, 4};
constexpr std::array<std::uint8_t, 8> kHexa{0, 3, 2, 1, 4, 7, 6, 5};

std::vector<ElementType> make_elements() {
  const auto quadratic = [](CellKind kind, std::span<const std::uint8_t> corners) {
    return permutation_by_edges(kind, corners, topology_of(kind).edges);
  };
  static const auto tetra10 = quadratic(CellKind::tetrahedron10, kTetra);
  static const auto pyramid13 = quadratic(CellKind::pyramid13, kPyramid);
  static const auto hexa20 = quadratic(CellKind::brick20, kHexa);
  return {{"TE4", 4, converted_to(CellKind::tetrahedron4, kTetra)},
          {"T10", 10, converted_to(CellKind::tetrahedron10, tetra10)},
          {"PY5", 5, converted_to(CellKind::pyramid5, kPyramid)},
          {"P13", 13, converted_to(CellKind::pyramid13, pyramid13)},
          {"PE6", 6, converted_to(CellKind::prism6)},
          {"P15", 15, converted_to(CellKind::prism15)},
          {"P18", 18, unsupported_with(CellKind::prism6)},
          {"HE8", 8, converted_to(CellKind::brick8, kHexa)},
          {"H20", 20, converted_to(CellKind::brick20, hexa20)},
          {"H27", 27, unsupported_with(CellKind::brick8, kHexa)},
          {"O12", 12, kUnsupported},
          {"PO1", 1, kNoVolume},
          {"SE2", 2, kNoVolume},
          {"SE3", 3, kNoVolume},
          {"SE4", 4, kNoVolume},
          {"TR3", 3, kNoVolume},
          {"TR6", 6, kNoVolume},
          {"TR7", 7, kNoVolume},
          {"QU4", 4, kNoVolume},
          {"QU8", 8, kNoVolume},
          {"QU9", 9, kNoVolume}};
}

}  // namespace

std::optional<ElementType> element_named(std::string_view name) {
  static const std::vector<ElementType> elements = make_elements();
  for (const ElementType& element : elements)
    if (element.name == name) return element;
  return std::nullopt;
}

}  // namespace hiac::formats::med
