#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hiac/base/shared_array.hpp"
#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

using NodeId = std::uint32_t;
using CellId = std::uint32_t;
inline constexpr CellId kNoCell = std::numeric_limits<CellId>::max();

/// Where a field's values live.
enum class FieldLocation : std::uint8_t {
  node,   ///< one tuple a node: continuous
  cell,   ///< one tuple a cell: constant in the cell
  corner  ///< one tuple an entry of ZooMesh::nodes: discontinuous across faces
};

/// A field of scalars, vectors or tensors over the mesh.
struct Field {
  std::string name;
  std::string unit;  ///< empty when the source names none
  FieldLocation location = FieldLocation::node;
  std::uint32_t components = 1;
  SharedArray<double> values;  ///< tuple count x components, component fastest
};

/// For every face of every cell, the cell on its other side.
/// Faces are numbered cell by cell in the order of their shape's table (ZooMesh::face_offset).
struct FaceAdjacency {
  /// One entry a face: the neighbour, or kNoCell where no other cell has a face with the same
  /// conventional nodes. Faces shared by more than two cells count as unmatched.
  SharedArray<CellId> neighbors;
  /// Number of distinct faces that more than two cells share.
  std::uint64_t overshared = 0;
};

/// A mesh of mixed cells (Williams, Max, Stein 1998, Appendix A, with an explicit kind per cell).
///
/// Invariants, checked by `validate`: elems.size() == kinds.size() + 1, elems[0] == 0,
/// elems[i+1] - elems[i] == node_count(kinds[i]), elems.back() == nodes.size(), every entry of
/// nodes is below node_count(), coordinates are finite, and fields have the size that their
/// location demands. Field values may be NaN (real results are).
struct ZooMesh {
  /// Cumulative node counts: cell i has nodes[elems[i]] ... nodes[elems[i+1] - 1].
  SharedArray<std::uint64_t> elems;
  SharedArray<NodeId> nodes;
  SharedArray<double> xyz;  ///< x y z a node, world units
  SharedArray<CellKind> kinds;
  std::vector<Field> fields;
  /// Free text by key, in order: source file, time, units ...
  std::vector<std::pair<std::string, std::string>> metadata;
  std::optional<FaceAdjacency> adjacency;

  [[nodiscard]] std::size_t cell_count() const { return kinds.size(); }
  [[nodiscard]] std::size_t node_count() const { return xyz.size() / 3; }

  /// The nodes of one cell, conventional ones first.
  [[nodiscard]] std::span<const NodeId> cell_nodes(CellId cell) const {
    return nodes.view().subspan(elems[cell], elems[cell + 1] - elems[cell]);
  }
  /// The position of one node.
  [[nodiscard]] std::span<const double, 3> position(NodeId node) const {
    return xyz.view().subspan(std::size_t{3} * node).first<3>();
  }
};

/// Throws InputError(subject, ...) naming the first broken invariant, with the cell or node.
void validate(const ZooMesh& mesh, const std::string& subject);

/// Index of the first face of every cell, and after the last the number of faces: the numbering of
/// FaceAdjacency. (cell_count() + 1 entries.)
std::vector<std::uint64_t> face_offsets(const ZooMesh& mesh);

/// A hash of 128 bits of the mesh: kinds, nodes, coordinates and fields, but not the metadata and
/// not data that can be recomputed. Written as 32 hexadecimal digits.
std::string content_hash(const ZooMesh& mesh);

/// The name by which scalar_field knows a field of the mesh (before any `:`): the field's own name,
/// followed by its location when several fields share the name.
std::string distinct_name(const ZooMesh& mesh, const Field& field);

/// A scalar field picked out by name. Accepts NAME for a field of one component, NAME:x (y, z; xx,
/// yy, zz, xy, yz, xz for six components; 0, 1, 2 ... always), and NAME:magnitude, the Euclidean
/// length of every tuple. Where a node, a cell and a corner field share a name, NAME@node,
/// NAME@cell and NAME@corner distinguish them (before any `:`). Throws UsageError, which names the
/// existing fields, when there is no such field, or more than one.
/// Copies nothing when the field is a scalar.
Field scalar_field(const ZooMesh& mesh, const std::string& reference);

/// The names that scalar_field accepts, components and magnitudes included, in the mesh's order.
std::vector<std::string> scalar_field_names(const ZooMesh& mesh);

}  // namespace hiac
