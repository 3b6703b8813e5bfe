#include "hiac/render/world_polynomial.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/render/renderable.hpp"
#include "tests/render/general_meshes.hpp"

namespace hiac {
namespace {

using test::cube_scene;
using test::Cut;
using test::Position;

Image picture(ZooMesh mesh, const test::ScalarFunction& field, Interpolation interpolation,
              bool with_surface = false) {
  test::add_node_field(mesh, "f", field);
  Scene scene = cube_scene(Projection::perspective, 20, 18);
  scene.render.interpolation = interpolation;
  if (with_surface) {
    Isosurface surface;
    surface.field = "f";
    surface.value = 0.5;
    surface.opacity = 0.5;
    scene.isosurfaces.push_back(surface);
  }
  check_renderable(mesh, scene);
  return test::draw(mesh, scene).image;
}

double difference(const Image& a, const Image& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i)
    most = std::max(most, std::abs(a.values()[i] - b.values()[i]));
  return most;
}

// What the paper's functions have exactly, they have in cells that are bent as one likes, where the
// isoparametric interpolant has linear fields alone.
TEST(WorldPolynomial, HasItsOwnMonomialsOnDistortedCells) {
  const auto trilinear = [](const Position& p) {
    return 0.2 + 0.3 * p[0] - 0.2 * p[1] + 0.4 * p[0] * p[1] + 0.9 * p[0] * p[1] * p[2];
  };
  const auto quadratic = [](const Position& p) {
    return 0.2 + 0.3 * p[0] - 0.2 * p[1] * p[2] + 0.4 * p[0] * p[0] + 0.3 * p[2] * p[2];
  };
  const auto warped = [](const Position& p) { return test::warped(p, 0.08); };
  const ZooMesh fine = test::of_order(test::structured(1, Cut::tetrahedra), CellOrder::cubic);
  const ZooMesh bricks = test::moved(test::structured(2, Cut::bricks), warped);
  const ZooMesh curved = test::moved(
      test::of_order(test::structured(2, Cut::bricks), CellOrder::quadratic), test::bent);
  for (const bool surface : {false, true}) {
    const Image expected = picture(fine, trilinear, Interpolation::isoparametric, surface);
    EXPECT_LE(difference(picture(bricks, trilinear, Interpolation::polynomial, surface), expected),
              1e-11);
    EXPECT_GT(
        difference(picture(bricks, trilinear, Interpolation::isoparametric, surface), expected),
        1e-5);
  }
  const Image expected = picture(fine, quadratic, Interpolation::isoparametric);
  EXPECT_LE(difference(picture(curved, quadratic, Interpolation::polynomial), expected), 1e-11);
  EXPECT_GT(difference(picture(curved, quadratic, Interpolation::isoparametric), expected), 1e-5);
}

// On bricks along the axes and on straight tetrahedra both are the same.
TEST(WorldPolynomial, IsTheIsoparametricInterpolantOfBoxes) {
  const auto any = [](const Position& p) {
    return 0.5 + 0.4 * std::sin(5 * p[0] + 3 * p[1]) * std::cos(4 * p[2]);
  };
  for (const CellOrder order : {CellOrder::linear, CellOrder::quadratic})
    for (const Cut cut : {Cut::bricks, Cut::tetrahedra}) {
      const ZooMesh mesh = test::of_order(test::structured(2, cut), order);
      EXPECT_LE(difference(picture(mesh, any, Interpolation::polynomial),
                           picture(mesh, any, Interpolation::isoparametric)),
                1e-12);
    }
}

std::string refusal(const ZooMesh& mesh) {
  try {
    picture(mesh, test::smooth_field, Interpolation::polynomial);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(WorldPolynomial, RefusesCellsThatHaveNone) {
  EXPECT_NE(refusal(test::structured(1, Cut::pyramids)).find("pyramid5 found"), std::string::npos);
  const double c = std::sqrt(0.5);
  const ZooMesh turned = test::moved(test::structured(1, Cut::bricks), [c](const Position& p) {
    return Position{c * (p[0] - p[1]), c * (p[0] + p[1]), p[2]};
  });
  EXPECT_NE(refusal(turned).find("do not determine"), std::string::npos);
}

TEST(WorldPolynomial, GradientIsItsDerivative) {
  ZooMesh mesh = test::moved(test::of_order(test::structured(1, Cut::bricks), CellOrder::quadratic),
                             test::tapered);
  std::vector<double> values;
  for (std::size_t k = 0; k < 20; ++k) values.push_back(std::sin(3.0 * static_cast<double>(k)));
  const auto polynomial = WorldPolynomial::through(mesh, 0, values);
  ASSERT_TRUE(polynomial);
  constexpr double kStep = 1e-5;
  const Position at{0.3, 0.2, 0.4};
  const auto gradient = polynomial->gradient(at);
  for (std::size_t c = 0; c < 3; ++c) {
    Position high = at, low = at;
    high[c] += kStep;
    low[c] -= kStep;
    EXPECT_NEAR(gradient[c], (polynomial->at(high) - polynomial->at(low)) / (2 * kStep), 1e-5);
  }
}

}  // namespace
}  // namespace hiac
