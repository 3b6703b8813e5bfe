#include "hiac/render/explain_pixel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/scene/view_of.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/sorting.hpp"

namespace hiac {
namespace {

using test::cube_scene;
using test::Cut;

VisibilityOrder order_of(const ZooMesh& mesh, const Scene& scene) {
  return test::sorted(mesh, view_of(scene.camera)).order;
}

Isosurface surface_of(const std::string& field, double value, double opacity) {
  Isosurface surface;
  surface.field = field;
  surface.value = value;
  surface.color = {0.9, 0.6, 0.3};
  surface.opacity = opacity;
  return surface;
}

ZooMesh mesh_number(std::size_t number, std::uint64_t seed) {
  ZooMesh mesh;
  switch (number) {
    case 0:
      mesh = test::moved(test::mixed_columns(2), test::tapered);
      break;
    case 1:
      mesh = test::two_wedges();
      break;
    case 2:
      mesh = test::random_delaunay(20 + seed, seed);
      break;
    case 3:
      mesh = test::structured(3, Cut::prisms);
      break;
    default:  // faces and edges seen edge-on
      mesh = test::structured(3, Cut::tetrahedra);
  }
  test::add_random_field(mesh, "f", FieldLocation::node, seed);
  test::add_random_field(mesh, "g", FieldLocation::corner, seed + 1);
  return mesh;
}

Scene scene_number(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  Scene scene =
      cube_scene(seed % 2 == 0 ? Projection::perspective : Projection::orthographic, 70, 40);
  if (seed % 3 == 0) scene.camera.eye = {0.3, 0.4, 0.35};  // inside
  if (seed % 5 == 0) {                                     // along axes
    scene.camera.eye = {0.5, 0.5, 4};
    scene.camera.look_at = {0.5, 0.5, 0};
    scene.camera.up = {0, 1, 0};
  }
  if (unit(random) < 0.5) scene.volume.glow = Glow::emission;
  if (unit(random) < 0.5) scene.volume.color->field = "g";
  if (unit(random) < 0.3)
    for (auto& point : scene.volume.extinction->points) point.value[0] *= 30;  // rays end early
  if (unit(random) < 0.6)
    scene.isosurfaces = {surface_of("f", 0.5, unit(random)), surface_of("g", 0.3, 0.2)};
  if (unit(random) < 0.4) scene.camera.clip = {{0.3, 3.7}};
  if (unit(random) < 0.3) scene.render.integration = Integration::approximate;
  scene.background = {BackgroundPattern::checker, {0.1, 0.2, 0.3}, {1, 0.5, 0}, 7};
  return scene;
}

// What is explained is what is drawn, to the last bit.
TEST(ExplainPixel, EndsWithWhatThePictureHolds) {
  std::size_t segments = 0, surfaces = 0, ended = 0;
  for (std::uint64_t seed = 1; seed <= 40; seed += test::kInstrumented ? 3 : 1) {
    const ZooMesh mesh = mesh_number(seed % 7 % 5, seed);
    const Scene scene = scene_number(seed);
    VisibilityOrder order = order_of(mesh, scene);
    if (seed % 4 == 0)
      order.groups =
          std::vector<CellGroup>{{1, static_cast<std::uint32_t>(order.cells.size() / 2)}};
    const bool with_error = scene.render.integration == Integration::exact;
    const bool with_background = seed % 8 != 0;
    const auto channels = parse_channels(with_error ? "transparency,cells,error" : "cells");
    const Image image = render(mesh, order, scene, with_background, nullptr, channels).image;
    std::mt19937 random(static_cast<std::uint32_t>(seed));
    for (int i = 0; i < 6; ++i) {
      const auto x = static_cast<std::uint32_t>(random() % 70);
      const auto y = static_cast<std::uint32_t>(random() % 40);
      const PixelExplanation pixel = explain_pixel(mesh, order, scene, x, y, with_background);
      for (std::size_t c = 0; c < 4; ++c)
        ASSERT_EQ(pixel.rgba[c], image.at(x, y, c)) << seed << ' ' << x << ' ' << y << ' ' << c;
      ASSERT_EQ(static_cast<double>(pixel.segments.size()),
                image.at(x, y, image.channel_index("cells").value()));
      ASSERT_EQ(pixel.error.has_value(), with_error);
      if (with_error) {
        ASSERT_EQ(pixel.transparency, image.at(x, y, 4));
        ASSERT_EQ(*pixel.error, image.at(x, y, 6)) << seed << ' ' << x << ' ' << y;
      }
      double front = -1e300;
      for (const PixelSegment& segment : pixel.segments) {
        ASSERT_GE(segment.front.depth, front - 1e-9);
        ASSERT_FALSE(segment.out_of_order);
        front = segment.front.depth;
        surfaces += segment.surfaces.size();
      }
      if (!pixel.segments.empty()) {
        ASSERT_EQ(pixel.segments.back().transparency, pixel.transparency);
      }
      segments += pixel.segments.size();
      ended += pixel.ended ? 1 : 0;
    }
  }
  EXPECT_GT(segments, test::tried(160));
  EXPECT_GT(surfaces, test::tried(30));
  EXPECT_GT(ended, 0U);
}

class ExplainKinds : public testing::TestWithParam<CellKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, ExplainKinds, testing::ValuesIn(test::all_kinds()),
                         [](const auto& instance) {
                           return std::string(kind_name(instance.param));
                         });

// Cells of every kind, straight and curved, drawn with channels and without, one by one and as a
// group.
TEST_P(ExplainKinds, EndWithWhatThePictureHolds) {
  for (const bool curved : {false, true})
    for (const Projection projection : {Projection::perspective, Projection::orthographic})
      for (const bool grouped : {false, true}) {
        ZooMesh mesh = curved ? test::curved_mesh(GetParam()) : test::straight_mesh(GetParam());
        test::add_random_field(mesh, "f", FieldLocation::node, 15);
        Scene scene = cube_scene(projection, 9, 7);
        scene.render.tolerance = 1e-9;
        VisibilityOrder order = test::sorted(mesh, scene);
        if (grouped)
          order.groups =
              std::vector<CellGroup>{{0, static_cast<std::uint32_t>(order.cells.size())}};
        const Image plain = render(mesh, order, scene, false).image;
        const Image image =
            render(mesh, order, scene, false, nullptr, parse_channels("cells,error")).image;
        for (const auto& [x, y] : {std::pair{4U, 3U}, std::pair{3U, 2U}, std::pair{5U, 4U}}) {
          const PixelExplanation pixel = explain_pixel(mesh, order, scene, x, y, false);
          for (std::size_t c = 0; c < 4; ++c)
            ASSERT_EQ(pixel.rgba[c], plain.at(x, y, c)) << curved << ' ' << x << ' ' << y;
          ASSERT_EQ(static_cast<double>(pixel.segments.size()), image.at(x, y, 4));
          ASSERT_EQ(*pixel.error, image.at(x, y, 5));
          ASSERT_FALSE(pixel.segments.empty());
          ASSERT_EQ(pixel.segments.back().transparency, pixel.transparency);
          ASSERT_EQ(pixel.segments.back().color[0], plain.at(x, y, 0));
        }
      }
}

// The skin and edges of cells of every kind, beside a medium and without, and in groups: the rows
// end with the picture's pixel, each follows from the one before it, and cells are counted alone.
TEST_P(ExplainKinds, TellOfSkinAndEdgesWhatThePictureHolds) {
  std::size_t met_skin = 0, met_edges = 0;
  for (const std::uint32_t number : {0U, 1U, 2U, 3U, 4U, 5U}) {
    const bool curved = number % 2 == 1;
    ZooMesh mesh = curved ? test::curved_mesh(GetParam()) : test::straight_mesh(GetParam());
    test::add_random_field(mesh, "f", FieldLocation::node, 15);
    Scene scene =
        cube_scene(number < 3 ? Projection::perspective : Projection::orthographic, 31, 23);
    if (number != 4) scene.skin.emplace().opacity = 0.3;
    if (number == 2) scene.volume = {};
    if (number != 1)
      scene.edges =
          Edges{number == 3 ? EdgeChoice::feature : EdgeChoice::all, 30, 3, {0.1, 0.2, 0.3}, 0.7};
    VisibilityOrder order = test::sorted(mesh, scene);
    if (number >= 4)
      order.groups = std::vector<CellGroup>{{0, static_cast<std::uint32_t>(order.cells.size())}};
    const auto channels = parse_channels("transparency,cells");
    const Image image = render(mesh, order, scene, true, nullptr, channels).image;
    std::mt19937 random(number);
    for (int i = 0; i < static_cast<int>(test::tried(12)); ++i) {
      const auto x = static_cast<std::uint32_t>(10 + random() % 12);
      const auto y = static_cast<std::uint32_t>(6 + random() % 12);
      SCOPED_TRACE(fmt::format("{}: {} {}", number, x, y));
      const PixelExplanation pixel = explain_pixel(mesh, order, scene, x, y, true);
      for (std::size_t c = 0; c < 4; ++c) ASSERT_EQ(pixel.rgba[c], image.at(x, y, c));
      ASSERT_EQ(pixel.transparency, image.at(x, y, 4));
      EXPECT_TRUE(pixel.error);
      double transparency = 1, reached = -1e300, cells = 0;
      Color color{};
      for (const PixelSegment& s : pixel.segments) {
        // an edge's place lies beside the ray, and where a curved face bends back even far from it
        if (s.part != RayPart::edge) {
          ASSERT_GE(s.front.depth, reached - 1e-9);
          reached = s.front.depth;
        } else if (!curved) {
          ASSERT_GE(s.front.depth, reached - 0.05);
        }
        if (s.part == RayPart::inside) {
          ++cells;
        } else {
          ++(s.part == RayPart::skin ? met_skin : met_edges);
          ASSERT_GT(s.opacity, 0);
          ASSERT_EQ(s.front.depth, s.back.depth);
          ASSERT_NEAR(s.transparency, transparency * (1 - s.opacity), 1e-15);
          for (std::size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(s.color[c], color[c] + transparency * s.light[c], 1e-15);
        }
        transparency = s.transparency;
        color = s.color;
      }
      ASSERT_EQ(transparency, pixel.transparency);
      ASSERT_EQ(cells, image.at(x, y, 5));
    }
  }
  EXPECT_GT(met_skin, test::tried(40));
  EXPECT_GT(met_edges, test::tried(10));
}

// Psi by Simpson's rule, of an extinction that is linear along the segment.
double psi_of(double front, double back, double length) {
  const auto at = [&](double u) {
    return std::exp(-length * u * (front + 0.5 * u * (back - front)));
  };
  constexpr int kSteps = 2000;
  double sum = at(0) + at(1);
  for (int i = 1; i < kSteps; ++i) sum += (i % 2 == 1 ? 4 : 2) * at(double(i) / kSteps);
  return sum / (3 * kSteps);
}

// The unit cube seen from above, fields of height: everything is known in closed form.
Scene scene_from_above(Projection projection) {
  Scene scene;
  scene.image = {6, 6};
  scene.camera.projection = projection;
  scene.camera.eye = {0.5, 0.53, 4};
  scene.camera.look_at = {0.5, 0.53, 0};
  scene.camera.up = {0, 1, 0};
  scene.camera.height = 0.7;
  scene.camera.fov = 8;
  scene.render.tolerance = 1e-13;
  scene.volume.extinction = ExtinctionTransfer{"z", {{0, {0.5}}, {1, {2.5}}}};
  scene.volume.color = ColorTransfer{"x", {{0, {0.2, 0, 1}}, {1, {0.2, 1, 0}}}};
  return scene;
}

ZooMesh mesh_from_above(Cut cut) {
  ZooMesh mesh = test::structured(2, cut);
  test::add_node_field(mesh, "z", [](const test::Position& p) { return p[2]; });
  test::add_node_field(mesh, "x", [](const test::Position& p) { return p[0]; });
  return mesh;
}

TEST(ExplainPixel, SaysWhatFieldsAndOpticsAre) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids})
    for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
      const ZooMesh mesh = mesh_from_above(cut);
      const Scene scene = scene_from_above(projection);
      const VisibilityOrder order = order_of(mesh, scene);
      for (std::uint32_t x = 0; x < 6; ++x) {
        const PixelExplanation pixel = explain_pixel(mesh, order, scene, x, 1, false);
        // the ray leans by this per unit of depth
        const double half =
            projection == Projection::perspective ? std::tan(8 * M_PI / 360) : 0.7 / 2;
        const double right = (x + 0.5 - 3) / 3 * half, up = (3 - 1.5) / 3 * half;
        const bool parallel = projection == Projection::orthographic;
        const double scale = parallel ? 1 : std::sqrt(1 + right * right + up * up);
        double reached = 3, transparency = 1;
        ASSERT_GE(pixel.segments.size(), 2U);
        for (const PixelSegment& s : pixel.segments) {
          ASSERT_NEAR(s.front.depth, reached, 1e-12);
          reached = s.back.depth;
          for (const SegmentEnd& end : {s.front, s.back}) {
            ASSERT_NEAR(end.extinction_field, 4 - end.depth, 1e-12);
            ASSERT_NEAR(end.color_field, 0.5 + right * (parallel ? 1 : end.depth), 1e-12);
            ASSERT_NEAR(end.tau, 0.5 + 2 * end.extinction_field, 1e-12);
            ASSERT_NEAR(end.kappa[0], 0.2, 1e-15);
            ASSERT_NEAR(end.kappa[1], end.color_field, 1e-12);
            ASSERT_NEAR(end.kappa[2], 1 - end.color_field, 1e-12);
          }
          ASSERT_NEAR(s.length, scale * (s.back.depth - s.front.depth), 1e-12);
          ASSERT_NEAR(s.psi, psi_of(s.front.tau, s.back.tau, s.length), 1e-11);
          transparency *= std::exp(-0.5 * (s.front.tau + s.back.tau) * s.length);
          ASSERT_NEAR(s.transparency, transparency, 1e-13);
          ASSERT_NEAR(s.color[0], 0.2 * (1 - transparency), 1e-13);
        }
        ASSERT_NEAR(reached, 4, 1e-12);
      }
    }
}

