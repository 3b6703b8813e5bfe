#include "tests/render/truth/curved_cell_truth.hpp"

#include <algorithm>
#include <cmath>

#include "tests/support/extended_vectors.hpp"

namespace hiac::test {
namespace {

using Real = CurvedCellTruth::Real;
using Vec = ExtendedVec;

// How far points are from a line, in two directions across it.
struct Across {
  Vec origin, first, second;

  Across(const Vec& at, const Vec& direction) : origin(at) {
    std::size_t least = 0;
    for (std::size_t c = 1; c < 3; ++c)
      if (std::abs(direction[c]) < std::abs(direction[least])) least = c;
    Vec axis{};
    axis[least] = 1;
    first = cross(direction, axis);
    first = (1 / norm(first)) * first;
    second = cross(direction, first);
    second = (1 / norm(second)) * second;
  }
  [[nodiscard]] std::array<Real, 2> of(const Vec& p) const {
    return {dot(p - origin, first), dot(p - origin, second)};
  }
};

// In places that differ by less, a crossing is the same.
constexpr Real kSame = 1e-9L;

}  // namespace

CurvedCellTruth::CurvedCellTruth(CellKind kind, std::span<const Vec> nodes)
    : kind_(kind), nodes_(nodes.begin(), nodes.end()) {
  const auto order = static_cast<std::size_t>(order_of(kind));
  for (const ShapeFace& shape : topology_of(kind).faces) {
    Face& face = faces_.emplace_back();
    face.corner_count = shape.corner_count;
    face.squares = 10 * order;
    if (order == 1 && shape.corner_count == 3) face.squares = 1;
    for (std::size_t k = 0; k < shape.corner_count; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        face.corners[k][c] = reference_nodes(kind)[shape.corners[k]][c];
    const std::size_t n = face.squares;
    for (std::size_t j = 0; j <= n; ++j)
      for (std::size_t i = 0; i <= n; ++i)
        face.grid.push_back(
            place(face, static_cast<Real>(i) / Real(n), static_cast<Real>(j) / Real(n)).point);
    for (const Vec& p : face.grid) face.center = face.center + (1 / Real(face.grid.size())) * p;
    for (const Vec& p : face.grid) face.reach = std::max(face.reach, norm(p - face.center));
  }
}

CurvedCellTruth::Place CurvedCellTruth::place(const Face& face, Real u, Real v) const {
  const auto& r = face.corners;
  Place place;
  Vec along_u = r[1] - r[0], along_v = r[2] - r[0];
  if (face.corner_count == 3) {
    place.reference = r[0] + u * along_u + v * along_v;
  } else {
    along_u = (1 - v) * (r[1] - r[0]) + v * (r[2] - r[3]);
    along_v = (1 - u) * (r[3] - r[0]) + u * (r[2] - r[1]);
    place.reference = (1 - v) * ((1 - u) * r[0] + u * r[1]) + v * ((1 - u) * r[3] + u * r[2]);
  }
  std::array<Real, kMaxNodesPerCell> shape;
  std::array<Vec, kMaxNodesPerCell> gradient;
  shape_functions<Real>(kind_, place.reference, shape);
  shape_gradients<Real>(kind_, place.reference, gradient);
  place.point = place.by_u = place.by_v = {};
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    place.point = place.point + shape[k] * nodes_[k];
    place.by_u = place.by_u + dot(gradient[k], along_u) * nodes_[k];
    place.by_v = place.by_v + dot(gradient[k], along_v) * nodes_[k];
  }
  return place;
}

void CurvedCellTruth::add_crossings(const Face& face, const Vec& origin, const Vec& direction,
                                    std::vector<Crossing>& found) const {
  const Across across(origin, direction);
  const auto middle = across.of(face.center);
  if (std::hypot(middle[0], middle[1]) > 1.5L * face.reach) return;
  const std::size_t n = face.squares;
  std::vector<std::array<Real, 2>> off;
  for (const Vec& p : face.grid) off.push_back(across.of(p));
  std::vector<std::array<Real, 2>> known;
  const auto search = [&](Real u, Real v) {
    for (int step = 0; step < 30; ++step) {
      const Place here = place(face, u, v);
      const auto [a, b] = across.of(here.point);
      const Real a_u = dot(here.by_u, across.first), a_v = dot(here.by_v, across.first);
      const Real b_u = dot(here.by_u, across.second), b_v = dot(here.by_v, across.second);
      const Real determinant = a_u * b_v - a_v * b_u;
      const Real du = (a * b_v - a_v * b) / determinant, dv = (a_u * b - a * b_u) / determinant;
      u -= du;
      v -= dv;
      if (!(std::abs(u) < 2 && std::abs(v) < 2)) return;
      if (std::max(std::abs(du), std::abs(dv)) > 1e-12L) continue;
      const Real outside = face.corner_count == 3 ? u + v - 1 : std::max(u, v) - 1;
      if (std::max({-u, -v, outside}) > 0) return;
      for (const auto& k : known)
        if (std::abs(k[0] - u) < kSame && std::abs(k[1] - v) < kSame) return;
      known.push_back({u, v});
      const Place there = place(face, u, v);
      found.push_back(
          {dot(there.point - origin, direction) / dot(direction, direction), there.reference});
      return;
    }
  };
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      if (face.corner_count == 3 && i + j >= n) continue;
      bool may = true;
      for (std::size_t c = 0; c < 2; ++c) {
        const std::size_t at = j * (n + 1) + i;
        const auto [least, most] =
            std::minmax({off[at][c], off[at + 1][c], off[at + n + 1][c], off[at + n + 2][c]});
        may = may && least <= most - least && -most <= most - least;
      }
      if (may) search((Real(i) + 0.5L) / Real(n), (Real(j) + 0.5L) / Real(n));
    }
}

std::vector<CurvedCellTruth::Crossing> CurvedCellTruth::crossings(const Vec& origin,
                                                                  const Vec& direction) const {
  std::vector<Crossing> found;
  for (const Face& face : faces_) add_crossings(face, origin, direction, found);
  std::ranges::sort(found, {}, &Crossing::t);
  return found;
}

}  // namespace hiac::test
