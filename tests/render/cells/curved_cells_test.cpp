// Cells of all fifteen kinds with curved edges and twisted faces, against brute force.

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/frame/renderable.hpp"
#include "hiac/render/cells/general_cells.hpp"
#include "hiac/render/explain_pixel.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/render/truth/scene_truth.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac {
namespace {

using test::cube_scene;
using test::Cut;
using test::Position;

constexpr std::uint32_t kSide = test::kInstrumented ? 1 : 2;

ZooMesh curved_mesh(CellKind kind) {
  ZooMesh mesh = test::curved_mesh(kind);
  test::add_random_field(mesh, "f", FieldLocation::node, 15);
  test::add_random_field(mesh, "corner", FieldLocation::corner, 16);
  test::add_random_field(mesh, "cell", FieldLocation::cell, 17);
  return mesh;
}

struct Errors {
  double largest = 0;       // of any channel
  double unaccounted = -1;  // of what it exceeds the error channel by
  double claimed = 0;       // largest claim
  std::size_t seen = 0;     // pixels
};

using Truth = std::vector<std::array<long double, 4>>;

// Red, green, blue and alpha of all pixels.
Truth truth_of(const ZooMesh& mesh, const Scene& scene) {
  const test::SceneTruth truth(mesh, scene);
  Truth pixels;
  for (std::uint32_t y = 0; y < scene.image.height; ++y)
    for (std::uint32_t x = 0; x < scene.image.width; ++x) {
      pixels.push_back(truth.pixel(x, y));
      pixels.back()[3] = 1 - pixels.back()[3];
    }
  return pixels;
}

Errors errors_of(const ZooMesh& mesh, const Scene& scene, const Truth& truth) {
  check_renderable(mesh, scene);
  const std::array channels{Channel::error};
  const RenderResult result =
      render(mesh, test::sorted(mesh, scene), scene, false, nullptr, channels);
  EXPECT_EQ(result.statistics.violations, 0U);
  Errors errors;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const auto pixel = std::span(result.image.values()).subspan(5 * k, 5);
    double here = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const auto off = static_cast<double>(std::abs(truth[k][c] - pixel[c]));
      EXPECT_TRUE(std::isfinite(off)) << k;
      here = std::max(here, off);
    }
    if (truth[k][3] > 0) ++errors.seen;
    errors.largest = std::max(errors.largest, here);
    errors.claimed = std::max(errors.claimed, pixel[4]);
    errors.unaccounted = std::max(errors.unaccounted, here - pixel[4]);
  }
  return errors;
}

class CurvedCells : public testing::TestWithParam<CellKind> {};

TEST_P(CurvedCells, VolumesAgreeWithBruteForce) {
  const ZooMesh mesh = curved_mesh(GetParam());
  for (const Projection projection : {Projection::perspective, Projection::orthographic})
    for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
      const bool mixed = (projection == Projection::perspective) == (glow == Glow::emission);
      const bool is_slow = test::kInstrumented || order_of(GetParam()) == CellOrder::cubic;
      if (is_slow && mixed) continue;
      Scene scene = cube_scene(projection, kSide, kSide);
      scene.volume.glow = glow;
      const Truth truth = truth_of(mesh, scene);
      for (const double tolerance : {1e-9, 1e-13}) {
        scene.render.tolerance = tolerance;
        const Errors errors = errors_of(mesh, scene, truth);
        EXPECT_LE(errors.largest, tolerance == 1e-9 ? 1e-9 : 1e-12);
        EXPECT_LE(errors.unaccounted, 0);
        EXPECT_LE(errors.claimed, 1e-8);
        EXPECT_GT(errors.seen, 0U);
      }
    }
}

TEST_P(CurvedCells, IsosurfacesAgreeWithBruteForce) {
  const ZooMesh mesh = curved_mesh(GetParam());
  const bool odd = static_cast<unsigned>(GetParam()) % 2 != 0;
  Scene scene = cube_scene(odd ? Projection::perspective : Projection::orthographic, kSide, kSide);
  for (const double value : {0.2, 0.52, 1.05}) {
    Isosurface surface;
    surface.field = value < 0.5 ? "corner" : "f";
    surface.value = value;
    surface.opacity = 0.6;
    surface.color = {std::abs(1 - value), 0.4, value};
    scene.isosurfaces.push_back(surface);
  }
  const Errors errors = errors_of(mesh, scene, truth_of(mesh, scene));
  EXPECT_LE(errors.largest, 1e-11);
  EXPECT_LE(errors.unaccounted, 0);
}

