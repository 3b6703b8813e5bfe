#include "tests/order/brute_force_order.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <random>

#include "tests/geometry/rational_orientation.hpp"

namespace hiac::test {
namespace {

using Point = std::array<double, 3>;
using Real = long double;
using Vec = std::array<Real, 3>;

Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Real dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Point point(const ZooMesh& mesh, NodeId node) {
  const auto p = mesh.position(node);
  return {p[0], p[1], p[2]};
}

Vec corner(const ZooMesh& mesh, CellId cell, std::size_t k) {
  const auto p = mesh.position(mesh.cell_nodes(cell)[k]);
  return {p[0], p[1], p[2]};
}

Vec center(const ZooMesh& mesh, CellId cell) {
  Vec sum{};
  const std::size_t corners = corner_count(mesh.kinds[cell]);
  for (std::size_t k = 0; k < corners; ++k)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += corner(mesh, cell, k)[c] / Real(corners);
  return sum;
}

struct Ray {
  Vec origin, direction;
  Real from;
};

struct Piece {
  Real from, to;
  CellId cell;
};

// The part of a ray in a convex cell; from > to when there is none.
Piece cut(const ZooMesh& mesh, CellId cell, const Ray& ray) {
  Piece piece{ray.from, std::numeric_limits<Real>::infinity(), cell};
  const Vec inside = center(mesh, cell);
  for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces) {
    const Vec a = corner(mesh, cell, face.corners[0]);
    // twice the face's area vector, from its diagonals (a triangle's second one is an edge)
    const Vec normal = cross(corner(mesh, cell, face.corners[2]) - a,
                             corner(mesh, cell, face.corners[face.corner_count - 1U]) -
                                 corner(mesh, cell, face.corners[1]));
    const Real side = dot(normal, inside - a);
    if (side == 0) continue;  // a face without area, or a cell without volume
    const Real value = dot(normal, ray.origin - a) / side,
               slope = dot(normal, ray.direction) / side;
    if (slope > 0) piece.from = std::max(piece.from, -value / slope);
    if (slope < 0) piece.to = std::min(piece.to, -value / slope);
    if (slope == 0 && value < 0) return {1, 0, cell};
  }
  return piece;
}

bool is_flat(const ZooMesh& mesh, CellId cell) {
  const auto faces = topology_of(mesh.kinds[cell]).faces;
  const Vec inside = center(mesh, cell);
  return std::ranges::all_of(faces, [&](const ShapeFace& face) {
    const Vec a = corner(mesh, cell, face.corners[0]);
    const Vec normal =
        cross(corner(mesh, cell, face.corners[1]) - a, corner(mesh, cell, face.corners[2]) - a);
    return dot(normal, inside - a) == 0;
  });
}

Real size_of(const ZooMesh& mesh) {
  Vec low = corner(mesh, 0, 0), high = low;
  for (std::size_t i = 0; i < mesh.xyz.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], Real(mesh.xyz[i]));
    high[i % 3] = std::max(high[i % 3], Real(mesh.xyz[i]));
  }
  return std::sqrt(dot(high - low, high - low));
}

// A ray through a random point of a random cell, its direction of unit length.
Ray random_ray(const ZooMesh& mesh, const View& view, std::mt19937_64& random) {
  CellId cell = 0;
  do {
    cell = static_cast<CellId>(random() % mesh.cell_count());
  } while (is_flat(mesh, cell));
  std::exponential_distribution<double> weight;
  Vec through{};
  Real sum = 0;
  for (std::size_t k = 0; k < corner_count(mesh.kinds[cell]); ++k) {
    const Real w = weight(random);
    sum += w;
    for (std::size_t c = 0; c < 3; ++c) through[c] += w * corner(mesh, cell, k)[c];
  }
  for (Real& x : through) x /= sum;
  const Vec eye{view.eye[0], view.eye[1], view.eye[2]};
  Ray ray{through, {view.direction[0], view.direction[1], view.direction[2]}, 0};
  ray.from = -std::numeric_limits<Real>::infinity();
  if (view.perspective) ray = {eye, through - eye, 0};
  const Real length = std::sqrt(dot(ray.direction, ray.direction));
  for (Real& x : ray.direction) x /= length;
  return ray;
}

using Reached = std::bitset<kMostCells>;

std::vector<Reached> reachability(const Arrows& arrows, std::size_t cells) {
  std::vector<Reached> reached(cells);
  for (std::size_t i = 0; i < cells; ++i) reached[i].set(i);
  for (const auto& [front, behind] : arrows) reached[front].set(behind);
  for (std::size_t k = 0; k < cells; ++k)
    for (std::size_t i = 0; i < cells; ++i)
      if (reached[i][k]) reached[i] |= reached[k];
  return reached;
}

}  // namespace

