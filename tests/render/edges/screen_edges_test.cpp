// The pieces of a mesh's edges on the screen, the tiles that they reach, and the places of what
// they cover of pixels, against the points of the edges themselves.
#include "hiac/render/edges/screen_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/frame/surfaces/boundary_faces.hpp"
#include "hiac/frame/tiles/tile_bins.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/render/edges/chosen_edges.hpp"
#include "hiac/render/edges/strip_coverage.hpp"
#include "hiac/render/edges/tile_edges.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac {
namespace {

using test::Cut;
using test::Position;

class EdgesView {
 public:
  EdgesView(ZooMesh mesh, Scene scene, double width = 3)
      : mesh_(std::move(mesh)), scene_(std::move(scene)), projector_(scene_.camera, scene_.image) {
    test::add_node_field(mesh_, "f", [](const Position& p) { return p[0]; });
    scene_.edges = Edges{EdgeChoice::all, 30, width, {0.2, 1, 0.4}, 0.6};
    frame_ = std::make_unique<const Frame>(mesh_, scene_, projector_);
    edges_ = ScreenEdges(*frame_, scene_);
    tiles_ = tiles_of(scene_.image, whole_picture(scene_.image));
  }

  [[nodiscard]] const ZooMesh& mesh() const { return mesh_; }
  [[nodiscard]] const Projector& projector() const { return projector_; }
  [[nodiscard]] const Frame& frame() const { return *frame_; }
  [[nodiscard]] const ScreenEdges& edges() const { return edges_; }
  [[nodiscard]] const std::vector<TileRect>& tiles() const { return tiles_; }
  // Camera coordinates of a place along a straight edge.
  [[nodiscard]] std::array<double, 3> place(const std::array<NodeId, 2>& edge, double s) const {
    const auto a = mesh_.position(edge[0]), b = mesh_.position(edge[1]);
    return projector_.camera_coordinates(
        Position{a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])});
  }
  [[nodiscard]] std::array<double, 2> on_screen(const std::array<double, 3>& p) const {
    const auto axes = projector_.axes();
    const double scale = projector_.pixels_per_unit() / (projector_.perspective() ? p[2] : 1);
    return {axes.center_x + scale * p[0], axes.center_y - scale * p[1]};
  }
  // All pieces, by their edge and where they begin; each in the tiles that have it.
  using Key = std::pair<std::array<NodeId, 2>, double>;
  [[nodiscard]] std::map<Key, EdgePiece> pieces() const {
    std::map<Key, EdgePiece> all;
    for (const TileRect& tile : tiles_)
      edges_.visit_in(tile, [&](const EdgePiece& piece) { all[{piece.edge, piece.from}] = piece; });
    return all;
  }

 private:
  ZooMesh mesh_;
  Scene scene_;
  Projector projector_;
  std::unique_ptr<const Frame> frame_;
  ScreenEdges edges_;
  std::vector<TileRect> tiles_;
};

// A piece lies where its edge is, from one of its places to the other.
void expect_on_edge(const EdgesView& view, const EdgePiece& piece) {
  for (const bool begin : {true, false}) {
    const auto p = view.place(piece.edge, begin ? piece.from : piece.to);
    const auto [x, y] = view.on_screen(p);
    const double reach = 1 + std::abs(x) + std::abs(y);
    EXPECT_NEAR(begin ? piece.x0 : piece.x1, x, 1e-9 * reach);
    EXPECT_NEAR(begin ? piece.y0 : piece.y1, y, 1e-9 * reach);
    const double depth = begin ? piece.depth0 : piece.depth1;
    EXPECT_NEAR(view.projector().perspective() ? -1 / depth : depth, p[2], 1e-9);
  }
  EXPECT_EQ(piece.ends[0], piece.from == 0 ? piece.edge[0] : kNoNode);
  EXPECT_EQ(piece.ends[1], piece.to == 1 ? piece.edge[1] : kNoNode);
}

TEST(ScreenEdges, LieWhereTheMeshHasThem) {
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    const EdgesView view(test::moved(test::structured(1, Cut::tetrahedra), test::sheared),
                         test::cube_scene(projection, 90, 70));
    const auto pieces = view.pieces();
    EXPECT_EQ(pieces.size(), all_edges(view.mesh()).size());
    for (const auto& [key, piece] : pieces) {
      EXPECT_EQ(piece.from, 0);
      EXPECT_EQ(piece.to, 1);
      expect_on_edge(view, piece);
    }
  }
}

