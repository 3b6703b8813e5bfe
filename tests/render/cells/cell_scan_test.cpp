#include "hiac/render/cells/cell_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/geometry/face_form.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac {
namespace {

using test::cube_scene;
using test::Cut;
using test::draw;
using test::Position;

struct NamedMesh {
  const char* name;
  ZooMesh mesh;
};

void add_constant_field(ZooMesh& mesh) {
  test::add_node_field(mesh, "f", [](const Position&) { return 0.5; });
}

// Meshes of the unit cube; those that are warped have bilinear faces inside it,
// and those that are curved or cubic parametric ones.
std::vector<NamedMesh> cubes() {
  std::vector<NamedMesh> meshes{{"bricks", test::structured(4, Cut::bricks)},
                                {"prisms", test::structured(4, Cut::prisms)},
                                {"pyramids", test::structured(4, Cut::pyramids)},
                                {"tetrahedra", test::structured(4, Cut::tetrahedra)},
                                {"mixed", test::mixed_columns(4)}};
  const auto warped = [](const Position& p) { return test::warped(p, 0.05); };
  for (const auto& [name, mesh] : {NamedMesh{"warped bricks", test::structured(4, Cut::bricks)},
                                   {"warped prisms", test::structured(4, Cut::prisms)},
                                   {"warped mixed", test::mixed_columns(4)}})
    meshes.push_back({name, test::moved(mesh, warped)});
  const auto of_order = [](const ZooMesh& mesh, CellOrder order) {
    return test::moved(test::of_order(mesh, order), test::bent);
  };
  meshes.push_back(
      {"curved tetrahedra", of_order(test::structured(2, Cut::tetrahedra), CellOrder::quadratic)});
  meshes.push_back({"curved mixed", of_order(test::mixed_columns(2), CellOrder::quadratic)});
  meshes.push_back({"cubic bricks", of_order(test::structured(2, Cut::bricks), CellOrder::cubic)});
  meshes.push_back({"cubic prisms", of_order(test::structured(2, Cut::prisms), CellOrder::cubic)});
  for (auto& [name, mesh] : meshes) add_constant_field(mesh);
  return meshes;
}

// Length of a line inside the unit cube, for parameters not below `from`, and whether it runs in or
// touches the boundary, where rounding may say that it is inside or outside.
struct CubeChord {
  double length;
  bool on_boundary;
};
CubeChord chord(const Position& origin, const Position& direction, double from) {
  double to = std::numeric_limits<double>::infinity(), length2 = 0;
  CubeChord result{0, false};
  for (std::size_t a = 0; a < 3; ++a) {
    length2 += direction[a] * direction[a];
    if (std::abs(direction[a]) < 1e-12) {
      if (std::abs(origin[a]) < 1e-9 || std::abs(origin[a] - 1) < 1e-9) result.on_boundary = true;
      if (!result.on_boundary && (origin[a] < 0 || origin[a] > 1)) return result;
      continue;
    }
    const double t0 = -origin[a] / direction[a], t1 = (1 - origin[a]) / direction[a];
    from = std::max(from, std::min(t0, t1));
    to = std::min(to, std::max(t0, t1));
  }
  if (std::abs(to - from) < 1e-9) result.on_boundary = true;
  if (to > from) result.length = (to - from) * std::sqrt(length2);
  return result;
}

constexpr double kTau = 1.5;

// Alpha of every pixel against 1 - exp(-tau L); rays in the boundary may see less. `turn` takes the
// mesh's space to the unit cube's (orthogonal). `violations`: where rays lie in faces to within
// rounding they may cross to and fro, between cells that the order knows no order for.
template <typename Turn>
void expect_watertight(const NamedMesh& m, const Scene& scene, double bound, const Turn& turn,
                       std::uint64_t violations = 0) {
  const RenderResult result = draw(m.mesh, scene);
  const Projector projector(scene.camera, scene.image);
  EXPECT_LE(result.statistics.violations, violations) << m.name;
  double worst = 0;
  std::size_t judged = 0;
  for (std::uint32_t y = 0; y < scene.image.height; ++y)
    for (std::uint32_t x = 0; x < scene.image.width; ++x) {
      const double from = projector.perspective() ? 0 : -std::numeric_limits<double>::infinity();
      const auto origin = projector.origin(x + 0.5, y + 0.5);
      const auto tip = projector.direction(x + 0.5, y + 0.5);
      const CubeChord c = chord(turn(origin, true), turn(tip, false), from);
      const double expected = -std::expm1(-kTau * c.length), alpha = result.image.at(x, y, 3);
      const double error = std::abs(alpha - expected);
      if (c.length > 0) ++judged;
      worst = std::max(worst, c.on_boundary ? alpha - expected : error);
    }
  // between curved faces a ray has several times as many operations behind it
  const bool curved = order_of(m.mesh.kinds[0]) != CellOrder::linear;
  EXPECT_LE(worst, curved ? 8 * bound : bound) << m.name;
  EXPECT_GT(judged, 50U) << m.name;
}

Position unturned(const Position& p, bool) { return p; }

// Neighbours drawn by the tetrahedron kernel and by general cells have the same depths on shared
// faces, however thin these look.
TEST(CellScan, RaysInGeneralPositionAreWatertight) {
  for (const NamedMesh& m : cubes())
    for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
      Scene scene = cube_scene(projection, 160, 120);
      test::make_uniform(scene);
      expect_watertight(m, scene, 1e-14, unturned);
    }
}

