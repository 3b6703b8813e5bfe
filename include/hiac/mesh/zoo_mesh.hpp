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

/// What a field's values belong to.
enum class FieldLocation : std::uint8_t {
  node,   ///< one tuple per node: continuous
  cell,   ///< one tuple per cell: constant in the cell
  corner  ///< one tuple per entry of ZooMesh::nodes: discontinuous across faces
};

/// A field of scalars, vectors or tensors over the mesh.
struct Field {
  std::string name;
  std::string unit;  ///< empty if the source names none
  FieldLocation location = FieldLocation::node;
  std::uint32_t components = 1;
  SharedArray<double> values;  ///< tuple count x components, component fastest
};

/// For every face of every cell, the cell on its other side.
/// Faces are numbered cell by cell in the order of their shape's table (ZooMesh::face_offset).
struct FaceAdjacency {
  /// One entry per face: the neighbour, or kNoCell if no other cell has a face with the same
  /// conventional nodes. Faces that more than two cells share count as unmatched.
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
  SharedArray<double> xyz;  ///< x y z per node, world units
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

/// Returns the index of the first face of every cell, and last the number of faces (cell_count() +
/// 1 entries): the numbering of FaceAdjacency.
std::vector<std::uint64_t> face_offsets(const ZooMesh& mesh);

/// Returns a 128-bit hash of the mesh's kinds, nodes, coordinates and fields, without metadata and
/// data that can be recomputed, as 32 hexadecimal digits.
std::string content_hash(const ZooMesh& mesh);

/// Returns the name by which scalar_field knows a field of the mesh (before any `:`): the field's
/// own name, followed by its location if several fields share the name.
std::string distinct_name(const ZooMesh& mesh, const Field& field);

/// Returns a scalar field by name. Accepts NAME for a field of one component, NAME:x (y, z; xx, yy,
/// zz, xy, yz, xz for six components; xx, xy, xz, yx ... zz for nine; 0, 1, 2 ... always), and
/// NAME:magnitude, the Euclidean length of every tuple, or NAME:value, a scalar as it is, else its
/// magnitude. Fields of six and nine components also have NAME:von_mises, NAME:tresca, NAME:trace
/// and NAME:principal_1 (the largest), _2 and _3; of nine components these are the scalars of the
/// symmetric part. `position:x`, `:y` and `:z` are the coordinates of the nodes, unless a field has
/// that name. If a node, a cell and a corner field share a name, NAME@node, NAME@cell and
/// NAME@corner distinguish them (before any `:`). Throws UsageError, which names the existing
/// fields, if no field or more than one matches. A field that is a scalar is not copied.
Field scalar_field(const ZooMesh& mesh, const std::string& reference);

/// Returns the names that scalar_field accepts, components and magnitudes included, in the mesh's
/// order.
std::vector<std::string> scalar_field_names(const ZooMesh& mesh);

}  // namespace hiac
