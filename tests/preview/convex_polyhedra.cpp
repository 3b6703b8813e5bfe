#include "tests/preview/convex_polyhedra.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "hiac/geometry/predicates.hpp"

namespace hiac::test {
namespace {

using Points = std::vector<std::array<double, 3>>;

// Whether q lies on the line through a and b: three planes through it would contain it.
bool collinear(const Points& p, std::size_t a, std::size_t b, std::size_t q) {
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<double, 3> off = p[a];
    off[c] += 1 + std::abs(off[c]);
    if (orientation(p[a], p[b], p[q], off) != 0) return false;
  }
  return true;
}

// Whether q, on the line through a and b, lies outside of the segment.
bool outside(const Points& p, std::size_t a, std::size_t b, std::size_t q) {
  for (std::size_t c = 0; c < 3; ++c)
    if (p[q][c] < std::min(p[a][c], p[b][c]) || p[q][c] > std::max(p[a][c], p[b][c])) return true;
  return false;
}

// The border of the coplanar points of a face, whose inner side `inside` is on.
std::vector<std::uint16_t> border(const Points& p, const std::set<std::uint16_t>& face,
                                  std::uint16_t inside) {
  std::map<std::uint16_t, std::uint16_t> next;
  for (const std::uint16_t a : face)
    for (const std::uint16_t b : face) {
      if (a == b) continue;
      const bool is_edge = std::ranges::all_of(face, [&](std::uint16_t q) {
        if (q == a || q == b) return true;
        const int sign = orientation(p[a], p[b], p[q], p[inside]);
        if (sign != 0) return sign < 0;
        return collinear(p, a, b, q) && !outside(p, a, b, q);
      });
      if (is_edge) next[a] = b;
    }
  std::vector<std::uint16_t> loop;
  std::uint16_t at = next.begin()->first;
  do {
    loop.push_back(at);
    at = next.at(at);
  } while (at != loop.front());
  return loop;
}

}  // namespace

HullPolyhedron hull_of(const Points& given) {
  Points p = given;
  std::ranges::sort(p);
  p.erase(std::unique(p.begin(), p.end()), p.end());
  const auto n = static_cast<std::uint16_t>(p.size());
  std::map<std::set<std::uint16_t>, std::uint16_t> inside;
  for (std::uint16_t a = 0; a < n; ++a)
    for (std::uint16_t b = a + 1; b < n; ++b)
      for (std::uint16_t c = b + 1; c < n; ++c) {
        if (collinear(p, a, b, c)) continue;
        std::set<std::uint16_t> face;
        int seen = 0;
        std::uint16_t inner = 0;
        bool is_face = true;
        for (std::uint16_t q = 0; q < n && is_face; ++q) {
          const int sign = q == a || q == b || q == c ? 0 : orientation(p[a], p[b], p[c], p[q]);
          if (sign == 0) {
            face.insert(q);
            continue;
          }
          is_face = seen == 0 || sign == seen;
          seen = sign;
          inner = q;
        }
        if (!is_face || seen == 0) continue;
        inside[face] = inner;
      }
  HullPolyhedron hull;
  std::map<std::uint16_t, std::uint16_t> number;
  for (const auto& [face, inner] : inside) {
    std::vector<std::uint16_t> loop = border(p, face, inner);
    for (std::uint16_t& corner : loop) {
      const auto [at, is_new] =
          number.try_emplace(corner, static_cast<std::uint16_t>(number.size()));
      if (is_new) hull.corners.push_back(p[corner]);
      corner = at->second;
    }
    hull.faces.push_back(loop);
  }
  return hull;
}

std::vector<preview::PolyhedronEdge> HullPolyhedron::edges() const {
  std::vector<preview::PolyhedronEdge> all;
  for (const auto& face : faces)
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint16_t a = face[k], b = face[(k + 1) % face.size()];
      if (a < b) all.push_back({a, b});
    }
  return all;
}

std::vector<preview::ScreenPoint> HullPolyhedron::projected() const {
  std::vector<preview::ScreenPoint> points;
  for (const auto& corner : corners) points.push_back({corner[0], corner[1]});
  return points;
}

HullPolyhedron random_polyhedron(std::mt19937_64& random, std::size_t points, unsigned side) {
  std::uniform_real_distribution<double> anywhere(0, 1);
  std::uniform_int_distribution<int> on_lattice(0, side > 0 ? static_cast<int>(side) - 1 : 0);
  const auto coordinate = [&] {
    return side > 0 ? static_cast<double>(on_lattice(random)) : anywhere(random);
  };
  for (;;) {
    const bool prism = random() % 3 == 0;
    Points all;
    while (all.size() < points) {
      all.push_back({coordinate(), coordinate(), coordinate()});
      if (prism) all.push_back({all.back()[0], all.back()[1], coordinate()});
    }
    HullPolyhedron hull = hull_of(all);
    if (!hull.faces.empty()) return hull;
  }
}

}  // namespace hiac::test
