#include "hiac/render/splatting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/render/supersampling.hpp"
#include "hiac/scene/view_of.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/sorting.hpp"

namespace hiac {
namespace {

using test::Cut;
using test::Position;

VisibilityOrder order_of_scene(const ZooMesh& mesh, const Scene& scene) {
  return test::sorted(mesh, view_of(scene.camera)).order;
}

// The picture that splatting approximates.
Image filtered(const ZooMesh& mesh, Scene scene, std::uint32_t samples) {
  scene.render.splat_below = 0;
  return render_supersampled(mesh, order_of_scene(mesh, scene), scene, whole_picture(scene.image),
                             {samples, SampleFilter::bspline}, false)
      .image;
}

double largest_difference(const Image& a, const Image& b, std::size_t channel) {
  double largest = 0;
  for (std::size_t i = channel; i < a.values().size(); i += 4)
    largest = std::max(largest, std::abs(a.values()[i] - b.values()[i]));
  return largest;
}

double root_mean_square_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i)
    sum += std::pow(a.values()[i] - b.values()[i], 2);
  return std::sqrt(sum / static_cast<double>(a.values().size()));
}

double peak(const Image& image, std::size_t channel) {
  double most = 0;
  for (std::size_t i = channel; i < image.values().size(); i += 4)
    most = std::max(most, image.values()[i]);
  return most;
}

double sum(const Image& image, std::size_t channel) {
  double total = 0;
  for (std::size_t i = channel; i < image.values().size(); i += 4) total += image.values()[i];
  return total;
}

double total_optical_depth(const Image& image) {
  double total = 0;
  for (std::size_t i = 3; i < image.values().size(); i += 4)
    total -= std::log1p(-image.values()[i]);
  return total;
}

ZooMesh cube_in_five() {
  std::vector<Position> corners;
  for (unsigned k = 0; k < 8; ++k)
    corners.push_back({k & 1U ? 1.0 : 0, k & 2U ? 1.0 : 0, k & 4U ? 1.0 : 0});
  return test::make_mesh(corners, {{CellKind::tetrahedron4, {0, 3, 6, 5}},
                                   {CellKind::tetrahedron4, {1, 3, 0, 5}},
                                   {CellKind::tetrahedron4, {2, 0, 3, 6}},
                                   {CellKind::tetrahedron4, {4, 0, 5, 6}},
                                   {CellKind::tetrahedron4, {7, 6, 3, 5}}});
}

// The quadratic B-spline.
double kernel(double t) {
  const double d = std::abs(t);
  return d < 0.5 ? 0.75 - d * d : d < 1.5 ? (1.5 - d) * (1.5 - d) / 2 : 0;
}

double across(const Position& p) { return 0.2 + 0.3 * p[0] + 0.1 * p[1] + 0.4 * p[2]; }

// The cube from all but in front, in the middle of the picture with a margin around it.
Scene whole_cube_scene(Projection projection, std::uint32_t side) {
  Scene scene = test::cube_scene(projection, side, side);
  scene.camera.height = 2.4;
  scene.camera.look_at = {0.5, 0.5, 0.5};
  scene.camera.fov = 32;
  scene.volume.color->points = {{0, {0.1, 0.9, 0.5}}, {1, {0.9, 0.1, 0.5}}};
  return scene;
}

// The paper's own test: a cube cut into tiny tetrahedra, each smaller than a pixel, against the
// five large ones that it can be cut into.
TEST(Splatting, ACubeOfTinyTetrahedraIsTheCubeBlurred) {
  ZooMesh tiny = test::structured(24, Cut::tetrahedra), five = cube_in_five();
  test::add_node_field(tiny, "f", across);
  test::add_node_field(five, "f", across);
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    const VisibilityOrder order = order_of_scene(tiny, whole_cube_scene(projection, 30));
    for (const Glow glow : {Glow::chromaticity, Glow::emission})
      for (const double extinction : {0.06, 0.6}) {
        Scene scene = whole_cube_scene(projection, 30);
        scene.volume.glow = glow;
        scene.volume.extinction->points = {{0, {0}}, {1, {extinction}}};
        const Image exact = filtered(five, scene, 6);
        scene.render.splat_below = 9;
        const RenderResult splatted = render(tiny, order, scene, false);
        EXPECT_EQ(splatted.statistics.splatted_cells, tiny.cell_count());
        EXPECT_EQ(splatted.statistics.violations, 0U);
        EXPECT_GT(splatted.statistics.covered_pixels, 300U);
        for (std::size_t c = 0; c < 4; ++c) {
          EXPECT_LE(largest_difference(splatted.image, exact, c), 0.005 * peak(exact, c))
              << "channel " << c << " extinction " << extinction;
          EXPECT_NEAR(sum(splatted.image, c), sum(exact, c), 0.004 * sum(exact, c));
        }
      }
  }
}

