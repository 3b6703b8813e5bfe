// Edges in pictures against lines that are sampled densely, and the choice of edges.

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/frame/crop.hpp"
#include "hiac/frame/projection.hpp"
#include "hiac/frame/surfaces/boundary_faces.hpp"
#include "hiac/render/edges/chosen_edges.hpp"
#include "hiac/render/edges/strip_coverage.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/render/supersampling.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/render/truth/sampled_strips.hpp"

namespace hiac {
namespace {

using test::Cut;
using test::Position;
using test::sampled_coverage;

TEST(StripCoverage, AgreesWithSamples) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-2, 2), width(0.1, 2.5);
  double largest = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Strip strip{place(random), place(random), place(random), place(random), width(random)};
    const double found = strip_coverage(strip, 0.25, -0.5);
    largest = std::max(largest, std::abs(found - sampled_coverage({strip}, 0.25, -0.5)));
  }
  EXPECT_LE(largest, 0.02);
}

TEST(StripCoverage, IsTheSameOfALineAndOfItsParts) {
  // the parts end inside the pixel, where polygons are cut; the whole passes it
  std::mt19937 random(4);
  std::uniform_real_distribution<double> angle(0, 7), aside(-1.5, 1.5), width(0.01, 2.5);
  for (int trial = 0; trial < 2000; ++trial) {
    const double a = trial < 8 ? trial * 0.78539816339744831 : angle(random);
    const double ux = std::cos(a), uy = std::sin(a), d = aside(random), w = width(random);
    const auto part = [&](double from, double to) {
      return strip_coverage(
          {from * ux - d * uy, from * uy + d * ux, to * ux - d * uy, to * uy + d * ux, w}, 0, 0);
    };
    EXPECT_NEAR(part(-9, 9), part(-9, 0.1) + part(0.1, 9), 1e-14) << a << ' ' << d << ' ' << w;
  }
}

TEST(StripCoverage, OfLongLinesKeepsItsDigits) {
  // a line along a row of pixels, a third of it in each of three
  const Strip strip{-1e6, 0.5, 1e6, 0.5, 3};
  EXPECT_NEAR(strip_coverage(strip, 10.5, 0.5), 1, 1e-12);
  EXPECT_NEAR(strip_coverage(strip, 10.5, 2.5), 0, 1e-12);
  EXPECT_NEAR(strip_coverage({-1e6, 0.5, 1e6, 0.5, 1.5}, 10.5, 1.5), 0.25, 1e-12);
  EXPECT_EQ(strip_coverage({1, 1, 1, 1, 2}, 1, 1), 0);
}

std::size_t count(const ZooMesh& mesh, EdgeChoice show, double angle = 30) {
  Edges wanted;
  wanted.show = show;
  wanted.angle = angle;
  return chosen_edges(mesh, wanted, boundary_faces(mesh)).size();
}

TEST(ChosenEdges, AreThoseAtWhichTheBoundaryBends) {
  const ZooMesh bricks = test::structured(3, Cut::bricks);
  EXPECT_EQ(count(bricks, EdgeChoice::feature), 36U);
  EXPECT_EQ(count(bricks, EdgeChoice::feature, 89), 36U);
  EXPECT_EQ(count(bricks, EdgeChoice::feature, 91), 0U);
  EXPECT_EQ(count(bricks, EdgeChoice::boundary), 108U);
  EXPECT_EQ(count(bricks, EdgeChoice::all), 144U);
  // diagonals of the faces lie in them
  const ZooMesh tetrahedra = test::structured(2, Cut::tetrahedra);
  EXPECT_EQ(count(tetrahedra, EdgeChoice::feature), 24U);
  EXPECT_EQ(count(tetrahedra, EdgeChoice::boundary), 3 * 48 / 2U);
  const ZooMesh prisms = test::structured(1, Cut::prisms);
  EXPECT_EQ(count(prisms, EdgeChoice::feature, 1), 12U);
  EXPECT_EQ(count(prisms, EdgeChoice::boundary), 14U);
  // two cubes that share an edge: it has four faces beside it
  const ZooMesh touching = test::keep_cells(
      test::structured(2, Cut::bricks), [](const Position&, CellId c) { return c == 0 || c == 3; });
  EXPECT_EQ(count(touching, EdgeChoice::feature, 179), 1U);
}

