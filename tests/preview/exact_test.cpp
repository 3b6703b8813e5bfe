// The method `exact` against the accurate engine.
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "hiac/frame/projection.hpp"
#include "tests/preview/preview_support.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using test::benchmark_scene;
using test::delaunay_with_fields;
using test::lattice_with_fields;

constexpr double kLargest = 2e-5, kRms = 1e-6;

class ExactPreview : public test::WithDriver {};

TEST_F(ExactPreview, BothProjectionsGlowsAndSeparateFields) {
  const ZooMesh mesh = delaunay_with_fields(test::kInstrumented ? 40 : 150, 1);
  for (const Projection projection : {Projection::orthographic, Projection::perspective})
    for (const Glow glow : {Glow::chromaticity, Glow::emission})
      for (const char* color : {"f", "g"}) {
        Scene scene = benchmark_scene(projection, 120, 90);
        scene.volume.glow = glow;
        scene.volume.color->field = std::string(color);
        if (glow == Glow::emission) scene.camera.shift = {20.5, -13};
        SCOPED_TRACE(std::string(color) + (glow == Glow::emission ? " emission" : "") +
                     (projection == Projection::perspective ? " perspective" : ""));
        expect_close(mesh, scene, kLargest, kRms);
      }
}

TEST_F(ExactPreview, OtherCellsAreRefused) {
  for (const test::Cut cut : {test::Cut::bricks, test::Cut::prisms, test::Cut::pyramids}) {
    ZooMesh mesh = test::structured(2, cut);
    test::add_node_field(mesh, "f", test::smooth_field);
    const Scene scene = benchmark_scene(Projection::orthographic, 10, 10);
    EXPECT_THROW((void)preview_of(mesh, scene), std::invalid_argument);
  }
}

// Cameras and meshes anywhere, one transfer function, which shaders are compiled for once.
TEST_F(ExactPreview, RandomScenes) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (std::uint64_t k = 0; k < 20; ++k) {
    const ZooMesh mesh = delaunay_with_fields(20 + 15 * k, k);
    Scene scene =
        benchmark_scene(k % 2 == 0 ? Projection::orthographic : Projection::perspective, 97, 83);
    const double distance = 1.2 + 6 * unit(random), angle = 6.283 * unit(random);
    const double height = 2 * unit(random) - 1;
    scene.camera.eye = {0.5 + distance * std::cos(angle), 0.5 + distance * std::sin(angle),
                        0.5 + distance * height};
    scene.camera.fov = 10 + 60 * unit(random);
    scene.camera.height = 0.3 + 2 * unit(random);
    SCOPED_TRACE(k);
    expect_close(mesh, scene, kLargest, kRms);
  }
}

