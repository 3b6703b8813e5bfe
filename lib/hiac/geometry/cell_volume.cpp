#include "hiac/geometry/cell_volume.hpp"

#include <array>
#include <span>

#include "hiac/base/gauss_legendre.hpp"
#include "hiac/geometry/bezier_patch.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/face_nodes.hpp"

namespace hiac {
namespace {

// Positions of a face's nodes relative to a corner of the cell, in the order of its patch.
struct FacePatch {
  PatchShape shape;
  std::array<Vector, kMostPatchNodes> nodes{};
};

FacePatch patch_of(const ZooMesh& mesh, CellId cell, std::size_t face) {
  const CellKind kind = mesh.kinds[cell];
  const ShapeFace& corners = topology_of(kind).faces[face];
  const auto nodes = mesh.cell_nodes(cell);
  FacePatch patch{{static_cast<std::uint8_t>(order_of(kind)), corners.corner_count == 3,
                   kind == CellKind::tetrahedron20},
                  {}};
  std::size_t count = 0;
  const auto add = [&](std::size_t node) {
    patch.nodes[count++] = minus(mesh.position(nodes[node]), mesh.position(nodes[0]));
  };
  for (std::size_t k = 0; k < corners.corner_count; ++k) add(corners.corners[k]);
  const BetweenNodes between = nodes_between(kind, face);
  for (std::size_t k = 0; k < between.count; ++k) add(between.nodes[k]);
  return patch;
}

double six_volumes(const Vector& a, const Vector& b, const Vector& c) {
  return dot(a, cross(b, c));
}

// Six times the volume between a bilinear or flat face and the origin: for a bilinear face the mean
// of those of its two divisions into triangles.
double six_volumes_under(const FacePatch& patch) {
  const auto& n = patch.nodes;
  if (patch.shape.triangle) return six_volumes(n[0], n[1], n[2]);
  return 0.5 * (six_volumes(n[0], n[1], n[2]) + six_volumes(n[0], n[2], n[3]) +
                six_volumes(n[0], n[1], n[3]) + six_volumes(n[1], n[2], n[3]));
}

// The integral of x . (x_u x x_v) over a curved face. In u and in v the integrand's degree is at
// most 3 d - 1, also over a triangle that is mapped to the square, with that map's factor.
double flux_through(const FacePatch& patch) {
  const std::size_t degree = patch.shape.degree;
  std::array<PatchNet<double>, 3> nets;
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<double, kMostPatchNodes> values{};
    const std::size_t count = patch.shape.node_count();
    for (std::size_t k = 0; k < count; ++k) values[k] = patch.nodes[k][c];
    patch_net(patch.shape, std::span(values).first(count), nets[c]);
  }
  const GaussRule rule = gauss_legendre((3 * degree + 1) / 2);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      const double u = 0.5 + 0.5 * rule.nodes[i], along = 0.5 + 0.5 * rule.nodes[j];
      const double left = patch.shape.triangle ? 1 - u : 1;
      const BernsteinValues at_u(degree, u), at_v(degree, along * left);
      Vector x, by_u, by_v;
      for (std::size_t c = 0; c < 3; ++c) {
        const PatchValue value = evaluate_patch(degree, nets[c], at_u, at_v);
        x[c] = value.value, by_u[c] = value.by_u, by_v[c] = value.by_v;
      }
      sum += 0.25 * rule.weights[i] * rule.weights[j] * left * six_volumes(x, by_u, by_v);
    }
  return sum;
}

}  // namespace

double signed_volume(const ZooMesh& mesh, CellId cell) {
  const CellKind kind = mesh.kinds[cell];
  double three = 0;
  for (std::size_t face = 0; face < face_count(kind); ++face) {
    const FacePatch patch = patch_of(mesh, cell, face);
    three += patch.shape.degree == 1 ? six_volumes_under(patch) / 2 : flux_through(patch);
  }
  return three / 3;
}

}  // namespace hiac
