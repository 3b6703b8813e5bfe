#include "formats/common/cells/sorted_tetrahedra.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/geometry/predicates.hpp"

namespace hiac::formats {
namespace {

// fewer may be sorted by chance
constexpr std::size_t kFewest = 24;

// Where the nodes of the linear tetrahedra begin in cell_nodes.
std::vector<std::size_t> tetrahedra_of(const ForeignMesh& mesh) {
  std::vector<std::size_t> result;
  std::size_t begin = 0;
  for (const std::uint16_t type : mesh.cell_types) {
    const CellConversion& conversion = mesh.types[type].conversion;
    if (conversion.fate == CellFate::converted && conversion.kind == CellKind::tetrahedron4)
      result.push_back(begin);
    begin += mesh.types[type].nodes;
  }
  return result;
}

// Whether the four nodes are points of the mesh, in ascending order.
bool is_sorted(const ForeignMesh& mesh, std::span<const std::int64_t> nodes) {
  return nodes[0] >= mesh.first_node &&
         std::ranges::adjacent_find(nodes, std::greater_equal<>()) == nodes.end() &&
         nodes[3] - mesh.first_node < static_cast<std::int64_t>(mesh.point_count());
}

bool is_left_handed(const ForeignMesh& mesh, std::span<const std::int64_t> nodes) {
  const auto point = [&](std::size_t k) {
    return Point3(&mesh.xyz[3 * static_cast<std::size_t>(nodes[k] - mesh.first_node)], 3);
  };
  return orientation(point(0), point(1), point(2), point(3)) < 0;
}

}  // namespace

void turn_sorted_tetrahedra(ForeignMesh& mesh) {
  const std::vector<std::size_t> tetrahedra = tetrahedra_of(mesh);
  if (tetrahedra.size() < kFewest) return;
  const auto nodes_at = [&](std::size_t begin) {
    return std::span(mesh.cell_nodes).subspan(begin, 4);
  };
  std::vector<std::size_t> left;
  for (const std::size_t begin : tetrahedra) {
    if (!is_sorted(mesh, nodes_at(begin))) return;
    if (is_left_handed(mesh, nodes_at(begin))) left.push_back(begin);
  }
  if (left.empty() || left.size() == tetrahedra.size()) return;
  for (const std::size_t begin : left)
    std::swap(mesh.cell_nodes[begin], mesh.cell_nodes[begin + 1]);
  mesh.notes.push_back(
      fmt::format("numbered {} of {} tetrahedra right-handed: all have their nodes sorted by "
                  "number, which tells no hand",
                  left.size(), tetrahedra.size()));
}

}  // namespace hiac::formats