// Fields that bend so much along a ray that they are followed in several pieces: Psi is the mean of
// the transparency in front of all of them.
TEST(ExplainPixel, SaysPsiOfFieldsThatBend) {
  ZooMesh mesh = test::of_order(test::structured(1, Cut::bricks), CellOrder::cubic);
  mesh = test::moved(mesh, [](const test::Position& p) {
    return test::Position{p[0], p[1], p[2] + 0.1 * p[2] * (1 - p[2]) * (1 + p[0])};
  });
  test::add_node_field(
      mesh, "z", [](const test::Position& p) { return 0.5 + 0.5 * std::sin(9 * p[2] + p[0]); });
  Scene scene = scene_from_above(Projection::orthographic);
  scene.volume.extinction = ExtinctionTransfer{"z", {{0, {0}}, {1, {3}}}};
  scene.volume.color = ColorTransfer{"z", {{0, {1, 1, 1}}}};
  // emission of 1 everywhere is the length times Psi
  Scene shining = scene;
  shining.volume.glow = Glow::emission;
  const VisibilityOrder order = order_of(mesh, scene);
  for (std::uint32_t x = 0; x < 6; ++x) {
    const PixelExplanation pixel = explain_pixel(mesh, order, scene, x, 1, false);
    const PixelExplanation light = explain_pixel(mesh, order, shining, x, 1, false);
    ASSERT_EQ(pixel.segments.size(), 1U);
    const PixelSegment& s = pixel.segments[0];
    EXPECT_NEAR(s.length, 1, 1e-12);
    EXPECT_NEAR(s.psi, light.rgba[0] / s.length, 1e-11);
    EXPECT_NEAR(s.length * s.psi, light.segments[0].length * light.segments[0].psi, 1e-15);
    EXPECT_LT(s.psi, 0.9);
  }
}

