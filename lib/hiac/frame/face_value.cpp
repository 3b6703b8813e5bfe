#include "hiac/frame/face_value.hpp"

#include <array>
#include <span>

namespace hiac {

double face_value(const ZooMesh& mesh, const Projector& projector, const FaceOffsets& face,
                  double x, double y, double t) {
  const FaceOffsets canonical = canonical_face(face);
  const auto [right, up] = projector.slopes(x, y);
  const double reach = projector.perspective() ? t : 1;
  const std::size_t count = canonical.node_count();
  std::array<std::array<double, 3>, FaceOffsets::kMostNodes> from;
  for (std::size_t k = 0; k < count; ++k) {
    const auto c = projector.camera_coordinates(mesh.position(canonical.nodes[k]));
    from[k] = {c[0] - right * reach, c[1] - up * reach, c[2] - t};
  }
  return face_value_at(canonical, std::span(from).first(count));
}

}  // namespace hiac
