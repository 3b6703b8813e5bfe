// The pixels in which rounding may decide what is seen of the skin, against edges and faces that
// are sampled densely; and the angles between the faces beside an edge, by hand.
#include "hiac/render/bounds/skin_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/geometry/face_form.hpp"
#include "hiac/geometry/vector.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/cell_points.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac {
namespace {

using test::Cut;
using test::Position;

constexpr double kFarAway = std::numeric_limits<double>::infinity();

// A mesh with skin, seen in some way.
class OutlineView {
 public:
  OutlineView(ZooMesh mesh, Scene scene)
      : mesh_(std::move(mesh)), scene_(std::move(scene)), projector_(scene_.camera, scene_.image) {
    test::add_node_field(mesh_, "f", [](const Position& p) { return p[0]; });
    scene_.skin.emplace();
    frame_ = std::make_unique<const Frame>(mesh_, scene_, projector_, Details::bounded);
  }

  [[nodiscard]] const Frame& frame() const { return *frame_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] TileRect tile() const {
    return {0, 0, static_cast<int>(scene_.image.width), static_cast<int>(scene_.image.height)};
  }
  [[nodiscard]] std::vector<OutlineDoubt> doubts(CellId cell, double displaced) const {
    std::vector<OutlineDoubt> doubts;
    const TileRect whole = tile();
    append_outline_doubts(*frame_, cell, whole, displaced, doubts);
    return doubts;
  }
  // Camera coordinates of a point of a cell, by its reference coordinates.
  [[nodiscard]] Vector point(CellId cell, const Vector& reference) const {
    return projector_.camera_coordinates(test::point_of_cell(mesh_, cell, reference));
  }
  // How far a point passes the ray of a pixel by, times its depth in perspective, in pixels.
  [[nodiscard]] double beside(const Vector& p, int x, int y) const {
    const auto [right, up] = projector_.slopes(x + 0.5, y + 0.5);
    const double w = projector_.perspective() ? p[2] : 1;
    return projector_.pixels_per_unit() *
           std::max(std::abs(p[0] - right * w), std::abs(p[1] - up * w));
  }
  [[nodiscard]] double pixels(double displaced, int x, int y) const {
    return displaced * projector_.pixels_per_unit() * projector_.ray_scale(x + 0.5, y + 0.5);
  }

 private:
  ZooMesh mesh_;
  Scene scene_;
  Projector projector_;
  std::unique_ptr<const Frame> frame_;
};

bool is_on_skin(const Frame& frame, CellId cell, std::size_t face) {
  return (frame.skin.on(cell) >> face & 1U) != 0;
}

// How near the edges of a cell's skin come to every pixel's ray.
std::vector<double> distances_of_edges(const OutlineView& view, CellId cell) {
  constexpr int kSteps = 1500;
  const TileRect tile = view.tile();
  std::vector<double> nearest(kTilePlane, kFarAway);
  const CellKind kind = view.frame().mesh.kinds[cell];
  const ShapeTopology& topology = topology_of(kind);
  const auto reference = reference_nodes(kind);
  for (const ShapeEdge& edge : topology.edges) {
    bool is_drawn = false;
    for (std::size_t f = 0; f < topology.faces.size(); ++f) {
      const auto corners =
          std::span(topology.faces[f].corners).first(topology.faces[f].corner_count);
      is_drawn = is_drawn ||
                 (is_on_skin(view.frame(), cell, f) && std::ranges::count(corners, edge[0]) == 1 &&
                  std::ranges::count(corners, edge[1]) == 1);
    }
    if (!is_drawn) continue;
    for (int k = 0; k <= kSteps; ++k) {
      const double s = static_cast<double>(k) / kSteps;
      Vector at;
      for (std::size_t c = 0; c < 3; ++c)
        at[c] = (1 - s) * reference[edge[0]][c] + s * reference[edge[1]][c];
      const Vector p = view.point(cell, at);
      for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) {
          double& d = nearest[tile.index(x, y)];
          d = std::min(d, view.beside(p, x, y));
        }
    }
  }
  return nearest;
}

