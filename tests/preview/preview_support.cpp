#include "tests/preview/preview_support.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/scene/view_of.hpp"
#include "tests/benchmarks/cube_scene.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::test {
namespace {

void add_fields(ZooMesh& mesh) {
  add_node_field(mesh, "f", smooth_field);
  add_node_field(mesh, "g", [](const Position& p) {
    return 0.5 * (p[0] * p[0] + p[1] * (1 - p[2])) + 0.01 * p[1];
  });
}

}  // namespace

void WithDriver::SetUp() {
  try {
    context_ = std::make_unique<preview::Context>();
  } catch (const preview::DriverError& error) {
    GTEST_SKIP() << error.what();
  }
}

Image WithDriver::preview_of(const ZooMesh& mesh, const Scene& scene,
                             const preview::PreviewOptions& options) const {
  preview::Preview engine(context(), mesh, scene, options);
  return engine.draw(scene.camera, exact_order_of(mesh, scene), {}, false).image;
}

void WithDriver::expect_close(const ZooMesh& mesh, const Scene& scene, double largest,
                              double rms) const {
  const Image truth = render(mesh, exact_order_of(mesh, scene), scene, false).image;
  for (const bool fine : {false, true}) {
    const Image image = preview_of(mesh, scene, {.fine = fine});
    double most = 0, squares = 0, brightest = 0;
    for (std::size_t i = 0; i < truth.values().size(); ++i) {
      const double error = std::abs(image.values()[i] - truth.values()[i]);
      most = std::max(most, std::isnan(error) ? HUGE_VAL : error);
      squares += error * error;
      brightest = std::max(brightest, truth.values()[i]);
    }
    EXPECT_GT(brightest, 0.1) << "an empty picture proves nothing";
    EXPECT_LE(most, fine ? 2e-6 : largest) << (fine ? "double" : "single");
    EXPECT_LE(std::sqrt(squares / static_cast<double>(truth.values().size())), rms)
        << (fine ? "double" : "single");
  }
}

ZooMesh delaunay_with_fields(std::size_t points, std::uint64_t seed) {
  ZooMesh mesh = random_delaunay(points, seed);
  add_fields(mesh);
  return mesh;
}

ZooMesh lattice_with_fields(std::size_t n) {
  ZooMesh mesh = structured(n, Cut::tetrahedra);
  add_fields(mesh);
  return mesh;
}

Scene benchmark_scene(Projection projection, std::uint32_t width, std::uint32_t height) {
  Scene scene = hiac::cube_scene(width);
  scene.image.height = height;
  scene.camera.projection = projection;
  return scene;
}

VisibilityOrder exact_order_of(const ZooMesh& mesh, const Scene& scene) {
  return exact_order(mesh, build_face_adjacency(mesh), view_of(scene.camera),
                     scene.render.planarity)
      .order;
}

}  // namespace hiac::test
