#include "hiac/render/bounds/normal_doubt.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "hiac/base/rounding.hpp"
#include "hiac/geometry/extended_vector.hpp"
#include "hiac/geometry/face_form.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/render/cells/curved/patch_curvature.hpp"

namespace hiac {
namespace {

constexpr double kUnknown = 2;

// By order: the largest sum of the magnitudes of a control point's weights (PatchWeights).
constexpr std::array<double, 3> kNodeWeights{1.5, 4.8, 14.4};

// Of the rounding of a shape function's derivative, whose terms are no larger than a few times the
// square of the order.
constexpr double kDerivativeRounding = 64;

// The rotation into the camera's frame, and to double.
constexpr double kRotation = 8 * kUnit;

// An upper bound of the angle whose sine is x.
double angle_of(double x) { return x < 0.5 ? 1.2 * x : kUnknown; }

std::size_t order_number(CellKind kind) { return static_cast<std::size_t>(order_of(kind)); }

// How far a face's inner nodes are off their places between its corners.
double nodes_off(const ZooMesh& mesh, CellId cell, const ShapeFace& face) {
  const CellKind kind = mesh.kinds[cell];
  const std::size_t corners = corner_count(kind);
  const auto reference = reference_nodes(kind);
  const auto nodes = mesh.cell_nodes(cell);
  double most = 0;
  std::array<double, kMaxNodesPerCell> shape;
  for (std::size_t k = corners; k < node_count(kind); ++k) {
    shape_functions<double>(kind_of(shape_of(kind), CellOrder::linear), reference[k], shape);
    double on_face = 0;
    for (std::size_t n = 0; n < face.corner_count; ++n) on_face += shape[face.corners[n]];
    if (on_face < 0.999) continue;
    const auto place = mesh.position(nodes[k]);
    ExtendedVector off{place[0], place[1], place[2]};
    for (std::size_t n = 0; n < corners; ++n)
      for (std::size_t c = 0; c < 3; ++c)
        off[c] -= static_cast<long double>(shape[n]) * mesh.position(nodes[n])[c];
    most = std::max(most, static_cast<double>(length(off)));
  }
  return most;
}

}  // namespace

double planar_normal_doubt(const Frame& frame, CellId cell, std::size_t face) {
  const CellKind kind = frame.mesh.kinds[cell];
  const ShapeFace& shape = topology_of(kind).faces[face];
  const auto nodes = frame.mesh.cell_nodes(cell);
  const std::size_t n = shape.corner_count;
  const auto edge = [&](std::size_t from, std::size_t to) -> ExtendedVector {
    const auto a = frame.mesh.position(nodes[shape.corners[from % n]]),
               b = frame.mesh.position(nodes[shape.corners[to % n]]);
    return {static_cast<long double>(b[0]) - a[0], static_cast<long double>(b[1]) - a[1],
            static_cast<long double>(b[2]) - a[2]};
  };
  const ExtendedVector drawn =
      n == 3 ? cross(edge(0, 1), edge(0, 2)) : cross(edge(0, 2), edge(1, 3));
  const long double size = length(drawn);
  if (!(size > 0)) return kUnknown;
  double longest = 0, least = static_cast<double>(size), turned = 0;
  for (std::size_t k = 0; k < n; ++k) {
    longest = std::max(longest, static_cast<double>(length(edge(k, k + 1))));
    const ExtendedVector here = cross(edge(k, k + 1), edge(k, k + n - 1));
    const long double area = length(here);
    if (!(area > 0) || !(dot(here, drawn) > 0)) return kUnknown;
    least = std::min(least, static_cast<double>(area));
    if (n == 4)
      turned = std::max(turned, static_cast<double>(length(cross(here, drawn)) / (area * size)));
  }
  const std::size_t order = order_number(kind);
  double off = 32 * kExtendedUnit * longest;
  if (order > 1)
    off += 2 * static_cast<double>(order) * kNodeWeights[order - 1] *
           nodes_off(frame.mesh, cell, shape);
  return kRotation + angle_of(turned) + angle_of((2 * off * longest + off * off) / least);
}

double curved_normal_doubt(const Frame& frame, CellId cell, std::size_t face,
                           const std::array<double, 3>& reference, double off) {
  const CellKind kind = frame.mesh.kinds[cell];
  const ShapeFace& shape = topology_of(kind).faces[face];
  // the derivatives that CellSkin computes, and how far rounding may have moved them
  const auto nodes = relative_positions(frame.mesh, cell, frame.projector);
  const auto corners = reference_nodes(kind);
  const auto& origin = corners[shape.corners[0]];
  const Vector a = minus(corners[shape.corners[1]], origin),
               b = minus(corners[shape.corners[shape.corner_count - 1U]], origin);
  std::array<Vector, kMaxNodesPerCell> gradients;
  shape_gradients<double>(kind, reference, gradients);
  Vector along_a{}, along_b{};
  double sum = 0, weights = 0, reach = 0;
  for (std::size_t k = 0; k < node_count(kind); ++k) {
    const double by_a = dot(gradients[k], a), by_b = dot(gradients[k], b);
    const Vector edge = minus(nodes[k], nodes[0]);
    for (std::size_t c = 0; c < 3; ++c) {
      along_a[c] += by_a * edge[c];
      along_b[c] += by_b * edge[c];
    }
    sum += length(edge);
    weights += std::max(std::abs(by_a), std::abs(by_b));
    reach = std::max(reach, length(nodes[k]));
  }
  const auto order = static_cast<double>(order_number(kind));
  const double rounding = kUnit * (kDerivativeRounding * order * order * sum + 4 * weights * reach);
  // bounds of second derivatives in any two directions of the face's parameters
  const FaceForm form = face_form(frame.mesh, cell, face, frame.straightness);
  const auto on_patch = patch_nodes(frame.mesh, cell, face, form);
  Vector bends{};
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<double, kMostPatchNodes> coordinate{};
    for (std::size_t k = 0; k < form.shape.node_count(); ++k)
      coordinate[k] = frame.projector.relative(frame.mesh.position(on_patch[k]))[c];
    PatchNet<double> net{};
    patch_net(form.shape, std::span(coordinate).first(form.shape.node_count()), net);
    bends[c] = 2 * PatchCurvature(form.shape.degree, net).within(1, 1);
  }
  const double bent = length(bends), length_a = length(along_a), length_b = length(along_b);
  const double area = length(cross(along_a, along_b));
  // The true point is within a circle of this radius in the parameters: on its border the face is
  // farther than `off` from the point, and displacing the face moves the crossing continuously.
  const double stretch = area / std::hypot(length_a, length_b);
  const double radius = 2 * off / stretch;
  if (!(bent * radius <= stretch && radius <= PatchCurvature::kBorder / 2)) return kUnknown;
  const double moved = 1.5 * bent * radius + rounding;
  return kRotation + angle_of((moved * (length_a + length_b) + moved * moved) / area);
}

}  // namespace hiac
