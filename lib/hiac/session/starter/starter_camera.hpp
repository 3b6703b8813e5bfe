#pragma once

#include <vector>

#include "hiac/geometry/box.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::starter {

using Vec = Vector;

inline Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec operator*(double s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }

inline Vec position(const ZooMesh& mesh, NodeId node) {
  const auto p = mesh.position(node);
  return {p[0], p[1], p[2]};
}

/// A number rounded to a multiple of a power of ten that is at most a thousandth of `scale`.
double rounded(double value, double scale);

/// An orthonormal frame of a camera.
struct Frame {
  Vec right, up, ahead;
};

Frame frame_of(const Camera& camera);

/// Whether two nodes of cells lie at different places.
bool has_extent(const ZooMesh& mesh);

/// What a camera has to see: all nodes of a mesh's cells and, where the mesh is one step of a
/// series that reaches beyond it, the box around the cells of all steps.
struct Sight {
  explicit Sight(const ZooMesh& cells) : mesh(cells), box(box_of_cells(cells)) {}
  Sight(const ZooMesh& cells, const Box& series);

  const ZooMesh& mesh;
  Box box;                   ///< around all of it
  std::vector<Vec> corners;  ///< of the box, where it is larger than the mesh
};

/// A perspective camera that sees all of it, from `towards_eye` of its middle.
Camera camera_around(const Sight& sight, const ImageSize& image, const Vec& towards_eye);

/// The size, no larger than `image`, whose aspect is that of what the camera sees.
ImageSize fitting_size(const Sight& sight, const ImageSize& image, const Vec& towards_eye);

}  // namespace hiac::starter