// Two cells in the wrong order: the one that begins before the one in front of it has ended says
// so.
TEST(ExplainPixel, NamesSegmentsOutOfOrder) {
  const ZooMesh mesh = mesh_from_above(Cut::bricks);
  const Scene scene = scene_from_above(Projection::orthographic);
  VisibilityOrder order = order_of(mesh, scene);
  std::vector<CellId> cells(order.cells.begin(), order.cells.end());
  std::ranges::reverse(cells);
  const PixelExplanation pixel =
      explain_pixel(mesh, {std::move(cells), {}, "wrong"}, scene, 4, 1, false);
  ASSERT_EQ(pixel.segments.size(), 2U);
  EXPECT_FALSE(pixel.segments[0].out_of_order);
  EXPECT_TRUE(pixel.segments[1].out_of_order);
  EXPECT_NEAR(pixel.segments[0].front.depth, 3.5, 1e-12);
  EXPECT_NEAR(pixel.segments[1].front.depth, 3, 1e-12);
}

TEST(ExplainPixel, NamesTheIsosurfacesThatTheRayMeets) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids})
    for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
      const ZooMesh mesh = mesh_from_above(cut);
      Scene scene = scene_from_above(projection);
      scene.volume = {};
      scene.isosurfaces = {surface_of("z", 0.3, 0.25), surface_of("z", 0.8, 0.5),
                           surface_of("z", 0.5, 0.125)};
      const PixelExplanation pixel = explain_pixel(mesh, order_of(mesh, scene), scene, 4, 1, false);
      std::vector<MetIsosurface> met;
      for (const PixelSegment& segment : pixel.segments)
        met.insert(met.end(), segment.surfaces.begin(), segment.surfaces.end());
      ASSERT_EQ(met.size(), 3U);
      double transparency = 1;
      const std::array<std::size_t, 3> surfaces{1, 2, 0};
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(met[i].surface, surfaces[i]);
        const Isosurface& surface = scene.isosurfaces[surfaces[i]];
        EXPECT_NEAR(met[i].depth, 4 - surface.value, 1e-12);
        EXPECT_NEAR(met[i].opacity, surface.opacity, 0.01);  // nearly face-on
        transparency *= 1 - met[i].opacity;
      }
      EXPECT_NEAR(pixel.transparency, transparency, 1e-14);
    }
}