// The optical depths of all pixels together are tau times the volume, in pixels, whatever the cells
// are: in a parallel view exactly, and nothing goes amiss between tiles.
TEST(Splatting, OpticalDepthIsThatOfTheVolume) {
  constexpr double kScale = 40, kSheared = 0.87325;  // pixels per unit; the shear's determinant
  const auto at_tile_border = [](const Position& p) {
    const Position q = test::sheared(p);
    return Position{q[0] + 0.1, q[1] - 0.2, q[2]};
  };
  for (const bool wedges : {false, true}) {
    ZooMesh mesh =
        test::moved(wedges ? test::two_wedges() : test::mixed_columns(3), at_tile_border);
    test::add_node_field(mesh, "f", [](const Position&) { return 0.5; });
    Scene scene = test::cube_scene(Projection::orthographic, 130, 100);
    test::make_uniform(scene);
    scene.volume.extinction->points = {{0, {0.7e-3}}};
    scene.camera.height = 100 / kScale;
    scene.render.splat_below = 100000;
    const RenderResult result = test::draw(mesh, scene);
    EXPECT_EQ(result.statistics.splatted_cells, mesh.cell_count());
    EXPECT_NEAR(total_optical_depth(result.image) / (0.7e-3 * kSheared * kScale * kScale), 1,
                1e-10);
  }
}

// One cell of each kind at a corner of tiles, against the formula written out.
TEST(Splatting, ACellIsAKernelAtItsCentreOfGravity) {
  struct Sample {
    CellKind kind;
    std::vector<Position> corners;
    double volume;
    Position center;
  };
  const std::vector<Sample> samples{
      {CellKind::tetrahedron4,
       {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
       1.0 / 6,
       {0.25, 0.25, 0.25}},
      {CellKind::pyramid5,
       {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}},
       1.0 / 3,
       {0.5, 0.5, 0.25}},
      {CellKind::prism6,
       {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}},
       0.5,
       {1.0 / 3, 1.0 / 3, 0.5}},
      // 2 - y - z wide: the moments of 2 - y - z over the unit square
      {CellKind::wedge7,
       {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
       1,
       {7.0 / 12, 5.0 / 12, 5.0 / 12}},
      {CellKind::brick8,
       {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
       1,
       {0.5, 0.5, 0.5}}};
  for (const Sample& sample : samples)
    for (const Projection projection : {Projection::orthographic, Projection::perspective})
      for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
        SCOPED_TRACE(kind_name(sample.kind));
        constexpr double kSize = 0.02, kPixels = 1 / 0.04;
        ZooMesh mesh;
        {
          std::vector<Position> positions;
          std::vector<NodeId> nodes;
          for (const Position& p : sample.corners) {
            nodes.push_back(static_cast<NodeId>(positions.size()));
            positions.push_back({kSize * p[0], kSize * p[1], kSize * p[2]});
          }
          mesh = test::make_mesh(positions, {{sample.kind, nodes}});
        }
        test::add_node_field(mesh, "f", [](const Position& p) { return 10 * p[0] + 20 * p[1]; });
        Scene scene = test::cube_scene(projection, 128, 64);  // four tiles meet at 0
        scene.volume.glow = glow;
        scene.volume.color->points = {{0, {0, 1, 0.5}}, {1, {1, 0, 0.5}}};
        scene.volume.extinction->points = {{0, {100}}, {1, {300}}};
        scene.camera.look_at = {0, 0, 0};
        scene.camera.eye = {0, 0, 3};
        scene.camera.up = {0, 1, 0};
        scene.camera.height = 64 / kPixels;
        scene.camera.fov = 2 * std::atan(32 / kPixels / 3) * 180 / std::numbers::pi;
        scene.render.splat_below = 1000;
        const Image image = test::draw(mesh, scene).image;
        const double value = kSize * (10 * sample.center[0] + 20 * sample.center[1]);
        const double t = 3 - kSize * sample.center[2];
        const double pixels = projection == Projection::perspective ? kPixels * 3 / t : kPixels;
        const double right = kSize * sample.center[0], up = kSize * sample.center[1];
        const double slant =
            projection == Projection::perspective ? std::hypot(right, up, t) / t : 1;
        const double length = sample.volume * kSize * kSize * kSize * pixels * pixels * slant;
        for (std::uint32_t y = 0; y < 64; ++y)
          for (std::uint32_t x = 0; x < 128; ++x) {
            const double share = length * kernel(x + 0.5 - (64 + pixels * right)) *
                                 kernel(y + 0.5 - (32 - pixels * up));
            const double extinction = 100 + 200 * value;
            const double alpha = -std::expm1(-extinction * share);
            const double light = glow == Glow::emission ? alpha / extinction : alpha;
            ASSERT_NEAR(image.at(x, y, 3), alpha, 1e-12) << x << ' ' << y;
            ASSERT_NEAR(image.at(x, y, 0), light * value, 1e-12);
            ASSERT_NEAR(image.at(x, y, 1), light * (1 - value), 1e-12);
          }
        EXPECT_GT(peak(image, 3), 1e-4);
      }
}

