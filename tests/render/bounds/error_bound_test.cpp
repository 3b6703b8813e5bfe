#include "hiac/render/bounds/error_bound.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "hiac/geometry/vector.hpp"
#include "hiac/render/engine.hpp"
#include "tests/render/truth/error_comparison.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/phong.hpp"

namespace hiac {
namespace {

using test::compare_error_channel;
using test::ErrorComparison;
using test::SceneCells;

// A sample of what error_sweep compares.
ErrorComparison compared(SceneCells cells, std::uint64_t first, std::uint64_t last,
                         std::uint32_t side) {
  ErrorComparison all;
  for (std::uint64_t seed = first; seed <= last; ++seed)
    all.add(compare_error_channel(cells, seed, side));
  for (const test::PixelError& failure : all.failures)
    ADD_FAILURE() << "seed " << failure.seed << " pixel " << failure.x << ',' << failure.y
                  << " channel " << failure.channel << " error " << failure.error << " claimed "
                  << failure.claimed;
  return all;
}

TEST(ErrorBound, IsNeverBelowTheErrorOfTetrahedra) {
  const ErrorComparison all = compared(SceneCells::tetrahedra, 1, 30, 24);
  EXPECT_GT(all.pixels, 3000U);
  EXPECT_GT(all.largest_error, 1e-14);
}

TEST(ErrorBound, IsNeverBelowTheErrorOfOtherKinds) {
  EXPECT_GT(compared(SceneCells::other_kinds, 1, 30, 9).pixels, 200U);
}

// Claims are useful, too: not far above what rounding does.
TEST(ErrorBound, IsNeverBelowTheErrorOfCurvedCells) {
  ErrorComparison all = compared(SceneCells::curved, 1, test::tried(24), 4);
  EXPECT_GT(all.pixels, test::tried(60));
  std::ranges::sort(all.claims);
  EXPECT_LT(all.claims[all.claims.size() * 9 / 10], 1e-8);
}

// A scene of random cells, projection and view, as it is and moved by 2^20 in every coordinate: a
// million times its size. Its coordinates are multiples of 2^-20, so that nothing is rounded.
struct NearAndFar {
  ZooMesh near, far;
  Scene near_scene, far_scene;
};

NearAndFar moved_far(const ZooMesh& cells, Projection projection, bool along_faces) {
  constexpr double kFar = 0x1p20;
  const auto on_grid = [](test::Position p) {
    for (double& x : p) x = std::round(x * 0x1p20) * 0x1p-20;
    return p;
  };
  const auto far = [](test::Position p) {
    for (double& x : p) x += kFar;
    return p;
  };
  NearAndFar both{test::moved(cells, on_grid), {}, {}, {}};
  test::add_node_field(both.near, "f", test::smooth_field);
  both.far = test::moved(both.near, far);
  Scene& scene = both.near_scene;
  scene = test::cube_scene(projection, 28, 24);
  scene.camera.look_at = {0.5, 0.5, 0.5};
  scene.camera.eye =
      along_faces ? test::Position{0.5, 0.5, 3.5} : test::Position{3.125, 2.25, 2.75};
  scene.camera.up = {0, 1, 0};
  scene.camera.clip = {{2.5, 4}};
  scene.isosurfaces.resize(1);
  scene.isosurfaces[0].field = "f";
  scene.isosurfaces[0].value = 0.4;
  scene.isosurfaces[0].opacity = 0.5;
  both.far_scene = scene;
  both.far_scene.camera.look_at = far(scene.camera.look_at);
  both.far_scene.camera.eye = far(scene.camera.eye);
  return both;
}

// Rays are followed relative to the eye: what is far from the origin is drawn as it is there, to
// the last bit, and its errors are those there, in views along faces, which have no area on the
// screen, as well.
TEST(ErrorBound, HoldsFarFromTheOrigin) {
  const auto warped = [](const test::Position& p) { return test::warped(p, 0.05); };
  const std::vector<ZooMesh> meshes{
      test::random_delaunay(40, 3), test::structured(3, test::Cut::tetrahedra),
      test::moved(test::mixed_columns(3), test::sheared),
      test::moved(test::structured(2, test::Cut::bricks), warped),
      test::of_order(test::structured(1, test::Cut::tetrahedra), CellOrder::quadratic)};
  const std::array channels{Channel::error, Channel::depth};
  for (std::size_t k = 0; k < meshes.size(); ++k)
    for (const Projection projection : {Projection::perspective, Projection::orthographic})
      for (const bool along_faces : {false, true}) {
        const auto [near, far, near_scene, far_scene] =
            moved_far(meshes[k], projection, along_faces);
        const auto image = [&](const ZooMesh& mesh, const Scene& scene) {
          return render(mesh, test::sorted(mesh, scene), scene, false, nullptr, channels).image;
        };
        const Image here = image(near, near_scene), there = image(far, far_scene);
        std::size_t covered = 0;
        for (std::uint32_t y = 0; y < 24; ++y)
          for (std::uint32_t x = 0; x < 28; ++x) {
            if (here.at(x, y, 3) > 0) ++covered;
            for (std::size_t c = 0; c < here.channel_count(); ++c)
              ASSERT_EQ(here.at(x, y, c), there.at(x, y, c))
                  << k << ' ' << x << ' ' << y << ' ' << c;
          }
        EXPECT_GT(covered, 100U);
      }
}

// From far off the origin, along faces, with coordinates that are rounded there.
TEST(ErrorBound, HoldsForCoordinatesRoundedFarAway) {
  compared(SceneCells::tetrahedra, 46, 46, 80);
}

// Behind an opaque surface in a cell quadratures may be as coarse as they like: nothing of it is
// seen.
TEST(ErrorBound, DoesNotCountWhatOpaqueSurfacesHide) {
  const ErrorComparison all = compared(SceneCells::other_kinds, 115, 115, 20);
  EXPECT_LT(std::ranges::max(all.claims), 1e-10);
}

// The gradient of a linear tetrahedron's field, of any length; to 1e-19 over how thin it is.
std::array<long double, 3> exact_gradient(const ZooMesh& mesh) {
  std::array<std::array<long double, 3>, 3> edges;
  std::array<long double, 3> differences, gradient{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t c = 0; c < 3; ++c)
      edges[k][c] = static_cast<long double>(mesh.position(static_cast<NodeId>(k + 1))[c]) -
                    mesh.position(0)[c];
    differences[k] =
        static_cast<long double>(mesh.fields[0].values[k + 1]) - mesh.fields[0].values[0];
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const auto &a = edges[(k + 1) % 3], &b = edges[(k + 2) % 3];
    for (std::size_t c = 0; c < 3; ++c)
      gradient[c] +=
          differences[k] * (a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3]);
  }
  return gradient;
}

