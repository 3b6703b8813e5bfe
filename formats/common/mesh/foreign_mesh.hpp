#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/common/cells/cell_conversion.hpp"
#include "formats/common/mesh/field_steps.hpp"
#include "formats/common/mesh/format.hpp"
#include "hiac/base/parallel.hpp"

namespace hiac::formats {

/// A mid-edge node that a cell leaves out, as solvers' decks may.
inline constexpr std::int64_t kLeftOutNode = std::numeric_limits<std::int64_t>::min();

/// A cell type of the format: its name, the number of nodes of its cells in the file, and their
/// conversion. A file has few types.
struct ForeignType {
  std::string name;
  std::size_t nodes = 0;
  CellConversion conversion;
  /// For a type that the zoo does not have: the evenly spaced reference positions of its nodes, if
  /// the format defines them; empty: they are recognized from the positions of the cells' nodes.
  std::vector<std::array<double, 3>> places = {};
};

/// Some of the file's cells under a name: a part, a set, a material. Sets may overlap.
struct ForeignBlock {
  std::string name;
  std::vector<IndexRange> cells;  ///< places in ForeignMesh::cell_types
};

/// Cells that are described by their faces.
struct ForeignPolyhedra {
  /// Places in ForeignMesh::cell_types, rising; the type of such a cell has no nodes.
  std::vector<std::size_t> cells;
  std::vector<std::size_t> ends;    ///< for every such cell the end of its list in `faces`
  std::vector<std::int64_t> faces;  ///< face after face: how many nodes it has, and their numbers
};

/// One field at one step. Its values are read on request.
struct ForeignField {
  std::string name;
  std::string unit;
  FieldLocation location = FieldLocation::node;
  std::uint32_t components = 1;
  std::optional<std::size_t> step;  ///< place in ForeignMesh::times; none: it holds at all times
  std::string type = "double";      ///< the format's number type
  /// A tuple for every point, every cell, or every entry of ForeignMesh::cell_nodes; NaN where the
  /// file has no value. Throws InputError.
  std::function<std::vector<double>()> values;
};

/// A field whose values are already in memory, as the format's integers or reals.
ForeignField field_of(std::string name, FieldLocation location, std::uint32_t components,
                      std::vector<double>&& values);

/// The contents of a file, with its own numbers and node orders. A reader produces it, and
/// `assemble` turns it into a zoo mesh.
struct ForeignMesh {
  std::vector<double> xyz;
  /// The number of every point; empty: points are numbered from first_node on.
  std::vector<std::int64_t> node_numbers;
  std::int64_t first_node = 0;

  std::vector<ForeignType> types;
  std::vector<std::uint16_t> cell_types;  ///< for every cell its place in `types`
  std::vector<std::int64_t> cell_nodes;   ///< node numbers, cell after cell
  ForeignPolyhedra polyhedra;
  /// The number of every cell, for messages; empty: cells are numbered from 1 on.
  std::vector<std::int64_t> cell_numbers;

  std::vector<ForeignBlock> blocks;
  std::vector<double> times;  ///< in the file's order
  std::vector<ForeignField> fields;
  /// For a reader that adds the fields of one step only: the steps at which each field of the file
  /// has values. Empty: `fields` holds those of all steps.
  FieldSteps field_steps;
  std::vector<std::pair<std::string, std::string>> metadata;
  std::vector<std::string> notes;

  /// The place of the type with that name and number of nodes, which is added if it is new. Throws
  /// InputError when there are already 65536 types.
  std::uint16_t type_place(std::string_view name, std::size_t nodes,
                           const CellConversion& conversion);

  /// Adds a polyhedron with these faces, each a list of node numbers.
  void add_polyhedron(std::string_view type_name,
                      const std::vector<std::vector<std::int64_t>>& faces);

  [[nodiscard]] std::size_t point_count() const { return xyz.size() / 3; }
  [[nodiscard]] std::size_t cell_count() const { return cell_types.size(); }
};

}  // namespace hiac::formats
