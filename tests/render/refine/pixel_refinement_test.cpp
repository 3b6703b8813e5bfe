// Pixels recomputed in extended precision against those that the engine drew: two ways to the same
// picture, which differ by no more than the rounding of doubles.
#include "hiac/render/refine/pixel_refinement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/rounding.hpp"
#include "hiac/frame/tiles/tile_bins.hpp"
#include "hiac/render/engine.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac {
namespace {

using test::Cut;
using test::Position;

constexpr std::uint32_t kWidth = 7, kHeight = 6;

// A picture of one tile, as the engine drew it, and what recomputes its pixels.
class DrawnAgain {
 public:
  DrawnAgain(ZooMesh mesh, Scene scene, bool grouped)
      : mesh_(std::move(mesh)),
        scene_(std::move(scene)),
        order_(test::sorted(mesh_, scene_)),
        projector_(scene_.camera, scene_.image),
        frame_(mesh_, scene_, projector_, Details::bounded),
        drawn_(std::make_unique<TileBuffer>()) {
    if (grouped)
      order_.groups = std::vector<CellGroup>{
          {1, static_cast<std::uint32_t>(std::max<std::size_t>(order_.cells.size() / 2, 2))}};
    bins_ = bin_cells(frame_, order_, scene_.image, whole_picture(scene_.image));
    const TileRect& tile = bins_.tiles.front();
    refinement_ = std::make_unique<PixelRefinement>(frame_, order_, tile, bins_.cells_of(0));
    drawn_->reset(tile, projector_, true);
    const std::array channels{Channel::transparency};
    const Image image = render(mesh_, order_, scene_, false, nullptr, channels).image;
    for (std::uint32_t y = 0; y < scene_.image.height; ++y)
      for (std::uint32_t x = 0; x < scene_.image.width; ++x) {
        const std::size_t at = index(x, y);
        drawn_->red[at] = image.at(x, y, 0);
        drawn_->green[at] = image.at(x, y, 1);
        drawn_->blue[at] = image.at(x, y, 2);
        drawn_->transparency[at] = image.at(x, y, 4);
      }
  }
  DrawnAgain(const DrawnAgain&) = delete;
  DrawnAgain& operator=(const DrawnAgain&) = delete;
  ~DrawnAgain() = default;

  [[nodiscard]] std::size_t index(std::uint32_t x, std::uint32_t y) const {
    return bins_.tiles.front().index(static_cast<int>(x), static_cast<int>(y));
  }
  TileBuffer& drawn() { return *drawn_; }
  // The error bound of a pixel whose light is claimed to be off by `claimed`.
  double error(std::uint32_t x, std::uint32_t y, double claimed, double background) {
    drawn_->details[index(x, y)].radiance_error = claimed;
    return refinement_->error(*drawn_, index(x, y), background);
  }

