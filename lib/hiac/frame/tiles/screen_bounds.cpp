#include "hiac/frame/tiles/screen_bounds.hpp"

#include <cmath>
#include <cstddef>
#include <span>

#include "hiac/frame/tiles/curved_outline.hpp"

namespace hiac {
namespace {

// Includes control point k of an edge or a face.
template <class Controls>
void include(ScreenBounds& box, const Controls& controls, std::size_t k) {
  box.include(controls[0][k], controls[1][k], controls[2][k], controls[3][k]);
}

ScreenBounds bounds_of_curved(const Frame& frame, CellId cell) {
  const CellKind kind = frame.mesh.kinds[cell];
  const auto nodes = frame.mesh.cell_nodes(cell);
  ScreenBounds box;
  for (std::size_t e = 0; e < edge_count(kind); ++e) {
    const EdgeNodes edge = edge_nodes(kind, nodes, e);
    const EdgeControls controls = edge_controls(frame, edge);
    for (std::size_t k = 0; k < edge.count; ++k) include(box, controls, k);
  }
  for (std::size_t f = 0; f < face_count(kind); ++f) {
    const FaceForm form = face_form(frame.mesh, cell, f, frame.straightness);
    // the control points of quadratic triangles are those of their edges
    if (form.shape.degree == 1 || (form.shape.triangle && form.shape.degree == 2)) continue;
    const FaceNets nets = face_nets(frame, cell, f, form);
    for (std::size_t k = 0; k < form.shape.control_count(); ++k) include(box, nets, k);
  }
  return box;
}

// The bounds of a cell that reaches beside or behind the eye: only its range of ray parameters.
ScreenBounds bounds_beside_eye(const Frame& frame, std::span<const NodeId> corners) {
  ScreenBounds box;
  box.in_front = false;
  for (const NodeId node : corners)
    box.include_parameter(frame.projector.parameter(frame.mesh.position(node)));
  return box;
}

}  // namespace

ScreenBounds screen_bounds(const Frame& frame, CellId cell) {
  const CellKind kind = frame.mesh.kinds[cell];
  if (order_of(kind) != CellOrder::linear && frame.is_curved(cell))
    return bounds_of_curved(frame, cell);
  const auto corners = frame.mesh.cell_nodes(cell).first(corner_count(kind));
  ScreenBounds box;
  for (const NodeId node : corners) {
    const ProjectedNode& p = frame.nodes[node];
    if (std::isnan(p.depth)) return bounds_beside_eye(frame, corners);
    box.include(p.x, p.y);
    box.include_parameter(p.depth);
  }
  if (frame.projector.perspective()) {
    box.nearest = -1 / box.nearest;
    box.farthest = -1 / box.farthest;
  }
  return box;
}

}  // namespace hiac
