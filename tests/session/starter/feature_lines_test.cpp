#include "hiac/session/starter/feature_lines.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/shape_functions.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::starter {
namespace {

/// A box at 1 to 3, 0 to 5 and -1 to 0 of one cell.
ZooMesh box_of_one(CellKind kind) {
  std::vector<test::Position> places;
  std::vector<NodeId> nodes;
  for (const auto& p : reference_nodes(kind)) {
    places.push_back({1 + 2 * p[0], 5 * p[1], p[2] - 1});
    nodes.push_back(static_cast<NodeId>(nodes.size()));
  }
  return test::make_mesh(places, {{kind, nodes}});
}

// The eye looks along y: x / y and z / y are the slopes on the screen.
TEST(FeatureLines, AreAsLongAsOnTheScreen) {
  Camera camera;
  camera.eye = {2, -10, 3};
  camera.look_at = {2, 0, 3};
  camera.up = {0, 0, 1};
  camera.fov = 50;
  const double pixels = 60 / std::tan(25 * std::numbers::pi / 180);
  const auto seen = [&](const std::array<double, 3>& p) {
    return std::array{pixels * (p[0] - 2) / (p[1] + 10), pixels * (p[2] - 3) / (p[1] + 10)};
  };
  double expected = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double s : {0.0, 1.0})
      for (const double t : {0.0, 1.0}) {
        const std::array<double, 3> low{1, 0, -1}, size{2, 5, 1};
        std::array<double, 3> from{}, to{};
        for (std::size_t c = 0; c < 3; ++c) {
          const double at = c == axis ? 0 : c == (axis + 1) % 3 ? s : t;
          from[c] = low[c] + at * size[c];
          to[c] = low[c] + (c == axis ? 1 : at) * size[c];
        }
        const auto a = seen(from), b = seen(to);
        expected += std::hypot(b[0] - a[0], b[1] - a[1]);
      }
  const ImageSize size{200, 120};
  EXPECT_NEAR(line_length(box_of_one(CellKind::brick8), Edges{}, camera, size), expected,
              1e-9 * expected);
  EXPECT_NEAR(line_length(box_of_one(CellKind::brick20), Edges{}, camera, size), expected,
              1e-9 * expected);
}

TEST(FeatureLines, AreThoseThatAreChosen) {
  Camera camera;
  camera.eye = {2, -10, 3};
  camera.look_at = {2, 0, 3};
  camera.up = {0, 0, 1};
  camera.fov = 50;
  const ZooMesh bricks = test::structured(2, test::Cut::bricks);
  const ZooMesh cube = test::structured(1, test::Cut::bricks);
  const auto length = [&](const ZooMesh& mesh, EdgeChoice show) {
    Edges edges;
    edges.show = show;
    return line_length(mesh, edges, camera, {200, 120});
  };
  EXPECT_NEAR(length(bricks, EdgeChoice::feature), length(cube, EdgeChoice::feature), 1e-9);
  EXPECT_GT(length(bricks, EdgeChoice::boundary), 1.5 * length(bricks, EdgeChoice::feature));
  EXPECT_GT(length(bricks, EdgeChoice::all), 1.01 * length(bricks, EdgeChoice::boundary));
}

}  // namespace
}  // namespace hiac::starter
