// The error bound of pixels that show a skin: against brute force, and where rounding decides what
// is seen.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/render/engine.hpp"
#include "hiac/render/explain_pixel.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/render/truth/skin_truth.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/sorting.hpp"

namespace hiac {
namespace {

using test::Cut;

constexpr std::uint32_t kWidth = 20, kHeight = 16;

// The looks that a seed counts through: thin, thick and opaque; with and without a medium; one
// colour, and colours by fields, with steps; a headlight, lights from the side, highlights.
Scene skin_scene(std::uint64_t seed) {
  Scene scene = test::cube_scene(seed % 2 == 0 ? Projection::perspective : Projection::orthographic,
                                 kWidth, kHeight);
  test::make_uniform(scene);
  if (seed % 5 == 4) scene.volume = {};
  Skin& skin = scene.skin.emplace();
  skin.color = {0.3, 0.8, 0.6};
  skin.opacity = std::array{0.4, 1.0, 0.05}[seed / 2 % 3];
  skin.shininess = seed % 7 == 0 ? 0.5 : 20;
  scene.lights = {Light{}, Light{{{-1, 2, 0.5}}, {0.7, 0.6, 0.5}}};
  static constexpr std::array kFields{"", "node", "cell", "corner"};
  if (const char* field = kFields[seed / 3 % 4]; *field != 0) {
    skin.color_by = ColorTransfer{
        field, {{0.1, {0.1, 0.2, 0.9}}, {0.5, {0.2, 0.9, 0.3}}, {0.8, {0.9, 0, 0.1}}}};
    if (seed % 2 == 1) skin.color_by->points.push_back({0.8, {1, 1, 1}});
  }
  return scene;
}

void add_fields(ZooMesh& mesh, std::uint64_t seed) {
  test::add_random_field(mesh, "node", FieldLocation::node, seed);
  test::add_random_field(mesh, "cell", FieldLocation::cell, seed + 1);
  test::add_random_field(mesh, "corner", FieldLocation::corner, seed + 2);
  test::add_random_field(mesh, "f", FieldLocation::node, seed + 3);  // of the even medium
}

Image with_errors(const ZooMesh& mesh, const Scene& scene) {
  const std::vector<Channel> channels{Channel::error};
  return render(mesh, test::sorted(mesh, scene), scene, false, nullptr, channels).image;
}

// What pictures come to: errors and claims of all pixels in which something is seen.
struct ClaimComparison {
  std::vector<double> claims, ratios;  // claim by error, where there is an error
  double largest_share = 0;            // of a claim that the error is
  double largest_error = 0;
  std::size_t unknown = 0;  // claims of order 1

  void add(const ZooMesh& mesh, const Scene& scene, const std::string& name) {
    const Image image = with_errors(mesh, scene);
    const Image alone = render(mesh, test::sorted(mesh, scene), scene, false).image;
    const test::SkinTruth truth(mesh, scene);
    for (std::uint32_t y = 0; y < scene.image.height; ++y)
      for (std::uint32_t x = 0; x < scene.image.width; ++x) {
        const auto expected = truth.pixel(x, y);
        const double claim = image.at(x, y, 4);
        ASSERT_TRUE(claim >= 0) << name << ' ' << x << ' ' << y;
        for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(image.at(x, y, c), alone.at(x, y, c));
        if (std::isnan(expected[0]) || (expected[3] == 0 && image.at(x, y, 3) == 0)) continue;
        double error = 0;
        for (std::size_t c = 0; c < 4; ++c)
          error = std::max(error, static_cast<double>(std::abs(expected[c] - image.at(x, y, c))));
        EXPECT_LE(error, claim) << name << ' ' << x << ' ' << y;
        claims.push_back(claim);
        if (claim > 0.1) ++unknown;
        if (error > 1e-17) ratios.push_back(claim / error);
        largest_share = std::max(largest_share, error / claim);
        if (claim < 1e-2) largest_error = std::max(largest_error, error);
      }
  }

