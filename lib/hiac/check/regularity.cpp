#include "hiac/check/regularity.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <vector>

#include "hiac/base/cancellation.hpp"
#include "hiac/base/collect.hpp"
#include "hiac/check/lifted_orientation.hpp"
#include "hiac/geometry/box.hpp"
#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

constexpr std::size_t kRegularityGrain = 1 << 12;

bool all_cells(const ZooMesh& mesh, const auto& holds) {
  std::atomic<bool> all{true};
  parallel_for(mesh.cell_count(), kRegularityGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (!all.load(std::memory_order_relaxed)) return;
      if (!holds(static_cast<CellId>(i))) all.store(false, std::memory_order_relaxed);
    }
  });
  return all;
}

// Four corners of a cell that are not in one plane, in positive orientation.
struct Simplex {
  bool found = false;
  std::array<NodeId, 4> nodes{};
};

Simplex simplex_of(const ZooMesh& mesh, CellId cell) {
  const auto n = mesh.cell_nodes(cell).first(corner_count(mesh.kinds[cell]));
  for (std::size_t i = 1; i < n.size(); ++i)
    for (std::size_t j = i + 1; j < n.size(); ++j)
      for (std::size_t k = j + 1; k < n.size(); ++k) {
        const int sign = orientation(mesh.position(n[0]), mesh.position(n[i]), mesh.position(n[j]),
                                     mesh.position(n[k]));
        if (sign > 0) return {true, {n[0], n[i], n[j], n[k]}};
        if (sign < 0) return {true, {n[0], n[j], n[i], n[k]}};
      }
  return {};
}

int outside_sphere_of(const ZooMesh& mesh, const std::array<NodeId, 4>& s, NodeId node) {
  if (std::ranges::find(s, node) != s.end()) return 0;
  return outside_sphere(mesh.position(s[0]), mesh.position(s[1]), mesh.position(s[2]),
                        mesh.position(s[3]), mesh.position(node));
}

// Compares the corners of a cell's neighbours with the sphere of its own: strict if they are
// outside of it, weak if some are on it, none if some are inside or the cell's own are not on a
// sphere.
Delaunay delaunay_of(const OrderBasis& basis, CellId cell) {
  const ZooMesh& mesh = *basis.mesh;
  const auto own = mesh.cell_nodes(cell).first(corner_count(mesh.kinds[cell]));
  const Simplex simplex = simplex_of(mesh, cell);
  if (!simplex.found) return Delaunay::none;
  for (const NodeId node : own)
    if (outside_sphere_of(mesh, simplex.nodes, node) != 0) return Delaunay::none;
  Delaunay found = Delaunay::strict;
  for (std::uint32_t f = 0; f < basis.faces.count(cell); ++f) {
    const CellId other = basis.adjacency.neighbors[basis.faces.first(cell) + f];
    // once per face, as the other side gives the same answer
    if (other == kNoCell || other < cell) continue;
    for (const NodeId node : mesh.cell_nodes(other).first(corner_count(mesh.kinds[other]))) {
      if (std::ranges::find(own, node) != own.end()) continue;
      const int side = outside_sphere_of(mesh, simplex.nodes, node);
      if (side < 0) return Delaunay::none;
      if (side == 0) found = Delaunay::weak;
    }
  }
  return found;
}

// Returns the least that holds for all cells, in parallel.
Delaunay delaunay_of_mesh(const OrderBasis& basis) {
  std::atomic<Delaunay> least{Delaunay::strict};
  all_cells(*basis.mesh, [&](CellId cell) {
    const Delaunay here = delaunay_of(basis, cell);
    Delaunay before = least.load(std::memory_order_relaxed);
    while (here < before && !least.compare_exchange_weak(before, here, std::memory_order_relaxed)) {
    }
    return here != Delaunay::none;
  });
  return least;
}

// Two tetrahedra that share a face: the nodes of one in positive orientation, then the other's far
// one.
using Hinge = std::array<NodeId, 5>;

