#include "tests/support/ray_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace hiac::test {
namespace {

using Real = long double;
using Vec = std::array<Real, 3>;

Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct Stretch {
  Real from, to;
  CellId cell;
};

// The part of the ray inside a tetrahedron.
bool inside(const ZooMesh& mesh, CellId cell, const Vec& origin, const Vec& direction, Real from,
            Stretch& stretch) {
  std::array<Vec, 4> p;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto q = mesh.position(mesh.cell_nodes(cell)[k]);
    p[k] = {q[0], q[1], q[2]};
  }
  stretch = {from, std::numeric_limits<Real>::infinity(), cell};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec& a = p[(k + 1) % 4];
    const Vec normal = cross(minus(p[(k + 2) % 4], a), minus(p[(k + 3) % 4], a));
    const Real height = dot(normal, minus(p[k], a));
    if (height == 0) return false;
    const Real value = dot(normal, minus(origin, a)) / height;
    const Real slope = dot(normal, direction) / height;
    if (slope > 0) stretch.from = std::max(stretch.from, -value / slope);
    if (slope < 0) stretch.to = std::min(stretch.to, -value / slope);
    if (slope == 0 && value < 0) return false;
  }
  return stretch.to - stretch.from > 1e-12L;
}

std::vector<std::uint32_t> group_numbers(const VisibilityOrder& order) {
  std::vector<std::uint32_t> number(order.cells.size());
  auto group = order.groups.begin();
  for (std::uint32_t rank = 0; rank < order.cells.size(); ++rank) {
    while (group != order.groups.end() && rank >= group->first + group->count) ++group;
    const bool grouped = group != order.groups.end() && rank >= group->first;
    number[order.cells[rank]] = grouped ? group->first : rank;
  }
  return number;
}

}  // namespace

RayCheck check_along_rays(const ZooMesh& mesh, const VisibilityOrder& order, const View& view,
                          std::size_t rays, std::uint64_t seed) {
  const auto number = group_numbers(order);
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<CellId> any_cell(0, static_cast<CellId>(mesh.cell_count() - 1));
  std::uniform_real_distribution<double> unit(0, 1);
  RayCheck check;
  for (std::size_t ray = 0; ray < rays; ++ray) {
    // through a random point of a random cell
    Vec target{};
    Real weight = 0;
    for (const NodeId node : mesh.cell_nodes(any_cell(random))) {
      const Real w = unit(random);
      weight += w;
      for (std::size_t c = 0; c < 3; ++c) target[c] += w * mesh.position(node)[c];
    }
    for (Real& x : target) x /= weight;
    const Vec eye{view.eye[0], view.eye[1], view.eye[2]};
    const Vec direction = view.perspective
                              ? minus(target, eye)
                              : Vec{view.direction[0], view.direction[1], view.direction[2]};
    const Vec& origin = view.perspective ? eye : target;
    const Real from = view.perspective ? 0 : -std::numeric_limits<Real>::infinity();
    std::vector<Stretch> stretches;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
      Stretch stretch{};
      if (inside(mesh, cell, origin, direction, from, stretch)) stretches.push_back(stretch);
    }
    std::sort(stretches.begin(), stretches.end(),
              [](const Stretch& a, const Stretch& b) { return a.from + a.to < b.from + b.to; });
    for (std::size_t i = 0; i + 1 < stretches.size(); ++i) {
      ++check.pairs;
      if (number[stretches[i].cell] > number[stretches[i + 1].cell]) ++check.misordered;
    }
  }
  return check;
}

}  // namespace hiac::test