  [[nodiscard]] static double part(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  }
  void record(const std::string& name) const {
    testing::Test::RecordProperty(name + "_pixels", std::to_string(claims.size()));
    for (const auto& [what, values] : {std::pair{"claim", &claims}, std::pair{"ratio", &ratios}})
      for (const double share : {0.5, 0.99, 1.0})
        testing::Test::RecordProperty(name + "_" + what + "_" + std::to_string(share),
                                      std::to_string(std::log10(part(*values, share))));
  }
};

std::array<double, 3> bent(const std::array<double, 3>& p) {
  return {p[0] + 0.15 * p[1] * p[2], p[1] + 0.1 * p[0] * p[2], p[2] - 0.12 * p[0] * p[1]};
}

std::vector<std::pair<std::string, ZooMesh>> linear_meshes() {
  return {{"random tetrahedra", test::random_delaunay(40, 3)},
          {"tetrahedra", test::moved(test::structured(2, Cut::tetrahedra), test::sheared)},
          {"bricks", test::moved(test::structured(2, Cut::bricks), test::sheared)},
          {"prisms", test::moved(test::structured(2, Cut::prisms), test::sheared)},
          {"pyramids", test::moved(test::structured(1, Cut::pyramids), test::sheared)},
          {"wedges", test::moved(test::two_wedges(), test::sheared)},
          {"twisted bricks", test::moved(test::structured(2, Cut::bricks), bent)}};
}

TEST(SkinErrors, AreNeverBelowTheTrueErrorOfLinearCells) {
  ClaimComparison all;
  for (std::uint64_t seed = 1; seed <= test::tried(24); ++seed)
    for (auto [name, mesh] : linear_meshes()) {
      add_fields(mesh, seed);
      all.add(mesh, skin_scene(seed), name + " " + std::to_string(seed));
    }
  all.record("linear");
  EXPECT_GT(all.claims.size(), test::tried(15000));
  EXPECT_GT(all.largest_share, 1e-3);
  EXPECT_LT(ClaimComparison::part(all.claims, 0.99), 1e-9);
  EXPECT_LE(all.unknown, all.claims.size() / 2000);
}

TEST(SkinErrors, AreNeverBelowTheTrueErrorOfCurvedCells) {
  ClaimComparison all;
  for (std::uint64_t seed = 1; seed <= test::tried(4); ++seed)
    for (const CellKind kind : test::tried(test::all_kinds())) {
      ZooMesh mesh = test::curved_mesh(kind);
      add_fields(mesh, seed);
      all.add(mesh, skin_scene(seed), std::string(kind_name(kind)) + " " + std::to_string(seed));
    }
  all.record("curved");
  EXPECT_GT(all.claims.size(), test::tried(test::tried(4000)));
  EXPECT_GT(all.largest_share, 1e-4);
  EXPECT_LT(ClaimComparison::part(all.claims, 0.95), 1e-7);
}

// Faces that count as planar at a planarity of 10 kBent, and are not.
constexpr double kBent = 1e-6;

ZooMesh bent_a_little(CellKind kind) {
  return test::moved(test::straight_mesh(kind), [](const std::array<double, 3>& p) {
    return std::array{p[0] + kBent * std::sin(5 * p[1] + 3 * p[2] + 1),
                      p[1] + kBent * std::sin(4 * p[2] + 6 * p[0]),
                      p[2] + kBent * std::sin(5 * p[0] + 4 * p[1] + 2)};
  });
}

// The skin is drawn planar, and the truth is curved: its place, its normals and its field's values
// are all off by more than rounding.
TEST(SkinErrors, HoldWhereFacesCountAsPlanar) {
  for (const bool with_field : {false, true}) {
    ClaimComparison all;
    for (std::uint64_t seed = 1; seed <= test::tried(2); ++seed)
      for (const CellKind kind : test::tried(test::all_kinds())) {
        ZooMesh mesh = bent_a_little(kind);
        add_fields(mesh, seed);
        Scene scene = skin_scene(seed);
        scene.render.planarity = 10 * kBent;
        if (seed == 1) {  // nearly along the upper faces
          scene.camera.eye = {3.1, 0.4, 1.04};
          scene.camera.look_at = {0.5, 0.5, 0.9};
        }
        scene.volume = {};
        scene.skin->color_by.reset();
        scene.skin->shininess = 50;
        if (with_field) scene.skin->color_by = ColorTransfer{"node", {{0, {}}, {1, {9, 9, 9}}}};
        all.add(mesh, scene, std::string(kind_name(kind)) + " " + std::to_string(seed));
      }
    EXPECT_GT(all.claims.size(), test::tried(test::tried(2000)));
    EXPECT_GT(all.largest_error, kBent / 10);
    EXPECT_GT(all.largest_share, 1e-2);
  }
}

TEST(SkinErrors, HoldFarFromTheOriginAndInFlatCells) {
  ClaimComparison all;
  for (std::uint64_t seed = 1; seed <= test::tried(6); ++seed)
    for (const bool far : {false, true}) {
      const std::array<double, 3> away{far ? 1e6 : 0, far ? -2e6 : 0, far ? 5e5 : 0};
      ZooMesh mesh = test::moved(test::structured(2, seed % 2 == 0 ? Cut::bricks : Cut::prisms),
                                 [&](std::array<double, 3> p) {
                                   if (!far) p[2] *= 1e-5;
                                   for (std::size_t c = 0; c < 3; ++c) p[c] += away[c];
                                   return p;
                                 });
      add_fields(mesh, seed);
      Scene scene = skin_scene(seed);
      for (std::size_t c = 0; c < 3; ++c) {
        scene.camera.eye[c] += away[c];
        scene.camera.look_at[c] += away[c];
      }
      all.add(mesh, scene, (far ? "far " : "flat ") + std::to_string(seed));
    }
  EXPECT_GT(all.claims.size(), test::tried(500));
}

// Moves the view until the ray of a pixel is at a jump of the picture: between two views that
// differ by rounding, one shows the skin and the other one does not, or another face of it.
struct Brink {
  double jump;  // of the picture
  double least_claim;
  double at;  // how much of the way
};

Scene moved_by(Scene scene, double s, const std::array<double, 3>& way) {
  for (std::size_t c = 0; c < 3; ++c) {
    scene.camera.eye[c] += s * way[c];
    scene.camera.look_at[c] += s * way[c];
  }
  return scene;
}

Brink brink(const ZooMesh& mesh, const Scene& scene, const std::array<double, 3>& way,
            std::uint32_t x, std::uint32_t y) {
  const auto seen = [&](double s) {
    const Image image = with_errors(mesh, moved_by(scene, s, way));
    std::array<double, 5> values{};
    for (std::size_t c = 0; c < 5; ++c) values[c] = image.at(x, y, c);
    return values;
  };
  const auto apart = [](const std::array<double, 5>& a, const std::array<double, 5>& b) {
    double most = 0;
    for (std::size_t c = 0; c < 4; ++c) most = std::max(most, std::abs(a[c] - b[c]));
    return most;
  };
  double low = 0, high = 1;
  auto at_low = seen(low), at_high = seen(high);
  for (int step = 0; step < 52; ++step) {
    const double middle = 0.5 * (low + high);
    if (!(low < middle && middle < high)) break;
    const auto at_middle = seen(middle);
    // the half in which the picture changes more
    if (apart(at_low, at_middle) > apart(at_middle, at_high)) {
      high = middle;
      at_high = at_middle;
    } else {
      low = middle;
      at_low = at_middle;
    }
  }
  return {apart(at_low, at_high), std::min(at_low[4], at_high[4]), low};
}

TEST(SkinErrors, SayWhereRoundingDecidesWhatIsSeen) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  std::size_t jumps = 0, outlines = 0;
  std::vector<std::pair<std::string, ZooMesh>> meshes = linear_meshes();
  for (const CellKind kind : {CellKind::tetrahedron10, CellKind::brick20, CellKind::prism15})
    meshes.emplace_back(kind_name(kind), test::curved_mesh(kind));
  for (auto& [name, mesh] : meshes) {
    add_fields(mesh, 5);
    for (std::size_t k = 0; k < test::tried(24); ++k) {
      Scene scene = skin_scene(2 * k + (k % 3 == 0 ? 1 : 0));
      scene.image = {3, 3};
      scene.skin->opacity = 1;
      const std::array<double, 3> way{1.5 * any(random), 1.5 * any(random), 1.5 * any(random)};
      const Brink at = brink(mesh, scene, way, 1, 1);
      if (at.jump < 1e-3) continue;
      ++jumps;
      if (at.jump > 0.9) ++outlines;
      EXPECT_GE(at.least_claim, at.jump) << name << ' ' << k;
    }
  }
  EXPECT_GT(jumps, test::tried(100));
  EXPECT_GT(outlines, test::tried(30));
}

// The outline that is drawn is not the true one: between the two, all is wrong.
TEST(SkinErrors, SayWhereTheOutlineOfFacesThatCountAsPlanarIsOff) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> any(-1, 1);
  std::size_t wrong = 0;
  for (const CellKind kind : {CellKind::tetrahedron10, CellKind::brick20, CellKind::prism15}) {
    ZooMesh mesh = bent_a_little(kind);
    add_fields(mesh, 5);
    for (std::size_t k = 0; k < test::tried(24); ++k) {
      Scene scene = skin_scene(2 * k);
      scene.image = {3, 3};
      scene.skin->opacity = 1;
      scene.volume = {};
      scene.render.planarity = 10 * kBent;
      const std::array<double, 3> way{1.5 * any(random), 1.5 * any(random), 1.5 * any(random)};
      const Brink at = brink(mesh, scene, way, 1, 1);
      if (at.jump < 0.9) continue;
      for (const double off : {-0.3 * kBent, 0.3 * kBent}) {
        const Scene there = moved_by(scene, at.at + off, way);
        const Image image = with_errors(mesh, there);
        const auto expected = test::SkinTruth(mesh, there).pixel(1, 1);
        if (std::isnan(expected[0])) continue;
        const auto error = static_cast<double>(std::abs(expected[3] - image.at(1, 1, 3)));
        if (error > 0.9) ++wrong;
        EXPECT_LE(error, image.at(1, 1, 4)) << kind_name(kind) << ' ' << k;
      }
    }
  }
  EXPECT_GE(wrong, test::tried(8));
}