testing::AssertionResult is_sequence_of_groups(const VisibilityOrder& order, std::size_t cells) {
  if (order.cells.size() != cells)
    return testing::AssertionFailure() << order.cells.size() << " cells of " << cells;
  std::vector<bool> seen(cells, false);
  for (const CellId cell : order.cells) {
    if (cell >= cells || seen[cell]) return testing::AssertionFailure() << "cell " << cell;
    seen[cell] = true;
  }
  std::uint64_t free_from = 0;
  for (const CellGroup& group : order.groups) {
    const std::uint64_t end = std::uint64_t{group.first} + group.count;
    if (group.first < free_from || group.count < 2 || end > cells)
      return testing::AssertionFailure() << "group of " << group.count << " from " << group.first;
    free_from = end;
  }
  return testing::AssertionSuccess();
}

std::vector<std::uint32_t> group_ranks(const VisibilityOrder& order) {
  std::vector<std::uint32_t> ranks(order.cells.size());
  std::size_t next_group = 0;
  std::uint32_t rank = 0;
  for (std::size_t at = 0; at < order.cells.size(); ++rank) {
    std::size_t count = 1;
    if (next_group < order.groups.size() && order.groups[next_group].first == at)
      count = order.groups[next_group++].count;
    for (std::size_t k = 0; k < count; ++k) ranks[order.cells[at + k]] = rank;
    at += count;
  }
  return ranks;
}

testing::AssertionResult is_order_of(const Arrows& arrows, std::size_t cells,
                                     const VisibilityOrder& order) {
  if (const auto sequence = is_sequence_of_groups(order, cells); !sequence) return sequence;
  const auto rank = group_ranks(order);
  const auto reached = reachability(arrows, cells);
  for (CellId i = 0; i < cells; ++i)
    for (CellId j = 0; j < cells; ++j)
      if ((rank[i] == rank[j]) != (reached[i][j] && reached[j][i]))
        return testing::AssertionFailure()
               << "cells " << i << " and " << j << " are "
               << (rank[i] == rank[j] ? "in one group and no cycle" : "in one cycle and no group");
  for (const auto& [front, behind] : arrows)
    if (rank[front] > rank[behind])
      return testing::AssertionFailure() << "cell " << front << " comes after " << behind;
  return testing::AssertionSuccess();
}

Arrows rational_arrows(const ZooMesh& tetrahedra, const View& view) {
  // face by its sorted nodes: the cells that have it, each with its fourth node
  std::map<std::array<NodeId, 3>, std::vector<std::pair<CellId, NodeId>>> faces;
  for (CellId cell = 0; cell < tetrahedra.cell_count(); ++cell) {
    const auto nodes = tetrahedra.cell_nodes(cell);
    for (std::size_t k = 0; k < 4; ++k) {
      std::array<NodeId, 3> face{nodes[(k + 1) % 4], nodes[(k + 2) % 4], nodes[(k + 3) % 4]};
      std::ranges::sort(face);
      faces[face].emplace_back(cell, nodes[k]);
    }
  }
  Arrows arrows;
  for (const auto& [face, cells] : faces) {
    if (cells.size() != 2) continue;
    const Point a = point(tetrahedra, face[0]), b = point(tetrahedra, face[1]),
                c = point(tetrahedra, face[2]);
    const int eye = view.perspective ? rational_orientation(a, b, c, view.eye)
                                     : -rational_orientation_towards(a, b, c, view.direction);
    for (std::size_t k = 0; k < 2; ++k) {
      const int side = rational_orientation(a, b, c, point(tetrahedra, cells[k].second));
      if (side != 0 && side == eye) arrows.emplace_back(cells[k].first, cells[1 - k].first);
      if (side != 0 && side == -eye) arrows.emplace_back(cells[1 - k].first, cells[k].first);
    }
  }
  return arrows;
}

testing::AssertionResult holds_along_rays(const ZooMesh& mesh, const View& view,
                                          const VisibilityOrder& order, std::size_t count,
                                          std::uint64_t seed) {
  if (const auto sequence = is_sequence_of_groups(order, mesh.cell_count()); !sequence)
    return sequence;
  const auto rank = group_ranks(order);
  const Real shortest = 1e-9L * size_of(mesh);
  std::mt19937_64 random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    const Ray ray = random_ray(mesh, view, random);
    std::vector<Piece> pieces;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
      const Piece piece = cut(mesh, cell, ray);
      if (piece.to - piece.from > shortest && !is_flat(mesh, cell)) pieces.push_back(piece);
    }
    for (const Piece& p : pieces)
      for (const Piece& q : pieces)
        if (p.to < q.from + shortest && p.from < q.from && rank[p.cell] > rank[q.cell])
          return testing::AssertionFailure()
                 << "ray " << i << " meets cell " << p.cell << " (to " << p.to << ") before cell "
                 << q.cell << " (from " << q.from << ")";
  }
  return testing::AssertionSuccess();
}

}  // namespace hiac::test
