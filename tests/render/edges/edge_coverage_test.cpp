// What lines cover of pixels where many meet, against 64 x 64 samples of all of them.

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/frame/projection.hpp"
#include "hiac/frame/surfaces/boundary_faces.hpp"
#include "hiac/render/edges/chosen_edges.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/render/truth/sampled_strips.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac {
namespace {

using test::Cut;
using test::Position;

constexpr std::uint32_t kWidth = 150, kHeight = 120;

// The unit cube with skin and all edges of its boundary, seen from larger coordinates.
Scene cube_lines(double width, double skin_opacity) {
  Scene scene = test::cube_scene(Projection::orthographic, kWidth, kHeight);
  scene.volume = {};
  Skin& skin = scene.skin.emplace();
  skin.color = {0.9, 0.6, 0};
  skin.specular = 0;
  skin.opacity = skin_opacity;
  Edges& edges = scene.edges.emplace();
  edges.show = EdgeChoice::boundary;
  edges.color = {0, 0, 1};
  edges.width = width;
  return scene;
}

struct Lines {
  std::vector<Strip> front, back;  // on the faces towards the eye, and on the others alone
};

Lines lines_of(const ZooMesh& mesh, const Scene& scene) {
  const Projector projector(scene.camera, scene.image);
  Lines lines;
  for (const EdgeNodes& edge : chosen_edges(mesh, *scene.edges, boundary_faces(mesh))) {
    const auto a = mesh.position(edge.nodes[0]), b = mesh.position(edge.nodes[edge.count - 1]);
    ProjectedNode p, q;
    projector.project(a, p);
    projector.project(b, q);
    bool is_front = false;
    for (std::size_t c = 0; c < 3; ++c) is_front = is_front || (a[c] == 1 && b[c] == 1);
    (is_front ? lines.front : lines.back).push_back({p.x, p.y, q.x, q.y, scene.edges->width});
  }
  return lines;
}

// The share of light that passes the skin towards the eye, or nothing where the ray passes by.
double through_front(const Scene& scene, double x, double y) {
  const Projector projector(scene.camera, scene.image);
  const auto origin = projector.origin(x, y);
  const auto way = projector.direction(x, y);
  double entry = -1e9, exit = 1e9, cosine = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double near = (1 - origin[c]) / way[c], far = -origin[c] / way[c];
    if (near > entry) cosine = std::abs(way[c]) / std::hypot(way[0], way[1], way[2]);
    entry = std::max(entry, near);
    exit = std::min(exit, far);
  }
  return entry < exit ? std::pow(1 - scene.skin->opacity, 1 / cosine) : -1;
}

struct Judged {
  double largest = 0;
  std::size_t pixels = 0;
};

// The blue of a picture is that of its lines: of those in front as they cover the pixel, of those
// behind through the skin where none is in front. Near the outline, where the rays of a pixel pass
// different faces, a picture of one ray a pixel cannot say.
Judged judge(const ZooMesh& mesh, const Scene& scene) {
  const Image image = test::draw(mesh, scene).image;
  const Lines lines = lines_of(mesh, scene);
  Judged result;
  for (std::uint32_t j = 0; j < kHeight; ++j)
    for (std::uint32_t i = 0; i < kWidth; ++i) {
      const double x = i + 0.5, y = j + 0.5;
      const auto front = test::strips_near(lines.front, x, y);
      const auto back = test::strips_near(lines.back, x, y);
      if (front.empty() && back.empty()) continue;
      const double through = through_front(scene, x, y);
      bool is_inside = true;
      for (const double side : {-3.0, 3.0})
        is_inside = is_inside && through_front(scene, x + side, y) == through &&
                    through_front(scene, x, y + side) == through;
      if (!is_inside || through < 0) continue;
      const double expected = test::sampled_mean(x, y, [&](double px, double py) {
        return test::any_holds(front, px, py) ? 1 : test::any_holds(back, px, py) ? through : 0;
      });
      if (expected > 0) ++result.pixels;
      result.largest = std::max(result.largest, std::abs(image.at(i, j, 2) - expected));
    }
  return result;
}

TEST(EdgeCoverage, IsThatOfAllLinesWhereManyMeet) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms})
    for (const double width : test::tried(std::vector{1.0, 0.4, 2.5}))
      for (const std::size_t per_edge : {3U, 12U}) {
        ZooMesh mesh = test::structured(per_edge, cut);
        const Judged found = judge(mesh, cube_lines(width, 1));
        const std::string what = std::to_string(static_cast<int>(cut)) + " of width " +
                                 std::to_string(width) + ", " + std::to_string(per_edge);
        EXPECT_LE(found.largest, 0.02) << what;
        EXPECT_GT(found.pixels, 1000U) << what;
      }
}

TEST(EdgeCoverage, OfLinesBehindIsWhatThoseInFrontLeave) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra})
    for (const double width : {0.7, 2.0}) {
      ZooMesh mesh = test::structured(5, cut);
      const Judged found = judge(mesh, cube_lines(width, 0.4));
      EXPECT_LE(found.largest, 0.02) << static_cast<int>(cut) << " of width " << width;
      EXPECT_GT(found.pixels, 2000U);
    }
}

TEST(EdgeCoverage, IsTheSameInGroupsOfCells) {
  ZooMesh mesh = test::structured(4, Cut::tetrahedra);
  const Scene scene = cube_lines(1.3, 0.4);
  VisibilityOrder order = test::sorted(mesh, scene);
  const Image one_by_one = render(mesh, order, scene, false).image;
  order.groups = std::vector<CellGroup>{{0, static_cast<std::uint32_t>(order.cells.size())}};
  // a group has no order
  order.cells = std::vector<CellId>(std::make_reverse_iterator(order.cells.end()),
                                    std::make_reverse_iterator(order.cells.begin()));
  const Image sorted = render(mesh, order, scene, false).image;
  double sum = 0, largest = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const double off = std::abs(sorted.at(x, y, 2) - one_by_one.at(x, y, 2));
      sum += one_by_one.at(x, y, 2);
      largest = std::max(largest, off);
    }
  EXPECT_GT(sum, 1000);
  EXPECT_LE(largest, 1e-12);
}

}  // namespace
}  // namespace hiac
