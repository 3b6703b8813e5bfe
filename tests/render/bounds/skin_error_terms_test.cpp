// Every term of the bound of a point of the skin by itself.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/rounding.hpp"
#include "hiac/base/special_values.hpp"
#include "hiac/render/bounds/normal_doubt.hpp"
#include "hiac/render/bounds/skin_errors.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac {
namespace {

using test::Cut;
using test::Position;

constexpr std::array<double, 3> kNowhere{kNaN, kNaN, kNaN};

// The unit cube as 2 x 2 x 2 bricks, seen from above in 8 x 8 pixels of an eighth of a unit: pixel
// (x, y) is above the world's ((x + 1/2) / 8 - shift, 1 - (y + 1/2) / 8). In perspective the top is
// a pixel's unit away, too.
class SkinPointTest : public testing::Test {
 protected:
  void view(Projection projection, double shift, const char* field,
            std::optional<std::array<double, 2>> clip = {}) {
    mesh_ = test::structured(2, Cut::bricks);
    test::add_node_field(mesh_, "f", [](const Position& p) { return p[0]; });
    test::add_random_field(mesh_, "cell", FieldLocation::cell, 3);
    Scene scene = test::cube_scene(projection, 8, 8);
    scene.camera.eye = {0.5 - shift, 0.5, 5};
    scene.camera.look_at = {0.5 - shift, 0.5, 0};
    scene.camera.up = {0, 1, 0};
    scene.camera.height = 1;
    scene.camera.fov = 2 * std::atan(0.125) * 180 / 3.14159265358979323846;
    scene.camera.clip = clip;
    Skin& skin = scene.skin.emplace();
    skin.color = {0.5, 0.25, 0.125};
    skin.opacity = 0.75;
    skin.ambient = 0.25;
    skin.diffuse = 0.5;
    skin.specular = 0;
    if (*field != 0)
      skin.color_by = ColorTransfer{field,
                                    {{0.1, {0.1, 0.2, 0.9}},
                                     {0.5, {0.2, 0.9, 0.3}},
                                     {0.8, {0.9, 0, 0.1}},
                                     {0.8, {0.4, 0.1, 0.1}},
                                     {0.9, {0.4, 0.1, 0.7}}}};
    scene.lights = {Light{{}, {0.75, 0.5, 0.25}}, Light{{{1, 1, 1}}, {0.125, 0.5, 0.25}}};
    projector_ = std::make_unique<const Projector>(scene.camera, scene.image);
    frame_ = std::make_unique<const Frame>(mesh_, scene, *projector_, Details::bounded);
    errors_ = std::make_unique<SkinErrors>(*frame_);
    for (CellId cell = 0; cell < 8; ++cell)
      for (std::uint8_t f = 0; f < 6; ++f)
        if (is_top(cell, f)) top_.at(cell) = f;
  }
  [[nodiscard]] bool is_top(CellId cell, std::size_t face) const {
    const ShapeFace& shape = topology_of(CellKind::brick8).faces[face];
    return std::ranges::all_of(shape.corners, [&](std::uint8_t k) {
      return mesh_.position(mesh_.cell_nodes(cell)[k])[2] == 1;
    });
  }
  // The cell at the top whose lower corner is here.
  [[nodiscard]] CellId cell_at(double x, double y) const {
    for (CellId cell = 0; cell < 8; ++cell) {
      double low_x = 9, low_y = 9, low_z = 9;
      for (const NodeId node : mesh_.cell_nodes(cell)) {
        low_x = std::min(low_x, mesh_.position(node)[0]);
        low_y = std::min(low_y, mesh_.position(node)[1]);
        low_z = std::min(low_z, mesh_.position(node)[2]);
      }
      if (low_x == x && low_y == y && low_z == 0.5) return cell;
    }
    return 8;
  }
  void enter(CellId cell) {
    cell_ = cell;
    rays_.clear();
    scan_cell(*frame_, cell, kWhole, rays_);
    errors_->enter(cell, kWhole, rays_);
  }
  // What is added for a point of the top of the cell.
  [[nodiscard]] SegmentDetails at(int x, int y, double value, double doubt = kNaN) {
    SegmentDetails details;
    const double t = projector_->perspective() ? 4 : -1;
    errors_->add({x, y, t, true, top_[cell_], kNowhere, doubt}, kWhole.index(x, y), seen(x, y),
                 value, details);
    return details;
  }
  [[nodiscard]] ShadedPoint seen(int x, int y) const {
    const double scale = projector_->ray_scale(x + 0.5, y + 0.5);
    const auto [right, up] = projector_->slopes(x + 0.5, y + 0.5);
    std::array<double, 3> ray{0, 0, 1};
    if (projector_->perspective()) ray = {right / scale, up / scale, 1 / scale};
    return {{0, 0, -1}, ray, kColor, {{}, 0.25}};
  }
  // The doubt along the ray about a point of the top of a cell.
  [[nodiscard]] double along(CellId cell, int x, int y) const {
    const RayDisplacement moved = displacement_in_world(*frame_, cell);
    double reach = 0;
    for (const NodeId node : mesh_.cell_nodes(cell)) {
      const auto p = projector_->relative(mesh_.position(node));
      reach = std::max(reach, std::hypot(p[0], p[1], p[2]));
    }
    const double scale = projector_->ray_scale(x + 0.5, y + 0.5);
    return (2 * moved.at_ends + 16 * kUnit * reach) * scale + moved.along;
  }
  [[nodiscard]] ErrorBound bound(int x, int y, double angle) const {
    SurfaceLook look = frame_->skin.look;
    look.color = kColor;
    return shade_bound(look, frame_->skin.lights, {0, 0, -1}, seen(x, y).ray, angle);
  }
  // Of a value's colour, by sampling all that are as near as `error`, from both sides of the step.
  [[nodiscard]] double color_change(double value, double error) const {
    double most = 0;
    const auto here = frame_->skin.colors(value);
    const auto include = [&](double s) {
      const auto there = frame_->skin.colors(s);
      for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(there[c] - here[c]));
    };
    for (int k = -1000; k <= 1000; ++k) include(value + error * k / 1000);
    for (const double s : {0.5, 0.8, std::nextafter(0.8, 0), 0.9})
      if (std::abs(s - value) <= error) include(s);
    return most;
  }

