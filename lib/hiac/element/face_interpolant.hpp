#pragma once

#include <array>
#include <span>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// One face of a cell with the offsets of a scalar from an isosurface's value at its nodes: first
/// the corners in order around the face, then the nodes between them in the same order, then the
/// centre node if there is one.
struct FaceOffsets {
  static constexpr std::size_t kMostNodes = 12;
  CellOrder order = CellOrder::linear;
  std::size_t count = 0;  ///< of corners: 3 or 4
  bool centred = false;   ///< a cubic tetrahedron's face
  std::array<NodeId, kMostNodes> nodes;
  std::array<double, kMostNodes> offsets;

  /// Adds a corner of a linear face.
  void add(NodeId node, double offset) {
    nodes[count] = node;
    offsets[count++] = offset;
  }
  /// The number of all nodes.
  [[nodiscard]] std::size_t node_count() const {
    return count * static_cast<std::size_t>(order) + (centred ? 1 : 0);
  }
  /// The sign of the offset on the whole face, if it is certain (interpolant_range.hpp): 0 or 1 if
  /// the offset is nowhere below 0, -1 if it is nowhere above and somewhere below 0. Otherwise
  /// returns 0 and sets `mixed`.
  [[nodiscard]] double sign(bool& mixed) const;
};

/// The sign of an interpolant that lies between two values; `mixed`: both signs may occur.
double sign_between(double least, double most, bool& mixed);

/// An offset just below the surface's value, too small to have any other effect.
inline constexpr double kJustBelow = -1e-200;

/// The number of the tetrahedron's face that lacks one corner.
std::size_t tetrahedron_face_without(std::size_t corner);

/// Face `face` of a cell. `nodes`, `offsets`: those of the cell's nodes.
FaceOffsets face_offsets(CellKind kind, std::size_t face, std::span<const NodeId> nodes,
                         std::span<const double> offsets);

/// The same face with its corners starting at the smallest node id and proceeding towards the
/// smaller of its neighbours: identical in the two cells of the face.
FaceOffsets canonical_face(const FaceOffsets& face);

/// The offset at a point of a canonical face: the interpolant of the face's own nodes. `from`: the
/// nodes' positions minus the point, in any rectangular coordinates.
double face_value_at(const FaceOffsets& canonical, std::span<const std::array<double, 3>> from);

}  // namespace hiac