// The same of the places of its curved faces at which these turn over.
std::vector<double> distances_of_folds(const OutlineView& view, CellId cell) {
  constexpr int kSteps = 160;
  const TileRect tile = view.tile();
  std::vector<double> nearest(kTilePlane, kFarAway);
  const Frame& frame = view.frame();
  const CellKind kind = frame.mesh.kinds[cell];
  const auto reference = reference_nodes(kind);
  for (std::size_t f = 0; f < topology_of(kind).faces.size(); ++f) {
    if (!is_on_skin(frame, cell, f) || !face_form(frame.mesh, cell, f, frame.straightness).curved)
      continue;
    const ShapeFace& face = topology_of(kind).faces[f];
    const bool triangle = face.corner_count == 3;
    const auto corner = [&](std::size_t k) { return reference[face.corners[k]]; };
    std::vector<Vector> grid;
    const auto index = [](int i, int j) { return static_cast<std::size_t>(i + (kSteps + 1) * j); };
    for (int j = 0; j <= kSteps; ++j)
      for (int i = 0; i <= kSteps; ++i) {
        const double u = static_cast<double>(i) / kSteps, v = static_cast<double>(j) / kSteps;
        Vector at;
        for (std::size_t c = 0; c < 3; ++c)
          at[c] = corner(0)[c] + u * (corner(1)[c] - corner(0)[c]) +
                  v * (corner(face.corner_count - 1U)[c] - corner(0)[c]);
        grid.push_back(view.point(cell, at));
      }
    // which side of a small parallelogram of the face is seen
    const auto facing = [&](int i, int j) {
      const Vector &p = grid[index(i, j)], &q = grid[index(i + 1, j)], &r = grid[index(i, j + 1)];
      const Vector normal = cross(minus(q, p), minus(r, p));
      return frame.projector.perspective() ? dot(normal, p) : normal[2];
    };
    for (int j = 0; j + 1 < kSteps; ++j)
      for (int i = 0; i + 1 < kSteps; ++i) {
        if (triangle && i + j + 2 > kSteps) continue;
        const double here = facing(i, j);
        if ((here > 0) == (facing(i + 1, j) > 0) && (here > 0) == (facing(i, j + 1) > 0)) continue;
        for (int y = tile.y0; y < tile.y1; ++y)
          for (int x = tile.x0; x < tile.x1; ++x) {
            double& d = nearest[tile.index(x, y)];
            d = std::min(d, view.beside(grid[index(i + 1, j + 1)], x, y));
          }
      }
  }
  return nearest;
}

struct Found {
  std::size_t doubted = 0, clear = 0;
};

// All pixels to whose rays edges or folds come as near as may be are in doubt, none that they are
// farther from by as much again.
Found expect_sampled(const OutlineView& view, CellId cell, double displaced, double slack,
                     const std::string& what) {
  const std::vector<OutlineDoubt> doubts = view.doubts(cell, displaced);
  const auto edges = distances_of_edges(view, cell), folds = distances_of_folds(view, cell);
  const TileRect tile = view.tile();
  std::vector<int> in_doubt(kTilePlane, 0);
  for (const OutlineDoubt& doubt : doubts) ++in_doubt[doubt.at];
  Found found;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      const std::size_t at = tile.index(x, y);
      const double nearest = std::min(edges[at], folds[at]), reach = view.pixels(displaced, x, y);
      if (nearest < reach - slack) {
        ++found.doubted;
        EXPECT_GT(in_doubt[at], 0) << what << ' ' << x << ' ' << y << " at " << nearest;
      }
      if (edges[at] > 2.3 * reach && folds[at] > reach + slack) {
        ++found.clear;
        EXPECT_EQ(in_doubt[at], 0) << what << ' ' << x << ' ' << y << " at " << nearest;
      }
    }
  return found;
}

