#pragma once

#include <cstdint>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/tetrahedralize/cell_place.hpp"

namespace hiac {

/// Cells that replace those of a mesh, between its nodes and new ones in its cells. They are added
/// one after another: their nodes, then what they are.
class Replacement {
 public:
  /// The mesh must outlive this.
  explicit Replacement(const ZooMesh& mesh);

  /// Makes a node at a place and returns its number, which follows those of the mesh's own nodes.
  /// Throws InputError where there would be more than 2^32 - 1 nodes.
  NodeId make_node(const CellPlace& place);

  /// Adds a node of the next cell; `place_of()` is where fields of corners are evaluated for it.
  template <typename PlaceOf>
  void add_node(NodeId node, const PlaceOf& place_of) {
    nodes_.push_back(node);
    if (has_corner_fields_) corner_places_.push_back(place_of());
  }

  /// Makes a cell of the nodes added since the last one; cell fields have the parent's values
  /// there. Throws InputError where there would be more than 2^32 - 1 cells.
  void finish_cell(CellId parent, CellKind kind);

  /// The nodes that were made, whether or not a cell uses them.
  [[nodiscard]] std::size_t made_nodes() const { return made_.size(); }

  /// Returns the mesh of the new cells with the nodes that they use, in their order, and the fields
  /// and metadata of the given one, but no adjacency; to be called once. Fields are interpolated at
  /// the nodes made.
  ZooMesh finish();

 private:
  [[nodiscard]] SharedArray<double> at_nodes(const NodeValues& values,
                                             const std::vector<NodeId>& used) const;
  [[nodiscard]] SharedArray<double> at_corners(const NodeValues& values) const;
  [[nodiscard]] SharedArray<double> values_of(const Field& field,
                                              const std::vector<NodeId>& used) const;

  const ZooMesh& mesh_;
  bool has_corner_fields_ = false;
  std::vector<CellKind> kinds_;
  std::vector<std::uint64_t> elems_{0};
  std::vector<NodeId> nodes_;
  std::vector<CellId> parents_;           // of every cell
  std::vector<CellPlace> corner_places_;  // of every entry of nodes_, if a field lives on corners
  std::vector<CellPlace> made_;           // the nodes made
};

}  // namespace hiac