// Jumps from cell to cell are where the faces are.
TEST_P(CurvedCells, CellFieldsAgreeWithBruteForce) {
  const ZooMesh mesh = curved_mesh(GetParam());
  Scene scene = cube_scene(Projection::perspective, 2 * kSide, 2 * kSide);
  scene.volume.color->field = scene.volume.extinction->field = "cell";
  const Errors errors = errors_of(mesh, scene, truth_of(mesh, scene));
  EXPECT_LE(errors.largest, 1e-12);
  EXPECT_LE(errors.unaccounted, 0);
  EXPECT_LE(errors.claimed, 1e-9);
}

// Bends what is inside the bodies of straight_mesh and leaves their surfaces where they are.
Position bent_inside(CellShape shape, const Position& p) {
  if (shape != CellShape::wedge) return test::bent(p);
  const auto& [x, y, z] = p;
  return {x + 0.2 * (1 - std::abs(x) - (y + z) / 2) * std::sin(5 * y + 4 * z + 1), y, z};
}

// Every kind has linear fields exactly, however its cells are bent: the picture is that of the
// whole body, which needs none of them.
TEST_P(CurvedCells, LinearFieldsAreThoseOfTheBody) {
  const CellShape shape = shape_of(GetParam());
  const auto linear = [](const Position& p) { return 0.5 + 0.3 * p[0] - 0.4 * p[1] + 0.2 * p[2]; };
  ZooMesh body =
      shape == CellShape::wedge ? test::two_wedges() : test::structured(1, Cut::tetrahedra);
  test::add_node_field(body, "f", linear);
  ZooMesh mesh = test::straight_mesh(GetParam(), 2);
  mesh = test::moved(mesh, [&](const Position& p) { return bent_inside(shape, p); });
  test::add_node_field(mesh, "f", linear);
  for (const Projection projection : {Projection::perspective, Projection::orthographic})
    for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
      Scene scene = cube_scene(projection, 2 * kSide, 2 * kSide);
      scene.volume.glow = glow;
      const Errors errors = errors_of(mesh, scene, truth_of(body, scene));
      EXPECT_LE(errors.largest, 1e-12);
      EXPECT_LE(errors.unaccounted, 0);
    }
}

// What is told of a pixel's segments is what their places have.
TEST_P(CurvedCells, ExplainedFieldsAreThoseOfThePlaces) {
  const auto linear = [](const Position& p) { return 0.5 + 0.3 * p[0] - 0.4 * p[1] + 0.2 * p[2]; };
  ZooMesh mesh = curved_mesh(GetParam());
  mesh.fields.clear();
  test::add_node_field(mesh, "f", linear);
  const Scene scene = cube_scene(Projection::perspective, 3, 3);
  const Projector projector(scene.camera, scene.image);
  std::size_t told = 0;
  for (const auto& [x, y] : {std::pair{1U, 1U}, {0U, 1U}, {1U, 2U}}) {
    const PixelExplanation pixel =
        explain_pixel(mesh, test::sorted(mesh, scene), scene, x, y, false);
    const auto origin = projector.origin(x + 0.5, y + 0.5),
               direction = projector.direction(x + 0.5, y + 0.5);
    for (const PixelSegment& segment : pixel.segments)
      for (const SegmentEnd& end : {segment.front, segment.back}) {
        Position at;
        for (std::size_t c = 0; c < 3; ++c) at[c] = origin[c] + end.depth * direction[c];
        EXPECT_NEAR(end.extinction_field, linear(at), 1e-9);
        ++told;
      }
  }
  EXPECT_GT(told, 0U);
}

INSTANTIATE_TEST_SUITE_P(Kinds, CurvedCells, testing::ValuesIn(test::all_kinds()),
                         [](const auto& instance) {
                           return std::string(kind_name(instance.param));
                         });

}  // namespace
}  // namespace hiac
