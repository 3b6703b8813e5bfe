// Quadratic and cubic cells of every shape with straight edges, against brute force.

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/frame/renderable.hpp"
#include "hiac/render/cells/general_cells.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/render/truth/polyhedron_reference.hpp"

namespace hiac {
namespace {

using test::cube_scene;
using test::Cut;

struct NamedMesh {
  const char* name;
  ZooMesh mesh;
};

std::vector<NamedMesh> linear_meshes() {
  return {{"tetrahedra", test::structured(1, Cut::tetrahedra)},
          {"pyramids", test::structured(1, Cut::pyramids)},
          {"prisms", test::structured(1, Cut::prisms)},
          {"wedges", test::two_wedges()},
          {"bricks", test::structured(1, Cut::bricks)}};
}

// Random values: interpolants overshoot them.
ZooMesh of_random_field(const ZooMesh& linear, CellOrder order,
                        test::Position (*map)(const test::Position&)) {
  ZooMesh mesh = test::of_order(test::moved(linear, map), order);
  test::add_random_field(mesh, "f", FieldLocation::node, 15);
  return mesh;
}

struct Errors {
  double largest = 0;       // of any channel
  double unaccounted = -1;  // of what it exceeds the error channel by
};

Errors errors_of(const ZooMesh& mesh, const Scene& scene) {
  check_renderable(mesh, scene);
  const std::array channels{Channel::error};
  const VisibilityOrder order = test::sorted(mesh, scene);
  const RenderResult result = render(mesh, order, scene, false, nullptr, channels);
  EXPECT_EQ(result.statistics.violations, 0U);
  Errors errors;
  for (std::uint32_t y = 0; y < scene.image.height; ++y)
    for (std::uint32_t x = 0; x < scene.image.width; ++x) {
      const auto expected = test::polyhedron_reference(mesh, scene, x + 0.5, y + 0.5);
      double here = 0;
      for (std::size_t c = 0; c < 4; ++c)
        here = std::max(here, std::abs(expected[c] - result.image.at(x, y, c)));
      errors.largest = std::max(errors.largest, here);
      errors.unaccounted = std::max(errors.unaccounted, here - result.image.at(x, y, 4));
    }
  return errors;
}

class HigherOrders : public testing::TestWithParam<CellOrder> {};

TEST_P(HigherOrders, VolumesAgreeWithBruteForce) {
  for (const auto& [name, linear] : linear_meshes())
    for (const auto map : {test::sheared, test::tapered})
      for (const double tolerance : {1e-9, 1e-13}) {
        const ZooMesh mesh = of_random_field(linear, GetParam(), map);
        const bool odd = (map == test::tapered) == (tolerance == 1e-9);
        Scene scene = cube_scene(odd ? Projection::perspective : Projection::orthographic, 4, 4);
        if (odd) scene.volume.glow = Glow::emission;
        scene.render.tolerance = tolerance;
        const Errors errors = errors_of(mesh, scene);
        EXPECT_LE(errors.largest, tolerance == 1e-9 ? 1e-9 : 1e-12) << name;
        EXPECT_LE(errors.unaccounted, 0) << name;
      }
}

TEST_P(HigherOrders, IsosurfacesAgreeWithBruteForce) {
  for (const auto& [name, linear] : linear_meshes()) {
    const ZooMesh mesh = of_random_field(linear, GetParam(), test::tapered);
    Scene scene = cube_scene(Projection::perspective, 4, 4);
    for (const double value : {0.2, 0.52, 1.05}) {
      Isosurface surface;
      surface.field = "f";
      surface.value = value;
      surface.opacity = value;
      surface.color = {1 - value, 0.4, value};
      if (value > 1) surface.opacity = 0.6;
      scene.isosurfaces.push_back(surface);
    }
    const Errors errors = errors_of(mesh, scene);
    EXPECT_LE(errors.largest, 1e-11) << name;
    EXPECT_LE(errors.unaccounted, 0) << name;
  }
}

// Fields that a kind has exactly give the picture that another mesh of the same body gives.
double difference_of(const ZooMesh& a, const ZooMesh& b, const test::ScalarFunction& field) {
  const Scene scene = cube_scene(Projection::perspective, 24, 20);
  const auto picture = [&](ZooMesh mesh) {
    test::add_node_field(mesh, "f", field);
    return test::draw(mesh, scene).image;
  };
  const Image one = picture(a), other = picture(b);
  double largest = 0;
  for (std::size_t i = 0; i < one.values().size(); ++i)
    largest = std::max(largest, std::abs(one.values()[i] - other.values()[i]));
  return largest;
}

TEST_P(HigherOrders, LinearFieldsAreExactOnDistortedCells) {
  const auto linear = [](const test::Position& p) { return 0.5 + 0.4 * p[0] - 0.3 * p[1]; };
  const ZooMesh cube = test::moved(test::structured(1, Cut::tetrahedra), test::tapered);
  for (const auto& [name, cells] : linear_meshes()) {
    const ZooMesh bent = test::moved(cells, test::tapered);
    const ZooMesh& same_body = bent.kinds[0] == CellKind::wedge7 ? bent : cube;
    EXPECT_LE(difference_of(test::of_order(bent, GetParam()), same_body, linear), 1e-12) << name;
  }
}

// Complete polynomials, where the kind has them (shape_functions.hpp).
TEST_P(HigherOrders, PolynomialsAreExactOnAffineCells) {
  const bool is_cubic = GetParam() == CellOrder::cubic;
  const auto quadratic = [](const test::Position& p) {
    return 0.3 + 0.5 * p[0] * p[0] - 0.4 * p[1] * p[2] + 0.3 * p[2];
  };
  const auto cubic = [&](const test::Position& p) {
    return quadratic(p) + 0.4 * p[0] * p[1] * p[2] - 0.2 * p[1] * p[1] * p[1];
  };
  const ZooMesh exact = test::of_order(
      test::moved(test::structured(1, Cut::tetrahedra), test::sheared), CellOrder::cubic);
  for (const auto& [name, cells] : linear_meshes()) {
    if (cells.kinds[0] == CellKind::wedge7) continue;
    const ZooMesh mesh = test::of_order(test::moved(cells, test::sheared), GetParam());
    EXPECT_LE(difference_of(mesh, exact, quadratic), 1e-12) << name;
    const CellShape shape = shape_of(mesh.kinds[0]);
    if (!is_cubic || (shape != CellShape::brick && shape != CellShape::tetrahedron)) continue;
    EXPECT_LE(difference_of(mesh, exact, cubic), 1e-12) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, HigherOrders,
                         testing::Values(CellOrder::quadratic, CellOrder::cubic),
                         [](const auto& instance) {
                           return instance.param == CellOrder::cubic ? "Cubic" : "Quadratic";
                         });

}  // namespace
}  // namespace hiac
