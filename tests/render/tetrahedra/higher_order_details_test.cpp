#include "hiac/render/tetrahedra/higher_order_details.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/frame/frame.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/optics/polynomial_piece.hpp"
#include "hiac/render/bounds/cell_errors.hpp"
#include "hiac/render/bounds/ray_displacement.hpp"
#include "hiac/render/cells/planar_crossing.hpp"
#include "hiac/render/cells/volume_along_ray.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac {
namespace {

// The corner 0 <= x, y, z, x + y + z <= 1 of order 2, seen from above, with a field z^2: extinction
// 30 z^2, and white light of the strength z^2.
class HigherOrderDetailsTest : public testing::Test {
 protected:
  explicit HigherOrderDetailsTest(double tolerance = 1e-2) {
    std::vector<test::Position> nodes;
    for (const auto& p : reference_nodes(CellKind::tetrahedron10))
      nodes.push_back({p[0], p[1], p[2]});
    mesh_ = test::one_cell(CellKind::tetrahedron10, nodes);
    test::add_node_field(mesh_, "f", [](const test::Position& p) { return p[2] * p[2]; });
    scene_ = test::cube_scene(Projection::orthographic, 8, 8);
    scene_.camera.eye = {0, 0, 4};
    scene_.camera.look_at = {0, 0, 0};
    scene_.camera.up = {0, 1, 0};
    scene_.camera.height = 2;
    scene_.volume.color->points = {{0, {0, 0, 0}}, {1, {1, 1, 1}}};
    scene_.volume.extinction->points = {{0, {0}}, {1, {30}}};
    scene_.render.tolerance = tolerance;
  }

  // The segment in pixel (4, 3): x = y = 1/8, heights from 3/4 to 0; light `rgb` all alike.
  SegmentDetails details(double rgb, double transparency) {
    const Projector projector(scene_.camera, scene_.image);
    const Frame frame(mesh_, scene_, projector, Details::bounded);
    HigherOrderDetails described(frame, kTile);
    described.enter(0);
    const auto [front, back, scale] = place(projector);
    return described.describe(
        {kX, kY, front, back, scale, visible_, PlainRadiance{{rgb, rgb, rgb}, transparency}});
  }

  // The bounds of the segment but for its quadrature, of fields that are evaluated up to `aside`
  // further from the ray than rounding takes them.
  SegmentDetails bounds_beside_quadrature(double transparency, double aside = 0) {
    const Projector projector(scene_.camera, scene_.image);
    const Frame frame(mesh_, scene_, projector, Details::bounded);
    VolumeAlongRay volume(frame, kTile);
    volume.enter(0);
    const auto nodes = relative_positions(mesh_, 0, projector);
    const CellMap map(CellKind::tetrahedron10, nodes, frame.straightness);
    CellErrors errors(frame, volume.longest());
    RayDisplacement displacement = ray_displacement(frame, 0);
    displacement.aside += aside;
    errors.enter(0, nodes, volume.color(), volume.extinction(), displacement);
    const auto [front, back, scale] = place(projector);
    const CellCrossing crossing = planar_crossing(projector, kX, kY, front, back);
    SegmentDetails details{.front = front, .back = back, .first = front};
    details.transparency = transparency;
    errors.add(crossing, stretch_of(projector, crossing), scale,
               FieldAlongRay(CellKind::tetrahedron10, map, volume.fields()), {}, details);
    return details;
  }

  static constexpr double kHeight = 0.75;
  ZooMesh mesh_;
  double visible_ = 1;  // the transparency in front of the segment
  Scene scene_;

 private:
  static constexpr int kX = 4, kY = 3;
  static constexpr TileRect kTile{0, 0, 8, 8};

