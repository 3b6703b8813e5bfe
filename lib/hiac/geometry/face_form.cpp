#include "hiac/geometry/face_form.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

std::size_t edge_between(CellKind kind, std::uint8_t a, std::uint8_t b) {
  const auto edges = topology_of(kind).edges;
  const auto found = std::ranges::find_if(edges, [&](const ShapeEdge& e) {
    return (e[0] == a && e[1] == b) || (e[0] == b && e[1] == a);
  });
  return static_cast<std::size_t>(found - edges.begin());
}

// Returns a face's corners, as numbers within the cell, in an order that both cells share: from the
// lowest node towards the lower of its two neighbours.
std::array<std::uint8_t, 4> canonical_corners(const ShapeFace& face,
                                              std::span<const NodeId> nodes) {
  const std::size_t n = face.corner_count;
  const auto node = [&](std::size_t k) { return nodes[face.corners[k % n]]; };
  std::size_t first = 0;
  for (std::size_t k = 1; k < n; ++k)
    if (node(k) < node(first)) first = k;
  const bool forward = node(first + 1) < node(first + n - 1);
  std::array<std::uint8_t, 4> corners{};
  for (std::size_t k = 0; k < n; ++k)
    corners[k] = face.corners[(first + (forward ? k : n - k)) % n];
  return corners;
}

// Returns whether |a| > scale |b|. A vector's length is between 1 and sqrt(3) times its largest
// component, which mostly decides without a square root.
bool is_longer(const Vector& a, double scale, const Vector& b) {
  const double least_a = largest(a), least_b = scale * largest(b);
  if (2 * least_a <= least_b) return false;
  return least_a > 2 * least_b || length(a) > scale * length(b);
}

}  // namespace

double quadrilateral_deviation(Point3 a, Point3 b, Point3 c, Point3 d) {
  const Vector ab = minus(b, a), ac = minus(c, a), bd = minus(d, b);
  const Vector n = cross(ac, bd);
  const double area = length(n), size = std::max(length(ac), length(bd));
  if (!(area > 0)) return 0;
  // the diagonals' distance: the component of an edge between them along their common normal
  const double gap = std::abs(dot(n, ab)) / area;
  return gap / size;
}

EdgeNodes edge_nodes(CellKind kind, std::span<const NodeId> nodes, std::size_t edge) {
  const ShapeEdge& ends = topology_of(kind).edges[edge];
  const auto inner = static_cast<std::size_t>(order_of(kind)) - 1;
  EdgeNodes result{inner + 2, {nodes[ends[0]]}};
  for (std::size_t k = 0; k < inner; ++k)
    result.nodes[k + 1] = nodes[corner_count(kind) + inner * edge + k];
  result.nodes[inner + 1] = nodes[ends[1]];
  if (result.nodes[0] > result.nodes[inner + 1])
    std::reverse(result.nodes.begin(),
                 result.nodes.begin() + static_cast<std::ptrdiff_t>(result.count));
  return result;
}

bool is_curved(const ZooMesh& mesh, const EdgeNodes& edge, double straightness) {
  const Point3 a = mesh.position(edge.nodes[0]);
  const Vector along = minus(mesh.position(edge.nodes[edge.count - 1]), a);
  for (std::size_t k = 1; k + 1 < edge.count; ++k) {
    const double s = static_cast<double>(k) / static_cast<double>(edge.count - 1);
    const Vector from = minus(mesh.position(edge.nodes[k]), a);
    if (is_longer({from[0] - s * along[0], from[1] - s * along[1], from[2] - s * along[2]},
                  straightness, along))
      return true;
  }
  return false;
}

namespace {

// Returns whether a face's n corners deviate from a plane.
bool is_bent(const ZooMesh& mesh, std::span<const NodeId> nodes,
             const std::array<std::uint8_t, 4>& corners, std::size_t n, double straightness) {
  const auto at = [&](std::size_t k) { return mesh.position(nodes[corners[k]]); };
  return n == 4 && quadrilateral_deviation(at(0), at(1), at(2), at(3)) > straightness;
}

// Returns whether the centre node of a cubic tetrahedron's face is off the mean of the face's
// corners.
bool is_centre_off(const ZooMesh& mesh, std::span<const NodeId> nodes,
                   const std::array<std::uint8_t, 4>& corners, std::size_t face,
                   double straightness) {
  const auto at = [&](std::size_t k) { return mesh.position(nodes[corners[k]]); };
  const Point3 centre = mesh.position(nodes[16 + face]);
  const Vector u = minus(at(1), at(0)), v = minus(at(2), at(0)), w = minus(centre, at(0));
  const Vector off{w[0] - (u[0] + v[0]) / 3, w[1] - (u[1] + v[1]) / 3, w[2] - (u[2] + v[2]) / 3};
  return is_longer(off, straightness, u) && is_longer(off, straightness, v);
}

}  // namespace

