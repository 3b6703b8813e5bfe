// Pictures of fields that are polynomials in the world in every cell.

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/frame/renderable.hpp"
#include "tests/render/truth/general_meshes.hpp"

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

// Cells that are splatted show the field at their centres of gravity, where a linear one has the
// same value in either interpolation.
TEST(WorldPolynomialPictures, SplatsHaveTheValueAtTheCentre) {
  ZooMesh mesh =
      test::moved(test::of_order(test::wedge_grid(2), CellOrder::quadratic), [](const Position& p) {
        return Position{p[0] + 3, p[1] - 2, p[2] + 0.3 * p[0]};
      });
  test::add_node_field(mesh, "f", [](const Position& p) { return 0.3 * (p[0] - 3) + 0.5 * p[2]; });
  Scene scene = cube_scene(Projection::perspective, 20, 18);
  scene.camera.eye[0] += 3;
  scene.camera.eye[1] -= 2;
  scene.camera.look_at[0] += 3;
  scene.camera.look_at[1] -= 2;
  scene.render.splat_below = 1000;
  const RenderResult expected = test::draw(mesh, scene);
  ASSERT_EQ(expected.statistics.splatted_cells, mesh.cell_count());
  scene.render.interpolation = Interpolation::polynomial;
  EXPECT_LE(difference(test::draw(mesh, scene).image, expected.image), 1e-12);
  EXPECT_GT(std::ranges::max(expected.image.values()), 0.1);
}