// A view of the unit cube, and what its edges are on the screen.
class CubeView {
 public:
  CubeView(std::size_t per_edge, std::uint32_t width, std::uint32_t height)
      : mesh(test::structured(per_edge, Cut::bricks)) {
    test::add_node_field(mesh, "f", test::smooth_field);
    scene = test::cube_scene(Projection::orthographic, width, height);
    scene.volume = {};
    Skin& skin = scene.skin.emplace();
    skin.color = {0.9, 0.6, 0};
    Edges& edges = scene.edges.emplace();
    edges.show = EdgeChoice::boundary;
    edges.color = {0, 0, 1};
    edges.width = 2.3;
  }

  [[nodiscard]] std::array<double, 2> on_screen(const Position& p) const {
    const Projector projector(scene.camera, scene.image);
    ProjectedNode node;
    projector.project(p, node);
    return {node.x, node.y};
  }
  // The grid lines on those of the cube's faces that the eye sees (`front`), or does not see alone.
  [[nodiscard]] std::vector<Strip> lines(std::size_t per_edge, bool front) const {
    std::vector<Strip> strips;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i <= per_edge; ++i)
        for (std::size_t j = 0; j <= per_edge; ++j) {
          const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
          // the camera is at larger coordinates than the cube
          const bool is_front = i == per_edge || j == per_edge;
          const bool is_back = i == 0 || j == 0;
          if (front ? !is_front : is_front || !is_back) continue;
          Position a{}, b{};
          a[u] = b[u] = static_cast<double>(i) / static_cast<double>(per_edge);
          a[v] = b[v] = static_cast<double>(j) / static_cast<double>(per_edge);
          b[axis] = 1;
          const auto p = on_screen(a), q = on_screen(b);
          strips.push_back({p[0], p[1], q[0], q[1], scene.edges->width});
        }
    return strips;
  }
  // Whether a place where lines meet is near: there, shares add up.
  [[nodiscard]] bool near_node(double x, double y) const {
    for (NodeId node = 0; node < mesh.node_count(); ++node) {
      const auto p = mesh.position(node);
      const auto at = on_screen({p[0], p[1], p[2]});
      if (std::hypot(at[0] - x, at[1] - y) < 4) return true;
    }
    return false;
  }
  [[nodiscard]] Image draw(bool with_edges) const {
    Scene drawn = scene;
    if (!with_edges) drawn.edges.reset();
    return test::draw(mesh, drawn).image;
  }

  ZooMesh mesh;
  Scene scene;
};

TEST(Edges, LieInFrontOfTheSkinThatTheyAreOn) {
  const CubeView view(3, 150, 120);
  const Image with = view.draw(true), without = view.draw(false);
  const auto lines = view.lines(3, true);
  std::size_t seen = 0;
  double largest = 0;
  for (std::uint32_t y = 0; y < 120; ++y)
    for (std::uint32_t x = 0; x < 150; ++x) {
      if (view.near_node(x + 0.5, y + 0.5)) continue;
      const double share = sampled_coverage(lines, x + 0.5, y + 0.5);
      if (share > 0) ++seen;
      const std::array<double, 3> edge{0, 0, 1};
      for (std::size_t c = 0; c < 3; ++c)
        largest = std::max(largest, std::abs(with.at(x, y, c) - share * edge[c] -
                                             (1 - share) * without.at(x, y, c)));
      largest =
          std::max(largest, std::abs(with.at(x, y, 3) - share - (1 - share) * without.at(x, y, 3)));
    }
  EXPECT_LE(largest, 0.02);
  EXPECT_GT(seen, 1000U);
}

TEST(Edges, BehindTheMediumLieInFrontOfTheSkinAwayFromTheEye) {
  CubeView view(2, 150, 120);
  view.scene.skin->opacity = 0.4;
  view.scene.skin->specular = 0;
  const Image with = view.draw(true);
  const auto front = view.lines(2, true), back = view.lines(2, false);
  const std::array<double, 3> way{view.scene.camera.look_at[0] - view.scene.camera.eye[0],
                                  view.scene.camera.look_at[1] - view.scene.camera.eye[1],
                                  view.scene.camera.look_at[2] - view.scene.camera.eye[2]};
  const double length = std::hypot(way[0], way[1], way[2]);
  const Projector projector(view.scene.camera, view.scene.image);
  std::size_t seen = 0;
  double largest = 0;
  for (std::uint32_t y = 0; y < 120; ++y)
    for (std::uint32_t x = 0; x < 150; ++x) {
      if (view.near_node(x + 0.5, y + 0.5) || sampled_coverage(front, x + 0.5, y + 0.5) > 0)
        continue;
      const double share = sampled_coverage(back, x + 0.5, y + 0.5);
      if (share == 0) continue;
      ++seen;
      // the front face is the last of three planes that the ray passes
      const auto origin = projector.origin(x + 0.5, y + 0.5);
      double entry = -1e9, cosine = 0;
      for (std::size_t c = 0; c < 3; ++c)
        if (const double t = (1 - origin[c]) / (way[c] / length); t > entry) {
          entry = t;
          cosine = std::abs(way[c]) / length;
        }
      const double through = std::pow(0.6, 1 / cosine);
      largest = std::max(largest, std::abs(with.at(x, y, 2) - through * share));
    }
  EXPECT_LE(largest, 0.02);
  EXPECT_GT(seen, 300U);
}

