// The method `exact` against the accurate engine, both in the exact order: the scenes of the
// benchmarks, real meshes and random scenes. Prints the errors as a table.
//
// By default meshes of a few thousand cells; HIAC_ALL_DATA=1 in the environment takes all of them,
// and every view with both glows.
#include "tests/preview/exact_sweep.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "hiac/base/error.hpp"
#include "hiac/frame/renderable.hpp"
#include "hiac/session/session.hpp"
#include "hiac/tetrahedralize/subdivide_cells.hpp"
#include "tests/benchmarks/cube_scene.hpp"
#include "tests/preview/preview_support.hpp"
#include "tests/render/truth/random_scenes.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/meshes.hpp"
#if HIAC_WITH_FORMATS
#  include "tests/formats/files.hpp"
#endif

namespace hiac {
namespace {

namespace fs = std::filesystem;
using test::SweepRow;

constexpr std::uint32_t kWidth = 200, kHeight = 150;

bool takes_all() { return std::getenv("HIAC_ALL_DATA") != nullptr; }
// Shaders are compiled anew for every transfer function, which takes minutes when sanitized.
bool takes_few() { return test::kInstrumented && !takes_all(); }

class ExactSweep : public test::WithDriver {
 protected:
  // `steps`: transfer functions jump, or have thin shells.
  void expect(const SweepRow& row, bool steps) {
    test::print_row(row, !begun_);
    begun_ = true;
    EXPECT_LE(row.single.largest, steps ? 1e-3 : 2e-5) << row.name;
    EXPECT_LE(row.single.rms, 1e-6) << row.name;
    EXPECT_LE(row.fine.largest, 2e-6) << row.name;
    EXPECT_LE(row.fine.rms, 1e-6) << row.name;
  }

 private:
  bool begun_ = false;
};

// The transfer functions of the comparison with other renderers.
struct BenchmarkView {
  const char* name;
  std::vector<ExtinctionTransfer::Point> extinction;
};

TEST_F(ExactSweep, ScenesOfTheBenchmarks) {
  const std::vector<BenchmarkView> views{
      {"bends", cube_scene(1).volume.extinction->points},
      {"constant", {{0, {2}}, {1, {2}}}},
      {"nearly constant", {{0, {2}}, {1, {2.01}}}},
      {"thin", {{0, {0.001}}, {1, {0.002}}}},
      {"ramp", {{0, {0.5}}, {1, {5}}}},
      {"dense", {{0, {3}}, {0.25, {9}}, {0.45, {60}}, {0.55, {7.5}}, {0.8, {90}}, {1, {15}}}}};
  std::vector<std::pair<std::string, ZooMesh>> meshes;
  std::vector<std::size_t> points{1600};
  if (takes_all()) points.insert(points.end(), {26000, 85000});
  for (const std::size_t count : points)
    meshes.emplace_back("random tetrahedra", test::delaunay_with_fields(count, 1));
  meshes.emplace_back("lattice", test::lattice_with_fields(6));
  for (const auto& [name, mesh] : meshes)
    for (const BenchmarkView& view : views) {
      if (mesh.cell_count() > 20000 && view.name != std::string("bends")) continue;
      if (takes_few() && view.name != std::string("dense")) continue;
      Scene scene = test::benchmark_scene(Projection::orthographic, kWidth, kHeight);
      scene.volume.extinction->points = view.extinction;
      expect(test::sweep(context(), name + ", " + view.name, mesh,
                         test::views_of(mesh, scene, takes_all())),
             false);
    }
  for (const char* field : {"f", "g"}) {
    if (takes_few() && field == std::string("f")) continue;
    Scene scene = test::benchmark_scene(Projection::orthographic, kWidth, kHeight);
    for (const double value : {0.3, 0.4, 0.55, 0.6, 0.7}) {
      Isosurface surface;
      surface.field = field;
      surface.value = value;
      surface.opacity = 0.2;
      scene.isosurfaces.push_back(surface);
    }
    const ZooMesh& mesh = meshes.front().second;
    expect(test::sweep(context(), std::string("five isosurfaces of ") + field, mesh,
                       test::views_of(mesh, scene, takes_all())),
           false);
  }
}

template <std::size_t N>
bool jumps(const std::optional<TransferFunction<N>>& function) {
  for (std::size_t k = 1; function && k < function->points.size(); ++k)
    if (function->points[k].scalar - function->points[k - 1].scalar < 1e-2) return true;
  return false;
}

TEST_F(ExactSweep, RandomScenes) {
  for (std::uint64_t seed = 0; seed < (takes_all() ? 200U : takes_few() ? 3U : 10U); ++seed) {
    test::RandomScene random = test::random_scene(test::SceneCells::tetrahedra, 9000 + seed, 60);
    random.scene.render.tolerance = 1e-9;
    expect(
        test::sweep(context(), "random scene " + std::to_string(seed), random.mesh, {random.scene}),
        jumps(random.scene.volume.color) || jumps(random.scene.volume.extinction));
  }
}

#if HIAC_WITH_FORMATS

constexpr std::size_t kMostCells = test::kInstrumented ? 200 : 1500;

// A file's cells as tetrahedra, and its first field; a made one where it has none.
ZooMesh tetrahedra_of(ZooMesh mesh) {
  mesh = subdivide_cells(mesh, {.linearize = true, .levels = 0}).mesh;
  bool any = false;
  for (const Field& field : mesh.fields)
    for (const double value : field.values) any = any || std::isfinite(value);
  if (any) return mesh;
  mesh.fields.clear();
  double size = 0;
  for (const double x : mesh.xyz) size = std::max(size, std::abs(x));
  test::add_node_field(mesh, "shade", [&](const test::Position& p) {
    return 0.5 + 0.5 * std::sin(7 * (p[0] + 2 * p[1] + 3 * p[2]) / size);
  });
  return mesh;
}

TEST_F(ExactSweep, RealMeshes) {
  const std::string folder = formats::data_dir();
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path().string());
  std::ranges::sort(files);
  std::size_t number = 0, drawn = 0;
  for (const std::string& path : files) {
    if (!takes_all() && (fs::file_size(path) > 2'000'000 || number++ % 8 != 0)) continue;
    const std::string name = fs::relative(path, folder).string();
    ZooMesh mesh;
    Scene scene;
    std::vector<CellId> invalid;
    try {
      mesh = formats::read_any(path).mesh;
      if (!takes_all() && mesh.cell_count() > kMostCells) continue;
      mesh = tetrahedra_of(std::move(mesh));
      scene = starter_view(mesh);
      scene.skin.reset();  // the preview draws neither
      scene.edges.reset();
      check_renderable(mesh, scene, InvalidCells::skipped);
      invalid = invalid_cells(mesh, scene.render.planarity);
    } catch (const Error& error) {
      if (takes_all()) std::printf("%s: no picture: %s\n", name.c_str(), error.what());
      continue;
    }
    scene.image = {kWidth, kHeight};
    expect(test::sweep(context(), name, mesh, test::views_of(mesh, scene, takes_all()), invalid),
           false);
    ++drawn;
  }
  EXPECT_GT(drawn, 0U);
}

#endif

}  // namespace
}  // namespace hiac