FaceForm face_form(const ZooMesh& mesh, CellId cell, std::size_t number, double straightness) {
  const CellKind kind = mesh.kinds[cell];
  const auto nodes = mesh.cell_nodes(cell);
  const ShapeFace& face = topology_of(kind).faces[number];
  const std::size_t n = face.corner_count;
  FaceForm form{false, {1, n == 3, false}, canonical_corners(face, nodes), {}, {}};
  for (std::size_t k = 0; k < n; ++k) {
    form.edges[k] = edge_between(kind, form.corners[k], form.corners[(k + 1) % n]);
    form.curved_edges[k] = order_of(kind) != CellOrder::linear &&
                           is_curved(mesh, edge_nodes(kind, nodes, form.edges[k]), straightness);
    if (form.curved_edges[k]) form.shape.degree = static_cast<std::uint8_t>(order_of(kind));
  }
  if (kind == CellKind::tetrahedron20) {
    if (is_centre_off(mesh, nodes, form.corners, number, straightness)) form.shape.degree = 3;
    form.shape.centre = form.shape.degree == 3;
  }
  form.curved = form.shape.degree > 1 || is_bent(mesh, nodes, form.corners, n, straightness);
  return form;
}

std::array<NodeId, kMostPatchNodes> patch_nodes(const ZooMesh& mesh, CellId cell, std::size_t face,
                                                const FaceForm& form) {
  const CellKind kind = mesh.kinds[cell];
  const auto nodes = mesh.cell_nodes(cell);
  const std::size_t n = form.shape.corner_count(), inner = form.shape.degree - std::size_t{1};
  std::array<NodeId, kMostPatchNodes> of_face{};
  for (std::size_t k = 0; k < n; ++k) {
    of_face[k] = nodes[form.corners[k]];
    const EdgeNodes edge = edge_nodes(kind, nodes, form.edges[k]);
    const bool along = edge.nodes[0] == of_face[k];
    for (std::size_t i = 0; i < inner; ++i)
      of_face[n + inner * k + i] = edge.nodes[along ? i + 1 : inner - i];
  }
  if (form.shape.centre)
    of_face[n + inner * n] = nodes[corner_count(kind) + 2 * edge_count(kind) + face];
  return of_face;
}

PatchNet<std::array<double, 3>> control_points(const ZooMesh& mesh, CellId cell, std::size_t face,
                                               const FaceForm& form) {
  const auto nodes = patch_nodes(mesh, cell, face, form);
  PatchNet<std::array<double, 3>> points{};
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<double, kMostPatchNodes> coordinates;
    const std::size_t count = form.shape.node_count();
    for (std::size_t k = 0; k < count; ++k) coordinates[k] = mesh.position(nodes[k])[c];
    PatchNet<double> net;
    patch_net(form.shape, std::span(coordinates).first(count), net);
    for (std::size_t k = 0; k < form.shape.control_count(); ++k) points[k][c] = net[k];
  }
  return points;
}

bool has_curved_faces(const ZooMesh& mesh, CellId cell, double straightness) {
  const CellKind kind = mesh.kinds[cell];
  const auto nodes = mesh.cell_nodes(cell);
  if (order_of(kind) != CellOrder::linear)
    for (std::size_t e = 0; e < edge_count(kind); ++e)
      if (is_curved(mesh, edge_nodes(kind, nodes, e), straightness)) return true;
  const auto faces = topology_of(kind).faces;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::size_t n = faces[f].corner_count;
    const bool has_centre = kind == CellKind::tetrahedron20;
    if (n == 3 && !has_centre) continue;
    const auto corners = canonical_corners(faces[f], nodes);
    if (is_bent(mesh, nodes, corners, n, straightness)) return true;
    if (has_centre && is_centre_off(mesh, nodes, corners, f, straightness)) return true;
  }
  return false;
}

}  // namespace hiac
