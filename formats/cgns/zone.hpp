#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "formats/cgns/cgns_file.hpp"
#include "formats/common/mesh/structured.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats::cgns {

/// A zone and its place in the mesh.
struct Zone {
  std::string name;
  Node node;
  bool structured = false;
  StructuredBlock block;
  std::size_t points = 0;
  std::size_t cells = 0;
  /// For an unstructured zone: the place of each of its cells among the values of a solution.
  std::vector<std::size_t> numbers;
  std::size_t numbered = 0;  ///< cells of the zone that solutions have values for
};

/// Extra layers around a structured zone's values, before and behind along each axis.
using Rind = std::array<std::size_t, 6>;

/// The arrays of one zone that hold a field at one step, one per component.
struct FieldPart {
  std::vector<Node> arrays;
  Rind rind{};  ///< of a structured zone's solution
};

/// The extra layers that a node declares for the arrays below it.
Rind rind_of(const CgnsFile& file, const Node& parent);

/// A field's values in one zone, one list per component; NaN in cells that solutions have no values
/// for. Throws InputError when an array has another size.
std::vector<std::vector<double>> values_in(const CgnsFile& file, const Zone& zone,
                                           const FieldPart& part, FieldLocation location);

}  // namespace hiac::formats::cgns
