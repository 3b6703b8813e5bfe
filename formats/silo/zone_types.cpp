#include "formats/silo/zone_types.hpp"

#include <array>
#include <cstddef>

#include <silo.h>

namespace hiac::formats::silo {
namespace {

// Silo's prism lists its quadrilateral 0 1 2 3 first and then the opposite edge 4 5, with 4 next to
// 0 and 3. Tetrahedra, pyramids and prisms occur in either orientation: those of one kind in a
// block are reversed when most of them are inside out.
constexpr std::array<std::uint8_t, 6> kPrism{2, 5, 1, 3, 4, 0};
constexpr std::array<std::uint8_t, 6> kPrismTurned{3, 4, 0, 2, 5, 1};
constexpr std::array<std::uint8_t, 4> kTetrahedronTurned{0, 2, 1, 3};
constexpr std::array<std::uint8_t, 5> kPyramidTurned{0, 3, 2, 1, 4};
constexpr std::array<std::uint8_t, 8> kBrickTurned{0, 3, 2, 1, 4, 7, 6, 5};

}  // namespace

std::optional<ZoneType> zone_type(int type, int size) {
  // older files have no types, only sizes
  if (type == DB_ZONETYPE_TET || (type == 0 && size == 4))
    return ZoneType{CellKind::tetrahedron4, "tetrahedron", {}, kTetrahedronTurned};
  if (type == DB_ZONETYPE_PYRAMID || (type == 0 && size == 5))
    return ZoneType{CellKind::pyramid5, "pyramid", {}, kPyramidTurned};
  if (type == DB_ZONETYPE_PRISM || (type == 0 && size == 6))
    return ZoneType{CellKind::prism6, "prism", kPrism, kPrismTurned};
  if (type == DB_ZONETYPE_HEX || (type == 0 && size == 8))
    return ZoneType{CellKind::brick8, "hexahedron", {}, kBrickTurned};
  return std::nullopt;
}

bool are_inside_out(const ZoneType& type, std::span<const std::int64_t> nodes,
                    std::span<const double> xyz) {
  const std::size_t size = node_count(type.kind);
  const bool prism = type.kind == CellKind::prism6;
  const std::size_t third = prism || type.kind == CellKind::tetrahedron4 ? 2 : 3;
  const std::size_t above = type.kind == CellKind::tetrahedron4 || prism ? 3 : 4;
  std::int64_t votes = 0;
  for (std::size_t z = 0; z < nodes.size() / size; ++z) {
    const auto corner = [&](std::size_t n) {
      const std::size_t place = type.order.empty() ? n : type.order[n];
      return &xyz[3 * static_cast<std::size_t>(nodes[z * size + place])];
    };
    std::array<std::array<double, 3>, 3> arrows{};
    const std::array<std::size_t, 3> ends{1, third, above};
    for (std::size_t e = 0; e < 3; ++e)
      for (std::size_t c = 0; c < 3; ++c) arrows[e][c] = corner(ends[e])[c] - corner(0)[c];
    const auto& [a, b, h] = arrows;
    const double volume = (a[1] * b[2] - a[2] * b[1]) * h[0] + (a[2] * b[0] - a[0] * b[2]) * h[1] +
                          (a[0] * b[1] - a[1] * b[0]) * h[2];
    votes += (prism ? -volume : volume) > 0 ? 1 : -1;
  }
  return votes < 0;
}

}  // namespace hiac::formats::silo