  struct Place {
    double front, back, scale;  // ray parameters, and world length per unit of them
  };
  static Place place(const Projector& projector) {
    const double start = projector.distance(0), scale = projector.distance(1) - start;
    return {(4 - kHeight - start) / scale, (4 - start) / scale, scale};
  }
};

// Simpson's rule on a thousand panels: to 1e-14.
long double true_light(long double height) {
  constexpr int kPanels = 1000;
  const auto at = [&](long double z) {
    return 30 * z * z * z * z * std::exp(-10 * (height * height * height - z * z * z));
  };
  long double sum = 0;
  for (int i = 0; i < kPanels; ++i) {
    const long double a = height * i / kPanels, b = height * (i + 1) / kPanels;
    sum += (b - a) / 6 * (at(a) + 4 * at((a + b) / 2) + at(b));
  }
  return sum;
}

// What is drawn may be anything: how far it is from the integral made for the bound is claimed, and
// the bound of that integral besides. Of light that is drawn too bright and too dark by as much the
// two claims tell both.
TEST_F(HigherOrderDetailsTest, ClaimsHowFarDrawnAndBoundedLightAreApartAndTheBound) {
  constexpr double kOff = 0.2;
  const double transparency = std::exp(-10 * kHeight * kHeight * kHeight);
  const auto truth = static_cast<double>(true_light(kHeight));
  const double above = details(truth + kOff, transparency).radiance_error;
  const double below = details(truth - kOff, transparency).radiance_error;
  const double bound = (above + below) / 2 - kOff, integral_off = (below - above) / 2;
  EXPECT_LE(std::abs(integral_off), bound);
  EXPECT_GT(bound, 1e-7) << "a tolerance of 0.01 leaves a quadrature's error";
  EXPECT_LE(bound, 1e-2);
}

// In an opaque medium whose colour falls from the height at the front to 0, and behind so much that
// the middle's colour is near enough: the light is that of the front, and the quadrature is wrong
// by nearly all that it claims.
TEST_F(HigherOrderDetailsTest, ClaimsWhatTheQuadratureIsWrongBy) {
  constexpr double kOff = 1, kExtinction = 200;
  mesh_.fields.clear();
  test::add_node_field(mesh_, "f", [](const test::Position& p) { return p[2]; });
  scene_.volume.extinction->points = {{0, {kExtinction}}};
  visible_ = 1e-4;
  // int_0^h (h - s) k exp(-k s) ds
  const double truth = kHeight + std::expm1(-kExtinction * kHeight) / kExtinction;
  const double above = details(truth + kOff, 0).radiance_error;
  const double below = details(truth - kOff, 0).radiance_error;
  const double bound = (above + below) / 2 - kOff, integral_off = (above - below) / 2;
  EXPECT_NEAR(integral_off, kHeight / 2 - 1 / kExtinction, 1e-3);
  EXPECT_LE(integral_off, bound);
  EXPECT_GE(integral_off, 0.95 * bound);
}

// The bound of a transparency's quadrature is for rounding alone, of which no case needs all: it is
// told by what integrate_segment claims of z^2, and by the other bounds.
TEST_F(HigherOrderDetailsTest, AddsTheBoundOfTheTransparencysQuadrature) {
  constexpr double kOff = 0x1p-40;  // drawn transparencies are exact
  scene_.render.tolerance = 1e-9;
  const SegmentRadiance alone = integrate_segment(
      {BernsteinPolynomial(std::array{kHeight * kHeight, 0.0, 0.0}),
       BernsteinPolynomial(std::array{kHeight * kHeight, 0.0, 0.0}), kHeight},
      PiecewiseLinear<3>(scene_.volume.color->points),
      PiecewiseLinear<1>(scene_.volume.extinction->points), Glow::chromaticity, 1e-9);
  double sum = 0;
  for (const double drawn : {alone.transparency - kOff, alone.transparency + kOff})
    sum +=
        details(0, drawn).transparency_error - bounds_beside_quadrature(drawn).transparency_error;
  EXPECT_GT(alone.transparency_error, 1e-17);
  EXPECT_NEAR(sum / 2 - kOff, alone.transparency_error, 0.01 * alone.transparency_error);
}

// Of what is drawn as far above the truth as below it.
TEST_F(HigherOrderDetailsTest, ClaimsHowFarTransparenciesAreApart) {
  constexpr double kOff = 0.01;
  const double truth = std::exp(-10 * kHeight * kHeight * kHeight);
  for (const double off : {-kOff, kOff}) {
    EXPECT_GE(details(0, truth + off).transparency_error, kOff * (1 - 1e-12));
    EXPECT_LE(details(0, truth + off).transparency_error, kOff + 1e-3);
  }
  EXPECT_LE(details(0, truth).transparency_error, 1e-3);
}

// Fields whose gradients are 1 and 3, evaluated up to 1e-6 from the ray: extinction that is wrong
// by 30 times as much over the segment's length, and colour by three times as much.
TEST_F(HigherOrderDetailsTest, ClaimsWhatFieldsDifferByBesideTheRay) {
  constexpr double kAside = 1e-6, kTransparency = 0.75;
  scene_.render.tolerance = 1e-9;
  mesh_.fields.clear();
  test::add_node_field(mesh_, "f", [](const test::Position& p) { return p[2]; });
  test::add_node_field(mesh_, "g", [](const test::Position& p) { return 3 * p[2]; });
  const auto grown_by = [&](double SegmentDetails::*bound) {
    return bounds_beside_quadrature(kTransparency, kAside).*bound -
           bounds_beside_quadrature(kTransparency).*bound;
  };
  const double of_extinction = kTransparency * kHeight * 30 * kAside;
  EXPECT_NEAR(grown_by(&SegmentDetails::transparency_error), of_extinction, 1e-4 * of_extinction);
  scene_.volume.extinction->points = {{0, {2}}};
  for (const double gradient : {1.0, 3.0}) {
    scene_.volume.color->field = gradient == 1 ? "f" : "g";
    const double of_color = (1 - kTransparency) * gradient * kAside;
    EXPECT_NEAR(grown_by(&SegmentDetails::radiance_error), of_color, 1e-4 * of_color);
  }
}

}  // namespace
}  // namespace hiac
