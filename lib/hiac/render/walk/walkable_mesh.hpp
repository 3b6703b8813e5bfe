#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/render/walk/near_order.hpp"

namespace hiac {

/// A face of a tetrahedron of a WalkableMesh, named by the cell and the number of the node that it
/// lacks; or no face.
class OppositeFace {
 public:
  static constexpr std::size_t kMostCells = (std::size_t{1} << 30) - 1;

  constexpr OppositeFace() = default;
  constexpr OppositeFace(CellId cell, std::size_t opposite)
      : code_(4 * cell + static_cast<std::uint32_t>(opposite)) {}

  [[nodiscard]] constexpr bool exists() const { return code_ != kNone; }
  [[nodiscard]] constexpr CellId cell() const { return code_ / 4; }
  [[nodiscard]] constexpr std::size_t opposite() const { return code_ % 4; }
  constexpr bool operator==(const OppositeFace&) const = default;

 private:
  static constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t code_ = kNone;
};

/// A face without a neighbour, and its nodes.
struct BoundaryFace {
  OppositeFace face;
  std::array<NodeId, 3> corners;
};

/// A mesh of linear tetrahedra whose rays can be followed from cell to cell: what does not depend
/// on the view. It numbers nodes and cells anew (near_order): those that a ray meets one after the
/// other lie near one another in memory.
class WalkableMesh {
 public:
  /// None if the mesh has other cells, cells with one node twice, or 2^30 cells or more, or if the
  /// adjacency is not that of the mesh: a neighbour that does not have the face, or has another
  /// neighbour there. The mesh must outlive the object. Takes the time of near_order, in parallel,
  /// 36 bytes a cell and 4 a node.
  static std::optional<WalkableMesh> of(const ZooMesh& mesh, const FaceAdjacency& adjacency);
  /// The same of a mesh of which `of` has made one before: nothing is checked again.
  static WalkableMesh again(const ZooMesh& mesh, const FaceAdjacency& adjacency);

  [[nodiscard]] const ZooMesh& mesh() const { return *mesh_; }

  /// A cell's nodes and, opposite each of them, the face as the cell on the other side names it:
  /// none on the boundary.
  struct alignas(32) Cell {
    std::array<NodeId, 4> nodes;
    std::array<OppositeFace, 4> across;
  };
  /// Which of a cell's nodes is this one, which must be one of them. Without branches, which
  /// nothing predicts.
  static constexpr std::size_t number_of(NodeId node, const std::array<NodeId, 4>& nodes) {
    return std::size_t{nodes[1] == node} + 2 * std::size_t{nodes[2] == node} +
           3 * std::size_t{nodes[3] == node};
  }

  [[nodiscard]] const Cell& operator[](CellId cell) const { return cells_[cell]; }
  /// The faces without a neighbour, in ascending order of their cells.
  [[nodiscard]] const std::vector<BoundaryFace>& boundary() const { return boundary_; }

  [[nodiscard]] std::size_t cell_count() const { return cells_.size(); }
  [[nodiscard]] std::size_t node_count() const { return order_.nodes.size(); }
  /// What the mesh itself calls a cell and a node.
  [[nodiscard]] CellId cell_of_mesh(CellId cell) const { return order_.cells[cell]; }
  [[nodiscard]] NodeId node_of_mesh(NodeId node) const { return order_.nodes[node]; }

 private:
  WalkableMesh(const ZooMesh& mesh, const FaceAdjacency& adjacency);
  void find_boundary();

  const ZooMesh* mesh_;
  NearOrder order_;
  std::vector<Cell> cells_;
  std::vector<BoundaryFace> boundary_;
};

}  // namespace hiac