// A field of each kind is taken at the centre of gravity.
// A brick whose height is 1 + 4 a x (1 - x), in closed form; and all kinds bent inside a cube.
TEST(Splatting, CurvedCellsHaveTheirVolumeAndCentre) {
  constexpr double a = 0.2;
  ZooMesh mesh = test::moved(test::of_order(test::structured(1, Cut::bricks), CellOrder::quadratic),
                             [](const Position& p) {
                               return Position{p[0], p[1], p[2] * (1 + 4 * a * p[0] * (1 - p[0]))};
                             });
  test::add_node_field(mesh, "f", [](const Position&) { return 0.5; });
  const Scene scene = test::cube_scene(Projection::orthographic, 40, 40);
  const Projector projector(scene.camera, scene.image);
  const double pixels = std::pow(projector.pixels_per_unit(), 2);
  const Splat splat = splat_of(Frame(mesh, scene, projector), 0);
  const double volume = 1 + 2 * a / 3;
  EXPECT_NEAR(splat.length / pixels, volume, 1e-12);
  EXPECT_NEAR(splat.point[0], 0.5, 1e-12);
  EXPECT_NEAR(splat.point[2], (0.5 + 2 * a / 3 + 4 * a * a / 15) / volume, 1e-12);
  for (const ZooMesh& straight :
       {test::structured(2, Cut::tetrahedra), test::structured(2, Cut::pyramids),
        test::structured(2, Cut::prisms), test::wedge_grid(2), test::structured(2, Cut::bricks)})
    for (const CellOrder order : {CellOrder::quadratic, CellOrder::cubic}) {
      ZooMesh cube = test::moved(test::of_order(straight, order), test::bent);
      test::add_node_field(cube, "f", [](const Position&) { return 0.5; });
      const Frame frame(cube, scene, projector);
      double sum = 0;
      for (CellId cell = 0; cell < cube.cell_count(); ++cell)
        sum += splat_of(frame, cell).length / pixels;
      EXPECT_NEAR(sum, 1, 1e-12) << kind_name(cube.kinds[0]);
    }
}

