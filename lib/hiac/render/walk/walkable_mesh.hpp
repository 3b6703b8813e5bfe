#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A face of a tetrahedron, named by the node that it lacks: node number `opposite` of the cell.
struct OppositeFace {
  CellId cell;
  std::uint8_t opposite;

  bool operator==(const OppositeFace&) const = default;
};

/// A face without a neighbour, and its nodes.
struct BoundaryFace {
  OppositeFace face;
  std::array<NodeId, 3> corners;
};

/// A mesh of linear tetrahedra whose rays can be followed from cell to cell: what does not depend
/// on the view.
class WalkableMesh {
 public:
  /// None if the mesh has other cells, or cells with one node twice, or if the adjacency is not
  /// that of the mesh: a neighbour that does not have the face, or has another neighbour there.
  /// The mesh must outlive the object. Takes linear time, in parallel, and 32 bytes a cell.
  static std::optional<WalkableMesh> of(const ZooMesh& mesh, const FaceAdjacency& adjacency);
  /// The same of a mesh of which `of` has made one before: nothing is checked again.
  static WalkableMesh again(const ZooMesh& mesh, const FaceAdjacency& adjacency);

  [[nodiscard]] const ZooMesh& mesh() const { return *mesh_; }

  /// A cell's nodes, and opposite each of them the cell on the other side; kNoCell if there is
  /// none.
  struct alignas(32) Cell {
    std::array<NodeId, 4> nodes;
    std::array<CellId, 4> across;
  };
  [[nodiscard]] const Cell& operator[](CellId cell) const { return cells_[cell]; }
  /// The faces without a neighbour, in ascending order of their cells.
  [[nodiscard]] const std::vector<BoundaryFace>& boundary() const { return boundary_; }

 private:
  WalkableMesh(const ZooMesh& mesh, const FaceAdjacency& adjacency);
  [[nodiscard]] bool is_sound(CellId cell) const;
  void find_boundary();

  const ZooMesh* mesh_;
  std::vector<Cell> cells_;
  std::vector<BoundaryFace> boundary_;
};

}  // namespace hiac
