// The parts of recomputed pixels by themselves: light against Simpson's rule, fields and their
// errors in a cell by hand.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/rounding.hpp"
#include "hiac/element/cell_field.hpp"
#include "hiac/frame/transfer_table.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/render/refine/extended_cell_fields.hpp"
#include "hiac/render/refine/extended_light.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac {
namespace {

using Real = long double;

// Points of a function on [0, 1], some of them steps.
template <std::size_t N>
std::vector<typename PiecewiseLinear<N>::Point> random_points(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> places(5);
  for (double& x : places) x = unit(random);
  std::ranges::sort(places);
  std::vector<typename PiecewiseLinear<N>::Point> points;
  for (const double x : places)
    for (std::size_t k = 0; k <= random() % 2; ++k) {
      typename PiecewiseLinear<N>::Point point{x, {}};
      for (double& value : point.value) value = 2 * unit(random);
      points.push_back(point);
    }
  return points;
}

// Light, transparency and what is seen of a stretch, by Simpson's rule between all places at which
// the functions bend or jump; only values just inside of each part are used.
ExtendedLight integrated(const Volume& volume, double length, const ExtendedEnds& color,
                         const ExtendedEnds& extinction) {
  const auto tau_function = volume.extinction->function();
  const auto color_function = volume.color->function();
  std::vector<double> cuts{0, 1};
  const auto add = [&](const ExtendedEnds& ends, double s) {
    const auto place = static_cast<double>((s - ends.front) / (ends.back - ends.front));
    if (place > 0 && place < 1) cuts.push_back(place);
  };
  for (const auto& point : volume.extinction->points) add(extinction, point.scalar);
  for (const auto& point : volume.color->points) add(color, point.scalar);
  std::ranges::sort(cuts);
  ExtendedLight sum;
  Real depth = 0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    constexpr int kSteps = 400;
    const double from = cuts[k], to = cuts[k + 1], inset = 1e-9 * (to - from);
    if (!(to - from > 1e-12)) continue;
    // linear in between: two values say all
    const auto at = [&](const auto& function, const ExtendedEnds& ends, std::size_t c,
                        double at_place) {
      const double first = function(static_cast<double>(ends.at(from + inset)))[c];
      const double last = function(static_cast<double>(ends.at(to - inset)))[c];
      return first + (last - first) * (at_place - from) / (to - from);
    };
    const double b = at(tau_function, extinction, 0, from), a = at(tau_function, extinction, 0, to);
    for (int i = 0; i <= kSteps; ++i) {
      const double v = static_cast<double>(i) / kSteps;
      const double weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
      const Real step = static_cast<Real>(weight) * (to - from) * length / (3 * kSteps);
      const Real here = depth + (to - from) * length * v * (b + v * (a - b) / 2);
      const Real seen = step * std::exp(-here);
      sum.seen += seen;
      const double tau = volume.glow == Glow::emission ? 1 : b + v * (a - b);
      for (std::size_t c = 0; c < 3; ++c)
        sum.rgb[c] += seen * tau * at(color_function, color, c, from + v * (to - from));
    }
    depth += (to - from) * length * (a + b) / 2;
  }
  sum.transparency = std::exp(-depth);
  return sum;
}

TEST(ExtendedVolume, IsTheIntegralAlongTheRay) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 60; ++trial) {
    Volume volume;
    volume.extinction = ExtinctionTransfer{"f", random_points<1>(random)};
    volume.color = ColorTransfer{trial % 2 == 0 ? "f" : "g", random_points<3>(random)};
    volume.glow = trial % 3 == 0 ? Glow::emission : Glow::chromaticity;
    const OpticsTables optics = make_optics_tables(volume, Integration::exact);
    const double length = trial % 5 == 0 ? 9 : 1.5;
    const ExtendedEnds extinction{unit(random), unit(random)};
    const ExtendedEnds color =
        trial % 2 == 0 ? extinction : ExtendedEnds{unit(random), unit(random)};
    const ExtendedLight found = extended_volume(optics, length, color, extinction);
    const ExtendedLight expected = integrated(volume, length, color, extinction);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(static_cast<double>(found.rgb[c] - expected.rgb[c]), 0, 1e-7) << trial;
    EXPECT_NEAR(static_cast<double>(found.transparency - expected.transparency), 0, 1e-7);
    EXPECT_NEAR(static_cast<double>(found.seen - expected.seen), 0, 1e-7);
  }
}