TEST(OutlineDoubts, AreWhereSampledEdgesPassTheRays) {
  Found all;
  for (const Projection projection : {Projection::perspective, Projection::orthographic})
    for (const Cut cut :
         test::tried(std::vector{Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids})) {
      const OutlineView view(
          test::moved(test::structured(cut == Cut::pyramids ? 1 : 2, cut), test::sheared),
          test::cube_scene(projection, 20, 17));
      const auto cells = static_cast<CellId>(view.frame().mesh.cell_count());
      for (CellId cell = 0; cell < cells; cell += 5) {
        const Found found = expect_sampled(view, cell, cell % 2 == 0 ? 0.012 : 0.06, 0.02,
                                           "cell " + std::to_string(cell));
        all.doubted += found.doubted;
        all.clear += found.clear;
      }
    }
  EXPECT_GT(all.doubted, test::tried(150));
  EXPECT_GT(all.clear, test::tried(300));
}

// Curved edges, and faces that turn over within.
TEST(OutlineDoubts, AreWhereSampledFacesTurnOver) {
  Found all;
  for (const Projection projection : {Projection::perspective, Projection::orthographic})
    for (const CellKind kind :
         test::tried(std::vector{CellKind::brick20, CellKind::tetrahedron20, CellKind::prism15,
                                 CellKind::brick8, CellKind::tetrahedron10})) {
      const ZooMesh mesh = test::moved(
          kind == CellKind::brick8 ? test::structured(1, Cut::bricks) : test::straight_mesh(kind),
          [](const Position& p) {
            return Position{p[0] + 0.2 * p[1] * p[2], p[1] + 0.5 * p[0] * (1 - p[0]) * p[2],
                            p[2] - 0.6 * p[0] * (1 - p[1])};
          });
      Scene scene = test::cube_scene(projection, 20, 17);
      scene.camera.eye = {4, 1, 0.9};  // along the bent tops
      const OutlineView view(mesh, scene);
      const Found found = expect_sampled(view, 0, 0.012, 0.05, std::string(kind_name(kind)));
      all.doubted += found.doubted;
      all.clear += found.clear;
    }
  EXPECT_GT(all.doubted, test::tried(100));
  EXPECT_GT(all.clear, test::tried(500));
}

// Pictures of 8 x 8 pixels, a quarter of a unit each, seen from above: world (x, y) is in column
// 4 + 4 x and row 4 - 4 y.
Scene from_above() {
  Scene scene = test::cube_scene(Projection::orthographic, 8, 8);
  scene.camera.eye = {0, 0, 5};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.up = {0, 1, 0};
  scene.camera.height = 2;
  return scene;
}

// A ridge along y at x = 1/8, through the centres of column 4, of two prisms: their tops fall off
// to both sides by slopes. The second one may be turned inside out.
OutlineView ridge(double left_slope, double right_slope, bool inside_out) {
  const double x = 0.125, w = 0.7;
  std::vector<Position> positions;
  for (const double y : {-0.9, 0.9}) {
    positions.push_back({x, y, 0});
    positions.push_back({x, y, -1});
    positions.push_back({x - w, y, -w * left_slope});
    positions.push_back({x + w, y, -w * right_slope});
  }
  const std::vector<NodeId> right =
      inside_out ? std::vector<NodeId>{4, 7, 5, 0, 3, 1} : std::vector<NodeId>{0, 3, 1, 4, 7, 5};
  return {test::make_mesh(positions,
                          {{CellKind::prism6, {0, 1, 2, 4, 5, 6}}, {CellKind::prism6, right}}),
          from_above()};
}

std::map<std::size_t, OutlineDoubt> by_pixel(const std::vector<OutlineDoubt>& doubts) {
  std::map<std::size_t, OutlineDoubt> found;
  for (const OutlineDoubt& doubt : doubts) found.emplace(doubt.at, doubt);
  return found;
}

