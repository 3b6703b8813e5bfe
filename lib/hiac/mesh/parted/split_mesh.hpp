#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hiac/mesh/parted/mesh_part.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Takes a mesh apart, one part after the other, so that no more than one has to be in memory.
/// Besides the mesh it holds 4 bytes a cell and 4 bytes a node.
///
/// Every node of the mesh is in at least one part: nodes of no cell go into part 0, so that the
/// parts together hold the whole mesh. A part keeps the fields of all locations and the metadata.
/// It has a face adjacency if the mesh has one: that of the part as a mesh of its own.
class MeshSplitter {
 public:
  /// `part_of_cell` gives the part of every cell. `mesh` must outlive this. Throws
  /// std::invalid_argument unless there is one entry a cell, each below `parts`.
  MeshSplitter(const ZooMesh& mesh, std::span<const std::uint32_t> part_of_cell, std::size_t parts);

  [[nodiscard]] std::size_t part_count() const { return ends_.size(); }
  /// The cells of a part, ascending.
  [[nodiscard]] std::span<const CellId> cells_of(std::size_t part) const;
  /// Makes a part. It has no cells if no cell was given to it.
  MeshPart part(std::size_t part);

 private:
  std::vector<NodeId> take_nodes(std::size_t part, std::span<NodeId> nodes);
  [[nodiscard]] FaceAdjacency adjacency_of(const ZooMesh& part, std::span<const CellId> cells);

  const ZooMesh& mesh_;
  std::vector<CellId> cells_;      ///< part after part
  std::vector<std::size_t> ends_;  ///< of every part's cells in `cells_`
  std::vector<NodeId> unused_;     ///< the nodes of no cell
  std::vector<NodeId> local_;      ///< scratch: for every node its number in the part at hand
  std::vector<std::uint64_t> face_offsets_;  ///< empty unless the adjacency is cut
};

/// Takes a mesh apart, all parts at once. See MeshSplitter.
std::vector<MeshPart> split_mesh(const ZooMesh& mesh, std::span<const std::uint32_t> part_of_cell,
                                 std::size_t parts);

}  // namespace hiac