// Centres of pixels on the mesh's planes: all rays lie in faces and edges.
TEST(CellScan, RaysInFacesAndEdgesSeeEveryCellOnce) {
  for (const NamedMesh& m : cubes())
    for (const auto& [direction, up] : {std::pair{Position{0, 0, 1}, Position{0, 1, 0}},
                                        {Position{1, 0, 0}, Position{0, 0, 1}},
                                        {Position{0, -1, 0}, Position{1, 0, 0}}}) {
      Scene scene = cube_scene(Projection::orthographic, 17, 17);
      test::make_uniform(scene);
      scene.camera.look_at = {0.5, 0.5, 0.5};
      for (std::size_t a = 0; a < 3; ++a) scene.camera.eye[a] = 0.5 - 3 * direction[a];
      scene.camera.up = up;
      scene.camera.height = 17.0 / 8;
      expect_watertight(m, scene, 1e-14, unturned);
    }
}

// From the middle of a side: faces through the eye, seen edge-on, of which diagonal ones do not
// stay straight when their corners are projected.
TEST(CellScan, FacesThroughTheEyeAreWatertight) {
  for (const NamedMesh& m : cubes()) {
    Scene scene = cube_scene(Projection::perspective, 33, 33);
    test::make_uniform(scene);
    scene.camera.look_at = {0.5, 0.5, 0.5};
    scene.camera.eye = {0.5, -1.5, 0.5};
    scene.camera.fov = 40;
    scene.camera.up = {0, 0, 1};
    const bool diagonal_faces = std::string_view(m.name) == "tetrahedra";
    expect_watertight(m, scene, 1e-14, unturned, diagonal_faces ? 16 : 0);
  }
}

// The eye in a cell, in a face, in an edge, on a node; rays in faces and edges.
TEST(CellScan, EyeInsideIsWatertight) {
  for (const NamedMesh& m : cubes())
    for (const Position& eye :
         {Position{0.55, 0.4, 0.6}, Position{0.5, 0.4, 0.6}, Position{0.5, 0.4, 0.5},
          Position{0.5, 0.5, 0.5}, Position{0.25, 0.5, 1.0 / 3}}) {
      Scene scene = cube_scene(Projection::perspective, 21, 21);
      test::make_uniform(scene);
      scene.camera.eye = eye;
      scene.camera.look_at = {eye[0], eye[1] + 1, eye[2]};
      scene.camera.up = {0, 0, 1};
      scene.camera.fov = 90;
      expect_watertight(m, scene, 1e-14, unturned);
    }
}

// A rotation by no particular angles: faces that rays lie in are off by rounding.
constexpr std::array<Position, 3> kTurn{{{0.36, 0.48, -0.8}, {-0.8, 0.6, 0}, {0.48, 0.64, 0.6}}};

