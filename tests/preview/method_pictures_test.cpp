#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/preview/drawn.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::preview {
namespace {

using test::accurate;
using test::drawn;
using test::Drawn;
using test::Errors;
using test::errors;

constexpr Method kMethods[] = {Method::interpolated_opacity, Method::mean_color, Method::tables,
                               Method::exact_at_vertices};

ZooMesh with_field(ZooMesh mesh) {
  test::add_node_field(mesh, "f", test::smooth_field);
  return mesh;
}

TEST(MethodPictures, ErrorsFallFromM0ToM3OnSmoothScenes) {
  const ZooMesh mesh = with_field(test::random_delaunay(300, 5));
  for (const Projection projection : {Projection::orthographic, Projection::perspective})
    for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
      const Scene scene = test::smooth_scene(projection, glow);
      const Image truth = accurate(mesh, scene);
      double before = 1;
      for (const Method method : kMethods) {
        const Drawn picture = drawn(mesh, scene, method);
        const Errors found = errors(picture.image, truth);
        EXPECT_LE(found.rms, before * 1.001) << "M" << static_cast<int>(method);
        before = found.rms;
      }
    }
}

// Where cells reach far out of the picture, they are clipped beside it.
TEST(MethodPictures, AShiftedPictureShowsTheSamePixelsElsewhere) {
  const ZooMesh mesh = with_field(test::random_delaunay(20, 5));
  for (const Projection projection : {Projection::orthographic, Projection::perspective})
    for (const double part : {1.0, 1e-3}) {
      Scene scene = test::smooth_scene(projection, Glow::chromaticity);
      scene.camera.height *= part;
      scene.camera.fov *= part;
      const auto width = static_cast<int>(scene.image.width);
      const auto height = static_cast<int>(scene.image.height);
      const int right = -2 * width / 5, below = -height / 3;
      Scene shifted = scene;
      shifted.camera.shift = {static_cast<double>(right), static_cast<double>(below)};
      for (const Method method : kMethods) {
        const Image plain = drawn(mesh, scene, method).image;
        const Image moved = drawn(mesh, shifted, method).image;
        double alpha = 0;
        for (int y = 0; y < height + below; ++y)
          for (int x = 0; x < width + right; ++x) {
            const auto here = moved.pixel(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
            const auto there = plain.pixel(static_cast<std::size_t>(x - right),
                                           static_cast<std::size_t>(y - below));
            for (std::size_t c = 0; c < 4; ++c)
              ASSERT_NEAR(here[c], there[c], 1e-4) << x << ' ' << y;
            alpha += here[3];
          }
        EXPECT_GT(alpha, 100);
      }
    }
}

// Alpha of a medium of extinction 1.5 in the unit cube: every pixel's optical depth in closed form.
double cube_alpha(const Scene& scene, double tau, std::uint32_t x, std::uint32_t y) {
  const Projector projector(scene.camera, scene.image);
  const auto origin = projector.origin(x + 0.5, y + 0.5);
  const auto direction = projector.direction(x + 0.5, y + 0.5);
  double enter = projector.near(), leave = projector.far();
  for (std::size_t c = 0; c < 3; ++c) {
    if (direction[c] == 0) {
      if (origin[c] < 0 || origin[c] > 1) return 0;
      continue;
    }
    const double p = -origin[c] / direction[c], q = (1 - origin[c]) / direction[c];
    enter = std::max(enter, std::min(p, q));
    leave = std::min(leave, std::max(p, q));
  }
  const double length = projector.ray_scale(x + 0.5, y + 0.5) * std::max(0.0, leave - enter);
  return -std::expm1(-tau * length);
}

void expect_homogeneous(const ZooMesh& mesh, const Scene& given, const std::string& what,
                        double most = 1e-5) {
  constexpr double kTau = 1.5;
  Scene scene = given;
  scene.volume.extinction = ExtinctionTransfer{"f", {{0, {kTau}}}};
  for (const Method method : {Method::mean_color, Method::exact_at_vertices}) {
    const Image image = drawn(mesh, scene, method).image;
    double largest = 0;
    int wrong = 0;
    for (std::uint32_t y = 0; y < scene.image.height; ++y)
      for (std::uint32_t x = 0; x < scene.image.width; ++x) {
        const double error = std::abs(image.at(x, y, 3) - cube_alpha(scene, kTau, x, y));
        wrong += error > most ? 1 : 0;
        largest = std::max(largest, error);
      }
    EXPECT_EQ(wrong, 0) << what << ": largest error " << largest;
  }
}

TEST(MethodPictures, AHomogeneousMediumHasItsOpacityAtEveryPixel) {
  const ZooMesh delaunay = with_field(test::random_delaunay(2000, 7));
  const ZooMesh lattice = with_field(test::structured(6, test::Cut::tetrahedra));
  // cells in which every term of the opacity's series counts
  const ZooMesh large = with_field(test::structured(1, test::Cut::tetrahedra));
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    const std::string name = projection == Projection::perspective ? "perspective" : "parallel";
    Scene scene = test::smooth_scene(projection, Glow::chromaticity);
    scene.image = {400, 300};
    expect_homogeneous(delaunay, scene, name + ", Delaunay");
    expect_homogeneous(lattice, scene, name + ", lattice");
    expect_homogeneous(large, scene, name + ", six cells", 2e-6);
    // along an axis; nodes of the lattice meet on the screen, in parallel projection all of them
    scene.camera.eye = {0.5, 0.5, 3};
    scene.camera.up = {0, 1, 0};
    expect_homogeneous(delaunay, scene, name + ", Delaunay along z");
    expect_homogeneous(lattice, scene, name + ", lattice along z");
  }
}

}  // namespace
}  // namespace hiac::preview