double condition_of(const ZooMesh& mesh) {
  std::array<Vector, 3> edges;
  Vector differences;
  for (std::size_t k = 0; k < 3; ++k) {
    edges[k] = minus(mesh.position(static_cast<NodeId>(k + 1)), mesh.position(0));
    differences[k] = mesh.fields[0].values[k + 1] - mesh.fields[0].values[0];
  }
  return gradient_condition(edges, differences);
}

// A tetrahedron as thin as 1e-8 whose field is nearly that of a plane along it: rounding turns the
// isosurface's normal by up to 1e-8, and its light by nearly as much, all of which is claimed.
TEST(ErrorBound, CountsWhatRoundingTurnsNormals) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> number(0.1, 0.9);
  double largest = 0;
  std::size_t seen = 0;
  for (std::size_t trial = 0; trial < test::tried(60); ++trial) {
    const double x = 0.3 + 0.2 * number(random), y = 0.3 + 0.2 * number(random);
    const double thin = 1e-8 * number(random);
    const double a = number(random), b = number(random);
    ZooMesh mesh = test::make_mesh({{0, 0, 0}, {1, 0, 0.1}, {0, 1, 0.2}, {x, y, 0.1 * x + 0.2 * y}},
                                   {{CellKind::tetrahedron4, {0, 1, 2, 3}}});
    std::vector<double> xyz(mesh.xyz.begin(), mesh.xyz.end());
    xyz[11] += thin;
    mesh.xyz = std::move(xyz);
    mesh.fields = {
        {"f", "", FieldLocation::node, 1,
         std::vector<double>{1, 1 + a, 1 + b, 1 + a * x + b * y + 1e-8 * number(random)}}};
    Scene scene = test::cube_scene(Projection::orthographic, 6, 6);
    scene.camera.eye = {0.4, 0.4, 4};
    scene.camera.look_at = {0.4, 0.4, 0};
    scene.camera.up = {0, 1, 0};
    scene.camera.height = 3e-8;
    scene.volume.extinction->points = {{0, {0}}};
    scene.isosurfaces.resize(1);
    scene.isosurfaces[0] = {.field = "f",
                            .value = 1 + 0.4 * (a + b),
                            .opacity = 1,
                            .ambient = 0,
                            .diffuse = 1,
                            .specular = 0};
    scene.lights = {{.direction = {{0.6, -0.3, 0.74}}}};
    scene.render.tolerance = 1;  // or what is doubtful would be looked into
    const std::array channels{Channel::error};
    const Image image =
        render(mesh, test::sorted(mesh, scene), scene, false, nullptr, channels).image;
    const double condition = condition_of(mesh);
    const test::ReferenceShade truth =
        test::reference_shade(scene.isosurfaces[0], scene.lights, exact_gradient(mesh), {0, 0, -1});
    for (std::uint32_t py = 0; py < 6; ++py)
      for (std::uint32_t px = 0; px < 6; ++px) {
        if (image.at(px, py, 3) == 0) continue;
        ++seen;
        for (std::size_t c = 0; c < 3; ++c) {
          const double error = std::abs(image.at(px, py, c) - static_cast<double>(truth.rgb[c]));
          ASSERT_LE(error, image.at(px, py, 4)) << trial << ' ' << px << ' ' << py;
          largest = std::max(largest, error);
          // what 16 roundings of the condition turn it by, twice for either unit vector
          ASSERT_GE(image.at(px, py, 4), 0.999 * 32 * 0x1p-53 * condition);
          ASSERT_LE(image.at(px, py, 4), 1.1 * 32 * 0x1p-53 * condition);
        }
      }
  }
  EXPECT_GT(seen, test::tried(60));
  EXPECT_GT(largest, 1e-10);
}

