#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "hiac/geometry/predicates.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The corners of a cell and their positions.
struct CellCorners {
  std::span<const NodeId> nodes;
  std::array<const double*, 8> positions;
  /// The same coordinates by axis, padded to an even number by repeating the last corner.
  std::array<std::array<double, 8>, 3> coordinates;

  CellCorners(const ZooMesh& mesh, CellId cell)
      : nodes(mesh.cell_nodes(cell).first(corner_count(mesh.kinds[cell]))) {
    for (std::size_t k = 0; k < filled_up(); ++k) {
      positions[k] = mesh.position(nodes[std::min(k, nodes.size() - 1)]).data();
      for (std::size_t c = 0; c < 3; ++c) coordinates[c][k] = positions[k][c];
    }
  }
  [[nodiscard]] std::size_t filled_up() const { return nodes.size() + nodes.size() % 2; }
  [[nodiscard]] Point3 at(std::size_t k) const { return Point3(positions[k], 3); }
};

/// The plane of a face in floating point, with error bounds of its values: the plane of a triangle,
/// or the one that Newell's method fits to a quadrilateral (I. Sutherland, R. Sproull, R.
/// Schumacker, "A Characterization of Ten Hidden-Surface Algorithms", 1974).
///
/// value(x) = normal . (x - point); the normal's length is twice the face's area.
struct FacePlane {
  std::array<double, 3> normal, point;
  double size;       ///< size of the face: the larger of the two vectors that span it
  double deviation;  ///< of a quadrilateral: the largest |value| of a corner

  /// Values of mesh points above `certain` or below -`apart` need no closer test.
  double certain, apart;
  /// A triangle's value has the right sign if its magnitude exceeds this times |x - point|.
  double certain_slope;
  /// Bounds the value of a point in the plane: the effect of rounded coordinates of the face and
  /// the point, plus the face's deviation from the plane. `distance` is |x - point|.
  [[nodiscard]] double touch(double distance) const { return touching + touching_slope * distance; }
  double touching, touching_slope;

  [[nodiscard]] double value(const std::array<double, 3>& from_point) const {
    return normal[0] * from_point[0] + normal[1] * from_point[1] + normal[2] * from_point[2];
  }
};

/// What the planes of a mesh have in common, in world units.
struct MeshScale {
  double extent;    ///< no two points are farther apart than this
  double rounding;  ///< the rounding of coordinates

  explicit MeshScale(const ZooMesh& mesh);
};

/// Returns the plane of a face, with the normal to the left of the corners' order.
FacePlane plane_of_face(const CellCorners& cell, const ShapeFace& face, const MeshScale& scale);

/// Reverses the plane's normal.
inline void flip(FacePlane& plane) {
  for (double& n : plane.normal) n = -n;
}

/// Returns the sum of absolute values: the norm of all distances and sizes here.
inline double taxicab(const std::array<double, 3>& v) {
  return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
}

}  // namespace hiac
