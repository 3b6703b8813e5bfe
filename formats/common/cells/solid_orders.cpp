#include "formats/common/cells/solid_orders.hpp"

#include "formats/common/cells/edge_order.hpp"
#include "formats/common/cells/upright_edges.hpp"

namespace hiac::formats {

CellConversion ordered_conversion(CellKind kind, std::span<const std::uint8_t> corners,
                                  std::span<const ShapeEdge> edges) {
  return converted_to(kind, kept_permutation(permutation_by_edges(
                                kind, corners, edges.empty() ? topology_of(kind).edges : edges)));
}

CellConversion solid_conversion(CellKind kind, std::span<const ShapeEdge> edges) {
  if (shape_of(kind) == CellShape::prism) return ordered_conversion(kind, kRightHandedPrism, edges);
  return edges.empty() ? converted_to(kind) : ordered_conversion(kind, {}, edges);
}

CellConversion vertical_edges_first(CellKind kind) {
  if (kind == CellKind::brick20) return solid_conversion(kind, kUprightBrick);
  if (kind == CellKind::prism15) return solid_conversion(kind, kUprightPrism);
  return solid_conversion(kind);
}

CellConversion unsupported_with_corners(CellShape shape) {
  CellConversion conversion = solid_conversion(kind_of(shape, CellOrder::linear));
  conversion.fate = CellFate::unsupported;
  conversion.corners = conversion.kind;
  return conversion;
}

}  // namespace hiac::formats
