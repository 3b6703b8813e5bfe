#include "formats/unv/unv_elements.hpp"

#include <array>

#include <fmt/format.h>

#include "formats/common/cells/solid_orders.hpp"

namespace hiac::formats::unv {
namespace {

// Node i of the zoo's kind is the file's node [i]; checked with files of SALOME, whose reader has
// the same lists.
constexpr std::array<std::uint8_t, 10> kTetrahedron10{0, 2, 4, 9, 1, 3, 5, 6, 7, 8};
constexpr std::array<std::uint8_t, 15> kPrism15{0, 4, 2, 9, 13, 11, 5, 3, 1, 14, 12, 10, 6, 8, 7};
constexpr std::array<std::uint8_t, 20> kBrick20{0, 2, 4,  6,  12, 14, 16, 18, 1,  3,
                                                5, 7, 13, 15, 17, 19, 8,  9,  10, 11};

/// The number of nodes of a surface. The last digit of its descriptor is the shape: linear,
/// parabolic, cubic triangle; quadrilateral.
std::size_t surface_nodes(std::int64_t descriptor) {
  constexpr std::array<std::size_t, 7> kNodes{0, 3, 6, 9, 4, 8, 12};
  const auto digit = static_cast<std::size_t>(descriptor % 10);
  return digit < kNodes.size() ? kNodes[digit] : 0;
}

}  // namespace

std::optional<UnvElement> unv_element(std::int64_t descriptor) {
  switch (descriptor) {
    case 11:
      return UnvElement{{"rod", 2, kNoVolume}, true};
    case 21:
    case 22:
      return UnvElement{{"beam", 2, kNoVolume}, true};
    case 23:
    case 24:
      return UnvElement{{"parabolic beam", 3, kNoVolume}, true};
    case 111:
      return UnvElement{{"tet4", 4, solid_conversion(CellKind::tetrahedron4)}};
    case 112:
      return UnvElement{{"wedge6", 6, solid_conversion(CellKind::prism6)}};
    case 113:
      return UnvElement{{"wedge15", 15, converted_to(CellKind::prism15, kPrism15)}};
    case 115:
      return UnvElement{{"hex8", 8, solid_conversion(CellKind::brick8)}};
    case 116:
      return UnvElement{{"hex20", 20, converted_to(CellKind::brick20, kBrick20)}};
    case 118:
      return UnvElement{{"tet10", 10, converted_to(CellKind::tetrahedron10, kTetrahedron10)}};
    case 114:
      return UnvElement{{"cubic wedge", 24, {}}};
    case 117:
      return UnvElement{{"cubic hex", 32, {}}};
    case 161:
      return UnvElement{{"lumped mass", 1, kNoVolume}};
    default:
      break;
  }
  const std::int64_t family = descriptor / 10;
  if (family < 4 || family > 10 || surface_nodes(descriptor) == 0) return std::nullopt;
  const std::size_t nodes = surface_nodes(descriptor);
  return UnvElement{{fmt::format("surface{}", nodes), nodes, kNoVolume}};
}

}  // namespace hiac::formats::unv