Position turned(const Position& p) {
  Position q{};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) q[a] += kTurn[a][b] * p[b];
  return {q[0] + 0.1, q[1] - 0.3, q[2] + 0.7};
}
Position turned_back(const Position& p, bool is_point) {
  const Position shift = is_point ? Position{0.1, -0.3, 0.7} : Position{};
  Position q{};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) q[b] += kTurn[a][b] * (p[a] - shift[a]);
  return q;
}

TEST(CellScan, RaysNearlyInFacesAreWatertight) {
  for (const auto& [name, straight] : cubes()) {
    const NamedMesh m{name, test::moved(straight, turned)};
    for (const Projection projection : {Projection::orthographic, Projection::perspective})
      for (const double distance : {2.0, 0.1}) {
        Scene scene = cube_scene(projection, 17, 17);
        test::make_uniform(scene);
        scene.camera.look_at = turned({0.5, 0.5, 0.5});
        scene.camera.eye = turned({0.5, 0.5 - distance, 0.5});
        const Position up = turned({0, 0, 1}), zero = turned({0, 0, 0});
        for (std::size_t a = 0; a < 3; ++a) scene.camera.up[a] = up[a] - zero[a];
        scene.camera.height = 17.0 / 8;
        scene.camera.fov = 60;
        expect_watertight(m, scene, 1e-13, turned_back);
      }
  }
}

// Crossings by pixel, in order.
using PixelCrossings = std::map<std::pair<int, int>, std::vector<std::pair<double, double>>>;

void add(const std::vector<CellCrossing>& crossings, PixelCrossings& pixels) {
  for (const CellCrossing& c : crossings) pixels[{c.x, c.y}].emplace_back(c.front, c.back);
}

// Returns how many of the crossings are in runs.
std::size_t expect_same_crossings(const NamedMesh& m, const Scene& scene) {
  const Projector projector(scene.camera, scene.image);
  const Frame frame(m.mesh, scene, projector);
  const TileRect tile{1, 2, static_cast<int>(scene.image.width) - 3,
                      static_cast<int>(scene.image.height) - 1};
  std::size_t in_runs = 0;
  CrossingRuns runs;
  for (CellId cell = 0; cell < m.mesh.cell_count(); ++cell) {
    const CellSurface surface = cell_surface(m.mesh.kinds[cell], m.mesh.cell_nodes(cell));
    if (!is_projectable(frame, surface) || frame.is_curved(cell)) continue;
    std::vector<CellCrossing> expected, others;
    scan_projected_cell(frame, surface, nullptr, tile, expected);
    runs.clear();
    scan_projected_runs(frame, surface, tile, runs, others);
    PixelCrossings of_cell, found;
    add(expected, of_cell);
    add(others, found);
    for (const auto& [x, y, first, count] : runs.runs)
      for (std::size_t k = 0; k < count; ++k)
        found[{x + static_cast<int>(k), y}].emplace_back(runs.front[first + k],
                                                         runs.back[first + k]);
    EXPECT_EQ(found, of_cell) << m.name << " " << cell;
    in_runs += runs.count;
  }
  return in_runs;
}

// The same crossings, to the bit, wherever the eye is and however rays run in faces.
TEST(CellScan, RunsHaveTheCrossingsOfSingleRays) {
  std::size_t in_runs = 0;
  for (const NamedMesh& m : cubes()) {
    for (const Projection projection : {Projection::orthographic, Projection::perspective})
      in_runs += expect_same_crossings(m, cube_scene(projection, 60, 31));
    for (const Position& eye : {Position{0.5, 0.5, -2.5}, Position{0.5, -1.5, 0.5},
                                Position{0.5, 0.5, 0.5}, Position{0.25, 0.5, 1.0 / 3}})
      for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
        Scene scene = cube_scene(projection, 17, 17);
        scene.camera.eye = eye;
        scene.camera.look_at = {0.5, 0.5, 0.75};
        scene.camera.up = {0.1, 0.7, 0.4};
        scene.camera.height = 17.0 / 8;
        scene.camera.fov = 60;
        expect_same_crossings(m, scene);
        expect_same_crossings({m.name, test::moved(m.mesh, turned)}, scene);
      }
  }
  EXPECT_GT(in_runs, 10000U);
}

}  // namespace
}  // namespace hiac
