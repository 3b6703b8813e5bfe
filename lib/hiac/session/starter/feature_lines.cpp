#include "hiac/session/starter/feature_lines.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "hiac/frame/surfaces/boundary_faces.hpp"
#include "hiac/render/edges/chosen_edges.hpp"
#include "hiac/session/starter/starter_camera.hpp"

namespace hiac::starter {

double line_length(const ZooMesh& mesh, const Edges& edges, const Camera& camera,
                   const ImageSize& size) {
  const Frame frame = frame_of(camera);
  const double pixels_per_slope =
      size.height / (2 * std::tan(0.5 * camera.fov * std::numbers::pi / 180));
  const auto on_screen = [&](NodeId node) {
    const Vec p = position(mesh, node) - camera.eye;
    const double scale = pixels_per_slope / dot(p, frame.ahead);
    return std::array{scale * dot(p, frame.right), scale * dot(p, frame.up)};
  };
  double sum = 0;
  for (const EdgeNodes& edge : chosen_edges(mesh, edges, boundary_faces(mesh))) {
    const auto a = on_screen(edge.nodes[0]), b = on_screen(edge.nodes[edge.count - 1]);
    sum += std::hypot(b[0] - a[0], b[1] - a[1]);
  }
  return sum;
}

}  // namespace hiac::starter
