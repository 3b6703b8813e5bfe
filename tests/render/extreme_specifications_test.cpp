#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/frame/renderable.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/scene/specification.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/reference.hpp"

namespace hiac {
namespace {

using test::Cut;

constexpr double kLargest = std::numeric_limits<double>::max();

// Every pixel is a finite colour, not negative but for rounding, and its alpha is one.
void expect_sound(const Image& image, const std::string& name) {
  const std::size_t channels = image.channel_count();
  for (std::size_t i = 0; i < image.values().size(); ++i) {
    const double value = image.values()[i];
    const std::size_t c = i % channels;
    ASSERT_FALSE(std::isnan(value)) << image.channels()[c] << " of " << i / channels << '\n'
                                    << name;
    if (c > 3) continue;
    ASSERT_TRUE(std::isfinite(value)) << image.channels()[c] << '\n' << name;
    ASSERT_LE(std::abs(value), 4 * kLargestColor) << name;
    if (c != 3) continue;
    ASSERT_GE(value, -1e-12) << name;
    ASSERT_LE(value, 1 + 1e-12) << name;
  }
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }
  double unit() { return std::ldexp(static_cast<double>(engine_() >> 11), -53); }

  // Of any magnitude up to `most`, as often an ordinary one.
  double size(double most) {
    static constexpr std::array kSizes{0.0,   5e-324, 1e-310, 1e-200, 1e-99,   1e-30,
                                       1e-16, 1e-9,   1e9,    1e16,   1e29,    1e60,
                                       1e99,  1e200,  1e293,  1e308,  kLargest};
    if (below(2) == 0) return unit();
    double found = kSizes[below(kSizes.size())];
    while (found > most) found = kSizes[below(kSizes.size())];
    return found;
  }

  // Not decreasing; some an ulp or a few apart, around 0 or far from it.
  std::vector<double> scalars() {
    std::vector<double> result(1 + below(5));
    const double scale = below(3) == 0 ? size(1e99) : 1;
    for (double& s : result) s = scale * (unit() - (below(2) == 0 ? 0.0 : 0.5));
    for (std::size_t k = 1; k < result.size(); ++k)
      if (below(2) == 0) result[k] = std::nextafter(result[k - 1], kLargest);
    std::ranges::sort(result);
    return result;
  }

