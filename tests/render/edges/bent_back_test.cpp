// Edges of faces that bend back, which a ray meets twice, against brute force: an edge is seen
// where a ray through it meets no face before.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/frame/projection.hpp"
#include "hiac/frame/surfaces/boundary_faces.hpp"
#include "hiac/render/edges/chosen_edges.hpp"
#include "tests/render/truth/curved_cell_truth.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/render/truth/sampled_strips.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac {
namespace {

using test::Position;

constexpr std::uint32_t kWidth = 120, kHeight = 90;

// Along the arch, from `above` degrees over the horizon.
Scene arch_scene(Projection projection, double above, double aside) {
  Scene scene = test::cube_scene(projection, kWidth, kHeight);
  scene.volume = {};
  const double up = above * std::numbers::pi / 180, turn = aside * std::numbers::pi / 180;
  Camera& camera = scene.camera;
  camera.look_at = {0, 0.5, 0.7};
  camera.eye = {camera.look_at[0] - 6 * std::cos(up) * std::cos(turn),
                camera.look_at[1] - 6 * std::cos(up) * std::sin(turn),
                camera.look_at[2] + 6 * std::sin(up)};
  camera.up = {0, 0, 1};
  camera.height = 3.2;
  camera.fov = 30;
  Skin& skin = scene.skin.emplace();
  skin.color = {0.9, 0.6, 0};
  skin.specular = 0;
  skin.opacity = 1;
  Edges& edges = scene.edges.emplace();
  edges.show = EdgeChoice::boundary;
  edges.color = {0, 0, 1};
  edges.width = 1.6;
  return scene;
}

// A short piece of an edge on the screen, and whether it is seen.
struct Piece {
  Strip strip;
  bool is_seen;
};

class ArchTruth {
 public:
  using Real = long double;
  using Vec = std::array<Real, 3>;

  ArchTruth(const ZooMesh& mesh, const Scene& scene)
      : mesh_(mesh), scene_(scene), projector_(scene.camera, scene.image) {
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
      std::vector<Vec> nodes;
      for (const NodeId node : mesh.cell_nodes(cell)) {
        const auto p = mesh.position(node);
        nodes.push_back(real({p[0], p[1], p[2]}));
      }
      cells_.emplace_back(mesh.kinds[cell], nodes);
    }
    for (const EdgeNodes& edge : chosen_edges(mesh, *scene.edges, boundary_faces(mesh)))
      add_edge(edge);
  }

  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }

 private:
  static Vec real(const Position& p) { return {p[0], p[1], p[2]}; }

  // The quadratic edge's sixteen straight pieces, each in parts that are seen or hidden as a whole.
  void add_edge(const EdgeNodes& edge) {
    constexpr int kPieces = 16, kParts = 4;
    const auto on_edge = [&](double s) {
      Position point{};
      for (std::size_t k = 0; k < edge.count; ++k) {
        double weight = 1;
        for (std::size_t j = 0; j < edge.count; ++j)
          if (j != k)
            weight *= (s * static_cast<double>(edge.count - 1) - static_cast<double>(j)) /
                      (static_cast<double>(k) - static_cast<double>(j));
        for (std::size_t c = 0; c < 3; ++c) point[c] += weight * mesh_.position(edge.nodes[k])[c];
      }
      return point;
    };
    for (int piece = 0; piece < kPieces; ++piece) {
      const auto from = on_screen(on_edge(static_cast<double>(piece) / kPieces));
      const auto to = on_screen(on_edge((piece + 1.0) / kPieces));
      for (int part = 0; part < kParts; ++part) {
        const double s = static_cast<double>(part) / kParts, e = (part + 1.0) / kParts;
        const auto at = [&](double u, std::size_t c) { return from[c] + u * (to[c] - from[c]); };
        pieces_.push_back({{at(s, 0), at(s, 1), at(e, 0), at(e, 1), scene_.edges->width},
                           is_seen(on_edge((piece + 0.5 * (s + e)) / kPieces))});
      }
    }
  }

  [[nodiscard]] std::array<double, 2> on_screen(const Position& p) const {
    ProjectedNode node;
    projector_.project(p, node);
    return {node.x, node.y};
  }

  // Whether the ray through a point meets no face in front of it.
  [[nodiscard]] bool is_seen(const Position& point) const {
    const Vec eye = real(scene_.camera.eye), aim = real(scene_.camera.look_at);
    Vec direction{}, origin{};
    for (std::size_t c = 0; c < 3; ++c) {
      direction[c] = scene_.camera.projection == Projection::perspective
                         ? static_cast<Real>(point[c]) - eye[c]
                         : aim[c] - eye[c];
      origin[c] = point[c] - direction[c];
    }
    for (const auto& cell : cells_)
      for (const auto& crossing : cell.crossings(origin, direction))
        if (crossing.t < 1 - 0.005L) return false;
    return true;
  }

  const ZooMesh& mesh_;
  const Scene& scene_;
  Projector projector_;
  std::vector<test::CurvedCellTruth> cells_;
  std::vector<Piece> pieces_;
};

struct Judged {
  double largest = 0;
  std::size_t seen = 0, hidden = 0;
};

// Where all pieces near a pixel are seen, or all are hidden: elsewhere rays of one pixel differ.
Judged judge(const ZooMesh& mesh, const Scene& scene) {
  const Image image = test::draw(mesh, scene).image;
  const ArchTruth truth(mesh, scene);
  Judged result;
  for (std::uint32_t j = 0; j < kHeight; ++j)
    for (std::uint32_t i = 0; i < kWidth; ++i) {
      const double x = i + 0.5, y = j + 0.5;
      std::vector<Strip> near;
      std::size_t seen = 0;
      for (const Piece& piece : truth.pieces()) {
        const Strip& s = piece.strip;
        if (std::hypot(0.5 * (s.x0 + s.x1) - x, 0.5 * (s.y0 + s.y1) - y) > 4) continue;
        near.push_back(s);
        seen += piece.is_seen ? 1 : 0;
      }
      if (near.empty() || (seen != 0 && seen != near.size())) continue;
      const double covered = test::sampled_coverage(near, x, y);
      if (covered > 0) ++(seen > 0 ? result.seen : result.hidden);
      const double expected = seen > 0 ? covered : 0;
      result.largest = std::max(result.largest, std::abs(image.at(i, j, 2) - expected));
    }
  return result;
}

TEST(EdgesOfBentFaces, AreDrawnWhereTheFaceIsMetAtThem) {
  for (const CellKind kind : {CellKind::brick20, CellKind::prism15, CellKind::brick32})
    for (const Projection projection : {Projection::orthographic, Projection::perspective})
      for (const double above : test::tried(std::vector{25.0, 12.0, 40.0})) {
        const ZooMesh mesh = test::arch(kind, 150);
        const Judged found = judge(mesh, arch_scene(projection, above, 8));
        EXPECT_LE(found.largest, 0.02) << kind_name(kind) << ' ' << above;
        EXPECT_GT(found.seen, 100U) << kind_name(kind) << ' ' << above;
        EXPECT_GT(found.hidden, 30U) << kind_name(kind) << ' ' << above;
      }
}

}  // namespace
}  // namespace hiac