 private:
  ZooMesh mesh_;
  Scene scene_;
  VisibilityOrder order_;
  Projector projector_;
  Frame frame_;
  TileBins bins_;
  std::unique_ptr<PixelRefinement> refinement_;
  std::unique_ptr<TileBuffer> drawn_;
};

void add_fields(ZooMesh& mesh) {
  test::add_node_field(mesh, "f", test::smooth_field);
  test::add_node_field(mesh, "g", [](const Position& p) { return 0.2 + 0.6 * p[2] - 0.1 * p[0]; });
  test::add_random_field(mesh, "cell", FieldLocation::cell, 1);
  test::add_random_field(mesh, "corner", FieldLocation::corner, 2);
}

Isosurface pane(const std::string& field, double value, double opacity) {
  Isosurface surface;
  surface.field = field;
  surface.value = value;
  surface.color = {0.9, 0.6, 0.3};
  surface.opacity = opacity;
  surface.shininess = 12;
  return surface;
}

struct Look {
  std::string name;
  std::function<void(Scene&)> set;
};

std::vector<Look> looks() {
  const auto surfaces = [](Scene& scene) {
    // values that no node has
    scene.isosurfaces = {pane("f", 0.47, 0.5), pane("g", 0.41, 0.3), pane("f", 0.36, 0.7)};
    scene.lights = {Light{}, Light{{{-1, 2, 0.5}}, {0.7, 0.6, 0.5}}};
  };
  return {{"one field", [](Scene&) {}},
          {"colour by cells", [](Scene& scene) { scene.volume.color->field = "cell"; }},
          {"cells alone",
           [](Scene& scene) {
             scene.volume.color->field = "cell";
             scene.volume.extinction->field = "cell";
           }},
          {"emission, by corners",
           [](Scene& scene) {
             scene.volume.glow = Glow::emission;
             scene.volume.color->field = "corner";
           }},
          {"steps",
           [](Scene& scene) {
             scene.volume.extinction->points = {
                 {0.3, {0.5}}, {0.4, {2}}, {0.4, {0}}, {0.6, {3}}, {0.6, {1}}};
             scene.volume.color->points = {{0.45, {0, 1, 0.5}}, {0.45, {1, 0.2, 0}}};
           }},
          {"surfaces", surfaces},
          {"surfaces in a medium that shines",
           [=](Scene& scene) {
             surfaces(scene);
             scene.volume.glow = Glow::emission;
           }},
          {"surfaces alone",
           [=](Scene& scene) {
             surfaces(scene);
             scene.volume = {};
           }},
          {"clipped",
           [=](Scene& scene) {
             surfaces(scene);
             scene.camera.clip = {{3.5, 4.1}};
           }},
          {"nearly opaque", [](Scene& scene) {
             for (auto& point : scene.volume.extinction->points)
               point.value[0] = 40 + point.value[0];
           }}};
}

std::vector<std::pair<std::string, ZooMesh>> refined_meshes() {
  return {{"tetrahedra", test::random_delaunay(25, 3)},
          {"bricks", test::moved(test::structured(2, Cut::bricks), test::tapered)},
          {"prisms", test::moved(test::structured(2, Cut::prisms), test::tapered)},
          {"pyramids", test::moved(test::structured(1, Cut::pyramids), test::sheared)},
          {"wedges", test::moved(test::two_wedges(), test::sheared)},
          {"all kinds", test::moved(test::mixed_columns(1), test::tapered)}};
}

// All pixels that show something, each claimed to be off by 1: what is found to be off instead, and
// how many are left as they are, as the ray passes them in doubt.
struct Recomputed {
  std::size_t covered = 0, doubtful = 0;
  double largest = 0;
};

Recomputed recomputed(const ZooMesh& mesh, const Scene& scene, bool grouped) {
  DrawnAgain again(mesh, scene, grouped);
  Recomputed found;
  for (std::uint32_t y = 0; y < scene.image.height; ++y)
    for (std::uint32_t x = 0; x < scene.image.width; ++x) {
      if (again.drawn().transparency[again.index(x, y)] == 1) continue;
      ++found.covered;
      const double error = again.error(x, y, 1, 0.5);
      if (error > 0.9)
        ++found.doubtful;
      else
        found.largest = std::max(found.largest, error);
    }
  return found;
}

TEST(PixelRefinement, FindsWhatTheEngineDrew) {
  if (!kExtendedIsFiner) GTEST_SKIP() << "long double is no finer than double";
  std::size_t number = 0, covered = 0, doubtful = 0;
  for (auto& [name, mesh] : refined_meshes()) {
    add_fields(mesh);
    for (const Look& look : looks()) {
      ++number;
      if (test::kInstrumented && number % 4 != 1) continue;
      const auto projection =
          (number + number / 10) % 2 == 0 ? Projection::perspective : Projection::orthographic;
      Scene scene = test::cube_scene(projection, kWidth, kHeight);
      look.set(scene);
      const Recomputed found = recomputed(mesh, scene, number % 3 == 0);
      // normals of isosurfaces lose digits to the inverse of the cell's map
      EXPECT_LT(found.largest, name == "tetrahedra" ? 1e-13 : 2e-11) << name << ", " << look.name;
      covered += found.covered;
      doubtful += found.doubtful;
    }
  }
  EXPECT_GT(covered, test::tried(380));
  EXPECT_LE(doubtful, covered / 50);
}

// Cells that reach beside the eye, whose corners have no place on the screen.
TEST(PixelRefinement, FindsWhatTheEngineDrewFromWithin) {
  if (!kExtendedIsFiner) GTEST_SKIP() << "long double is no finer than double";
  for (auto& [name, mesh] : refined_meshes()) {
    if (name == "all kinds") continue;
    add_fields(mesh);
    Scene scene = test::cube_scene(Projection::perspective, kWidth, kHeight);
    scene.camera.eye = {0.03, 0, 0};  // beside the middle of all nodes
    for (NodeId node = 0; node < mesh.node_count(); ++node)
      for (std::size_t c = 0; c < 3; ++c)
        scene.camera.eye[c] += mesh.position(node)[c] / static_cast<double>(mesh.node_count());
    scene.camera.look_at = {1.9, 0.3, 0.2};
    scene.camera.fov = 90;
    scene.isosurfaces = {pane("f", 0.47, 0.5), pane("g", 0.41, 0.3)};
    const Recomputed found = recomputed(mesh, scene, false);
    EXPECT_LT(found.largest, 2e-11) << name;
    EXPECT_EQ(found.covered, kWidth * kHeight) << name;
    EXPECT_LE(found.doubtful, found.covered / 10) << name;
  }
}

// What is said of a segment besides its light.
TEST(ExtendedSegments, SayWhatTheirLightIs) {
  for (const Cut cut : {Cut::tetrahedra, Cut::bricks}) {
    ZooMesh mesh = test::structured(1, cut);
    add_fields(mesh);
    Scene scene = test::cube_scene(Projection::orthographic, 9, 9);
    scene.volume.glow = Glow::emission;
    const Projector projector(scene.camera, scene.image);
    const Frame frame(mesh, scene, projector, Details::bounded);
    ExtendedSegments in_tetrahedra(frame);
    ExtendedCellSegments in_cells(frame);
    std::size_t met = 0;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
      for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) {
          ExtendedSegment s{};
          const auto found = cut == Cut::tetrahedra ? in_tetrahedra.find(cell, x, y, s)
                                                    : in_cells.find(cell, x, y, s);
          if (found != ExtendedSegments::Met::once) continue;
          ++met;
          EXPECT_EQ(s.details.light, static_cast<double>(std::ranges::max(s.light.rgb)));
          EXPECT_GT(s.details.light, 0);
          EXPECT_EQ(s.details.transparency, static_cast<double>(s.light.transparency));
          EXPECT_EQ(s.details.front, static_cast<double>(s.front));
          EXPECT_EQ(s.details.back, static_cast<double>(s.back));
          EXPECT_EQ(s.details.first, s.details.front);
          EXPECT_LT(s.details.front, s.details.back);
          EXPECT_GT(s.details.radiance_error, 0);
          EXPECT_LT(s.details.radiance_error, 1e-13);
          EXPECT_GT(s.details.front_edge, 0);
          EXPECT_LT(s.details.front_edge, 1e-13);
          EXPECT_GT(s.details.back_edge, 0);
          EXPECT_LT(s.details.back_edge, 1e-13);
        }
    EXPECT_GT(met, 20U);
  }
}

