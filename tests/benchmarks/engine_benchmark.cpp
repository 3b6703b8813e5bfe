// The engine alone, on random Delaunay tetrahedra of the unit cube: the view and
// transfer functions of the comparison with other renderers.

#include <map>

#include <benchmark/benchmark.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/render/engine.hpp"
#include "tests/benchmarks/cube_scene.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

// About 6.1 tetrahedra a point.
const ZooMesh& mesh_of(std::int64_t points) {
  static std::map<std::int64_t, ZooMesh> meshes;
  auto& mesh = meshes[points];
  if (mesh.cell_count() == 0) {
    mesh = test::random_delaunay(static_cast<std::size_t>(points), 1);
    test::add_node_field(mesh, "f", test::smooth_field);
    mesh.adjacency = build_face_adjacency(mesh);
  }
  return mesh;
}

void engine(benchmark::State& state, Projection projection) {
  const ZooMesh& mesh = mesh_of(state.range(0));
  Scene scene = cube_scene(static_cast<std::uint32_t>(state.range(1)));
  scene.camera.projection = projection;
  const VisibilityOrder order = order_of(mesh, scene).order;
  std::uint64_t segments = 0;
  for (auto _ : state) {
    const RenderResult result = render(mesh, order, scene, false);
    segments += result.statistics.segments;
    state.counters["prepare_s"] = result.statistics.prepare_seconds;
  }
  state.counters["cells"] = static_cast<double>(mesh.cell_count());
  state.counters["segments/s"] =
      benchmark::Counter(static_cast<double>(segments), benchmark::Counter::kIsRate);
}

// The same tetrahedra, with straight edges, of higher order.
void of_higher_order(benchmark::State& state, CellOrder cells) {
  ZooMesh mesh = test::of_order(mesh_of(state.range(0)), cells);
  test::add_node_field(mesh, "f", test::smooth_field);
  mesh.adjacency = build_face_adjacency(mesh);
  const Scene scene = cube_scene(1000);
  const VisibilityOrder order = order_of(mesh, scene).order;
  for (auto _ : state) {
    const RenderResult result = render(mesh, order, scene, false);
    state.counters["prepare_s"] = result.statistics.prepare_seconds;
  }
  state.counters["cells"] = static_cast<double>(mesh.cell_count());
}

// Five surfaces of the volume's own field, or of another.
void with_surfaces(benchmark::State& state, Projection projection, const char* field) {
  static ZooMesh mesh = [] {
    ZooMesh m = mesh_of(85000);
    test::add_node_field(m, "g", [](const test::Position& p) {
      return 0.5 * (p[0] * p[0] + p[1] * (1 - p[2]) + p[2]);
    });
    return m;
  }();
  Scene scene = cube_scene(1000);
  scene.camera.projection = projection;
  for (const double value : {0.3, 0.4, 0.55, 0.6, 0.7}) {
    Isosurface surface;
    surface.field = field;
    surface.value = value;
    surface.opacity = 0.2;
    scene.isosurfaces.push_back(surface);
  }
  const VisibilityOrder order = order_of(mesh, scene).order;
  for (auto _ : state) {
    const RenderResult result = render(mesh, order, scene, false);
    state.counters["prepare_s"] = result.statistics.prepare_seconds;
  }
}

BENCHMARK_CAPTURE(engine, orthographic, Projection::orthographic)
    ->ArgNames({"points", "side"})
    ->Args({1600, 1000})
    ->Args({26000, 1000})
    ->Args({85000, 1000})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(engine, perspective, Projection::perspective)
    ->ArgNames({"points", "side"})
    ->Args({85000, 1000})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(of_higher_order, quadratic, CellOrder::quadratic)
    ->ArgName("points")
    ->Arg(1600)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(of_higher_order, cubic, CellOrder::cubic)
    ->ArgName("points")
    ->Arg(1600)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(with_surfaces, orthographic_own, Projection::orthographic, "f")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(with_surfaces, orthographic_other, Projection::orthographic, "g")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(with_surfaces, perspective_other, Projection::perspective, "g")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace hiac
