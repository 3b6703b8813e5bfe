// Rays that run in faces, through edges and corners, of meshes whose faces are planar, or almost:
// cells share such rays without gap or overlap, and every segment lies in its cell.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/render/cells/cell_scan.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/cell_distance.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac {
namespace {

using test::Cut;
using test::Position;
using Real = long double;
using test::operator+;
using test::operator*;

// What is wrong with how the cells of a mesh that fills the unit cube share a ray.
struct Shared {
  double overlap = 0, gap = 0;  // the longest, in units of the ray parameter
  double outside = 0;           // how far segments are from their cells, at most
  std::size_t segments = 0;
};

Shared share(const ZooMesh& mesh, const Frame& frame, int x, int y) {
  const Projector& projector = frame.projector;
  const auto origin = projector.origin(x + 0.5, y + 0.5);
  const auto direction = projector.direction(x + 0.5, y + 0.5);
  double enters = -std::numeric_limits<double>::infinity(), leaves = -enters;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto [near, far] =
        std::minmax({-origin[c] / direction[c], (1 - origin[c]) / direction[c]});
    enters = std::max(enters, near);
    leaves = std::min(leaves, far);
  }
  std::vector<std::pair<CellCrossing, CellId>> segments;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    std::vector<CellCrossing> crossings;
    scan_cell(frame, cell, {x, y, x + 1, y + 1}, crossings);
    for (const CellCrossing& c : crossings)
      if (c.back - c.front > frame.witness_tolerance) segments.emplace_back(c, cell);
  }
  std::ranges::sort(segments, {}, [](const auto& s) { return s.first.front; });
  Shared shared{.segments = segments.size()};
  double last = enters;
  for (const auto& [c, cell] : segments) {
    shared.overlap = std::max(shared.overlap, std::min(last, c.back) - c.front);
    shared.gap = std::max(shared.gap, c.front - last);
    last = std::max(last, c.back);
    for (const double part : {0.001, 0.3, 0.7, 0.999}) {
      const Real t = c.front + Real(part) * (Real(c.back) - c.front);
      const Real off =
          test::distance_from(mesh, cell, test::vec(origin) + t * test::vec(direction));
      shared.outside = std::max(shared.outside, static_cast<double>(off));
    }
  }
  shared.gap = std::max(shared.gap, leaves - last);
  return shared;
}

ZooMesh with_field(ZooMesh mesh) {
  test::add_node_field(mesh, "f", [](const Position&) { return 0.5; });
  return mesh;
}

std::vector<ZooMesh> meshes_of_all_kinds() {
  std::vector<ZooMesh> meshes;
  for (const ZooMesh& linear :
       {test::structured(2, Cut::bricks), test::structured(2, Cut::tetrahedra),
        test::structured(2, Cut::prisms), test::structured(2, Cut::pyramids), test::wedge_grid(2)})
    for (const CellOrder order : {CellOrder::linear, CellOrder::quadratic, CellOrder::cubic})
      meshes.push_back(order == CellOrder::linear ? linear : test::of_order(linear, order));
  meshes.push_back(test::of_order(test::mixed_columns(2), CellOrder::quadratic));
  return meshes;
}

// Nodes inside the cube, moved along the view alone: what was vertical is seen exactly edge-on, and
// yet has curved edges and counts as curved.
TEST(RaysInFaces, FacesThatAreCurvedInTheirPlanesAreShared) {
  constexpr int kSide = 16;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> offset(-0.03, 0.03);
  std::size_t segments = 0;
  for (const ZooMesh& straight : meshes_of_all_kinds()) {
    const ZooMesh mesh = with_field(test::moved(straight, [&](Position p) {
      const double by = offset(random);
      if (p[2] > 0 && p[2] < 1) p[2] += by;
      return p;
    }));
    Scene scene = test::cube_scene(Projection::orthographic, kSide, kSide);
    // pixels' centres on faces between cells, straight and askew on the screen
    scene.camera.look_at = {0.5 - 1.0 / 32, 0.5 - 1.0 / 32, 0.5};
    scene.camera.eye = {scene.camera.look_at[0], scene.camera.look_at[1], 3};
    scene.camera.up = {0, 1, 0};
    scene.camera.height = 1;
    const Projector projector(scene.camera, scene.image);
    const Frame frame(mesh, scene, projector);
    for (int k = 1; k < 15; ++k)
      for (const auto& [x, y] : {std::pair{k, k}, {k, 15 - k + 1}, {k, 8}, {8, k}, {k, 4}}) {
        if (std::max(x, y) > 14) continue;
        const Shared shared = share(mesh, frame, x, y);
        const std::string where = std::string(kind_name(mesh.kinds[0])) + ' ' + std::to_string(x) +
                                  ' ' + std::to_string(y);
        EXPECT_LE(shared.overlap, frame.witness_tolerance) << where;
        EXPECT_LE(shared.gap, frame.witness_tolerance) << where;
        EXPECT_LE(shared.outside, 1e-12) << where;
        segments += shared.segments;
      }
  }
  EXPECT_GT(segments, 2000U);
}

