#include "hiac/frame/tiles/curved_outline.hpp"

#include <cmath>
#include <span>

namespace hiac {
namespace {

// A node's homogeneous coordinates on the screen, and its ray parameter.
struct Homogeneous {
  double x, y, w, t;
};

Homogeneous homogeneous(const Frame& frame, NodeId node) {
  const ProjectedNode& p = frame.nodes[node];
  if (!frame.projector.perspective()) return {p.x, p.y, 1, p.depth};
  if (std::isnan(p.depth)) {
    const auto [right, up, w] = frame.projector.camera_coordinates(frame.mesh.position(node));
    const auto [left_border, top_border] = frame.projector.slopes(0, 0);
    const double scale = frame.projector.pixels_per_unit();
    return {scale * (right - left_border * w), scale * (top_border * w - up), w, w};
  }
  const double w = -1 / p.depth;
  return {p.x * w, p.y * w, w, w};
}

// Replaces evenly spaced points by the control points of the curve of degree 1, 2 or 3 through
// them.
void to_controls(std::size_t degree, std::array<double, 4>& p) {
  if (degree == 2) p[1] = 2 * p[1] - 0.5 * (p[0] + p[2]);
  if (degree != 3) return;
  const double one = p[1], two = p[2];
  p[1] = (18 * one - 9 * two - 5 * p[0] + 2 * p[3]) / 6;
  p[2] = (18 * two - 9 * one - 5 * p[3] + 2 * p[0]) / 6;
}

// Moves nodes of edges that count as straight onto these edges: all faces around an edge then agree
// with the edge itself about its position (winding numbers), to rounding.
void straighten(const FaceForm& form, std::span<double> coordinate) {
  const std::size_t corners = form.shape.corner_count(), n = form.shape.degree;
  for (std::size_t k = 0; k < corners; ++k) {
    if (form.curved_edges[k]) continue;
    const double from = coordinate[k], to = coordinate[(k + 1) % corners];
    for (std::size_t i = 1; i < n; ++i)
      coordinate[corners + (n - 1) * k + i - 1] =
          from + static_cast<double>(i) / static_cast<double>(n) * (to - from);
  }
}

}  // namespace

EdgeControls edge_controls(const Frame& frame, const EdgeNodes& edge) {
  EdgeControls controls{};
  for (std::size_t k = 0; k < edge.count; ++k) {
    const Homogeneous h = homogeneous(frame, edge.nodes[k]);
    controls[0][k] = h.x;
    controls[1][k] = h.y;
    controls[2][k] = h.w;
    controls[3][k] = h.t;
  }
  for (auto& coordinate : controls) to_controls(edge.count - 1, coordinate);
  return controls;
}

FaceNets face_nets(const Frame& frame, CellId cell, std::size_t face, const FaceForm& form) {
  const auto nodes = patch_nodes(frame.mesh, cell, face, form);
  std::array<std::array<double, kMostPatchNodes>, 4> coordinates;
  const std::size_t count = form.shape.node_count();
  for (std::size_t k = 0; k < count; ++k) {
    const Homogeneous h = homogeneous(frame, nodes[k]);
    coordinates[0][k] = h.x;
    coordinates[1][k] = h.y;
    coordinates[2][k] = h.w;
    coordinates[3][k] = h.t;
  }
  FaceNets nets;
  for (std::size_t c = 0; c < 4; ++c) {
    straighten(form, coordinates[c]);
    patch_net(form.shape, std::span(coordinates[c]).first(count), nets[c]);
  }
  return nets;
}

}  // namespace hiac