// From above, the cube's skin is met at its top and its bottom, face-on, and an edge of its
// outline on the top where it covers half a pixel.
TEST(ExplainPixel, NamesTheSkinAndTheEdgesThatTheRayMeets) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids}) {
    const ZooMesh mesh = mesh_from_above(cut);
    Scene scene = scene_from_above(Projection::orthographic);
    scene.image = {8, 8};
    scene.camera.height = 8.0 / 5;
    // the cube's left side lies a tenth of a pixel left of the middle of column 1
    scene.camera.eye = {0.52, 0.5, 4};
    scene.camera.look_at = {0.52, 0.5, 0};
    scene.volume = {};
    scene.skin.emplace().opacity = 0.25;
    PixelExplanation pixel = explain_pixel(mesh, order_of(mesh, scene), scene, 3, 2, false);
    ASSERT_EQ(pixel.segments.size(), 2U);
    EXPECT_NEAR(pixel.segments[0].front.depth, 3, 1e-12);
    EXPECT_NEAR(pixel.segments[1].front.depth, 4, 1e-12);
    for (const PixelSegment& s : pixel.segments) {
      EXPECT_EQ(s.part, RayPart::skin);
      EXPECT_NEAR(s.opacity, 0.25, 1e-12);
      EXPECT_LT(s.cell, mesh.cell_count());
    }
    scene.skin.reset();
    scene.edges = Edges{EdgeChoice::feature, 30, 0.5, {1, 0, 0}, 0.8};
    pixel = explain_pixel(mesh, order_of(mesh, scene), scene, 1, 2, false);
    ASSERT_EQ(pixel.segments.size(), 2U);  // of the top and of the bottom
    // both cover the left half of the pixel: of the bottom's line a fifth is seen through the top's
    double transparency = 1;
    for (const double taken : {0.5 * 0.8, 0.5 * 0.2 * 0.8}) {
      const PixelSegment& s = pixel.segments[transparency < 1 ? 1 : 0];
      EXPECT_EQ(s.part, RayPart::edge);
      EXPECT_NEAR(s.opacity, taken / transparency, 1e-9);
      EXPECT_NEAR(s.light[0], taken / transparency, 1e-9);
      transparency -= taken;
    }
    EXPECT_NEAR(pixel.segments[0].front.depth, 3, 1e-12);
    // it is drawn where the segment beside it ends, which may be a face inside
    EXPECT_NEAR(pixel.segments[1].front.depth, 4, cut == Cut::bricks ? 1e-12 : 0.11);
    EXPECT_NEAR(pixel.transparency, transparency, 1e-9);
  }
}