  static constexpr TileRect kWhole{0, 0, 8, 8};
  static constexpr Color kColor{0.5, 0.25, 0.125};
  // ambient light, and what each light's largest channel gives to diffuse light
  static constexpr double kReflected = 0.25 + 0.75 * 0.5 + 0.5 * 0.5;
  ZooMesh mesh_;
  std::unique_ptr<const Projector> projector_;
  std::unique_ptr<const Frame> frame_;
  std::unique_ptr<SkinErrors> errors_;
  std::array<std::uint8_t, 9> top_{};
  std::vector<CellCrossing> rays_;
  CellId cell_ = 0;
};

TEST_F(SkinPointTest, IsOffAsTheEndsOfItsCellAre) {
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    view(projection, 0, "");
    enter(cell_at(0, 0));
    const SegmentDetails found = at(1, 6, kNaN);
    const double scale = projector_->ray_scale(1.5, 6.5);
    EXPECT_NEAR(found.moved, along(cell_, 1, 6) / scale, 1e-6 * found.moved);
    EXPECT_EQ(found.in_doubt, frame_->skin.largest_light);
    const ErrorBound expected = bound(1, 6, planar_normal_doubt(*frame_, cell_, top_[cell_]));
    EXPECT_EQ(found.radiance_error, expected.radiance);
    EXPECT_EQ(found.transparency_error, expected.transparency);
  }
}

// Off by as much as a curved face says, and by what depths are.
TEST_F(SkinPointTest, IsOffAsCurvedFacesSay) {
  view(Projection::perspective, 0, "");
  enter(cell_at(0, 0));
  const double scale = projector_->ray_scale(1.5, 6.5);
  const double depths = displacement_in_world(*frame_, cell_).along;
  EXPECT_NEAR(at(1, 6, kNaN, 1e-13).moved, (1e-13 + depths) / scale, 1e-18);
  EXPECT_NEAR(at(1, 6, kNaN, 0).moved, depths / scale, 1e-6 * depths);
}

// The field changes by 1 a unit, and its colours with it: between two bends, at a bend, and at a
// step, of which the other side counts once it is as near.
TEST_F(SkinPointTest, IsOffInColourByWhatTheFieldChanges) {
  view(Projection::orthographic, 0, "f");
  enter(cell_at(0.5, 0));
  for (const double value : {0.6, 0.55, 0.5, 0.505, 0.7, 0.79, 0.795, 0.8, 0.82, 0.9, 0.95})
    for (const double doubt : {1e-5, 1e-3, 0.008, 0.03, 0.15}) {
      const SegmentDetails found = at(6, 6, value, doubt);
      const ErrorBound base = bound(6, 6, planar_normal_doubt(*frame_, cell_, top_[cell_]));
      const double color = (0.75 + base.transparency) * kReflected * color_change(value, doubt);
      EXPECT_NEAR(found.radiance_error, std::min(base.radiance + color, frame_->skin.largest_light),
                  1e-5 * color + 1e-13)
          << value << ' ' << doubt;
      EXPECT_EQ(found.transparency_error, base.transparency);
    }
}

