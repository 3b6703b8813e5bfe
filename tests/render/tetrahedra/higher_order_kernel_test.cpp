#include "hiac/render/tetrahedra/higher_order_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/parallel.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/render/integrate/higher_order_shading-inl.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/render/truth/polyhedron_reference.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac {
namespace {

using test::cube_scene;
using test::Cut;

// Random values: the field bends and overshoots in every cell.
void add_bent_fields(ZooMesh& mesh) {
  test::add_random_field(mesh, "f", FieldLocation::node, 31);
  test::add_random_field(mesh, "corner", FieldLocation::corner, 32);
  test::add_random_field(mesh, "cell", FieldLocation::cell, 33);
}

ZooMesh bent_field(std::size_t n, CellOrder order) {
  ZooMesh mesh =
      test::of_order(test::moved(test::structured(n, Cut::tetrahedra), test::tapered), order);
  add_bent_fields(mesh);
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

Image reference_of(const ZooMesh& mesh, const Scene& scene) {
  Image image(scene.image.width, scene.image.height, {"R", "G", "B", "A"});
  for (std::uint32_t y = 0; y < scene.image.height; ++y)
    for (std::uint32_t x = 0; x < scene.image.width; ++x) {
      const auto expected = test::polyhedron_reference(mesh, scene, x + 0.5, y + 0.5);
      std::ranges::copy(expected, image.pixel(x, y).begin());
    }
  return image;
}

double error_of(const ZooMesh& mesh, const Scene& scene) {
  const RenderResult result = test::draw(mesh, scene);
  EXPECT_EQ(result.statistics.violations, 0U);
  return largest_difference(result.image, reference_of(mesh, scene));
}

// How many cells a kernel has in a scene.
std::size_t drawn_by(CellKernel kernel, const ZooMesh& mesh, const Scene& scene) {
  const Projector projector(scene.camera, scene.image);
  const Frame frame(mesh, scene, projector);
  return static_cast<std::size_t>(std::ranges::count(frame.kernel_cells, kernel));
}

class HigherOrderKernel : public testing::TestWithParam<CellOrder> {
 protected:
  [[nodiscard]] static bool is_cubic() { return GetParam() == CellOrder::cubic; }
  [[nodiscard]] static CellKernel kernel() {
    return is_cubic() ? CellKernel::cubic : CellKernel::quadratic;
  }
};

TEST_P(HigherOrderKernel, DrawsCellsWithStraightEdges) {
  const Scene scene = cube_scene(Projection::perspective, 8, 7);
  ZooMesh straight = bent_field(2, GetParam());
  EXPECT_EQ(drawn_by(kernel(), straight, scene), straight.cell_count());
  ZooMesh curved = test::of_order(test::structured(2, Cut::tetrahedra), GetParam());
  curved = test::moved(curved, [](const auto& p) { return test::rippled(p, 0.02); });
  add_bent_fields(curved);
  EXPECT_EQ(drawn_by(CellKernel::none_curved, curved, scene), curved.cell_count());
}

TEST_P(HigherOrderKernel, AgreesWithBruteForce) {
  const ZooMesh mesh = bent_field(1, GetParam());
  for (const Glow glow : {Glow::chromaticity, Glow::emission})
    for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
      Scene scene = cube_scene(projection, 8, is_cubic() ? 4 : 7);
      scene.volume.glow = glow;
      const Image expected = reference_of(mesh, scene);
      for (const double tolerance : {1e-9, 1e-13}) {
        scene.render.tolerance = tolerance;
        const RenderResult result = test::draw(mesh, scene);
        EXPECT_EQ(result.statistics.violations, 0U);
        EXPECT_LE(largest_difference(result.image, expected), tolerance == 1e-9 ? 1e-9 : 1e-12);
      }
    }
}

// Fields of two kinds, thin to opaque.
TEST_P(HigherOrderKernel, TwoFieldsAgreeWithBruteForce) {
  const ZooMesh mesh = bent_field(1, GetParam());
  std::size_t n = 0;
  for (const auto& [color, extinction] :
       {std::pair{"corner", "f"}, {"f", "corner"}, {"cell", "f"}, {"f", "cell"}}) {
    const bool odd = ++n % 2 == 0;
    Scene scene = cube_scene(odd ? Projection::perspective : Projection::orthographic, 4, 3);
    scene.volume.glow = n < 3 ? Glow::emission : Glow::chromaticity;
    scene.volume.color->field = color;
    scene.volume.extinction->field = extinction;
    for (auto& point : scene.volume.extinction->points) point.value[0] *= odd ? 30 : 0.1;
    EXPECT_LE(error_of(mesh, scene), 1e-12) << color << ' ' << extinction;
  }
}

TEST_P(HigherOrderKernel, EveryInstructionSetAgreesWithBruteForce) {
  const ZooMesh mesh = bent_field(1, GetParam());
  for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
    Scene scene = cube_scene(Projection::perspective, 9, test::tried(7));
    scene.volume.glow = glow;
    const Image expected = reference_of(mesh, scene);
    test::for_each_instruction_set([&](const std::string& name) {
      EXPECT_LE(largest_difference(test::draw(mesh, scene).image, expected), 1e-12) << name;
    });
  }
}