// Of quadratic wedges, whose polynomials in the world have quadratic fields exactly.
TEST(ExplainPixel, SaysWhatPolynomialsInTheWorldAre) {
  ZooMesh mesh = test::of_order(test::wedge_grid(2), CellOrder::quadratic);
  test::add_node_field(mesh, "z", [](const test::Position& p) { return p[2] * p[2]; });
  test::add_node_field(mesh, "x", [](const test::Position& p) { return p[0] * p[2]; });
  Scene scene = scene_from_above(Projection::orthographic);
  scene.render.interpolation = Interpolation::polynomial;
  scene.isosurfaces = {surface_of("z", 0.3, 0.25)};
  for (std::uint32_t x = 0; x < 6; ++x) {
    const PixelExplanation pixel = explain_pixel(mesh, order_of(mesh, scene), scene, x, 1, false);
    EXPECT_FALSE(pixel.error);
    std::size_t met = 0;
    for (const PixelSegment& s : pixel.segments) {
      for (const SegmentEnd& end : {s.front, s.back}) {
        const double z = 4 - end.depth;
        EXPECT_NEAR(end.extinction_field, z * z, 1e-12);
        EXPECT_NEAR(end.color_field, z * (0.5 + (x + 0.5 - 3) / 3 * 0.35), 1e-12);
      }
      for (const MetIsosurface& surface : s.surfaces)
        EXPECT_NEAR(surface.depth, 4 - std::sqrt(0.3), 1e-12);
      met += s.surfaces.size();
    }
    EXPECT_EQ(met, 1U);
  }
}

