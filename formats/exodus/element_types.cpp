#include "formats/exodus/element_types.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

#include "formats/common/cells/cell_conversion.hpp"
#include "formats/common/cells/edge_order.hpp"
#include "formats/common/cells/upright_edges.hpp"

namespace hiac::formats::exodus {
namespace {

/// An element's shape, its corners, and the nodes of its quadratic kind.
struct Element {
  std::string_view letters;  ///< with which names begin
  CellShape shape;
  std::span<const std::uint8_t> corners;
  std::vector<std::uint8_t> quadratic;
};

Element element(std::string_view letters, CellShape shape, std::span<const std::uint8_t> corners,
                std::span<const ShapeEdge> edges) {
  return {letters, shape, corners,
          permutation_by_edges(kind_of(shape, CellOrder::quadratic), corners, edges)};
}

const std::array<Element, 4>& elements() {
  static const std::array<Element, 4> all{
      element("HEX", CellShape::brick, {}, kUprightBrick),
      element("TET", CellShape::tetrahedron, {}, kUprightTetrahedron),
      element("WED", CellShape::prism, kRightHandedPrism, kUprightPrism),
      element("PYR", CellShape::pyramid, {}, kUprightPyramid)};
  return all;
}

constexpr std::array<std::string_view, 14> kFlat{"SHE", "QUA", "TRI", "BAR", "BEA", "TRU", "EDG",
                                                 "SPH", "CIR", "POI", "NSI", "LIN", "SUP", "ROD"};

}  // namespace

CellConversion conversion_of(const std::string& name, std::size_t nodes) {
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  for (const Element& element : elements()) {
    if (!upper.starts_with(element.letters)) continue;
    const CellKind linear = kind_of(element.shape, CellOrder::linear);
    const CellKind quadratic = kind_of(element.shape, CellOrder::quadratic);
    if (nodes == node_count(linear)) return converted_to(linear, element.corners);
    if (nodes == node_count(quadratic)) return converted_to(quadratic, element.quadratic);
    if (nodes < node_count(linear)) return kWrongCount;
    return unsupported_with(linear, element.corners);
  }
  const bool flat = std::any_of(kFlat.begin(), kFlat.end(), [&](std::string_view letters) {
    return upper.starts_with(letters);
  });
  return flat ? kNoVolume : kUnsupported;
}

}  // namespace hiac::formats::exodus