// With `weak`, only those whose five nodes are on one sphere.
std::vector<Hinge> hinges_of(const OrderBasis& basis, bool weak) {
  const ZooMesh& mesh = *basis.mesh;
  return collect<Hinge>(mesh.cell_count(), kRegularityGrain, [&](std::size_t i, auto& found) {
    const auto cell = static_cast<CellId>(i);
    const Simplex simplex = simplex_of(mesh, cell);
    for (std::uint32_t f = 0; f < 4; ++f) {
      const CellId other = basis.adjacency.neighbors[basis.faces.first(cell) + f];
      if (other == kNoCell || other < cell) continue;
      for (const NodeId node : mesh.cell_nodes(other))
        if (std::ranges::find(simplex.nodes, node) == simplex.nodes.end() &&
            (!weak || outside_sphere_of(mesh, simplex.nodes, node) == 0))
          found.push_back(
              {simplex.nodes[0], simplex.nodes[1], simplex.nodes[2], simplex.nodes[3], node});
    }
  });
}

// Derivatives, by the five heights, of the far node's height above the tetrahedron's affine
// function: minus the far node's barycentric coordinates, and 1.
std::array<double, 5> slopes_of(const ZooMesh& mesh, const Hinge& hinge) {
  std::array<Vector, 4> at;
  for (std::size_t k = 0; k < 4; ++k)
    at[k] = minus(mesh.position(hinge[k + 1]), mesh.position(hinge[0]));
  const auto det = [](const Vector& u, const Vector& v, const Vector& w) {
    return dot(u, cross(v, w));
  };
  const double volume = det(at[0], at[1], at[2]);
  const double b = det(at[3], at[1], at[2]) / volume, c = det(at[0], at[3], at[2]) / volume,
               d = det(at[0], at[1], at[3]) / volume;
  return {-(1 - b - c - d), -b, -c, -d, 1};
}

// The products of a quadratic form: xx, yy, zz, xy, yz, zx.
using Products = std::array<double, 6>;

Products products_of(const Vector& p) {
  return {p[0] * p[0], p[1] * p[1], p[2] * p[2], p[0] * p[1], p[1] * p[2], p[2] * p[0]};
}

