#include "hiac/render/quadratic_kernel.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/parallel.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/render/quadratic_shading-inl.hpp"
#include "tests/render/general_meshes.hpp"
#include "tests/render/polyhedron_reference.hpp"

namespace hiac {
namespace {

using test::cube_scene;
using test::Cut;

// Random values: the field bends and overshoots in every cell.
ZooMesh bent_field(std::size_t n) {
  ZooMesh mesh = test::of_order(test::moved(test::structured(n, Cut::tetrahedra), test::tapered),
                                CellOrder::quadratic);
  test::add_random_field(mesh, "f", FieldLocation::node, 31);
  test::add_random_field(mesh, "corner", FieldLocation::corner, 32);
  test::add_random_field(mesh, "cell", FieldLocation::cell, 33);
  return mesh;
}

double largest_difference(const Image& a, const Image& b) {
  double largest = 0;
  for (std::uint32_t y = 0; y < a.height(); ++y)
    for (std::uint32_t x = 0; x < a.width(); ++x)
      for (std::size_t c = 0; c < 4; ++c)
        largest = std::max(largest, std::abs(a.at(x, y, c) - b.at(x, y, c)));
  return largest;
}

double error_of(const ZooMesh& mesh, const Scene& scene) {
  const RenderResult result = test::draw(mesh, scene);
  EXPECT_EQ(result.statistics.violations, 0U);
  double largest = 0;
  for (std::uint32_t y = 0; y < scene.image.height; ++y)
    for (std::uint32_t x = 0; x < scene.image.width; ++x) {
      const auto expected = test::polyhedron_reference(mesh, scene, x + 0.5, y + 0.5);
      for (std::size_t c = 0; c < 4; ++c)
        largest = std::max(largest, std::abs(expected[c] - result.image.at(x, y, c)));
    }
  return largest;
}

TEST(QuadraticKernel, AgreesWithBruteForce) {
  const ZooMesh mesh = bent_field(1);
  for (const Glow glow : {Glow::chromaticity, Glow::emission})
    for (const Projection projection : {Projection::orthographic, Projection::perspective})
      for (const double tolerance : {1e-9, 1e-13}) {
        Scene scene = cube_scene(projection, 8, 7);
        scene.volume.glow = glow;
        scene.render.tolerance = tolerance;
        EXPECT_LE(error_of(mesh, scene), tolerance == 1e-9 ? 1e-9 : 1e-12);
      }
}

// Asked for details of pixels, the engine takes the general route: every cell of another kind does.
TEST(QuadraticKernel, AgreesWithTheGeneralRoute) {
  const ZooMesh mesh = bent_field(3);
  const std::array channels{Channel::cells};
  for (const auto& [color, extinction] :
       {std::pair{"f", "f"}, {"corner", "f"}, {"cell", "corner"}, {"f", "cell"}})
    for (const Glow glow : {Glow::chromaticity, Glow::emission})
      for (const double opacity : {0.01, 1.0, 300.0}) {
        Scene scene = cube_scene(Projection::perspective, 50, 40);
        scene.volume.glow = glow;
        scene.volume.color->field = color;
        scene.volume.extinction->field = extinction;
        scene.camera.clip = {3.2, 4.4};
        for (auto& point : scene.volume.extinction->points) point.value[0] *= opacity;
        const VisibilityOrder order = test::sorted(mesh, scene);
        const RenderResult kernel = render(mesh, order, scene, false);
        const RenderResult general = render(mesh, order, scene, false, nullptr, channels);
        EXPECT_EQ(kernel.statistics.segments, general.statistics.segments);
        EXPECT_LE(largest_difference(kernel.image, general.image), 1e-12)
            << color << ' ' << extinction << ' ' << opacity;
      }
}

// Where a transfer function jumps, the places of jumps are as uncertain as rounding makes roots.
TEST(QuadraticKernel, StepsAgreeWithTheGeneralRoute) {
  const ZooMesh mesh = bent_field(2);
  const std::array channels{Channel::cells};
  Scene scene = cube_scene(Projection::orthographic, 50, 40);
  scene.volume.extinction->points = {{0.3, {0.5}}, {0.3, {2}}, {0.7, {1}}, {0.7, {5}}};
  const VisibilityOrder order = test::sorted(mesh, scene);
  EXPECT_LE(largest_difference(render(mesh, order, scene, false).image,
                               render(mesh, order, scene, false, nullptr, channels).image),
            1e-9);
}

TEST(QuadraticKernel, GroupsAndThreadsGiveTheSameImage) {
  const ZooMesh mesh = bent_field(2);
  const Scene scene = cube_scene(Projection::perspective, 90, 70);
  const RenderResult sorted = test::draw(mesh, scene);
  VisibilityOrder group;
  std::vector<CellId> cells(mesh.cell_count());
  std::iota(cells.rbegin(), cells.rend(), CellId{0});
  group.groups = std::vector<CellGroup>{{0, static_cast<std::uint32_t>(cells.size())}};
  group.cells = std::move(cells);
  const RenderResult grouped = render(mesh, group, scene, false);
  EXPECT_EQ(grouped.statistics.segments, sorted.statistics.segments);
  EXPECT_LE(largest_difference(grouped.image, sorted.image), 1e-12);
  const ThreadLimit limit(1);
  EXPECT_EQ(largest_difference(test::draw(mesh, scene).image, sorted.image), 0);
}

// The rule's number of nodes against the integral by very many.
TEST(QuadraticRules, MeetWhatIsAllowed) {
  namespace simd = HWY_NAMESPACE;
  const hwy::HWY_NAMESPACE::CappedTag<double, 1> d;
  const auto nodes_for = [&](double wanted, double a1, double a2, double a3) {
    EllipseChoice choice;
    const hwy::HWY_NAMESPACE::Vec<decltype(d)> alpha[3] = {Set(d, a1), Set(d, a2), Set(d, a3)};
    std::size_t nodes = 0;
    // the last of these has tried all ellipses
    for (std::size_t k = 0; k < 2 * BernsteinEllipses::kCount; ++k)
      nodes = simd::quadratic_nodes<1>(d, bernstein_ellipses(), Set(d, wanted), alpha, choice);
    return nodes;
  };
  const auto integral = [](std::size_t nodes, double a0, double a1, double a2, double a3,
                           int parts) {
    const SymmetricRule& rule = symmetric_rules()[nodes - 1];
    const auto at = [&](double z) { return z * std::exp(-(a0 + z * (a1 + z * (a2 + z * a3)))); };
    double sum = 0;
    for (int p = 0; p < parts; ++p) {
      const double middle = (2.0 * p + 1) / parts - 1;
      sum += rule.middle / parts * at(middle);
      for (std::size_t k = 0; k < rule.pairs; ++k)
        sum += rule.weight[k] / parts *
               (at(middle - rule.z[k] / parts) + at(middle + rule.z[k] / parts));
    }
    return sum;
  };
  std::size_t most = 0;
  for (const double a1 : {0.0, 0.01, 0.3, 2.0, 4.5})
    for (const double a2 : {-0.2, 0.0, 0.2})
      for (const double a3 : {0.0, 0.1}) {
        const double a0 = a1 - a2 + a3;  // A is 0 in front
        if (a0 < 0) continue;
        for (const double allowed : {1e-3, 1e-9, 1e-14}) {
          const std::size_t n = nodes_for(1 / allowed, a1, a2, a3);
          if (n == 0) continue;
          most = std::max(most, n);
          const double exact = integral(12, a0, a1, a2, a3, 40);
          EXPECT_LE(std::abs(integral(n, a0, a1, a2, a3, 1) - exact), allowed + 1e-16)
              << a1 << ' ' << a2 << ' ' << a3;
        }
      }
  EXPECT_GE(most, 8U);
  EXPECT_EQ(nodes_for(1e12, 500, 0, 0), 0U);
  EXPECT_EQ(nodes_for(std::numeric_limits<double>::infinity(), 0, 0, 0), 0U);
}

}  // namespace
}  // namespace hiac