// A value at a step belongs to what is above it, all along a stretch on which the field is
// constant.
TEST(ExtendedVolume, OfAConstantFieldAtAStepIsThatAboveIt) {
  Volume volume;
  volume.extinction = ExtinctionTransfer{"f", {{0.5, {1}}, {0.5, {3}}}};
  volume.color = ColorTransfer{"f", {{0.5, {0, 1, 0}}, {0.5, {1, 0, 0}}}};
  const OpticsTables optics = make_optics_tables(volume, Integration::exact);
  const ExtendedLight at = extended_volume(optics, 2, {0.5, 0.5}, {0.5, 0.5});
  EXPECT_NEAR(static_cast<double>(at.transparency), std::exp(-6), 1e-16);
  EXPECT_NEAR(static_cast<double>(at.rgb[0]), 1 - std::exp(-6), 1e-16);
  EXPECT_EQ(at.rgb[1], 0);
  const Real below = std::nextafter(0.5, 0);
  const ExtendedLight under = extended_volume(optics, 2, {below, below}, {below, below});
  EXPECT_NEAR(static_cast<double>(under.transparency), std::exp(-2), 1e-16);
}

TEST(ExtendedLight, AddsWhatIsBehindThroughWhatIsInFront) {
  ExtendedLight sum{{1, 2, 3}, 0.5, 4};
  sum.add_behind({{16, 32, 64}, 0.25, 8});
  EXPECT_EQ(sum.rgb, (std::array<Real, 3>{9, 18, 35}));
  EXPECT_EQ(sum.transparency, 0.125);
  EXPECT_EQ(sum.seen, 8);
}

// A brick of 1 x 1 x 4 units seen from above, its upper end at a distance of 10 and a corner of it
// lifted, and a field of its height.
class ExtendedFieldsTest : public testing::Test {
 protected:
  void view(double lifted, double offset = 0) {
    std::vector<test::Position> positions;
    test::Cell cell{CellKind::brick8, {}};
    for (const test::Position& p : reference_nodes(CellKind::brick8)) {
      cell.nodes.push_back(static_cast<NodeId>(positions.size()));
      positions.push_back({p[0], p[1], 4 * p[2]});
    }
    positions[6][2] += lifted;
    mesh_ = test::make_mesh(positions, {cell});
    test::add_node_field(mesh_, "f", [=](const test::Position& p) { return offset + 3 * p[2]; });
    test::add_node_field(mesh_, "one", [](const test::Position&) { return 7; });
    Scene scene = test::cube_scene(Projection::perspective, 8, 8);
    scene.camera.eye = {0, 0, 14};
    scene.camera.look_at = {0, 0, 0};
    scene.camera.up = {0, 1, 0};
    scene.render.planarity = 1e-3;
    projector_ = std::make_unique<const Projector>(scene.camera, scene.image);
    frame_ = std::make_unique<const Frame>(mesh_, scene, *projector_, Details::bounded);
    fields_ = std::make_unique<ExtendedCellFields>(*frame_);
    fields_->enter(0, ExtendedCell(*frame_, 0));
  }
  [[nodiscard]] ExtendedCellField known(const char* name, double allowed, double level) const {
    const Field field = scalar_field(mesh_, name);
    const FrameField values{{field.values, field.location, false}, {}};
    CellField nodes = cell_field(mesh_, 0, values, level);
    nodes.allowed = allowed;
    return fields_->known(nodes, values, level);
  }

  static constexpr double e = kExtendedUnit;
  // of the lower end's far corner, and of the cell
  const double reach_ = std::sqrt(1 + 1 + 14.0 * 14), size_ = std::sqrt(1 + 1 + 16.0);
  ZooMesh mesh_;
  std::unique_ptr<const Projector> projector_;
  std::unique_ptr<const Frame> frame_;
  std::unique_ptr<ExtendedCellFields> fields_;
};

