// What comes before a view's order, and that order, on random Delaunay tetrahedra of the unit cube:
// whole, and with cavities until the boundary has a tenth as many faces as there are cells.

#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/order/visibility_order.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

enum class Shape { whole, cavities, sieve };
constexpr double kPlanarity = 1e-10;

// Balls cut out, so many and so small that about a tenth as many faces as cells are unmatched.
ZooMesh with_cavities(const ZooMesh& mesh) {
  constexpr std::size_t kBallsAlong = 10;
  constexpr double kRadius = 0.25 / kBallsAlong;
  return test::keep_cells(mesh, [&](const test::Position& p, CellId) {
    double squared = 0;
    for (const double x : p) {
      const double u = x - (std::floor(x * kBallsAlong) + 0.5) / kBallsAlong;
      squared += u * u;
    }
    return squared > kRadius * kRadius;
  });
}

// Single cells taken out all over: each hole is a tetrahedron.
ZooMesh sieve(const ZooMesh& mesh) {
  std::mt19937_64 random(2);
  return test::keep_cells(mesh, [&](const test::Position&, CellId) { return random() % 40 != 0; });
}

const ZooMesh& mesh_of(std::int64_t points, Shape shape) {
  static std::map<std::pair<std::int64_t, Shape>, ZooMesh> meshes;
  auto& mesh = meshes[{points, shape}];
  if (mesh.cell_count() > 0) return mesh;
  mesh = test::random_delaunay(static_cast<std::size_t>(points), 1);
  if (shape == Shape::cavities) mesh = with_cavities(mesh);
  if (shape == Shape::sieve) mesh = sieve(mesh);
  return mesh;
}

void count(benchmark::State& state, std::size_t cells) {
  state.counters["cells"] = static_cast<double>(cells);
  state.counters["cells/s"] =
      benchmark::Counter(static_cast<double>(cells), benchmark::Counter::kIsIterationInvariantRate);
}

void adjacency(benchmark::State& state) {
  const ZooMesh& mesh = mesh_of(state.range(0), Shape::whole);
  for (auto _ : state) benchmark::DoNotOptimize(build_face_adjacency(mesh));
  count(state, mesh.cell_count());
}

void basis(benchmark::State& state) {
  const ZooMesh& mesh = mesh_of(state.range(0), Shape::whole);
  const FaceAdjacency adjacency = build_face_adjacency(mesh);
  for (auto _ : state) benchmark::DoNotOptimize(order_basis(mesh, adjacency));
  count(state, mesh.cell_count());
}

void order(benchmark::State& state, Shape shape, bool perspective) {
  const ZooMesh& mesh = mesh_of(state.range(0), shape);
  const OrderBasis on = order_basis(mesh, build_face_adjacency(mesh));
  const View view{perspective, {3.1, 2.3, 2.7}, {-2.6, -1.8, -2.2}};
  OrderStatistics statistics;
  for (auto _ : state) statistics = exact_order(on, view, kPlanarity).statistics;
  count(state, mesh.cell_count());
  state.counters["unmatched"] = static_cast<double>(statistics.unmatched_faces);
  state.counters["gap_pairs"] = static_cast<double>(statistics.gap_pairs);
  state.counters["gap_arrows"] = static_cast<double>(statistics.gap_arrows);
  state.counters["largest_group"] = static_cast<double>(statistics.largest_group);
}

// 6.7 tetrahedra a point: a million for 149,000.
constexpr std::int64_t kMillion = 149000;

BENCHMARK(adjacency)->Arg(kMillion)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(basis)->Arg(kMillion)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(order, orthographic, Shape::whole, false)
    ->Arg(kMillion)
    ->Arg(2 * kMillion)
    ->Arg(4 * kMillion)
    ->Arg(8 * kMillion)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(order, perspective, Shape::whole, true)
    ->Arg(kMillion)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(order, cavities, Shape::cavities, true)
    ->Arg(kMillion)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(order, sieve, Shape::sieve, true)
    ->Arg(kMillion)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace hiac
