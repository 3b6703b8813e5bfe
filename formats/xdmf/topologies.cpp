#include "formats/xdmf/topologies.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>
#include <vtkCellType.h>

#include "formats/common/mesh/foreign_mesh.hpp"
#include "formats/vtk/cell_types.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::xdmf {
namespace {

constexpr std::int64_t kPolyhedron = 16;

constexpr std::array<Topology, 25> kTopologies{{
    {"POLYVERTEX", 1, 0, VTK_POLY_VERTEX},
    {"POLYLINE", 2, 0, VTK_POLY_LINE},
    {"POLYGON", 3, 0, VTK_POLYGON},
    {"TRIANGLE", 4, 3, VTK_TRIANGLE},
    {"QUADRILATERAL", 5, 4, VTK_QUAD},
    {"TETRAHEDRON", 6, 4, VTK_TETRA},
    {"PYRAMID", 7, 5, VTK_PYRAMID},
    {"WEDGE", 8, 6, VTK_WEDGE},
    {"HEXAHEDRON", 9, 8, VTK_HEXAHEDRON},
    {"EDGE3", 34, 3, VTK_QUADRATIC_EDGE},
    {"QUADRILATERAL9", 35, 9, VTK_BIQUADRATIC_QUAD},
    {"TRIANGLE6", 36, 6, VTK_QUADRATIC_TRIANGLE},
    {"QUADRILATERAL8", 37, 8, VTK_QUADRATIC_QUAD},
    {"TETRAHEDRON10", 38, 10, VTK_QUADRATIC_TETRA},
    {"PYRAMID13", 39, 13, VTK_QUADRATIC_PYRAMID},
    {"WEDGE15", 40, 15, VTK_QUADRATIC_WEDGE},
    {"WEDGE18", 41, 18, VTK_BIQUADRATIC_QUADRATIC_WEDGE},
    {"HEXAHEDRON20", 48, 20, VTK_QUADRATIC_HEXAHEDRON},
    {"HEXAHEDRON24", 49, 24, VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON},
    {"HEXAHEDRON27", 50, 27, VTK_TRIQUADRATIC_HEXAHEDRON},
    {"TET10", 0, 10, VTK_QUADRATIC_TETRA},
    {"TRI6", 0, 6, VTK_QUADRATIC_TRIANGLE},
    {"HEX20", 0, 20, VTK_QUADRATIC_HEXAHEDRON},
    {"HEX24", 0, 24, VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON},
    {"HEX27", 0, 27, VTK_TRIQUADRATIC_HEXAHEDRON},
}};

}  // namespace

std::optional<Topology> topology_named(const std::string& name) {
  std::string key;
  for (const char c : name)
    if (c != '_') key += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  for (const Topology& topology : kTopologies)
    if (topology.name == key) return topology;
  return std::nullopt;
}

void add_cells(const Topology& topology, std::size_t nodes,
               const std::vector<std::int64_t>& numbers, std::int64_t first_point,
               ForeignMesh& mesh) {
  const std::uint16_t type =
      mesh.type_place(topology.name, nodes, vtk::conversion_of(topology.vtk_type, nodes));
  mesh.cell_types.insert(mesh.cell_types.end(), numbers.size() / nodes, type);
  for (const std::int64_t number : numbers) mesh.cell_nodes.push_back(first_point + number);
}

void add_mixed_cells(const std::vector<std::int64_t>& numbers, std::int64_t first_point,
                     const std::string& subject, ForeignMesh& mesh) {
  std::size_t at = 0;
  const auto next = [&](const char* what) {
    if (at == numbers.size())
      throw InputError(subject, fmt::format("a mixed topology ended early ({} expected)", what));
    return numbers[at++];
  };
  const auto skip = [&](std::int64_t count) {
    if (count < 0 || static_cast<std::uint64_t>(count) > numbers.size() - at)
      throw InputError(subject, fmt::format("a mixed topology ended early ({} nodes expected, {} "
                                            "found)",
                                            count, numbers.size() - at));
    at += static_cast<std::size_t>(count);
  };
  while (at < numbers.size()) {
    const std::int64_t number = next("a cell type");
    if (number == kPolyhedron) {
      std::vector<std::vector<std::int64_t>> faces;
      for (std::int64_t left = next("the number of faces"); left > 0; --left) {
        const std::int64_t nodes = next("a number of nodes");
        const std::size_t first = at;
        skip(nodes);
        faces.emplace_back();
        for (std::size_t n = first; n < at; ++n) faces.back().push_back(first_point + numbers[n]);
      }
      mesh.add_polyhedron("POLYHEDRON", faces);
      continue;
    }
    const auto found =
        std::find_if(kTopologies.begin(), kTopologies.end(),
                     [&](const Topology& topology) { return topology.number == number; });
    if (number == 0 || found == kTopologies.end())
      throw InputError(subject,
                       fmt::format("a mixed topology has a cell of the unknown type {}", number));
    const auto nodes =
        found->nodes == 0 ? next("a number of nodes") : static_cast<std::int64_t>(found->nodes);
    const std::size_t first = at;
    skip(nodes);
    add_cells(*found, std::max<std::size_t>(static_cast<std::size_t>(nodes), 1),
              {numbers.begin() + static_cast<long>(first), numbers.begin() + static_cast<long>(at)},
              first_point, mesh);
  }
}

}  // namespace hiac::formats::xdmf