TEST(Edges, RunOnFromCellToCell) {
  CubeView whole(1, 150, 120), divided(7, 150, 120);
  for (CubeView* view : {&whole, &divided}) view->scene.edges->show = EdgeChoice::feature;
  const Image of_one = whole.draw(true), of_many = divided.draw(true);
  double largest = 0;
  for (std::uint32_t y = 0; y < 120; ++y)
    for (std::uint32_t x = 0; x < 150; ++x) {
      if (whole.near_node(x + 0.5, y + 0.5)) continue;
      for (std::size_t c = 0; c < 4; ++c)
        largest = std::max(largest, std::abs(of_one.at(x, y, c) - of_many.at(x, y, c)));
    }
  EXPECT_LE(largest, 1e-9);
}

TEST(Edges, AreHiddenByAnOpaqueSkin) {
  const CubeView view(2, 150, 120);
  Scene feature = view.scene;
  feature.edges->show = EdgeChoice::feature;
  const Image with = test::draw(view.mesh, feature).image, without = view.draw(false);
  // the corner that is farthest away lies behind the middle of the cube
  const auto hidden = view.on_screen({0, 0, 0});
  const auto x = static_cast<std::uint32_t>(hidden[0]), y = static_cast<std::uint32_t>(hidden[1]);
  for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(with.at(x, y, c), without.at(x, y, c));
}

TEST(Edges, AreDrawnWithoutASkinAndInsideAMedium) {
  CubeView view(2, 90, 80);
  view.scene.skin.reset();
  view.scene.edges->show = EdgeChoice::all;
  const Image clear = view.draw(true);
  view.scene.volume.color = ColorTransfer{"f", {{0, {0.5, 0.5, 0}}}};
  view.scene.volume.extinction = ExtinctionTransfer{"f", {{0, {2}}}};
  const Image dim = view.draw(true), medium = view.draw(false);
  // the edges that meet in the cube's middle are seen through half a medium
  const auto middle = view.on_screen({0.5, 0.5, 0.5});
  const auto x = static_cast<std::uint32_t>(middle[0]), y = static_cast<std::uint32_t>(middle[1]);
  EXPECT_NEAR(clear.at(x, y, 2), 1, 1e-12);
  const double transparency = 1 - medium.at(x, y, 3);
  EXPECT_NEAR(dim.at(x, y, 2), std::sqrt(transparency), 0.15 * std::sqrt(transparency));
}

TEST(Edges, AreTheSameInGroupsOfCells) {
  CubeView view(2, 60, 50);
  view.scene.skin->opacity = 0.4;
  VisibilityOrder order = test::sorted(view.mesh, view.scene);
  const Image one_by_one = render(view.mesh, order, view.scene, false).image;
  order.groups = std::vector<CellGroup>{{0, static_cast<std::uint32_t>(order.cells.size())}};
  const Image sorted = render(view.mesh, order, view.scene, false).image;
  std::size_t differing = 0;
  for (std::uint32_t y = 0; y < 50; ++y)
    for (std::uint32_t x = 0; x < 60; ++x) {
      if (view.near_node(x + 0.5, y + 0.5)) continue;
      differing += std::abs(sorted.at(x, y, 2) - one_by_one.at(x, y, 2)) > 1e-9;
    }
  EXPECT_EQ(differing, 0U);
}

TEST(Edges, AreAsWideInPicturesOfSamples) {
  const CubeView view(1, 60, 50);
  const Image one = view.draw(true);
  const Image many =
      render_supersampled(view.mesh, test::sorted(view.mesh, view.scene), view.scene,
                          whole_picture(view.scene.image), {4, SampleFilter::box}, false)
          .image;
  double of_one = 0, of_many = 0;
  for (std::uint32_t y = 0; y < 50; ++y)
    for (std::uint32_t x = 0; x < 60; ++x) {
      of_one += one.at(x, y, 2);
      of_many += many.at(x, y, 2);
    }
  EXPECT_NEAR(of_many / of_one, 1, 0.03);
}

}  // namespace
}  // namespace hiac
