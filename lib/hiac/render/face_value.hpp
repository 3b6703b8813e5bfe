#pragma once

#include <array>
#include <span>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/render/projection.hpp"

namespace hiac {

/// One face of a cell with the offsets of a scalar from the value of an isosurface at its corners,
/// in the order in which they follow one another around the face.
struct FaceOffsets {
  std::size_t count = 0;  ///< 3 or 4
  std::array<NodeId, 4> nodes;
  std::array<double, 4> offsets;

  void add(NodeId node, double offset) {
    nodes[count] = node;
    offsets[count++] = offset;
  }
  /// A number that stands for the offset at every point of the face when that has one sign: 0 or 1
  /// where it is nowhere below 0, -1 where it is nowhere above and somewhere below. Else 0 with
  /// `mixed` set.
  [[nodiscard]] double sign(bool& mixed) const;
};

/// The offset at the point where the ray of (x, y) crosses the face, at the ray parameter t: linear
/// on a triangle, bilinear on a planar quadrilateral. A function of the face and the point alone,
/// whichever way the face's corners are told: the cells on its two sides find the same number, to
/// the bit. It decides on which side of an isosurface a point is that lies on it to within
/// rounding.
double face_value(const ZooMesh& mesh, const Projector& projector, const FaceOffsets& face,
                  double x, double y, double t);

}  // namespace hiac