// 24 units of the distance, 64 of the cell's size; 8 of the distance along the ray.
TEST_F(ExtendedFieldsTest, AreDisplacedByTheRoundingOfExtendedNumbers) {
  view(0);
  const RayDisplacement& inside = fields_->inside();
  EXPECT_NEAR(inside.aside, e * (24 * reach_ + 64 * size_), 1e-9 * e);
  EXPECT_NEAR(inside.at_ends, inside.aside, 1e-9 * e);
  EXPECT_NEAR(inside.along, e * 8 * reach_, 1e-9 * e);
  EXPECT_EQ(inside.spread, 1);
}

// Corners off the planes of their faces count where the ray enters and leaves: a quarter of what
// one of four corners is off by.
TEST_F(ExtendedFieldsTest, AreDisplacedByWhatFacesAreBentAtTheirEnds) {
  view(0x1p-20);
  const RayDisplacement& inside = fields_->inside();
  EXPECT_NEAR(inside.at_ends - inside.aside, 0x1p-22, 1e-6 * 0x1p-22);
}

// The gradient of 3 times the displacement; 64 units of the largest value; and twice what the
// interpolation may leave away.
TEST_F(ExtendedFieldsTest, HaveTheErrorsOfTheirModel) {
  view(0, 5);
  const ExtendedCellField field = known("f", 1e-9, 0);
  EXPECT_EQ(field.field.least, 5);
  EXPECT_EQ(field.field.most, 17);
  EXPECT_EQ(field.field.negligible, 1e-9);
  EXPECT_EQ(field.at_faces, 0);
  const double aside = fields_->inside().aside;
  EXPECT_NEAR(field.error, 2e-9, 1e-13);
  // rounding, where less is allowed: 8 of the largest value, 16 of the range, the distance and the
  // steepness of the map, which is 1 across
  const ExtendedCellField fine = known("f", 0, 0);
  const double negligible = e * (8 * 17 + 16 * reach_ * 12);
  EXPECT_NEAR(static_cast<double>(fine.field.negligible), negligible, 1e-6 * negligible);
  EXPECT_NEAR(fine.error, 3 * aside + e * 64 * 17 + 2 * negligible, 1e-3 * fine.error);
  // no more than the whole range
  EXPECT_NEAR(known("f", 100, 0).error, 12, 1e-9);
}

TEST_F(ExtendedFieldsTest, AreThoseAboveALevel) {
  view(0, 5);
  const ExtendedCellField field = known("f", 1e-9, 20);
  EXPECT_EQ(field.field.least, -15);
  EXPECT_EQ(field.field.most, -3);
  for (std::size_t k = 0; k < 8; ++k)
    EXPECT_EQ(field.field.values[k], mesh_.position(mesh_.cell_nodes(0)[k])[2] * 3 - 15);
  const double negligible = e * (8 * 15 + 16 * reach_ * 12);
  EXPECT_NEAR(static_cast<double>(known("f", 0, 20).field.negligible), negligible,
              1e-6 * negligible);
}

// Where the ray enters or leaves the neighbour's field may be met, over twice the bend.
TEST_F(ExtendedFieldsTest, MayBeThoseOfNeighboursAtBentFaces) {
  view(0x1p-20);
  EXPECT_NEAR(known("f", 0, 0).at_faces, 3 * 2 * 0x1p-22, 1e-4 * 0x1p-20);
}

TEST_F(ExtendedFieldsTest, HaveNoErrorWhereTheyAreConstant) {
  view(0x1p-20);
  const ExtendedCellField field = known("one", 1e-9, 2);
  EXPECT_EQ(field.field.least, 5);
  EXPECT_EQ(field.field.most, 5);
  EXPECT_EQ(field.error, 0);
  EXPECT_EQ(field.at_faces, 0);
}

}  // namespace
}  // namespace hiac