// The eye inside the mesh: cells around it and behind it.
TEST_P(HigherOrderKernel, EyeInsideAgreesWithBruteForce) {
  const ZooMesh mesh = bent_field(3, GetParam());
  Scene scene = cube_scene(Projection::perspective, 4, test::tried(3));
  const test::Position eye = test::tapered({0.21, 0.22, 0.27});
  const test::Position look_at = test::tapered({0.7, 0.6, 0.5});
  scene.camera.eye = {eye[0], eye[1], eye[2]};
  scene.camera.look_at = {look_at[0], look_at[1], look_at[2]};
  scene.camera.fov = 100;
  EXPECT_GT(drawn_by(kernel(), mesh, scene), mesh.cell_count() / 4);
  EXPECT_LE(error_of(mesh, scene), 1e-12);
}

// Rays in faces and along edges, and through nodes: what is seen beside them, where the fields,
// which are continuous, are nearly the same. (Brute force takes faces to belong to both cells.)
TEST_P(HigherOrderKernel, GrazingRaysAgreeWithBruteForce) {
  ZooMesh mesh = test::of_order(test::structured(2, Cut::tetrahedra), GetParam());
  add_bent_fields(mesh);
  Scene scene = cube_scene(Projection::orthographic, 5, 5);
  scene.camera.look_at = {0.5, 0.5, 0.5};
  scene.camera.up = {0, 0, 1};
  scene.camera.height = 1.25;  // pixels' centres at multiples of 1/4
  constexpr double kBeside = 1e-8;
  for (const test::Position& eye : {test::Position{4.5, 0.5, 0.5}, {4.5, 4.5, 0.5}}) {
    scene.camera.eye = {eye[0], eye[1], eye[2]};
    const RenderResult result = test::draw(mesh, scene);
    EXPECT_EQ(result.statistics.violations, 0U);
    for (std::uint32_t y = 1; y <= test::tried(3); ++y)
      for (std::uint32_t x = 1; x < 4; ++x) {
        const auto expected =
            test::polyhedron_reference(mesh, scene, x + 0.5 + kBeside, y + 0.5 + 0.37 * kBeside);
        for (std::size_t c = 0; c < 4; ++c)
          EXPECT_NEAR(result.image.at(x, y, c), expected[c], 10 * kBeside) << x << ' ' << y;
      }
  }
}

// Faces are seen nearly edge-on.
TEST_P(HigherOrderKernel, FlatCellsAgreeWithBruteForce) {
  ZooMesh mesh = test::of_order(test::moved(test::structured(1, Cut::tetrahedra),
                                            [](const auto& p) {
                                              return test::sheared({p[0], p[1], 3e-4 * p[2]});
                                            }),
                                GetParam());
  add_bent_fields(mesh);
  Scene scene = cube_scene(Projection::perspective, 6, 4);
  for (auto& point : scene.volume.extinction->points) point.value[0] *= 1e3;
  EXPECT_GT(drawn_by(kernel(), mesh, scene), 0U);
  EXPECT_LE(error_of(mesh, scene), 1e-9);
}