TEST(Splatting, FieldsAreTakenAtTheCentre) {
  ZooMesh mesh = test::make_mesh({{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}},
                                 {{CellKind::tetrahedron4, {0, 1, 2, 3}}});
  mesh.fields.push_back({"n", "", FieldLocation::node, 1, std::vector<double>{0.1, 0.2, 0.3, 0.6}});
  mesh.fields.push_back({"k", "", FieldLocation::corner, 1, std::vector<double>{0.4, 0, 0.4, 0}});
  mesh.fields.push_back({"c", "", FieldLocation::cell, 1, std::vector<double>{0.7}});
  const std::vector<std::pair<std::string, double>> fields{{"n", 0.3}, {"k", 0.2}, {"c", 0.7}};
  for (const auto& [color, color_value] : fields)
    for (const auto& [extinction, extinction_value] : fields) {
      Scene scene = test::cube_scene(Projection::orthographic, 20, 20);
      scene.camera.look_at = {0, 0, 0};
      scene.volume.color = ColorTransfer{color, {{0, {0, 0, 0}}, {1, {1, 1, 1}}}};
      scene.volume.extinction = ExtinctionTransfer{extinction, {{0, {0}}, {1, {1000}}}};
      scene.render.splat_below = 5;
      const Image image = test::draw(mesh, scene).image;
      const double pixels = 20 / scene.camera.height;
      EXPECT_NEAR(total_optical_depth(image), 1000 * extinction_value * 1e-6 / 6 * pixels * pixels,
                  1e-12);
      EXPECT_NEAR(sum(image, 0), color_value * sum(image, 3), 1e-12);
    }
}

double cross(const std::array<double, 2>& a, const std::array<double, 2>& b,
             const std::array<double, 2>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool in_triangle(const std::array<double, 2>& p, const std::array<double, 2>& a,
                 const std::array<double, 2>& b, const std::array<double, 2>& c) {
  const double u = cross(a, b, p), v = cross(b, c, p), w = cross(c, a, p);
  return (u > 0) == (v > 0) && (v > 0) == (w > 0);
}

// How many pixel centres a tetrahedron covers, anywhere on the plane of the picture.
std::size_t centers_covered(const std::array<std::array<double, 2>, 4>& p) {
  std::array<double, 2> low = p[0], high = p[0];
  for (const auto& q : p)
    for (std::size_t a = 0; a < 2; ++a) {
      low[a] = std::min(low[a], q[a]);
      high[a] = std::max(high[a], q[a]);
    }
  std::size_t count = 0;
  for (double y = std::floor(low[1]) + 0.5; y < high[1]; ++y)
    for (double x = std::floor(low[0]) + 0.5; x < high[0]; ++x)
      if (in_triangle({x, y}, p[0], p[1], p[2]) || in_triangle({x, y}, p[0], p[1], p[3]) ||
          in_triangle({x, y}, p[0], p[2], p[3]) || in_triangle({x, y}, p[1], p[2], p[3]))
        ++count;
  return count;
}

TEST(Splatting, CellsThatCoverTooFewCentresAreSplatted) {
  ZooMesh mesh = test::random_delaunay(400, 5);
  test::add_node_field(mesh, "f", test::smooth_field);
  Scene scene = test::cube_scene(Projection::orthographic, 40, 40);
  scene.camera.eye = {0.5, 0.5, 4};
  scene.camera.look_at = {0.5, 0.5, 0};
  scene.camera.up = {0, 1, 0};
  scene.camera.height = 1.25;  // 32 pixels per unit
  for (const std::uint32_t below : {1U, 2U, 5U, 30U}) {
    std::size_t expected = 0, expected_beside = 0;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
      std::array<std::array<double, 2>, 4> corners;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto p = mesh.position(mesh.cell_nodes(cell)[k]);
        corners[k] = {20 + 32 * (p[0] - 0.5), 20 - 32 * (p[1] - 0.5)};
      }
      if (centers_covered(corners) >= below) continue;
      ++expected;
      // the other picture begins at column 20 of this one; kernels reach 1.5 pixels
      const auto rightmost = std::ranges::max_element(corners);
      if ((*rightmost)[0] > 20 - 1.5) ++expected_beside;
    }
    scene.render.splat_below = below;
    const RenderResult result = test::draw(mesh, scene);
    EXPECT_EQ(result.statistics.splatted_cells, expected) << below;
    EXPECT_GT(expected, 100U);
    EXPECT_LT(expected, mesh.cell_count());
    // what of a cell lies outside the picture counts, but cells that are not seen do not
    Scene beside = scene;
    beside.camera.look_at[0] = beside.camera.eye[0] = 1.0;
    beside.image.width = 32;
    EXPECT_EQ(test::draw(mesh, beside).statistics.splatted_cells, expected_beside) << below;
    EXPECT_LT(expected_beside, expected);
  }
}

