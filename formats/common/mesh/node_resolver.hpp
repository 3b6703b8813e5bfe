#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "formats/common/io/number_index.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// Turns the node numbers of a file's cells into places of its points, cell after cell, and creates
/// the mid-edge nodes that cells leave out: one for every edge, after the points.
class NodeResolver {
 public:
  /// Throws InputError when two points with different coordinates have one number. `foreign` must
  /// outlive the resolver.
  NodeResolver(const ForeignMesh& foreign, std::string subject);

  struct Cell {
    std::span<const NodeId> nodes;  ///< in the file's order; valid until the next call
    const CellConversion* conversion;
  };
  /// Resolves the cell at that place, whose node numbers begin at `begin`. Throws
  /// InputError(subject, ...) naming the cell when a node does not exist.
  Cell resolve(std::size_t cell, std::size_t begin);

  /// The ends of the edges that got a new node in the middle.
  [[nodiscard]] const std::vector<std::pair<NodeId, NodeId>>& made() const { return made_; }

 private:
  /// Data of a type that many cells use.
  struct Type {
    CellConversion linear;               ///< for cells that leave out all their mid-edge nodes
    std::vector<std::uint8_t> required;  ///< places of nodes that every cell must have
  };
  static Type type_of(const ForeignType& foreign);
  [[nodiscard]] NodeId place_of(std::int64_t number, std::size_t cell) const;
  const CellConversion* fill_in(std::size_t cell, const ForeignType& foreign, const Type& type,
                                std::span<const std::int64_t> numbers);
  NodeId middle_of(NodeId a, NodeId b);
  [[nodiscard]] std::string name_of(std::size_t cell) const;

  const ForeignMesh& foreign_;
  std::string subject_;
  NumberIndex index_;
  std::vector<Type> types_;
  std::vector<NodeId> nodes_;
  std::unordered_map<std::uint64_t, NodeId> middles_;
  std::vector<std::pair<NodeId, NodeId>> made_;
};

/// The node at `place` is left out and is the middle of an edge: the places of that edge's ends
/// among the nodes of the file's cell. `conversion` is to a quadratic kind.
std::pair<std::size_t, std::size_t> edge_ends(const CellConversion& conversion, std::size_t place);

}  // namespace hiac::formats