// Asked for details of pixels, the engine takes the general route: every cell of another kind does.
TEST_P(HigherOrderKernel, AgreesWithTheGeneralRoute) {
  const ZooMesh mesh = bent_field(3, GetParam());
  const std::array channels{Channel::cells};
  for (const auto& [color, extinction] :
       {std::pair{"f", "f"}, {"corner", "f"}, {"cell", "corner"}, {"f", "cell"}})
    for (const Glow glow : {Glow::chromaticity, Glow::emission})
      for (const double opacity : {0.01, 1.0, 300.0}) {
        Scene scene = cube_scene(Projection::perspective, 50, test::tried(40));
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
TEST_P(HigherOrderKernel, StepsAgreeWithTheGeneralRoute) {
  const ZooMesh mesh = bent_field(2, GetParam());
  const std::array channels{Channel::cells};
  Scene scene = cube_scene(Projection::orthographic, 50, 40);
  scene.volume.extinction->points = {{0.3, {0.5}}, {0.3, {2}}, {0.7, {1}}, {0.7, {5}}};
  const VisibilityOrder order = test::sorted(mesh, scene);
  EXPECT_LE(largest_difference(render(mesh, order, scene, false).image,
                               render(mesh, order, scene, false, nullptr, channels).image),
            1e-9);
}

// Rays that end in what is all but solid, in one vector with rays beside it: these must not be
// followed in as short pieces as those (which would take hours). Where the jump is, is as uncertain
// as rounding makes roots.
TEST_P(HigherOrderKernel, DenseAndThinNeighboursAgreeWithTheGeneralRoute) {
  const ZooMesh mesh = bent_field(2, GetParam());
  const std::array channels{Channel::cells};
  for (const Glow glow : {Glow::chromaticity, Glow::emission})
    for (const double extinction : {1e3, 1e6, 1e10}) {
      Scene scene = cube_scene(Projection::perspective, 50, 40);
      scene.volume.glow = glow;
      scene.render.tolerance = 1e-9;
      scene.volume.extinction->points = {
          {0, {0.01}}, {0.5, {0.01}}, {0.5, {extinction}}, {1, {extinction}}};
      const VisibilityOrder order = test::sorted(mesh, scene);
      EXPECT_LE(largest_difference(render(mesh, order, scene, false).image,
                                   render(mesh, order, scene, false, nullptr, channels).image),
                std::max(1e-9, 1e-16 * extinction))
          << extinction;
    }
}

TEST_P(HigherOrderKernel, GroupsAndThreadsGiveTheSameImage) {
  const ZooMesh mesh = bent_field(2, GetParam());
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

INSTANTIATE_TEST_SUITE_P(Orders, HigherOrderKernel,
                         testing::Values(CellOrder::quadratic, CellOrder::cubic),
                         [](const auto& instance) {
                           return instance.param == CellOrder::cubic ? "Cubic" : "Quadratic";
                         });

// Tetrahedra of all three orders in turn, where a linear field is the same in all of them: rays
// leave each where they enter the next, whatever their orders.
TEST(HigherOrderKernels, NeighboursOfOtherOrdersMeet) {
  const ZooMesh linear = test::moved(test::structured(3, Cut::tetrahedra), test::tapered);
  const std::array<ZooMesh, 3> orders{linear, test::of_order(linear, CellOrder::quadratic),
                                      test::of_order(linear, CellOrder::cubic)};
  std::vector<test::Position> positions;
  std::vector<test::Cell> cells;
  for (NodeId node = 0; node < linear.node_count(); ++node) {
    const auto p = linear.position(node);
    positions.push_back({p[0], p[1], p[2]});
  }
  for (CellId cell = 0; cell < linear.cell_count(); ++cell) {
    const ZooMesh& from = orders[cell % 3];
    test::Cell& mixed = cells.emplace_back(test::Cell{from.kinds[cell], {}});
    for (const NodeId node : from.cell_nodes(cell)) {
      if (node < linear.node_count()) {
        mixed.nodes.push_back(node);
        continue;
      }
      const auto p = from.position(node);
      mixed.nodes.push_back(static_cast<NodeId>(positions.size()));
      positions.push_back({p[0], p[1], p[2]});
    }
  }
  ZooMesh mesh = test::make_mesh(positions, cells), same = linear;
  const auto field = [](const test::Position& p) { return 0.5 + 0.4 * p[0] - 0.3 * p[1]; };
  test::add_node_field(mesh, "f", field);
  test::add_node_field(same, "f", field);
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    const Scene scene = cube_scene(projection, 90, 70);
    const RenderResult mixed = test::draw(mesh, scene), expected = test::draw(same, scene);
    EXPECT_EQ(mixed.statistics.violations, 0U);
    EXPECT_EQ(mixed.statistics.segments, expected.statistics.segments);
    EXPECT_LE(largest_difference(mixed.image, expected.image), 1e-12);
  }
}

struct RandomScene {
  ZooMesh mesh;
  Scene scene;
};

// Flat and far from the origin, bends and jumps, thin to opaque, one field or two.
RandomScene random_scene(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto chance = [&](double p) { return unit(random) < p; };
  ZooMesh mesh = test::random_delaunay(8 + random() % 20, random());
  const double flat = chance(0.3) ? std::pow(10, -4 * unit(random)) : 1;
  const double off = chance(0.2) ? 1e3 : 0;
  mesh = test::moved(mesh, [&](const test::Position& p) {
    return test::Position{p[0] + off, p[1], p[2] * flat};
  });
  mesh = test::of_order(mesh, seed % 4 == 0 ? CellOrder::quadratic : CellOrder::cubic);
  test::add_random_field(mesh, "f", FieldLocation::node, random());
  test::add_random_field(mesh, "g", chance(0.5) ? FieldLocation::node : FieldLocation::corner,
                         random());
  Scene scene =
      cube_scene(chance(0.5) ? Projection::perspective : Projection::orthographic, 30, 25);
  scene.camera.eye[0] += off;
  scene.camera.look_at[0] += off;
  scene.render.tolerance = chance(0.5) ? 1e-9 : 1e-13;
  if (chance(0.5)) scene.volume.glow = Glow::emission;
  if (chance(0.4)) scene.volume.color->field = std::string("g");
  if (chance(0.3))
    scene.volume.extinction->points = {{0.3, {0.5}}, {0.3, {2}}, {0.7, {1}}, {0.7, {5}}};
  const double opacity = std::pow(10, 5 * unit(random) - 2);
  for (auto& point : scene.volume.extinction->points) point.value[0] *= opacity;
  if (chance(0.3)) scene.camera.clip = {3.2, 4.4};
  return {std::move(mesh), std::move(scene)};
}

// Each of the pictures without and with the bounds of errors is as near to the truth as these say.
TEST(HigherOrderKernels, PicturesWithoutChannelsKeepToTheErrorsClaimedWithThem) {
  const std::array channels{Channel::error};
  for (std::uint64_t seed = 0; seed < test::tried(8); ++seed) {
    const auto [mesh, scene] = random_scene(seed);
    const VisibilityOrder order = test::sorted(mesh, scene);
    const Image plain = render(mesh, order, scene, false).image;
    const Image bounded = render(mesh, order, scene, false, nullptr, channels).image;
    for (std::uint32_t y = 0; y < scene.image.height; ++y)
      for (std::uint32_t x = 0; x < scene.image.width; ++x)
        for (std::size_t c = 0; c < 4; ++c)
          EXPECT_LE(std::abs(plain.at(x, y, c) - bounded.at(x, y, c)), 2 * bounded.at(x, y, 4))
              << seed << ": " << x << ' ' << y;
  }
}

// Cubics made of their roots, single and double ones, inside and outside of the segment.
TEST(SegmentCuts, AreTheRootsOfCubics) {
  namespace simd = HWY_NAMESPACE;
  const hwy::HWY_NAMESPACE::CappedTag<double, 1> d;
  using V = hwy::HWY_NAMESPACE::Vec<decltype(d)>;
  const V one = Set(d, 1.0);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-1.4, 1.4);
  simd::SegmentCuts<3> cuts;
  for (std::size_t n = 0; n < test::tried(20'000); ++n) {
    std::array<double, 3> roots{place(random), place(random), place(random)};
    if (n % 5 == 0) roots[1] = roots[0];
    std::ranges::sort(roots);
    const double factor = n % 2 == 0 ? 3 : -0.7, base = 0.25, value = n % 3 == 0 ? 0.25 : 1;
    const auto f = [&](double z) {
      return factor * (z - roots[0]) * (z - roots[1]) * (z - roots[2]) + value - base;
    };
    const double c3 = factor, c2 = -factor * (roots[0] + roots[1] + roots[2]);
    // slopes at the ends make the inner Bernstein coefficients
    const double rise = 2.0 / 3, sum = c2 / factor,
                 pairs = roots[0] * roots[1] + roots[0] * roots[2] + roots[1] * roots[2];
    const auto slope = [&](double z) { return factor * (3 * z * z + 2 * sum * z + pairs); };
    const simd::BernsteinScalar<V, 3> bernstein{{Set(d, f(-1)), Set(d, f(-1) + rise * slope(-1)),
                                                 Set(d, f(1) - rise * slope(1)), Set(d, f(1))}};
    const auto powers = simd::powers_of(d, bernstein);
    EXPECT_NEAR(GetLane(powers.c[3]), c3, 1e-14);
    EXPECT_NEAR(GetLane(powers.c[2]), c2, 1e-13);
    cuts.clear();
    const IntervalRange here =
        cuts.add(d, bernstein, powers, {-1e3, value, 1e3}, base, {0, 3}, Eq(one, one));
    EXPECT_GE(here.low, 1U);
    EXPECT_LE(here.high, 2U);
    std::vector<double> found;
    for (V z = Set(d, -1.0);;) {
      z = cuts.next(d, z, one);
      if (!(GetLane(z) < 1)) break;
      found.push_back(GetLane(z));
    }
    for (const double z : found) EXPECT_LE(std::abs(f(z) - (value - base)), 1e-13);
    // each root at which the field passes the value is among them
    for (const double root : roots) {
      const double steepness = std::abs(slope(root));
      if (steepness < 1e-6 || std::abs(root) > 1 - 1e-12) continue;
      EXPECT_TRUE(std::ranges::any_of(
          found, [&](double z) { return std::abs(z - root) <= 5e-14 / steepness; }))
          << roots[0] << ' ' << roots[1] << ' ' << roots[2];
    }
  }
}

// Against the C library in extended precision.
TEST(Transparency, IsExactToTheLastPlaces) {
  namespace simd = HWY_NAMESPACE;
  const hwy::HWY_NAMESPACE::CappedTag<double, 1> d;
  const auto at = [&](double a, double most) {
    return GetLane(simd::transparency(d, Set(d, a), simd::Thickness(most)));
  };
  constexpr double kDeep = 700;
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  for (std::size_t n = 0; n < test::tried(40'000); ++n) {
    const double part = unit(random);
    const auto relative = [&](double a, double most) {
      const long double exact = std::exp(-static_cast<long double>(a));
      return static_cast<double>(std::abs(at(a, most) - exact) / exact);
    };
    const double a = part * (n % 3 == 0 ? 700 : n % 3 == 1 ? 5 : 1e-3);
    EXPECT_LE(relative(a, kDeep), 2 * std::numeric_limits<double>::epsilon()) << a;
    // squared as often as is allowed, the error of the polynomial up to 0.5 doubles each time
    double bound = 4e-15;
    EXPECT_LE(relative(0.08 * part, 0.08), bound) << part;
    for (double most = 0.5; most <= 4; most += most, bound += bound)
      EXPECT_LE(relative(most * part, most), bound) << most << ' ' << part;
  }
  for (const double most : {0.08, 0.5, 1.0, 2.0, 4.0, kDeep}) EXPECT_EQ(at(0, most), 1) << most;
  EXPECT_GT(at(-1e-17, kDeep), 1 - 1e-15);
  EXPECT_EQ(at(1, std::numeric_limits<double>::quiet_NaN()), at(1, kDeep));
  for (const double a : {700.0, 1e10, 1e300, std::numeric_limits<double>::infinity()})
    EXPECT_LE(std::abs(at(a, a)), 1e-304) << a;
}

// The rule's number of nodes against the integral by very many.
TEST(HigherOrderRules, MeetWhatIsAllowed) {
  namespace simd = HWY_NAMESPACE;
  const hwy::HWY_NAMESPACE::CappedTag<double, 1> d;
  using V = hwy::HWY_NAMESPACE::Vec<decltype(d)>;
  const auto nodes_for = [&](double wanted, double a1, double a2, double a3) {
    EllipseChoice choice;
    const V zero = Zero(d), one = Set(d, 1.0);
    const V alpha[] = {zero, Set(d, a1), Set(d, a2), Set(d, a3)};
    const simd::FactorBound<V, 1> factor{{zero, one}, Set(d, wanted), zero};
    std::size_t nodes = 0;
    // the last of these has tried all ellipses
    for (std::size_t k = 0; k < 2 * BernsteinEllipses::kCount; ++k)
      nodes =
          simd::nodes_needed<3, 1>(d, bernstein_ellipses(), alpha, factor, Eq(one, one), choice);
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