TEST_F(ExactPreview, ViewsAlongTheAxesAndDiagonalsOfALattice) {
  const ZooMesh mesh = lattice_with_fields(5);
  // sizes that put projected faces on and between pixel centres
  for (const Projection projection : {Projection::orthographic, Projection::perspective})
    for (const std::uint32_t size : {100U, 101U, 120U})
      for (const test::Position& way :
           {test::Position{1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {1, 1, 0}, {0, -1, 1}, {1, 1, 1}}) {
        Scene scene = benchmark_scene(projection, size, size);
        for (std::size_t c = 0; c < 3; ++c) scene.camera.eye[c] = 0.5 + 3 * way[c];
        scene.camera.up =
            way[2] != 0 ? std::array<double, 3>{1, -1, 0} : std::array<double, 3>{0, 0, 1};
        scene.camera.height = 1.2;
        SCOPED_TRACE(testing::Message() << size << " pixels along " << way[0] << way[1] << way[2]);
        expect_close(mesh, scene, kLargest, kRms);
      }
}

// Rays through pixel centres run along edges and faces that are far narrower than a pixel, and pass
// from one cell to the other half way. The mesh's own sides are beside the picture.
TEST_F(ExactPreview, FacesThatAreNearlyEdgeOn) {
  const ZooMesh mesh = lattice_with_fields(5);
  for (const double width : {1.1e-4, 5e-5, 2e-5}) {  // of a face, pixels
    Scene scene = benchmark_scene(Projection::orthographic, 120, 120);
    scene.camera.height = 0.75;  // 32 pixels a cube
    scene.camera.up = {0, 1, 0};
    const double middle = 0.5 + 0.5 / 160, tilt = width / 32;
    scene.camera.look_at = {middle, middle, 0.5};
    scene.camera.eye = {middle + 3 * tilt, middle + 3 * tilt, 3.5};
    SCOPED_TRACE(width);
    expect_close(mesh, scene, 2e-6, kRms);
  }
}

TEST_F(ExactPreview, EyesInsideTheMesh) {
  for (const ZooMesh& mesh : {delaunay_with_fields(200, 3), lattice_with_fields(4)})
    for (const test::Position& eye :
         {test::Position{0.52, 0.47, 0.31}, {0.5, 0.5, 0.5}, {1.02, 0.5, 0.5}}) {
      Scene scene = benchmark_scene(Projection::perspective, 100, 80);
      scene.camera.eye = eye;
      scene.camera.look_at = {0.1, 0.2, 0.8};
      scene.camera.fov = 75;
      expect_close(mesh, scene, kLargest, kRms);
    }
}

// A few large cells, in which every term of the series counts.
TEST_F(ExactPreview, PiecesOfLargeOpticalDepth) {
  ZooMesh mesh = test::structured(1, test::Cut::tetrahedra);
  test::add_node_field(mesh, "f", [](const test::Position& p) { return p[0]; });
  for (const Glow glow : {Glow::chromaticity, Glow::emission})
    for (const double tau : {1.0, 3.0, 40.0}) {
      Scene scene = benchmark_scene(Projection::orthographic, 60, 50);
      scene.volume.glow = glow;
      scene.volume.color->points = {{0, {1, 0, 0.5}}, {1, {0, 1, 0.5}}};
      scene.volume.extinction->points = {{0, {0}}, {1, {tau}}};
      SCOPED_TRACE(tau);
      expect_close(mesh, scene, 1e-6, 2e-7);
    }
}

// The unit cube in that many layers along z, each of six tetrahedra.
ZooMesh layered(std::size_t layers) {
  const std::vector<test::Cell> cube = test::cells_of(test::structured(1, test::Cut::tetrahedra));
  std::vector<test::Position> positions;
  std::vector<test::Cell> cells;
  for (std::size_t k = 0; k <= layers; ++k)
    for (const double y : {0.0, 1.0})
      for (const double x : {0.0, 1.0})
        positions.push_back({x, y, static_cast<double>(k) / static_cast<double>(layers)});
  for (std::size_t k = 0; k < layers; ++k)
    for (test::Cell cell : cube) {
      for (NodeId& node : cell.nodes) node += static_cast<NodeId>(4 * k);
      cells.push_back(cell);
    }
  return test::make_mesh(positions, cells);
}

// Roundings of a cell's transparency and opacity add up, as all cells of a ray are much alike.
TEST_F(ExactPreview, RaysThroughManyFaintCells) {
  ZooMesh mesh = layered(150);
  test::add_node_field(mesh, "f", [](const test::Position& p) { return p[2]; });
  for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
    Scene scene = benchmark_scene(Projection::orthographic, 24, 24);
    scene.volume.glow = glow;
    scene.volume.color->points = {{0, {1, 0, 0.5}}, {1, {0, 1, 0.5}}};
    scene.volume.extinction->points = {{0, {0.1}}, {1, {0.3}}};
    scene.camera.eye = {0.5, 0.5, 3};
    scene.camera.up = {0, 1, 0};
    scene.camera.height = 1.2;
    SCOPED_TRACE(glow == Glow::emission ? "emission" : "chromaticity");
    expect_close(mesh, scene, 2e-6, kRms);
  }
}

// More intervals than shaders choose among: they are looked up in tables.
TEST_F(ExactPreview, FunctionsOfManyBreakpoints) {
  const ZooMesh mesh = delaunay_with_fields(60, 12);
  for (const char* color : {"f", "g"}) {
    Scene scene = benchmark_scene(Projection::perspective, 80, 60);
    scene.volume.color->field = std::string(color);
    scene.volume.color->points.clear();
    for (int k = 0; k <= 400; ++k)
      scene.volume.color->points.push_back(
          {k / 400.0, {0.5 + 0.5 * std::sin(k / 9.0), 0.5 + 0.5 * std::cos(k / 31.0), k / 400.0}});
    scene.volume.extinction->points.clear();
    for (int k = 0; k <= 60; ++k)
      scene.volume.extinction->points.push_back({k / 60.0, {2 + 2 * std::sin(k / 2.0)}});
    SCOPED_TRACE(color);
    expect_close(mesh, scene, kLargest, kRms);
  }
}

TEST_F(ExactPreview, ClippingSlab) {
  const ZooMesh mesh = delaunay_with_fields(150, 4);
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    Scene scene = benchmark_scene(projection, 100, 80);
    scene.camera.clip = {{3.3, 3.8}};
    expect_close(mesh, scene, kLargest, kRms);
    scene.camera.clip = {{3.7, std::numeric_limits<double>::infinity()}};
    expect_close(mesh, scene, kLargest, kRms);
  }
}

TEST_F(ExactPreview, DenseMediaAndFarFromTheOrigin) {
  Scene scene = benchmark_scene(Projection::perspective, 100, 80);
  for (auto& point : scene.volume.extinction->points) point.value[0] *= 1000;
  const ZooMesh mesh = delaunay_with_fields(150, 5);
  expect_close(mesh, scene, kLargest, kRms);
  Scene far = benchmark_scene(Projection::perspective, 100, 80);
  const auto away = [](const test::Position& p) {
    return test::Position{p[0] + 1e6, p[1] - 1e6, p[2] + 1e6};
  };
  far.camera.eye = away(far.camera.eye);
  far.camera.look_at = away(far.camera.look_at);
  expect_close(test::moved(mesh, away), far, kLargest, kRms);
}

