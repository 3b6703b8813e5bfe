#include "formats/solid_orders.hpp"

#include <array>
#include <list>
#include <mutex>
#include <vector>

#include "formats/edge_order.hpp"

namespace hiac::formats {
namespace {

constexpr std::array<ShapeEdge, 12> kVerticalFirstBrick{{{0, 1},
                                                         {1, 2},
                                                         {2, 3},
                                                         {3, 0},
                                                         {0, 4},
                                                         {1, 5},
                                                         {2, 6},
                                                         {3, 7},
                                                         {4, 5},
                                                         {5, 6},
                                                         {6, 7},
                                                         {7, 4}}};
constexpr std::array<ShapeEdge, 9> kVerticalFirstPrism{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4}, {2, 5}, {3, 4}, {4, 5}, {5, 3}}};

/// Permutations are views: the ones in use are kept here for good.
std::span<const std::uint8_t> kept(std::vector<std::uint8_t> permutation) {
  static std::mutex guard;
  static std::list<std::vector<std::uint8_t>> all;
  const std::scoped_lock lock(guard);
  for (const std::vector<std::uint8_t>& known : all)
    if (known == permutation) return known;
  return all.emplace_back(std::move(permutation));
}

}  // namespace

CellConversion permuted_conversion(CellKind kind, std::span<const std::uint8_t> permutation) {
  CellConversion conversion;
  conversion.fate = CellFate::converted;
  conversion.kind = kind;
  conversion.permutation = permutation;
  return conversion;
}

CellConversion ordered_conversion(CellKind kind, std::span<const std::uint8_t> corners,
                                  std::span<const ShapeEdge> edges) {
  return permuted_conversion(
      kind,
      kept(permutation_by_edges(kind, corners, edges.empty() ? topology_of(kind).edges : edges)));
}

CellConversion solid_conversion(CellKind kind, std::span<const ShapeEdge> edges) {
  if (shape_of(kind) == CellShape::prism) return ordered_conversion(kind, kRightHandedPrism, edges);
  return edges.empty() ? permuted_conversion(kind, {}) : ordered_conversion(kind, {}, edges);
}

CellConversion vertical_edges_first(CellKind kind) {
  if (kind == CellKind::brick20) return solid_conversion(kind, kVerticalFirstBrick);
  if (kind == CellKind::prism15) return solid_conversion(kind, kVerticalFirstPrism);
  return solid_conversion(kind);
}

CellConversion no_volume() {
  CellConversion conversion;
  conversion.fate = CellFate::no_volume;
  return conversion;
}

CellConversion unsupported_with_corners(CellShape shape) {
  CellConversion conversion = solid_conversion(kind_of(shape, CellOrder::linear));
  conversion.fate = CellFate::unsupported;
  conversion.corners = conversion.kind;
  return conversion;
}

}  // namespace hiac::formats
