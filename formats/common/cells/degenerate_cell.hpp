#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats {

/// The true kind of a cell with repeated nodes.
struct TrueCell {
  /// Empty, or why the cell is none of the zoo's kinds.
  std::string_view problem;
  CellKind kind{};
  /// Node i of the true cell is node nodes[i] of the cell as it was written.
  std::array<std::uint8_t, 20> nodes{};
  /// Mid-edge nodes of the cell as it was written that are not those of the true cell, and the
  /// nodes that lie where they should: the end of a collapsed edge, or the other middle of an edge
  /// that two edges became. `problem` says so, but `kind` and `nodes` are valid.
  std::vector<std::pair<std::uint8_t, std::uint8_t>> replaced = {};
};

/// The faces of a cell with repeated nodes that have an area, as places of its nodes, turning as
/// the shape's faces do. They close round the cell; fewer than four of them hold no volume.
std::vector<std::vector<std::uint8_t>> merged_faces(CellKind kind, std::span<const NodeId> nodes);

/// Finds the true kind of cells that were written with repeated nodes: the brick that is a prism, a
/// pyramid, a tetrahedron or a wedge, in any position, and likewise for the other shapes.
///
/// Method: repeated nodes are merged in the shape's faces, and faces left with fewer than three
/// corners are removed. The remaining faces are compared, with their winding, with the shapes of
/// the zoo under every numbering of its corners. Orientation is kept. The mid-edge nodes of a
/// 20-node brick follow: the mid-edge node of a collapsed edge must be its corner, and edges that
/// become one must have the same mid-edge node. (Merging nodes gives exactly the interpolant of the
/// linear true kind: with xi = r(1-s), eta = s the collapsed bilinear square is the linear
/// triangle.)
class TrueKinds {
 public:
  /// Whether two of the conventional nodes are the same.
  static bool has_repeated_corner(CellKind kind, std::span<const NodeId> nodes);

  /// The true cell. Patterns of repetition are solved once and remembered.
  TrueCell find(CellKind kind, std::span<const NodeId> nodes);

 private:
  /// Kind, and for every corner the first corner with the same node.
  using Pattern = std::pair<CellKind, std::array<std::uint8_t, 8>>;
  std::map<Pattern, TrueCell> known_;
};

}  // namespace hiac::formats