TEST(ExplainPixel, HasNoSegmentsWhereNothingIs) {
  const ZooMesh mesh = mesh_from_above(Cut::bricks);
  Scene scene = scene_from_above(Projection::perspective);
  scene.camera.look_at = {9, 9, 9};
  scene.background.color = {0.25, 0.5, 0.75};
  const PixelExplanation pixel = explain_pixel(mesh, order_of(mesh, scene), scene, 5, 0, true);
  EXPECT_TRUE(pixel.segments.empty());
  EXPECT_EQ(pixel.rgba, (std::array<double, 4>{0.25, 0.5, 0.75, 0}));
}

TEST(ExplainPixel, RefusesWhatItCannotExplain) {
  const ZooMesh mesh = mesh_from_above(Cut::bricks);
  Scene scene = scene_from_above(Projection::perspective);
  const VisibilityOrder order = order_of(mesh, scene);
  EXPECT_THROW(explain_pixel(mesh, order, scene, 6, 0, true), UsageError);
  EXPECT_THROW(explain_pixel(mesh, order, scene, 0, 6, true), UsageError);
  scene.render.splat_below = 2;
  EXPECT_THROW(explain_pixel(mesh, order, scene, 0, 0, true), UsageError);
}

}  // namespace
}  // namespace hiac