// Of each edge what the slab leaves is left, to its very borders.
TEST(ScreenEdges, EndAtTheBordersOfTheSlab) {
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    Scene scene = test::cube_scene(projection, 90, 70);
    scene.camera.clip = {{3.6, 4.2}};
    const EdgesView view(test::structured(2, Cut::bricks), scene);
    const double near = view.projector().near(), far = view.projector().far();
    const auto pieces = view.pieces();
    std::size_t cut = 0, left_out = 0;
    for (const EdgeNodes& edge : all_edges(view.mesh())) {
      const std::array<NodeId, 2> ends{edge.nodes[0], edge.nodes[1]};
      const double a = view.place(ends, 0)[2], b = view.place(ends, 1)[2];
      const auto found = std::ranges::find_if(
          pieces, [&](const auto& entry) { return entry.first.first == ends; });
      const bool is_seen = std::max(a, b) > near && std::min(a, b) < far;
      ASSERT_EQ(found != pieces.end(), is_seen);
      if (!is_seen) {
        ++left_out;
        continue;
      }
      const EdgePiece& piece = found->second;
      expect_on_edge(view, piece);
      const auto inside = [&](double depth) { return std::clamp(depth, near, far); };
      EXPECT_NEAR(view.place(ends, piece.from)[2], inside(a), 1e-12);
      EXPECT_NEAR(view.place(ends, piece.to)[2], inside(b), 1e-12);
      if (inside(a) != a || inside(b) != b) ++cut;
    }
    EXPECT_GT(cut, 10U);
    EXPECT_GT(left_out, 5U);
  }
}

// Beside the eye edges end a millionth of their farther end's depth in front of it.
TEST(ScreenEdges, EndInFrontOfTheEye) {
  Scene scene = test::cube_scene(Projection::perspective, 90, 70);
  scene.camera.eye = {0.31, 0.42, 0.57};
  scene.camera.look_at = {0.9, 0.7, 0.3};
  scene.camera.fov = 120;
  const EdgesView view(test::structured(1, Cut::bricks), scene);
  std::size_t cut = 0, behind = 0;
  const auto pieces = view.pieces();
  for (const EdgeNodes& edge : all_edges(view.mesh())) {
    const std::array<NodeId, 2> ends{edge.nodes[0], edge.nodes[1]};
    const double a = view.place(ends, 0)[2], b = view.place(ends, 1)[2];
    const auto found =
        std::ranges::find_if(pieces, [&](const auto& entry) { return entry.first.first == ends; });
    if (std::max(a, b) < 0) {
      ++behind;
      EXPECT_EQ(found, pieces.end());
    }
    if (found == pieces.end()) continue;
    const EdgePiece& piece = found->second;
    const double least = 1e-6 * std::max(a, b);
    EXPECT_NEAR(-1 / piece.depth0, std::max(a, least), 1e-12);
    EXPECT_NEAR(-1 / piece.depth1, std::max(b, least), 1e-12);
    EXPECT_NEAR(view.place(ends, piece.from)[2], std::max(a, least), 1e-12);
    EXPECT_NEAR(view.place(ends, piece.to)[2], std::max(b, least), 1e-12);
    if (std::min(a, b) < 0) ++cut;
  }
  EXPECT_GT(cut, 1U);
  EXPECT_GT(behind, 0U);
}

// A curved edge is sixteen straight pieces between points of it.
TEST(ScreenEdges, FollowCurvedEdges) {
  for (const CellKind kind : {CellKind::tetrahedron10, CellKind::tetrahedron20}) {
    const EdgesView view(test::moved(test::straight_mesh(kind),
                                     [](const Position& p) { return test::rippled(p, 0.05); }),
                         test::cube_scene(Projection::perspective, 90, 70));
    const auto pieces = view.pieces();
    const auto edges = all_edges(view.mesh());
    EXPECT_EQ(pieces.size(), 16 * edges.size());
    // the interpolation of the nodes of a line cell
    const std::size_t count = kind == CellKind::tetrahedron10 ? 3 : 4;
    for (const EdgeNodes& edge : edges) {
      const auto point = [&](double s) {
        Position p{};
        for (std::size_t k = 0; k < count; ++k) {
          double weight = 1;
          const double last = static_cast<double>(count - 1), at = static_cast<double>(k) / last;
          for (std::size_t j = 0; j < count; ++j)
            if (j != k)
              weight *= (s - static_cast<double>(j) / last) / (at - static_cast<double>(j) / last);
          for (std::size_t c = 0; c < 3; ++c)
            p[c] += weight * view.mesh().position(edge.nodes[k])[c];
        }
        return view.on_screen(view.projector().camera_coordinates(p));
      };
      const std::array<NodeId, 2> ends{edge.nodes[0], edge.nodes[count - 1]};
      for (int k = 0; k < 16; ++k) {
        const auto found = pieces.find({ends, k / 16.0});
        ASSERT_NE(found, pieces.end());
        const EdgePiece& piece = found->second;
        EXPECT_EQ(piece.to, (k + 1) / 16.0);
        EXPECT_NEAR(piece.x0, point(k / 16.0)[0], 1e-9);
        EXPECT_NEAR(piece.y0, point(k / 16.0)[1], 1e-9);
        EXPECT_NEAR(piece.x1, point((k + 1) / 16.0)[0], 1e-9);
        EXPECT_NEAR(piece.y1, point((k + 1) / 16.0)[1], 1e-9);
        EXPECT_EQ(piece.ends[0], k == 0 ? ends[0] : kNoNode);
        EXPECT_EQ(piece.ends[1], k == 15 ? ends[1] : kNoNode);
      }
    }
  }
}