// A line through two points of a face: corners, points of edges, of its inside.
std::array<Position, 2> line_in_face(const ZooMesh& mesh, std::mt19937& random) {
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  std::uniform_real_distribution<double> part(0, 1);
  const auto cell = static_cast<CellId>(below(mesh.cell_count()));
  const ShapeFace& face = topology_of(mesh.kinds[cell]).faces[below(face_count(mesh.kinds[cell]))];
  const auto point = [&] {
    const std::size_t n = face.corner_count, k = below(n), how = below(4);
    const auto corner = [&](std::size_t i) {
      return mesh.position(mesh.cell_nodes(cell)[face.corners[i % n]]);
    };
    double s = how == 0 ? 0 : how == 1 ? 0.5 : part(random), t = how == 3 ? part(random) : 0;
    if (s + t > 1) s = 1 - s, t = 1 - t;
    Position p{};
    for (std::size_t c = 0; c < 3; ++c)
      p[c] = corner(k)[c] + s * (corner(k + 1)[c] - corner(k)[c]) +
             t * (corner(k + 2)[c] - corner(k)[c]);
    return p;
  };
  for (;;) {
    const Position a = point(), b = point();
    if (std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) > 1e-3) return {a, b};
  }
}

// Whether a line stays on the cube's surface, where nobody says which rays are inside.
bool grazes_cube(const std::array<Position, 2>& line) {
  for (std::size_t c = 0; c < 3; ++c)
    for (const double side : {0, 1})
      if (std::abs(line[0][c] - side) < 1e-6 && std::abs(line[1][c] - side) < 1e-6) return true;
  return false;
}

// Faces bent by little more than what counts as planar, or by single precision, and by much.
TEST(RaysInFaces, BentFacesAreShared) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  std::size_t segments = 0;
  for (const ZooMesh& straight : meshes_of_all_kinds())
    for (const double by : {1e-7, 1e-5, 1e-2}) {
      const ZooMesh mesh = with_field(test::moved(straight, [&](Position p) {
        for (double& x : p)
          if (x > 0 && x < 1) x = static_cast<float>(x + by * number(random));
        return p;
      }));
      for (std::size_t i = 0; i < test::tried(24); ++i) {
        const auto line = line_in_face(i % 3 == 0 ? mesh : straight, random);
        if (grazes_cube(line)) continue;
        const std::uint32_t side = i % 2 == 0 ? 3 : 1001;
        Scene scene = test::cube_scene(
            i % 4 < 2 ? Projection::perspective : Projection::orthographic, side, side);
        scene.camera.look_at = line[0];
        const double length =
            std::hypot(line[1][0] - line[0][0], line[1][1] - line[0][1], line[1][2] - line[0][2]);
        for (std::size_t c = 0; c < 3; ++c) {
          scene.camera.eye[c] = line[0][c] - 3 / length * (line[1][c] - line[0][c]);
          scene.camera.up[c] = number(random);
        }
        scene.camera.height = 1;
        const Projector projector(scene.camera, scene.image);
        const Frame frame(mesh, scene, projector);
        const Shared shared =
            share(mesh, frame, static_cast<int>(side / 2), static_cast<int>(side / 2));
        const std::string where = std::string(kind_name(mesh.kinds[0])) + ' ' + std::to_string(by) +
                                  ' ' + std::to_string(i);
        EXPECT_LE(shared.overlap, 2 * frame.witness_tolerance) << where;
        EXPECT_LE(shared.gap, 10 * frame.witness_tolerance) << where;
        EXPECT_LE(shared.outside, 1e-9) << where;
        segments += shared.segments;
      }
    }
  EXPECT_GT(segments, test::tried(2000U));
}

}  // namespace
}  // namespace hiac
