#include "tests/check/rational_overlap.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <gmpxx.h>

namespace hiac::test {
namespace {

using Rational = mpq_class;
using Vec = std::array<Rational, 3>;

struct HalfSpace {
  Vec normal;
  Rational offset;  // normal . x <= offset inside
};

Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Rational dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

void add_half_spaces(const ZooMesh& mesh, CellId cell, std::vector<HalfSpace>& all) {
  const auto nodes = mesh.cell_nodes(cell);
  const auto at = [&](std::size_t k) {
    const auto p = mesh.position(nodes[k]);
    return Vec{Rational(p[0]), Rational(p[1]), Rational(p[2])};
  };
  for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces) {
    HalfSpace half;
    half.normal = cross(minus(at(face.corners[1]), at(face.corners[0])),
                        minus(at(face.corners[2]), at(face.corners[0])));
    half.offset = dot(half.normal, at(face.corners[0]));
    for (std::size_t k = 0; k < corner_count(mesh.kinds[cell]); ++k) {
      if (dot(half.normal, at(k)) <= half.offset) continue;
      for (Rational& x : half.normal) x = -x;  // the cell is on the other side
      half.offset = -half.offset;
      break;
    }
    all.push_back(half);
  }
}

bool boxes_meet(const ZooMesh& mesh, CellId a, CellId b) {
  for (std::size_t c = 0; c < 3; ++c) {
    const auto bounds = [&](CellId cell) {
      double low = mesh.position(mesh.cell_nodes(cell)[0])[c], high = low;
      for (const NodeId node : mesh.cell_nodes(cell)) {
        low = std::min(low, mesh.position(node)[c]);
        high = std::max(high, mesh.position(node)[c]);
      }
      return std::pair(low, high);
    };
    if (bounds(a).second <= bounds(b).first || bounds(b).second <= bounds(a).first) return false;
  }
  return true;
}

std::vector<Vec> corners_of(const std::vector<HalfSpace>& all) {
  std::vector<Vec> corners;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const Vec& u = all[i].normal;
        const Vec& v = all[j].normal;
        const Vec& w = all[k].normal;
        const Rational det = dot(u, cross(v, w));
        if (det == 0) continue;
        const Vec a = cross(v, w), b = cross(w, u), c = cross(u, v);
        Vec x;
        for (std::size_t d = 0; d < 3; ++d)
          x[d] = (all[i].offset * a[d] + all[j].offset * b[d] + all[k].offset * c[d]) / det;
        bool inside = true;
        for (const HalfSpace& half : all) inside = inside && dot(half.normal, x) <= half.offset;
        if (inside) corners.push_back(x);
      }
  return corners;
}

}  // namespace

bool interiors_meet(const ZooMesh& mesh, CellId a, CellId b) {
  if (!boxes_meet(mesh, a, b)) return false;
  std::vector<HalfSpace> all;
  add_half_spaces(mesh, a, all);
  add_half_spaces(mesh, b, all);
  const std::vector<Vec> corners = corners_of(all);
  for (std::size_t i = 1; i < corners.size(); ++i)
    for (std::size_t j = 1; j < i; ++j) {
      const Vec normal = cross(minus(corners[i], corners[0]), minus(corners[j], corners[0]));
      for (std::size_t k = 1; k < j; ++k)
        if (dot(normal, minus(corners[k], corners[0])) != 0) return true;
    }
  return false;
}

}  // namespace hiac::test