// What the paper's functions have exactly, they have in cells that are bent as one likes, where the
// isoparametric interpolant has linear fields alone.
TEST(WorldPolynomialPictures, HasItsOwnMonomialsOnDistortedCells) {
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

// On straight tetrahedra, on bricks of the paper's kinds along the axes, and on other bricks and
// prisms that are affine, however they lie, both are the same.
TEST(WorldPolynomialPictures, IsTheIsoparametricInterpolantOfManyAffineCells) {
  const auto any = [](const Position& p) {
    return 0.5 + 0.4 * std::sin(5 * p[0] + 3 * p[1]) * std::cos(4 * p[2]);
  };
  const auto expect_same = [&](const ZooMesh& mesh) {
    EXPECT_LE(difference(picture(mesh, any, Interpolation::polynomial),
                         picture(mesh, any, Interpolation::isoparametric)),
              1e-12)
        << kind_name(mesh.kinds[0]);
  };
  for (const CellOrder order : {CellOrder::linear, CellOrder::quadratic})
    for (const Cut cut : {Cut::bricks, Cut::tetrahedra})
      expect_same(test::of_order(test::structured(2, cut), order));
  const auto sheared = [](Cut cut, CellOrder order) {
    return test::of_order(test::moved(test::structured(2, cut), test::sheared), order);
  };
  expect_same(sheared(Cut::prisms, CellOrder::quadratic));
  expect_same(sheared(Cut::prisms, CellOrder::cubic));
  expect_same(sheared(Cut::bricks, CellOrder::cubic));
}

std::string refusal(const ZooMesh& mesh) {
  try {
    picture(mesh, test::smooth_field, Interpolation::polynomial);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(WorldPolynomialPictures, RefusesCellsThatHaveNone) {
  const double c = std::sqrt(0.5);
  const auto turned = [c](const Position& p) {
    return Position{c * (p[0] - p[1]), c * (p[0] + p[1]), p[2]};
  };
  EXPECT_NE(refusal(test::moved(test::structured(1, Cut::bricks), turned))
                .find("do not determine the paper's function"),
            std::string::npos);
  const ZooMesh pyramids = test::structured(1, Cut::pyramids);
  EXPECT_EQ(refusal(test::moved(pyramids, turned)), "");
  const auto flat = [](const Position& p) { return Position{p[0], p[1], 0}; };
  EXPECT_NE(refusal(test::moved(pyramids, flat)).find("do not determine a polynomial"),
            std::string::npos);
}

struct NamedMesh {
  const char* name;
  ZooMesh mesh;
};

// Of the unit cube, n cubes to an edge.
std::vector<NamedMesh> meshes_of_all_shapes(std::size_t n) {
  return {{"tetrahedra", test::structured(n, Cut::tetrahedra)},
          {"pyramids", test::structured(n, Cut::pyramids)},
          {"prisms", test::structured(n, Cut::prisms)},
          {"wedges", test::wedge_grid(n)},
          {"bricks", test::structured(n, Cut::bricks)}};
}

// A volume and an isosurface of a polynomial field do not show of what cells they are made: of any
// shape, no two of them alike, with twisted faces or with curved ones. Isoparametric interpolants
// have linear fields alone there.
void expect_pictures_of(const test::ScalarFunction& field, CellOrder order,
                        std::initializer_list<CellShape> shapes) {
  const ZooMesh fine = test::of_order(test::structured(1, Cut::tetrahedra), CellOrder::cubic);
  const auto warped = [](const Position& p) { return test::warped(p, 0.08); };
  for (const auto& [name, cells] : meshes_of_all_shapes(2)) {
    if (std::ranges::find(shapes, shape_of(cells.kinds[0])) == shapes.end()) continue;
    const ZooMesh twisted = test::of_order(test::moved(cells, warped), order);
    const ZooMesh curved = test::moved(test::of_order(cells, order), test::bent);
    for (const bool surface : {false, true}) {
      const Image expected = picture(fine, field, Interpolation::isoparametric, surface);
      for (const ZooMesh& mesh : {twisted, curved}) {
        EXPECT_LE(difference(picture(mesh, field, Interpolation::polynomial, surface), expected),
                  1e-11)
            << name;
        if (shape_of(mesh.kinds[0]) == CellShape::tetrahedron) continue;
        EXPECT_GT(difference(picture(mesh, field, Interpolation::isoparametric, surface), expected),
                  1e-6)
            << name;
      }
    }
  }
}

double quadratic_field(const Position& p) {
  return 0.2 + 0.3 * p[0] - 0.2 * p[1] * p[2] + 0.4 * p[0] * p[0] + 0.3 * p[2] * p[2];
}

TEST(WorldPolynomialPictures, DrawsQuadraticFieldsExactlyOnDistortedCells) {
  for (const CellOrder order : {CellOrder::quadratic, CellOrder::cubic})
    expect_pictures_of(quadratic_field, order,
                       {CellShape::tetrahedron, CellShape::pyramid, CellShape::prism,
                        CellShape::wedge, CellShape::brick});
}

TEST(WorldPolynomialPictures, DrawsCubicFieldsExactlyOnDistortedCells) {
  const auto field = [](const Position& p) {
    return quadratic_field(p) + 0.4 * p[0] * p[1] * p[2] - 0.3 * p[1] * p[1] * p[1] +
           0.2 * p[0] * p[2] * p[2];
  };
  expect_pictures_of(field, CellOrder::cubic,
                     {CellShape::tetrahedron, CellShape::wedge, CellShape::brick});
}

double mean_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i)
    sum += std::abs(a.values()[i] - b.values()[i]);
  return sum / static_cast<double>(a.values().size());
}

// The order of the mean error from 4 wedges to an edge to 8, of a smooth field without bends in
// colour and extinction.
double order_of_convergence(CellOrder order, Interpolation interpolation) {
  const auto smooth = [](const Position& p) {
    return 0.5 + 0.28 * std::sin(2.2 * p[0] + 0.7 * p[1]) * std::cos(1.7 * p[2] - 0.9 * p[1] + 0.4);
  };
  const auto draw = [&](const ZooMesh& linear, CellOrder of_order) {
    ZooMesh mesh = test::of_order(test::moved(linear, test::sheared), of_order);
    test::add_node_field(mesh, "f", smooth);
    Scene scene = cube_scene(Projection::perspective, 20, 18);
    scene.volume.color->points = {{0, {0.1, 0.2, 0.9}}, {1, {0.9, 0.6, 0.1}}};
    scene.volume.extinction->points = {{0, {0.5}}, {1, {4}}};
    scene.render.tolerance = 1e-10;
    scene.render.interpolation = interpolation;
    return test::draw(mesh, scene).image;
  };
  const Image exact = draw(test::structured(16, Cut::tetrahedra), CellOrder::cubic);
  const double coarse = mean_difference(draw(test::wedge_grid(4), order), exact);
  const double fine = mean_difference(draw(test::wedge_grid(8), order), exact);
  return std::log2(coarse / fine);
}

TEST(WorldPolynomialPictures, WedgesConvergeWithTheirOrder) {
  EXPECT_GT(order_of_convergence(CellOrder::quadratic, Interpolation::polynomial), 3);
  EXPECT_GT(order_of_convergence(CellOrder::cubic, Interpolation::polynomial), 3.6);
  for (const CellOrder order : {CellOrder::quadratic, CellOrder::cubic})
    EXPECT_LT(order_of_convergence(order, Interpolation::isoparametric), 2.4);
}

}  // namespace
}  // namespace hiac
