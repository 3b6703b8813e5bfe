#include "hiac/tetrahedralize/tetrahedron_lattice.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

LatticePoint between(const LatticePoint& a, const LatticePoint& b) {
  LatticePoint middle;
  for (std::size_t k = 0; k < 4; ++k) middle[k] = static_cast<std::uint16_t>((a[k] + b[k]) / 2);
  return middle;
}

// det[b - a, c - a, d - a] in the coordinates 1, 2, 3.
std::int64_t turn(const LatticeTetrahedron& t) {
  std::array<std::array<std::int64_t, 3>, 3> e;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) e[k][i] = std::int64_t{t[k + 1][i + 1]} - t[0][i + 1];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

void append_children(const LatticeTetrahedron& t, std::vector<LatticeTetrahedron>& children) {
  const auto m01 = between(t[0], t[1]), m02 = between(t[0], t[2]), m03 = between(t[0], t[3]);
  const auto m12 = between(t[1], t[2]), m13 = between(t[1], t[3]), m23 = between(t[2], t[3]);
  const std::array<LatticeTetrahedron, 8> parts{{{t[0], m01, m02, m03},
                                                 {m01, t[1], m12, m13},
                                                 {m02, m12, t[2], m23},
                                                 {m03, m13, m23, t[3]},
                                                 {m01, m02, m03, m13},
                                                 {m01, m02, m12, m13},
                                                 {m02, m03, m13, m23},
                                                 {m02, m12, m13, m23}}};
  children.insert(children.end(), parts.begin(), parts.end());
}

}  // namespace

std::vector<LatticePoint> nodes_on_lattice(CellOrder order) {
  const double n = static_cast<double>(order);
  std::vector<LatticePoint> points;
  for (const auto& [x, y, z] : reference_nodes(kind_of(CellShape::tetrahedron, order))) {
    const auto whole = [&](double v) { return static_cast<std::uint16_t>(std::lround(n * v)); };
    points.push_back({whole(1 - x - y - z), whole(x), whole(y), whole(z)});
  }
  return points;
}

std::vector<LatticeTetrahedron> halved(unsigned levels) {
  const auto n = static_cast<std::uint16_t>(1U << levels);
  std::vector<LatticeTetrahedron> tetrahedra{
      {{{n, 0, 0, 0}, {0, n, 0, 0}, {0, 0, n, 0}, {0, 0, 0, n}}}};
  for (unsigned level = 0; level < levels; ++level) {
    std::vector<LatticeTetrahedron> children;
    children.reserve(8 * tetrahedra.size());
    for (const LatticeTetrahedron& t : tetrahedra) append_children(t, children);
    tetrahedra = std::move(children);
  }
  // not earlier: the order of the corners determines where the next level cuts
  for (LatticeTetrahedron& t : tetrahedra)
    if (turn(t) < 0) std::swap(t[2], t[3]);
  return tetrahedra;
}

}  // namespace hiac