TEST(Splatting, NothingIsSplattedWhereAllCoverEnough) {
  ZooMesh mesh = test::structured(2, Cut::tetrahedra);
  test::add_random_field(mesh, "f", FieldLocation::node, 3);
  Scene scene = test::cube_scene(Projection::perspective, 90, 90);
  const RenderResult off = test::draw(mesh, scene);
  scene.render.splat_below = 4;
  const RenderResult on = test::draw(mesh, scene);
  EXPECT_EQ(on.statistics.splatted_cells, 0U);
  EXPECT_EQ(std::memcmp(on.image.values().data(), off.image.values().data(),
                        on.image.values().size_bytes()),
            0);
}

// Surfaces are never lost, and the slab cuts where it is.
TEST(Splatting, CellsThatAreCutAreMetByRays) {
  ZooMesh mesh = test::structured(6, Cut::tetrahedra);
  test::add_node_field(mesh, "f", [](const Position& p) { return p[0]; });
  Scene scene = whole_cube_scene(Projection::orthographic, 20);
  scene.camera.eye = {0.5, 0.5, 4};
  scene.render.splat_below = 1000;
  EXPECT_EQ(test::draw(mesh, scene).statistics.splatted_cells, 6U * 216);
  scene.camera.clip = {{3.3, 3.75}};  // down to 0.25: within the second layer of six
  EXPECT_EQ(test::draw(mesh, scene).statistics.splatted_cells, 6U * 36 * 2);
  scene.camera.clip.reset();
  scene.isosurfaces.push_back({.field = "f", .value = 0.55});
  EXPECT_EQ(test::draw(mesh, scene).statistics.splatted_cells, 6U * 36 * 5);
}

// A mesh refined towards the cube's middle, where most of its cells are far smaller than a pixel
// and differ from one another.
TEST(Splatting, ComesCloserToTheTruthWhereTheMeshIsRefined) {
  ZooMesh mesh = test::moved(test::structured(20, Cut::tetrahedra), [](const Position& p) {
    Position q;
    for (std::size_t a = 0; a < 3; ++a) q[a] = 0.5 + 4 * std::pow(p[a] - 0.5, 3);
    return q;
  });
  test::add_random_field(mesh, "f", FieldLocation::cell, 7);
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    Scene scene = whole_cube_scene(projection, 24);
    scene.volume.extinction->points = {{0.7, {0}}, {1, {8}}};
    const Image truth = filtered(mesh, scene, 24);
    const RenderResult sampled = test::draw(mesh, scene);
    for (const std::uint32_t below : {2U, 9U}) {
      scene.render.splat_below = below;
      const RenderResult splatted = test::draw(mesh, scene);
      EXPECT_GT(splatted.statistics.splatted_cells, 45000U);
      EXPECT_LE(root_mean_square_difference(splatted.image, truth),
                0.3 * root_mean_square_difference(sampled.image, truth));
    }
  }
}

// Cells of a cycle come by their depth: their opacity does not depend on it.
TEST(Splatting, GroupsMayHoldSplats) {
  ZooMesh mesh = test::random_delaunay(300, 6);
  test::add_node_field(mesh, "f", test::smooth_field);
  Scene scene = whole_cube_scene(Projection::perspective, 50);
  scene.render.splat_below = 4;
  const VisibilityOrder order = order_of_scene(mesh, scene);
  std::vector<CellId> cells(order.cells.begin(), order.cells.end());
  std::vector<CellGroup> groups;
  for (std::uint32_t first = 0; first + 40 < cells.size(); first += 55)
    groups.push_back({first, 40});
  for (const CellGroup& g : groups)
    std::reverse(cells.begin() + g.first, cells.begin() + g.first + g.count);
  const RenderResult expected = render(mesh, order, scene, false);
  const VisibilityOrder in_groups{std::move(cells), std::move(groups), "exact"};
  const RenderResult grouped = render(mesh, in_groups, scene, false);
  EXPECT_EQ(expected.statistics.violations, 0U);
  EXPECT_EQ(grouped.statistics.violations, 0U);
  EXPECT_GT(grouped.statistics.splatted_cells, 200U);
  for (std::size_t c = 0; c < 4; ++c)
    EXPECT_LE(largest_difference(grouped.image, expected.image, c), 1e-12);
}