// A tile has the pieces that come near it, each once, and none that do not.
TEST(ScreenEdges, AreInTheTilesThatTheyReach) {
  for (const double width : {1.0, 9.0}) {
    Scene scene = test::cube_scene(Projection::perspective, 300, 170);
    scene.camera.fov = 22;  // edges beside the picture, too
    const EdgesView view(test::structured(4, Cut::bricks), scene, width);
    const auto pieces = view.pieces();
    std::size_t met = 0, passed = 0;
    for (const TileRect& tile : view.tiles()) {
      std::map<EdgesView::Key, int> times;
      view.edges().visit_in(tile, [&](const EdgePiece& p) {
        ++times[EdgesView::Key{p.edge, p.from}];
      });
      for (const auto& [key, p] : pieces) {
        // how far the box around the piece is from the tile, which whole pixels round
        const auto away = [](double a, double b, double low, double high) {
          return std::max({low - std::max(a, b), std::min(a, b) - high, 0.0});
        };
        const double off = std::max(away(p.x0, p.x1, tile.x0, std::min(tile.x0 + 64, 300)),
                                    away(p.y0, p.y1, tile.y0, std::min(tile.y0 + 32, 170)));
        const int count = times.contains(key) ? times[key] : 0;
        EXPECT_LE(count, 1);
        if (off < width / 2) {
          ++met;
          EXPECT_EQ(count, 1);
        } else if (off > width / 2 + 1) {
          ++passed;
          EXPECT_EQ(count, 0);
        }
      }
    }
    EXPECT_GT(met, 300U);
    EXPECT_GT(passed, 300U);
  }
}

// What covers a pixel, by how much, and the place of the edge that is nearest to its centre.
TEST(TileEdges, SayWhatCoversEveryPixel) {
  constexpr double kLineWidth = 3;
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    Scene scene = test::cube_scene(projection, 100, 50);
    scene.camera.eye = {1.9, 1.4, 1.7};  // near: places along an edge are far from its middle's
    scene.camera.fov = 45;
    const EdgesView view(test::structured(1, Cut::bricks), scene, kLineWidth);
    std::size_t seen = 0, at_ends = 0;
    for (const TileRect& tile : view.tiles()) {
      const TileEdges edges(view.frame(), view.edges(), tile);
      std::map<std::pair<std::size_t, std::array<NodeId, 2>>, double> found;
      edges.visit_all([&](std::size_t at, double share, const TileEdges::Place& place) {
        const EdgePiece& piece = *place.piece;
        ASSERT_TRUE(found.emplace(std::pair{at, piece.edge}, share).second);
        const double x = tile.column(at) + 0.5, y = tile.row(at) + 0.5;
        const auto off = [&](double u) {
          return std::hypot(piece.x0 + u * (piece.x1 - piece.x0) - x,
                            piece.y0 + u * (piece.y1 - piece.y0) - y);
        };
        // the nearest point of the piece on the screen, by halving what may hold it
        double low = 0, high = 1;
        for (int k = 0; k < 80; ++k) {
          const double a = low + (high - low) / 3, b = high - (high - low) / 3;
          (off(a) < off(b) ? high : low) = off(a) < off(b) ? b : a;
        }
        const double s = (low + high) / 2, nearest = off(s);
        const double length = std::hypot(piece.x1 - piece.x0, piece.y1 - piece.y0);
        const auto p = view.place(piece.edge, place.along);
        EXPECT_NEAR(p[2], place.t, 1e-9);
        const auto on_screen = view.on_screen(p);
        EXPECT_NEAR(std::hypot(on_screen[0] - x, on_screen[1] - y), nearest, 1e-6);
        // half the width and half a pixel from an end
        const double reach = (kLineWidth / 2 + 0.5) / length;
        if (std::abs(std::min(s, 1 - s) - reach) > 1e-6) {
          const bool is_near = std::min(s, 1 - s) < reach;
          EXPECT_EQ(place.node, is_near ? piece.ends[s < 0.5 ? 0 : 1] : kNoNode);
          if (is_near) ++at_ends;
        }
        EXPECT_TRUE(edges.left().holds(at));
        ++seen;
      });
      for (const auto& [key, p] : view.pieces())
        for (int y = tile.y0; y < tile.y1; ++y)
          for (int x = tile.x0; x < tile.x1; ++x) {
            const double share =
                strip_coverage({p.x0, p.y0, p.x1, p.y1, kLineWidth}, x + 0.5, y + 0.5);
            const auto entry = found.find({tile.index(x, y), p.edge});
            EXPECT_EQ(entry == found.end() ? 0 : entry->second, share) << x << ' ' << y;
          }
    }
    EXPECT_GT(seen, 500U);
    EXPECT_GT(at_ends, 20U);
  }
}

}  // namespace
}  // namespace hiac