TEST(SkinErrors, AreSmallWhereFacesInOnePlaneMeet) {
  // mesh lines of a brick grid through the centres of pixels
  ZooMesh mesh = test::structured(2, Cut::bricks);
  add_fields(mesh, 3);
  Scene scene = skin_scene(1);
  scene.skin->color_by.reset();
  scene.volume = {};  // rays in the faces of bricks leave the medium in doubt
  scene.camera = {};
  scene.camera.projection = Projection::orthographic;
  scene.camera.eye = {0.5, 0.5, 5};
  scene.camera.look_at = {0.5, 0.5, 0.5};
  scene.camera.up = {0, 1, 0};
  scene.camera.height = 1.25;
  scene.image = {5, 5};
  const Image image = with_errors(mesh, scene);
  EXPECT_LT(image.at(2, 1, 4), 1e-9);  // on the line between two faces
  EXPECT_LT(image.at(1, 1, 4), 1e-9);  // inside a face
  EXPECT_GT(image.at(2, 2, 4), 0.1);   // at a node
}

TEST(SkinErrors, AreThoseOfTheExplainedPixel) {
  ZooMesh mesh = test::curved_mesh(CellKind::brick20);
  add_fields(mesh, 4);
  const Scene scene = skin_scene(2);
  const VisibilityOrder order = test::sorted(mesh, scene);
  const Image image = with_errors(mesh, scene);
  for (std::uint32_t y = 0; y < kHeight; y += 3)
    for (std::uint32_t x = 0; x < kWidth; x += 3) {
      const PixelExplanation pixel = explain_pixel(mesh, order, scene, x, y, false);
      ASSERT_TRUE(pixel.error);
      EXPECT_EQ(*pixel.error, image.at(x, y, 4)) << x << ' ' << y;
    }
}

TEST(SkinErrors, HoldInGroupsOfCells) {
  for (const auto& plain : {test::random_delaunay(40, 13), test::curved_mesh(CellKind::brick20)}) {
    ZooMesh mesh = plain;
    add_fields(mesh, 6);
    Scene scene = skin_scene(2);
    scene.skin->opacity = 0.4;
    VisibilityOrder order = test::sorted(mesh, scene);
    order.groups = std::vector<CellGroup>{{0, static_cast<std::uint32_t>(order.cells.size())}};
    const std::vector<Channel> channels{Channel::error};
    const Image image = render(mesh, order, scene, false, nullptr, channels).image;
    const test::SkinTruth truth(mesh, scene);
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        const auto expected = truth.pixel(x, y);
        if (std::isnan(expected[0])) continue;
        for (std::size_t c = 0; c < 4; ++c)
          EXPECT_LE(static_cast<double>(std::abs(expected[c] - image.at(x, y, c))),
                    image.at(x, y, 4))
              << x << ' ' << y;
      }
  }
}

}  // namespace
}  // namespace hiac