// Cells without volume, and light without absorption.
TEST(Splatting, FlatCellsAddNothingAndLightNeedsNoExtinction) {
  ZooMesh mesh =
      test::make_mesh({{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}, {0.01, 0.01, 0}},
                      {{CellKind::tetrahedron4, {0, 1, 2, 3}},
                       {CellKind::tetrahedron4, {0, 1, 4, 2}},  // flat
                       {CellKind::tetrahedron4, {0, 0, 0, 0}},
                       {CellKind::pyramid5, {0, 1, 4, 2, 2}}});
  test::add_node_field(mesh, "f", [](const Position& p) { return 100 * p[0]; });
  Scene scene = test::cube_scene(Projection::orthographic, 20, 20);
  scene.camera.look_at = {0, 0, 0};
  scene.volume.glow = Glow::emission;
  scene.volume.extinction.reset();
  scene.volume.color->points = {{0, {0, 0, 0}}, {1, {80, 40, 0}}};
  scene.render.splat_below = 5;
  const VisibilityOrder order{std::vector<CellId>{0, 1, 2, 3}, {}, "any"};
  const RenderResult result = render(mesh, order, scene, false);
  EXPECT_EQ(result.statistics.splatted_cells, 4U);
  const double pixels = 20 / scene.camera.height;
  // a quarter of 80 at the centre of the one cell that has a volume
  EXPECT_NEAR(sum(result.image, 0), 20 * 1e-6 / 6 * pixels * pixels, 1e-15);
  EXPECT_NEAR(sum(result.image, 1), 10 * 1e-6 / 6 * pixels * pixels, 1e-15);
  EXPECT_EQ(sum(result.image, 2), 0);
  EXPECT_EQ(sum(result.image, 3), 0);
}

TEST(Splatting, ChannelsSayWhatIsKnownOfSplats) {
  ZooMesh mesh = test::make_mesh({{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}},
                                 {{CellKind::tetrahedron4, {0, 1, 2, 3}}});
  test::add_node_field(mesh, "f", [](const Position&) { return 0.5; });
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    Scene scene = test::cube_scene(projection, 21, 21);
    test::make_uniform(scene);
    scene.camera.eye = {0, 0, 3};
    scene.camera.look_at = {0, 0, 0};
    scene.camera.up = {0, 1, 0};
    scene.render.splat_below = 9;
    const VisibilityOrder order = order_of_scene(mesh, scene);
    const Image image = render(mesh, order, scene, false, nullptr,
                               parse_channels("depth,mean_depth,cells,transparency"))
                            .image;
    for (std::uint32_t y = 0; y < 21; ++y)
      for (std::uint32_t x = 0; x < 21; ++x) {
        const bool reached = image.at(x, y, 3) > 0;
        EXPECT_EQ(reached, x >= 9 && x <= 11 && y >= 9 && y <= 11);
        EXPECT_EQ(image.at(x, y, 6), reached ? 1 : 0);
        EXPECT_NEAR(1 - image.at(x, y, 7), image.at(x, y, 3), 1e-15);
        if (!reached) continue;
        EXPECT_NEAR(image.at(x, y, 4), 3 - 0.0025, 1e-12);
        EXPECT_NEAR(image.at(x, y, 5), 3 - 0.0025, 1e-12);
      }
    EXPECT_THROW((void)render(mesh, order, scene, false, nullptr, parse_channels("error")),
                 UsageError);
  }
}

TEST(Splatting, ThreadsDoNotChangeABit) {
  ZooMesh mesh = test::random_delaunay(300, 7);
  test::add_node_field(mesh, "f", test::smooth_field);
  Scene scene = whole_cube_scene(Projection::perspective, 140);
  scene.render.splat_below = 20;
  std::vector<Image> images;
  for (const unsigned threads : {1U, 2U, 7U}) {
    const ThreadLimit limit(threads);
    images.push_back(test::draw(mesh, scene).image);
    EXPECT_EQ(std::memcmp(images.front().values().data(), images.back().values().data(),
                          images.front().values().size_bytes()),
              0);
  }
}

}  // namespace
}  // namespace hiac