double inner_product(const Products& a, const Products& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// The lifts of a hinge by the six products as heights, as a vector of length 1; zero if none of
// them lifts it. An affine function lifts nothing, so that any origin will do.
Products lifts_of(const ZooMesh& mesh, const Hinge& hinge) {
  const auto slopes = slopes_of(mesh, hinge);
  Products lifts{};
  for (std::size_t k = 0; k < 5; ++k) {
    const Products here = products_of(minus(mesh.position(hinge[k]), mesh.position(hinge[0])));
    for (std::size_t i = 0; i < here.size(); ++i) lifts[i] += slopes[k] * here[i];
  }
  const double size = std::sqrt(inner_product(lifts, lifts));
  for (double& lift : lifts) lift = size > 0 ? lift / size : 0;
  return lifts;
}

// Returns heights by a quadratic form that lifts every hinge, up to rounding; none if the search
// fails. (The tetrahedra of a grid are Delaunay with respect to another metric.)
std::vector<double> search_form(const ZooMesh& mesh, const std::vector<Hinge>& hinges) {
  constexpr int kSweeps = 50;
  CancellationCheck cancelled;
  Products form{};
  bool all = false;
  for (int sweep = 0; sweep < kSweeps && !all; ++sweep) {
    all = true;
    for (const Hinge& hinge : hinges) {
      cancelled();
      const Products lifts = lifts_of(mesh, hinge);
      const double lift = inner_product(lifts, form);
      if (lift > 0.5) continue;
      if (!(inner_product(lifts, lifts) > 0)) return {};
      all = false;
      for (std::size_t i = 0; i < form.size(); ++i) form[i] += (1 - lift) * lifts[i];
    }
  }
  if (!all) return {};
  const Vector low = box_of_nodes(mesh).low;
  std::vector<double> heights(mesh.node_count());
  for (std::size_t i = 0; i < heights.size(); ++i)
    heights[i] =
        inner_product(form, products_of(minus(mesh.position(static_cast<NodeId>(i)), low)));
  return heights;
}

// Returns heights that lift every hinge, up to rounding; none if the search fails. It starts from
// squared distances.
std::vector<double> search_heights(const ZooMesh& mesh, const std::vector<Hinge>& hinges) {
  constexpr int kSweeps = 300;
  constexpr double kMargin = 1e-3;  // of the mean, in units of the mesh's size
  const auto [low, high] = box_of_nodes(mesh);
  const double size = largest(minus(high, low));
  std::vector<double> heights(mesh.node_count());
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const Vector p = minus(mesh.position(static_cast<NodeId>(i)), low);
    heights[i] = dot(p, p) / size / size;
  }
  const double margin = kMargin / std::cbrt(static_cast<double>(heights.size()) *
                                            static_cast<double>(heights.size()));
  CancellationCheck cancelled;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bool all = true;
    for (const Hinge& hinge : hinges) {
      cancelled();
      const auto slopes = slopes_of(mesh, hinge);
      double lift = 0, norm = 0;
      for (std::size_t k = 0; k < 5; ++k) {
        lift += slopes[k] * heights[hinge[k]];
        norm += slopes[k] * slopes[k];
      }
      if (!std::isfinite(norm)) return {};
      const double wanted = margin * std::sqrt(norm);
      if (lift >= 0.5 * wanted) continue;
      all = false;
      for (std::size_t k = 0; k < 5; ++k) heights[hinge[k]] += (wanted - lift) / norm * slopes[k];
    }
    if (all) return heights;
  }
  return {};
}

// Exactly.
bool lifts_all(const ZooMesh& mesh, const std::vector<Hinge>& hinges,
               const std::vector<double>& heights) {
  if (heights.empty()) return false;
  CancellationCheck cancelled;
  return std::ranges::all_of(hinges, [&](const Hinge& h) {
    cancelled();
    const auto at = [&](std::size_t k) { return mesh.position(h[k]); };
    return lifted_orientation(
               {at(0), at(1), at(2), at(3), at(4)},
               {heights[h[0]], heights[h[1]], heights[h[2]], heights[h[3]], heights[h[4]]}) > 0;
  });
}

}  // namespace

Certificate certify_acyclic(const OrderBasis& basis, const CellShapes& shapes) {
  constexpr std::size_t kMostHinges = 1 << 18;  // for heights of every node
  const ZooMesh& mesh = *basis.mesh;
  using enum Acyclicity;
  if (!shapes.uniform) return {unknown, {}, "not all cells are valid and turn alike"};
  if (!basis.convex) return {unknown, {}, "rays may leave the mesh and enter it again"};
  if (!all_cells(mesh, [&](CellId c) { return order_of(mesh.kinds[c]) == CellOrder::linear; }))
    return {unknown, {}, "cells are curved"};
  const Delaunay found = delaunay_of_mesh(basis);
  if (found == Delaunay::strict) return {delaunay, found, ""};
  if (!all_cells(mesh, [&](CellId c) { return mesh.kinds[c] == CellKind::tetrahedron4; }))
    return {unknown, found, "other heights than Delaunay's are searched for tetrahedra alone"};
  const std::vector<Hinge> hinges = hinges_of(basis, found == Delaunay::weak);
  if (lifts_all(mesh, hinges, search_form(mesh, hinges))) return {regular, found, ""};
  if (hinges.size() > kMostHinges)
    return {unknown, found, "too many cells to search for other heights than Delaunay's"};
  if (lifts_all(mesh, hinges, search_heights(mesh, hinges))) return {regular, found, ""};
  return {unknown, found, "no other heights than Delaunay's found"};
}

}  // namespace hiac