TEST_F(ExactPreview, StepsAndThinShells) {
  const ZooMesh mesh = delaunay_with_fields(150, 6);
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    Scene scene = benchmark_scene(projection, 100, 80);
    scene.volume.color->points = {
        {0.3, {1, 0, 0}}, {0.3, {0, 1, 0}}, {0.6, {0, 0, 1}}, {0.6, {1, 1, 0}}};
    scene.volume.extinction->points = {{0.2, {0}},  {0.2, {5}},     {0.4, {0}},
                                       {0.45, {0}}, {0.4505, {90}}, {0.451, {0}},
                                       {0.52, {0}}, {0.52, {9}},    {0.7, {1}}};
    expect_close(mesh, scene, 1e-3, kRms);
  }
}

// Rays that go up and down meet faces on which the field is a step's value, and pass cells in which
// it is that everywhere: steps are continuous from the right.
TEST_F(ExactPreview, StepsAtTheValuesOfFaces) {
  ZooMesh mesh = test::structured(4, test::Cut::tetrahedra);
  test::add_node_field(mesh, "f", [](const test::Position& p) { return std::min(p[0], 0.5); });
  test::add_node_field(mesh, "g", [](const test::Position& p) { return p[2] > 0.6 ? 0.5 : p[2]; });
  for (const char* color : {"f", "g"})
    for (const double side : {-1.0, 1.0}) {
      Scene scene = benchmark_scene(Projection::orthographic, 50, 50);
      scene.camera.eye = {0.5 + 3 * side, 0.3, 0.2 - side};
      scene.camera.look_at = {0.5, 0.5, 0.5};
      scene.volume.color->field = std::string(color);
      scene.volume.color->points = {
          {0.25, {1, 0, 0}}, {0.25, {0, 1, 0}}, {0.5, {0, 0, 1}}, {0.5, {1, 1, 0}}};
      scene.volume.extinction->points = {
          {0, {1}}, {0.25, {5}}, {0.25, {0.5}}, {0.5, {2}}, {0.5, {0.3}}};
      SCOPED_TRACE(std::string(color) + (side > 0 ? " down" : " up"));
      expect_close(mesh, scene, kLargest, kRms);
    }
}

TEST_F(ExactPreview, FieldsOfCellsAndCorners) {
  ZooMesh mesh = delaunay_with_fields(60, 8);
  std::vector<double> of_cells, of_corners;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    of_cells.push_back(0.1 + 0.8 * (cell % 17) / 16.0);
    for (std::size_t k = 0; k < 4; ++k)
      of_corners.push_back(0.2 + 0.6 * static_cast<double>((cell + 5 * k) % 13) / 12);
  }
  mesh.fields.push_back({"c", "", FieldLocation::cell, 1, std::move(of_cells)});
  mesh.fields.push_back({"k", "", FieldLocation::corner, 1, std::move(of_corners)});
  Scene scene = benchmark_scene(Projection::perspective, 100, 80);
  scene.volume.color->field = "c";
  scene.volume.extinction->field = "k";
  expect_close(mesh, scene, kLargest, kRms);
}

// Faces seen at any angle leave no holes: alpha is what the length of the ray in the cube says.
TEST_F(ExactPreview, HomogeneousMediumHasNoHoles) {
  const double tau = 0.8;
  for (const ZooMesh& mesh : {delaunay_with_fields(300, 9), lattice_with_fields(6)})
    for (const test::Position& eye :
         {test::Position{3.1, 2.3, 2.7}, {3.5, 0.5, 0.5}, {3.5, 3.5, 0.5}}) {
      Scene scene = benchmark_scene(Projection::orthographic, 150, 150);
      scene.camera.eye = eye;
      scene.volume.extinction->points = {{0, {tau}}};
      const Image image = preview_of(mesh, scene);
      const Projector projector(scene.camera, scene.image);
      double most = 0;
      for (std::uint32_t y = 0; y < 150; ++y)
        for (std::uint32_t x = 0; x < 150; ++x) {
          const auto origin = projector.origin(x + 0.5, y + 0.5);
          const auto direction = projector.direction(x + 0.5, y + 0.5);
          double front = -1e9, back = 1e9;
          for (std::size_t c = 0; c < 3; ++c) {
            if (std::abs(direction[c]) < 1e-12) {
              if (origin[c] < 0 || origin[c] > 1) back = -1e9;
              continue;
            }
            const double a = -origin[c] / direction[c], b = (1 - origin[c]) / direction[c];
            front = std::max(front, std::min(a, b));
            back = std::min(back, std::max(a, b));
          }
          const double expected = -std::expm1(-tau * std::max(back - front, 0.0));
          most = std::max(most, std::abs(image.at(x, y, 3) - expected));
        }
      EXPECT_LE(most, 1e-5);
    }
}

}  // namespace
}  // namespace hiac