// Rounding alone: of the field 128 u of its largest value in the cell, and what its place is off;
// 8 u of a colour and of its slope's part.
TEST_F(SkinPointTest, IsOffInColourByRounding) {
  view(Projection::orthographic, 0, "f");
  enter(cell_at(0.5, 0));
  const double aside = displacement_in_world(*frame_, cell_).aside;
  const double value = 0.65, off = aside + along(cell_, 6, 6) + 128 * kUnit;
  // from (0.5, 0.9) on the green falls by 3 a unit
  const double color = 3 * off + 8 * kUnit * (0.9 + 3 * 0.15);
  const ErrorBound base = bound(6, 6, planar_normal_doubt(*frame_, cell_, top_[cell_]));
  const SegmentDetails found = at(6, 6, value);
  EXPECT_NEAR(found.radiance_error - base.radiance, 0.75 * kReflected * color, 0.01 * color);
}

// On a line between two tops the ray may meet either: the places of both are off, the angle between
// them, which is none, counts, and the values of both cells.
TEST_F(SkinPointTest, IsThatOfBothFacesBesideALine) {
  view(Projection::orthographic, 1.0 / 16, "");
  enter(cell_at(0, 0));
  const CellId other = cell_at(0.5, 0);
  const SegmentDetails alone = at(1, 6, kNaN), both = at(4, 6, kNaN);
  EXPECT_NEAR(alone.moved, along(cell_, 1, 6), 1e-6 * alone.moved);
  EXPECT_NEAR(both.moved, along(cell_, 4, 6) + along(other, 4, 6), 1e-6 * both.moved);
  const ErrorBound base = bound(4, 6, planar_normal_doubt(*frame_, cell_, top_[cell_]));
  EXPECT_EQ(both.radiance_error, base.radiance);

  view(Projection::orthographic, 1.0 / 16, "f");
  enter(cell_at(0, 0));
  const double aside = displacement_in_world(*frame_, cell_).aside;
  const double other_aside = displacement_in_world(*frame_, other).aside;
  const double value = 0.4, step = 1.75;  // of green from 0.2 at 0.1 on
  // the largest values are 0.5 here and 1 there
  const double here = aside + along(cell_, 4, 6) + 128 * kUnit * 0.5;
  const double there = other_aside + along(other, 4, 6) + 128 * kUnit;
  const double color = step * (here + there) + 8 * kUnit * (0.2 + step * 0.3);
  const SegmentDetails found = at(4, 6, value);
  EXPECT_NEAR(found.radiance_error - base.radiance, 0.75 * kReflected * color, 0.02 * color);
  EXPECT_LT(found.transparency_error, 1e-14);
}

// Another cell may have any other value: nothing is known of the pixel.
TEST_F(SkinPointTest, IsUnknownBesideLinesAtWhichTheFieldJumps) {
  view(Projection::orthographic, 1.0 / 16, "cell");
  enter(cell_at(0, 0));
  const SegmentDetails found = at(4, 6, 0.4);
  EXPECT_EQ(found.radiance_error, frame_->skin.largest_light);
  EXPECT_EQ(found.transparency_error, 1);
  EXPECT_LT(at(1, 6, 0.4).radiance_error, 1e-12);
}

TEST_F(SkinPointTest, IsUnknownWhereSeveralFacesMeet) {
  view(Projection::orthographic, 1.0 / 16, "");
  enter(cell_at(0, 0));
  const std::set<std::size_t> hidden(errors_->hidden().begin(), errors_->hidden().end());
  EXPECT_EQ(hidden.size(), errors_->hidden().size());
  // the outline's lines through centres: its left side, below the middle, is at column 0
  std::set<std::size_t> expected;
  for (int y = 4; y < 8; ++y) expected.insert(kWhole.index(0, y));
  EXPECT_EQ(hidden, expected);
  const SegmentDetails found = at(0, 6, kNaN);
  EXPECT_EQ(found.radiance_error, frame_->skin.largest_light);
  EXPECT_EQ(found.transparency_error, 1);
}

// A view that begins where the top is: whether it is seen is in doubt in all pixels, once in each.
TEST_F(SkinPointTest, IsUnknownWhereTheViewBeginsOrEnds) {
  for (const bool begins : {true, false})
    for (const double off : {0.0, 1e-15, 1e-9, -1e-9}) {
      view(Projection::orthographic, 0, "",
           begins ? std::array{4 + off, 9.0} : std::array{1.0, 4 + off});
      enter(cell_at(0, 0));
      const std::size_t expected = std::abs(off) < 1e-12 ? 16 : 0;
      EXPECT_EQ(errors_->hidden().size(), expected) << begins << ' ' << off;
      const std::set<std::size_t> hidden(errors_->hidden().begin(), errors_->hidden().end());
      EXPECT_EQ(hidden.size(), expected);
    }
  // the plane below the top belongs to no skin
  view(Projection::orthographic, 0, "", std::array{1.0, 4.5});
  enter(cell_at(0, 0));
  EXPECT_TRUE(errors_->hidden().empty());
}

}  // namespace
}  // namespace hiac