// At the default tolerance, 1e-9: bounds that rounding makes larger are looked into, pixel by
// pixel. Views from far, of flat cells and within the mesh; volumes from thin to opaque.
TEST(ErrorBound, StaysBelowATenthOfTheTolerance) {
  for (const std::uint64_t seed : {5037, 5186, 5256, 5491, 6065}) {
    const ErrorComparison all = compared(SceneCells::tetrahedra, seed, seed, 24);
    ASSERT_FALSE(all.claims.empty()) << seed;
    EXPECT_LT(std::ranges::max(all.claims), 1e-10) << seed;
  }
}

// The same of other cells: steep functions of fields far from zero, jumps, isosurfaces, corner
// fields; bricks, prisms, pyramids and wedges.
TEST(ErrorBound, StaysBelowATenthOfTheToleranceInOtherKinds) {
  for (const std::uint64_t seed : {1929, 1955, 1961, 1974, 1984, 2963, 2976}) {
    const ErrorComparison all = compared(SceneCells::other_kinds, seed, seed, 9);
    ASSERT_FALSE(all.claims.empty()) << seed;
    EXPECT_LT(std::ranges::max(all.claims), 1e-10) << seed;
  }
}

// Transfer functions that jump somewhere in a cell whose field hardly changes along a ray.
TEST(ErrorBound, DoesNotCountJumpsThatTheRayIsFarFrom) {
  for (const std::uint64_t seed : {3232, 3276, 3414}) {
    const ErrorComparison all = compared(SceneCells::tetrahedra, seed, seed, 80);
    EXPECT_LT(std::ranges::max(all.claims), 1e-10) << seed;
  }
}

// A field from 0 to 1e-9 and its function's jump of 3 at a value; both known to 1e-15.
TEST(LinearDoubt, IsAboutJumpsWithinTheFieldsError) {
  constexpr double kChange = 1e-9, kError = 1e-15, kLength = 2;
  const auto doubt_about = [](double value) {
    Volume volume;
    volume.extinction = ExtinctionTransfer{"f", {{value, {1}}, {value, {4}}}};
    const OpticsTables optics = make_optics_tables(volume, Integration::exact);
    return linear_doubt(optics.extinction, 3, 1e-16, {0, kChange}, kLength, 0, kError);
  };
  for (const double value : {-1.0, -2 * kError, kChange + 2 * kError, 1.0}) {
    EXPECT_EQ(doubt_about(value).error, kError);
    EXPECT_EQ(doubt_about(value).jumped, 0) << value;
  }
  for (const double value : {-0.5 * kError, 0.0, 0.3 * kChange, kChange})
    EXPECT_DOUBLE_EQ(doubt_about(value).jumped, 3 * kLength * 2 * kError / kChange) << value;
}

// The ends of a segment, off in places, move a field that changes along it.
TEST(LinearDoubt, GrowsWithTheDoubtAboutTheEnds) {
  const OpticsTables optics = make_optics_tables({}, Integration::exact);
  EXPECT_DOUBLE_EQ(linear_doubt(optics.color, 0, 0, {1, 4}, 2, 1e-10, 1e-15).error, 1e-15 + 3e-10);
  EXPECT_DOUBLE_EQ(linear_doubt(optics.color, 0, 0, {4, 1}, 2, 1, 0).error, 3);
}

// Fields are constant to the bit where all values are the same.
TEST(FieldError, IsNoneWhereTheFieldIsConstant) {
  const RayDisplacement moved{.aside = 1e-12};
  EXPECT_EQ(field_error({3, 3}, 0, moved, kTetrahedronRounding), 0);
  EXPECT_EQ(field_error({3, 4}, 1e300, moved, kTetrahedronRounding), 1);
  EXPECT_GT(field_error({3, 4}, 0, moved, kTetrahedronRounding), 4e-16);
}

// A transfer function whose anchor is far from the cell's values loses their digits.
TEST(CellOptics, KnowsTheRoundingOfFarAnchors) {
  Volume volume;
  volume.extinction = ExtinctionTransfer{"f", {{-1e6, {1e6}}, {0, {0}}, {1, {1}}}};
  const OpticsTables optics = make_optics_tables(volume, Integration::exact);
  const CellOptics far = cell_optics(optics, {-1e-6, -1e-7}, {-1e-6, -1e-7});
  const CellOptics near = cell_optics(optics, {1e-7, 1e-6}, {1e-7, 1e-6});
  EXPECT_GT(far.tau_rounding, 1e-10);
  EXPECT_LT(near.tau_rounding, 1e-20);
}

}  // namespace
}  // namespace hiac
