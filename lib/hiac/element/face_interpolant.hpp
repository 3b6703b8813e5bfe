#pragma once

#include <array>
#include <span>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// One face of a cell with the offsets of a scalar from the value of an isosurface at its nodes: at
/// the corners, in the order in which they follow one another around the face, then at the nodes
/// between them, along the same way, then at the centre where there is one.
struct FaceOffsets {
  static constexpr std::size_t kMostNodes = 12;
  CellOrder order = CellOrder::linear;
  std::size_t count = 0;  ///< of corners: 3 or 4
  bool centred = false;   ///< a cubic tetrahedron's
  std::array<NodeId, kMostNodes> nodes;
  std::array<double, kMostNodes> offsets;

  /// Adds a corner of a linear face.
  void add(NodeId node, double offset) {
    nodes[count] = node;
    offsets[count++] = offset;
  }
  /// Of all nodes.
  [[nodiscard]] std::size_t node_count() const {
    return count * static_cast<std::size_t>(order) + (centred ? 1 : 0);
  }
  /// A number that stands for the offset at every point of the face when that has one sign for
  /// certain (interpolant_range.hpp): 0 or 1 where it is nowhere below 0, -1 where it is nowhere
  /// above and somewhere below. Else 0 with `mixed` set.
  [[nodiscard]] double sign(bool& mixed) const;
};

/// The sign of an interpolant that lies between two values; `mixed`: both signs may occur.
double sign_between(double least, double most, bool& mixed);

/// An offset that is below the surface's value and not felt otherwise.
inline constexpr double kJustBelow = -1e-200;

/// Which of a tetrahedron's faces it is that lacks one of its corners.
std::size_t tetrahedron_face_without(std::size_t corner);

/// Face `face` of a cell. `nodes` and `offsets`: of the cell's nodes.
FaceOffsets face_offsets(CellKind kind, std::size_t face, std::span<const NodeId> nodes,
                         std::span<const double> offsets);

/// The same face with its corners from the smallest node on, towards the smaller of its neighbours:
/// the same in the cells on its two sides.
FaceOffsets canonical_face(const FaceOffsets& face);

/// The offset at a point of a canonical face: the interpolant of the face's own nodes. `from`: the
/// nodes' positions less the point, in any rectangular coordinates.
double face_value_at(const FaceOffsets& canonical, std::span<const std::array<double, 3>> from);

}  // namespace hiac