class PixelRefinementTest : public testing::Test {
 protected:
  PixelRefinementTest() {
    if (!kExtendedIsFiner) return;
    ZooMesh mesh = test::structured(1, Cut::tetrahedra);
    add_fields(mesh);
    Scene scene = test::cube_scene(Projection::orthographic, 9, 9);
    scene.render.tolerance = 1e-9;
    again_ = std::make_unique<DrawnAgain>(mesh, scene, false);
  }
  void SetUp() override {
    if (!kExtendedIsFiner) GTEST_SKIP() << "long double is no finer than double";
  }

  std::unique_ptr<DrawnAgain> again_;
};

// What is off is what was drawn minus what it should have been, with the background that shows
// through.
TEST_F(PixelRefinementTest, ClaimsHowFarThePictureIsOff) {
  TileBuffer& drawn = again_->drawn();
  const std::size_t at = again_->index(4, 4);
  const TileBuffer exact = drawn;
  ASSERT_LT(drawn.transparency[at], 0.9);
  for (TilePixels::Plane* plane : {&drawn.red, &drawn.green, &drawn.blue})
    for (const double off : {3e-6, -3e-6}) {
      (*plane)[at] += off;
      EXPECT_NEAR(again_->error(4, 4, 1, 2), 3e-6, 1e-13);
      drawn.transparency[at] += 2e-6;
      EXPECT_NEAR(again_->error(4, 4, 1, 0), 3e-6, 1e-13);
      EXPECT_NEAR(again_->error(4, 4, 1, 4), 11e-6, 1e-13);
      drawn = exact;
    }
  for (const double off : {2e-6, -2e-6}) {
    drawn.transparency[at] += off;
    EXPECT_NEAR(again_->error(4, 4, 1, 0), 2e-6, 1e-13);
    EXPECT_NEAR(again_->error(4, 4, 1, 0.25), 2e-6, 1e-13);
    EXPECT_NEAR(again_->error(4, 4, 1, 3), 6e-6, 1e-13);
    drawn = exact;
  }
}

// Only claims above a tenth of the tolerance are looked into, and none becomes larger.
TEST_F(PixelRefinementTest, LooksIntoLargeClaimsAlone) {
  EXPECT_NEAR(again_->error(4, 4, 0.99e-10, 0), 0.99e-10, 1e-14);
  EXPECT_LT(again_->error(4, 4, 1.01e-10, 0), 1e-12);
  again_->drawn().red[again_->index(4, 4)] += 1e-3;
  EXPECT_NEAR(again_->error(4, 4, 2e-4, 0), 2e-4, 1e-12);
}

// What the ray met besides cells is not met again.
TEST_F(PixelRefinementTest, LeavesPixelsWithEdgesAsTheyAre) {
  again_->drawn().details[again_->index(4, 4)].met = 1;
  EXPECT_NEAR(again_->error(4, 4, 0.125, 0), 0.125, 1e-12);
}

// Curved cells are not met again, either.
TEST(PixelRefinement, LeavesCellsOfHigherOrderAsTheyAre) {
  ZooMesh mesh = test::of_order(test::structured(1, Cut::tetrahedra), CellOrder::quadratic);
  add_fields(mesh);
  DrawnAgain again(mesh, test::cube_scene(Projection::orthographic, 9, 9), false);
  ASSERT_LT(again.drawn().transparency[again.index(4, 4)], 0.9);
  EXPECT_NEAR(again.error(4, 4, 0.125, 0), 0.125, 1e-12);
}

}  // namespace
}  // namespace hiac