 private:
  std::mt19937_64 engine_;
};

Scene extreme_scene(Random& random) {
  const auto projection = random.below(2) == 0 ? Projection::perspective : Projection::orthographic;
  Scene scene = test::cube_scene(projection, 9, 8);
  scene.render.tolerance = std::pow(10.0, -static_cast<double>(random.below(20)));
  scene.volume.glow = random.below(2) == 0 ? Glow::chromaticity : Glow::emission;
  scene.volume.color->field = random.below(2) == 0 ? "f" : "g";
  scene.volume.color->points.clear();
  for (const double s : random.scalars())
    scene.volume.color->points.push_back(
        {s, {random.size(1e29), random.size(1e29), random.size(1)}});
  scene.volume.extinction->points.clear();
  for (const double s : random.scalars())
    scene.volume.extinction->points.push_back({s, {random.size(kLargest)}});
  for (std::size_t k = random.below(3); k > 0; --k) {
    Isosurface surface;
    surface.field = "f";
    surface.value = random.unit();
    surface.color = {random.size(1e29), random.unit(), 1};
    surface.opacity = random.unit();
    surface.ambient = random.unit();
    surface.diffuse = random.below(2) == 0 ? 1 : random.size(1e29);
    surface.specular = random.size(1e29);
    surface.shininess = random.size(1e99);
    scene.isosurfaces.push_back(surface);
  }
  if (random.below(4) == 0)
    scene.lights = {Light{{{random.size(1e99), random.size(1e99), 1}}, {random.size(1e29), 1, 1}}};
  if (random.below(4) == 0) {
    scene.background.pattern = BackgroundPattern::gradient;
    scene.background.color = {random.size(1e29), 0, 1};
    scene.background.color2 = {random.size(1e29), 1, 0};
  }
  return scene;
}

void add_fields(ZooMesh& mesh, Random& random) {
  const double scale = random.below(3) == 0 ? random.size(1e99) : 1;
  for (const char* name : {"f", "g"}) {
    std::vector<double> values(mesh.node_count());
    for (double& v : values) v = random.below(4) == 0 ? 0.5 : scale * (random.unit() - 0.2);
    mesh.fields.push_back({name, "", FieldLocation::node, 1, std::move(values)});
  }
}

ZooMesh mesh_of(std::size_t which) {
  const auto twisted = [](const test::Position& p) { return test::rippled(p, 0.03); };
  switch (which) {
    case 0:
      return test::structured(2, Cut::tetrahedra);
    case 1:
      return test::moved(test::mixed_columns(1), test::tapered);
    case 2:
      return test::of_order(test::structured(1, Cut::tetrahedra), CellOrder::quadratic);
    case 3:
      return test::of_order(test::structured(1, Cut::tetrahedra), CellOrder::cubic);
    case 4:
      return test::moved(test::structured(1, Cut::prisms), test::sheared);
    case 5:
      return test::moved(test::two_wedges(), test::tapered);
    case 6:
      return test::of_order(test::structured(1, Cut::bricks), CellOrder::quadratic);
    default:
      return test::moved(test::of_order(test::structured(1, Cut::bricks), CellOrder::quadratic),
                         twisted);
  }
}

class ExtremeSpecifications : public testing::TestWithParam<std::size_t> {};

// Every one is drawn or refused.
TEST_P(ExtremeSpecifications, MakeNumbersOrAreRefused) {
  Random random(GetParam() + 1);
  std::size_t drawn = 0;
  for (int trial = 0; trial < 150; ++trial) {
    ZooMesh mesh = mesh_of(GetParam());
    add_fields(mesh, random);
    const Scene wanted = extreme_scene(random);
    const std::string text = to_toml(wanted);
    Scene scene;
    try {
      scene = parse_scene(text, "view.toml").scene;
      check_renderable(mesh, scene);
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("key `"), std::string::npos) << error.what();
      continue;
    }
    ++drawn;
    SCOPED_TRACE(text);
    const VisibilityOrder order = test::sorted(mesh, scene);
    expect_sound(render(mesh, order, scene, true).image, text);
    if (testing::Test::HasFatalFailure()) return;
    if (trial % 3 != 0) continue;
    const std::array channels{Channel::error, Channel::depth};
    const Image image = render(mesh, order, scene, true, nullptr, channels).image;
    expect_sound(image, text);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(drawn, 90U);
}

INSTANTIATE_TEST_SUITE_P(AllKinds, ExtremeSpecifications, testing::Range<std::size_t>(0, 8));

// Extinctions that run up to the largest numbers draw as opaque walls: a ramp that a ray passes at
// its foot, and a step within one unit in the last place.
TEST(ExtremeSpecification, RampsToTheLargestNumbersAreOpaque) {
  using Points = std::vector<PiecewiseLinear<1>::Point>;
  const double above = std::nextafter(0.5, 1.0);
  const Points step{{0, {0}}, {0.5, {0}}, {above, {1e293}}, {1, {1e293}}};
  const Points tent{{0, {0}}, {0.25, {1e308}}, {1, {0}}};
  for (const auto& [points, foot] : {std::pair{step, 0.5}, {tent, 0.0}})
    for (std::size_t which = 0; which < 8; ++which)
      for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        ZooMesh mesh = mesh_of(which);
        test::add_node_field(mesh, "f", [](const test::Position& p) { return p[0]; });
        Scene scene = test::cube_scene(projection, 24, 20);
        scene.volume.color->points = {{0, {0.2, 0.4, 0.6}}, {1, {0.4, 0.6, 0.8}}};
        scene.volume.extinction->points = points;
        check_renderable(mesh, scene);
        const Image image = test::draw(mesh, scene).image;
        expect_sound(image, "");
        std::size_t opaque = 0;
        for (std::uint32_t y = 0; y < 20; ++y)
          for (std::uint32_t x = 0; x < 24; ++x) {
            const double alpha = image.at(x, y, 3);
            ASSERT_TRUE(alpha == 0 || alpha > 1 - 1e-9)
                << which << ' ' << x << ' ' << y << ' ' << alpha;
            if (alpha == 0) continue;
            ++opaque;
            // the light is of one place of the ramp, where the field is not below its foot
            const double s = (image.at(x, y, 0) - 0.2) / 0.2;
            ASSERT_GE(s, foot - 1e-9) << which << ' ' << x << ' ' << y;
            ASSERT_NEAR(image.at(x, y, 1), 0.4 + 0.2 * s, 1e-9);
          }
        EXPECT_GT(opaque, 20U) << which;
      }
}

// The eye looks against the field, so that rays enter opaque walls where they enter the cube: cells
// of all orders show the colour there, and nothing of what lies behind.
TEST(ExtremeSpecification, OpaqueTetrahedraOfAllOrdersShowTheirNearSide) {
  using Points = std::vector<PiecewiseLinear<1>::Point>;
  const double above = std::nextafter(0.5, 1.0);
  const Points step{{0, {0}}, {0.5, {0}}, {above, {kLargest}}, {1, {kLargest}}};
  const Points tent{{0, {0}}, {0.25, {kLargest}}, {1, {0}}};
  const auto drawn = [](std::size_t which, const Points& points, bool two_fields) {
    ZooMesh mesh = mesh_of(which);
    for (const char* name : {"f", "g"})
      test::add_node_field(mesh, name, [](const test::Position& p) { return p[0]; });
    Scene scene = test::cube_scene(Projection::orthographic, 24, 20);
    scene.volume.color->field = two_fields ? "g" : "f";
    scene.volume.color->points = {{0, {0.2, 0.4, 0.6}}, {1, {0.4, 0.6, 0.8}}};
    scene.volume.extinction->points = points;
    return test::draw(mesh, scene).image;
  };
  for (const Points& points : {step, tent})
    for (const bool two_fields : {false, true}) {
      const Image linear = drawn(0, points, two_fields);
      for (const std::size_t which : {2U, 3U}) {
        const Image image = drawn(which, points, two_fields);
        for (std::size_t i = 0; i < image.values().size(); ++i)
          ASSERT_NEAR(image.values()[i], linear.values()[i], 1e-9) << which << ' ' << i / 4;
      }
    }
}

}  // namespace
}  // namespace hiac