TEST(OutlineDoubts, SayTheAngleBetweenTheFacesBesideAnEdge) {
  for (const auto& [left, right] : {std::pair{0.5, 0.25}, {0.0, 0.0}, {-0.3, 1.5}, {2.0, -1.0}}) {
    const OutlineView view = ridge(left, right, left == 0.5);
    const double angle = std::abs(std::atan(left) + std::atan(right));
    for (const CellId cell : {0U, 1U}) {
      const auto doubts = by_pixel(view.doubts(cell, 1e-12));
      for (int y = 0; y < 8; ++y) {
        const auto found = doubts.find(view.tile().index(4, y));
        ASSERT_NE(found, doubts.end()) << y;
        EXPECT_NEAR(found->second.angle, angle, 1e-14);
        ASSERT_NE(found->second.other, nullptr);
        EXPECT_EQ(found->second.other->cell, 1 - cell);
        const ShapeFace& face = topology_of(CellKind::prism6).faces[found->second.other->face];
        EXPECT_EQ(face.corner_count, 4);
      }
      EXPECT_EQ(doubts.size(), 8U);
    }
  }
}

// One of the faces is seen from behind or edge-on: the ray may miss the skin.
TEST(OutlineDoubts, AreOfAllThatIsSeenWhereOneFaceIsTurnedAway) {
  // a slope to the left that falls away below the ridge: the skin ends there
  const double x = 0.125;
  for (const double back : {0.0, 0.2, 1e-8}) {
    const OutlineView view(test::make_mesh({{x, -0.9, 0},
                                            {x + 0.7, -0.9, 0},
                                            {x + back, -0.9, -0.8},
                                            {x, 0.9, 0},
                                            {x + 0.7, 0.9, 0},
                                            {x + back, 0.9, -0.8}},
                                           {{CellKind::prism6, {0, 2, 1, 3, 5, 4}}}),
                           from_above());
    const auto doubts = by_pixel(view.doubts(0, 1e-12));
    for (int y = 1; y < 7; ++y) {
      const auto found = doubts.find(view.tile().index(4, y));
      ASSERT_NE(found, doubts.end()) << y;
      EXPECT_EQ(found->second.angle, kFarAway);
    }
  }
}

// Both faces are the cell's own, and the doubt says so.
TEST(OutlineDoubts, NameNoOtherCellWhereBothFacesAreOfOne) {
  const double x = 0.125;
  const OutlineView view(test::make_mesh({{x, -0.9, 0},
                                          {x + 0.7, -0.9, -0.7},
                                          {x - 0.7, -0.9, -0.35},
                                          {x, 0.9, 0},
                                          {x + 0.7, 0.9, -0.7},
                                          {x - 0.7, 0.9, -0.35}},
                                         {{CellKind::prism6, {0, 2, 1, 3, 5, 4}}}),
                         from_above());
  const auto doubts = by_pixel(view.doubts(0, 1e-12));
  for (int y = 1; y < 7; ++y) {
    const auto found = doubts.find(view.tile().index(4, y));
    ASSERT_NE(found, doubts.end()) << y;
    EXPECT_NEAR(found->second.angle, std::numbers::pi / 4 + std::atan(0.5), 1e-14);
    EXPECT_EQ(found->second.other, nullptr);
  }
}

// At the end of an edge more faces meet, as far as four times what may be off.
TEST(OutlineDoubts, AreOfAllThatIsSeenAtTheEndsOfEdges) {
  const double displaced = 0.01;
  for (const double beyond : {0.0, 0.035, 0.05}) {
    const double x = 0.125, y = 0.125 + beyond;  // the ridge ends above the centre of row 3
    const OutlineView view(test::make_mesh({{x, -0.9, 0},
                                            {x + 0.7, -0.9, -0.7},
                                            {x - 0.7, -0.9, -0.35},
                                            {x, y, 0},
                                            {x + 0.7, y, -0.7},
                                            {x - 0.7, y, -0.35}},
                                           {{CellKind::prism6, {0, 2, 1, 3, 5, 4}}}),
                           from_above());
    const auto doubts = view.doubts(0, displaced);
    double least = kFarAway;
    for (const OutlineDoubt& doubt : doubts)
      if (doubt.at == view.tile().index(4, 3)) least = std::min(least, doubt.angle);
    if (beyond < 0.04)
      EXPECT_EQ(least, kFarAway) << beyond;
    else
      EXPECT_NEAR(least, std::numbers::pi / 4 + std::atan(0.5), 1e-14);
  }
}

}  // namespace
}  // namespace hiac
