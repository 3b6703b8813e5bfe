#include "tests/support/cell_distance.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "hiac/mesh/shape_functions.hpp"

namespace hiac::test {
namespace {

using Real = long double;
using Vec = ExtendedVec;

// A place of the reference cell near to any: the place itself where it is inside.
Vec pulled_in(CellShape shape, Vec xi) {
  for (Real& x : xi) x = std::max<Real>(x, 0);
  const auto at_most = [](Real& x, Real most) { x = std::min(x, most); };
  switch (shape) {
    case CellShape::tetrahedron:
      return (1 / std::max<Real>(1, xi[0] + xi[1] + xi[2])) * xi;
    case CellShape::pyramid:
      at_most(xi[2], 1), at_most(xi[0], 1 - xi[2]), at_most(xi[1], 1 - xi[2]);
      return xi;
    case CellShape::prism: {
      const Real over = std::max<Real>(1, xi[0] + xi[1]);
      return {xi[0] / over, xi[1] / over, std::min<Real>(xi[2], 1)};
    }
    case CellShape::wedge:
      at_most(xi[1], 1), at_most(xi[2], 1), at_most(xi[0], 2 - xi[1] - xi[2]);
      return xi;
    case CellShape::brick:
      for (Real& x : xi) at_most(x, 1);
      return xi;
  }
  return xi;
}

}  // namespace

Real distance_from(const ZooMesh& mesh, CellId cell, const Vec& point) {
  const CellKind kind = mesh.kinds[cell];
  const auto reference = reference_nodes(kind);
  const auto nodes = mesh.cell_nodes(cell);
  const std::size_t corners = corner_count(kind);
  Vec middle{};
  for (std::size_t k = 0; k < corners; ++k)
    middle = middle + (1 / Real(corners)) * vec(reference[k]);
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t start = 0; start <= corners && least > 1e-13L; ++start) {
    Vec xi = start == 0 ? middle : 0.1L * middle + 0.9L * vec(reference[start - 1]);
    for (int step = 0; step < 25; ++step) {
      std::array<Real, kMaxNodesPerCell> shape;
      std::array<Vec, kMaxNodesPerCell> gradient;
      shape_functions<Real>(kind, xi, shape);
      shape_gradients<Real>(kind, xi, gradient);
      Vec rest = point;
      std::array<Vec, 3> m{};  // columns
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const Vec p = vec(mesh.position(nodes[k]));
        rest = rest - shape[k] * p;
        for (std::size_t a = 0; a < 3; ++a) m[a] = m[a] + gradient[k][a] * p;
      }
      const Real det = dot(m[0], cross(m[1], m[2]));
      Vec move = (1 / det) * Vec{dot(rest, cross(m[1], m[2])), dot(rest, cross(m[2], m[0])),
                                 dot(rest, cross(m[0], m[1]))};
      const Real length = norm(move);
      if (!(length < 1e3L)) break;
      xi = xi + (1 / std::max<Real>(1, length)) * move;
      shape_functions<Real>(kind, pulled_in(shape_of(kind), xi), shape);
      Vec there{};
      for (std::size_t k = 0; k < nodes.size(); ++k)
        there = there + shape[k] * vec(mesh.position(nodes[k]));
      least = std::min(least, norm(there - point));
      if (length < 1e-17L) break;
    }
  }
  return least;
}

}  // namespace hiac::test
