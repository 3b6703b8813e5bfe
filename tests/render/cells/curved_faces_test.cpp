#include "hiac/render/cells/curved/curved_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/frame/renderable.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "tests/render/truth/curved_cell_truth.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac {
namespace {

using test::cube_scene;
using test::Cut;
using test::Position;
using Real = long double;
using RealPoint = std::array<Real, 3>;

// One cell of a kind, its nodes moved by up to `by` over the order, as a mesh.
ZooMesh any_cell(CellKind kind, double by, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(-1, 1);
  std::vector<Position> positions;
  test::Cell cell{kind, {}};
  for (Position p : reference_nodes(kind)) {
    if (shape_of(kind) == CellShape::wedge) p[0] /= 2;
    for (double& x : p) x += by / static_cast<double>(order_of(kind)) * offset(random);
    cell.nodes.push_back(static_cast<NodeId>(positions.size()));
    positions.push_back(p);
  }
  // node numbers in no order
  std::vector<NodeId> number(cell.nodes);
  std::ranges::shuffle(number, random);
  std::vector<Position> shuffled(positions.size());
  for (std::size_t k = 0; k < positions.size(); ++k) shuffled[number[k]] = positions[k];
  cell.nodes = number;
  ZooMesh mesh = test::make_mesh(shuffled, {cell});
  test::add_node_field(mesh, "f", [](const Position&) { return 0.5; });
  return mesh;
}

// The same, the nodes moved by less where its
// Jacobian would not be positive.
ZooMesh random_cell(CellKind kind, double by, unsigned seed) {
  ZooMesh mesh = any_cell(kind, by, seed);
  for (unsigned more = 1000; !invalid_cells(mesh, 1e-10).empty(); more += 1000)
    mesh = any_cell(kind, by *= 0.9, seed + more);
  return mesh;
}

// A cell as a point set: where x(xi) = point has a solution in the reference cell.
class BruteForceCell {
 public:
  BruteForceCell(const ZooMesh& mesh, CellId cell) : kind_(mesh.kinds[cell]) {
    for (const NodeId node : mesh.cell_nodes(cell)) {
      const auto p = mesh.position(node);
      nodes_.push_back({p[0], p[1], p[2]});
    }
    for (std::size_t k = 0; k < corner_count(kind_); ++k)
      for (std::size_t c = 0; c < 3; ++c)
        middle_[c] += Real(reference_nodes(kind_)[k][c]) / Real(corner_count(kind_));
    last_ = middle_;
  }

  [[nodiscard]] const std::vector<RealPoint>& nodes() const { return nodes_; }

  // Newton's iteration from where the last point was, from the middle, and from every
  // other corner.
  bool holds(const RealPoint& point) {
    if (solved(point, last_)) return true;
    if (solved(point, middle_)) return true;
    for (std::size_t k = 0; k < corner_count(kind_); k += 2) {
      RealPoint start;
      for (std::size_t c = 0; c < 3; ++c)
        start[c] = 0.25L * middle_[c] + 0.75L * Real(reference_nodes(kind_)[k][c]);
      if (solved(point, start)) return true;
    }
    return false;
  }

 private:
  bool solved(const RealPoint& point, RealPoint xi) {
    for (int step = 0; step < 12; ++step) {
      std::array<Real, kMaxNodesPerCell> shape;
      std::array<RealPoint, kMaxNodesPerCell> gradient;
      shape_functions<Real>(kind_, xi, shape);
      shape_gradients<Real>(kind_, xi, gradient);
      RealPoint rest = point;
      std::array<RealPoint, 3> m{};  // columns
      for (std::size_t k = 0; k < nodes_.size(); ++k)
        for (std::size_t c = 0; c < 3; ++c) {
          rest[c] -= shape[k] * nodes_[k][c];
          for (std::size_t a = 0; a < 3; ++a) m[a][c] += gradient[k][a] * nodes_[k][c];
        }
      const auto cross = [](const RealPoint& a, const RealPoint& b) {
        return RealPoint{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};
      };
      const auto dot = [](const RealPoint& a, const RealPoint& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
      };
      const Real det = dot(m[0], cross(m[1], m[2]));
      const RealPoint move{dot(rest, cross(m[1], m[2])) / det, dot(rest, cross(m[2], m[0])) / det,
                           dot(rest, cross(m[0], m[1])) / det};
      Real most = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        xi[c] += move[c];
        most = std::max(most, std::abs(move[c]));
      }
      if (!(most < 10)) return false;
      if (most > 1e-14L) continue;
      if (!in_reference_cell(xi)) return false;
      last_ = xi;
      return true;
    }
    return false;
  }

  [[nodiscard]] bool in_reference_cell(const RealPoint& xi) const {
    const auto& [x, y, z] = xi;
    if (std::min({x, y, z}) < 0) return false;
    switch (shape_of(kind_)) {
      case CellShape::tetrahedron:
        return x + y + z <= 1;
      case CellShape::pyramid:
        return std::max(x, y) + z <= 1;
      case CellShape::prism:
        return std::max(x + y, z) <= 1;
      case CellShape::wedge:
        return std::max(y, z) <= 1 && x + y + z <= 2;
      case CellShape::brick:
        return std::max({x, y, z}) <= 1;
    }
    return false;
  }

  CellKind kind_;
  std::vector<RealPoint> nodes_;
  RealPoint middle_{}, last_{};
};

// The ray parameters at which a ray enters and leaves a cell, in turn: by small steps and
// bisection. What is shorter than `shortest`, three steps, may be missed.
std::vector<double> brute_force(BruteForceCell& cell, const Projector& projector, double x,
                                double y, double& shortest) {
  constexpr int kSteps = 40;
  const auto origin = projector.origin(x, y), direction = projector.direction(x, y);
  const auto at = [&](Real t) {
    return RealPoint{origin[0] + t * direction[0], origin[1] + t * direction[1],
                     origin[2] + t * direction[2]};
  };
  Real low = std::numeric_limits<Real>::infinity(), high = -low;
  for (const RealPoint& p : cell.nodes()) {
    const std::array<double, 3> q{static_cast<double>(p[0]), static_cast<double>(p[1]),
                                  static_cast<double>(p[2])};
    low = std::min(low, Real(projector.parameter(q)));
    high = std::max(high, Real(projector.parameter(q)));
  }
  const Real margin = (high - low) / 4;
  low -= margin;
  high += margin;
  std::vector<double> places;
  bool before = false;
  const Real step = (high - low) / kSteps;
  shortest = static_cast<double>(3 * step);
  for (int i = 1; i <= kSteps; ++i) {
    const Real t = low + i * step;
    const bool here = cell.holds(at(t));
    if (here != before) {
      Real a = t - step, b = t;
      for (int k = 0; k < 50; ++k) {
        const Real m = (a + b) / 2;
        (cell.holds(at(m)) == before ? a : b) = m;
      }
      places.push_back(static_cast<double>(b));
    }
    before = here;
  }
  return places;
}

// Every kind, with faces of every form, against the cell as a point set.
TEST(CurvedFaces, RandomCellsOfEveryKindAgreeWithBruteForce) {
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    if (kind == CellKind::tetrahedron4) continue;
    const ZooMesh mesh = random_cell(kind, 0.2, static_cast<unsigned>(k));
    BruteForceCell cell(mesh, 0);
    std::size_t compared = 0;
    const auto projection = k % 2 == 0 ? Projection::orthographic : Projection::perspective;
    {
      const Scene scene = cube_scene(projection, 4, 4);
      const Projector projector(scene.camera, scene.image);
      const Frame frame(mesh, scene, projector);
      ASSERT_TRUE(has_curved_faces(mesh, 0, frame.straightness));
      std::vector<CellCrossing> crossings;
      scan_cell(frame, 0, {0, 0, 4, 4}, crossings);
      for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
          double shortest = 0;
          const auto expected = brute_force(cell, projector, x + 0.5, y + 0.5, shortest);
          std::vector<double> found;
          for (const CellCrossing& c : crossings)
            if (c.x == x && c.y == y) found.insert(found.end(), {c.front, c.back});
          bool too_short = false;
          for (std::size_t i = 1; i < found.size(); ++i)
            too_short = too_short || found[i] - found[i - 1] < shortest;
          if (too_short) continue;
          ASSERT_EQ(found.size(), expected.size()) << kind_name(kind) << " " << x << " " << y;
          for (std::size_t i = 0; i < found.size(); ++i)
            EXPECT_NEAR(found[i], expected[i], 1e-11) << kind_name(kind) << " " << x << " " << y;
          compared += expected.size() / 2;
        }
    }
    EXPECT_GT(compared, 0U) << kind_name(kind);
  }
}

// Steps are too long for what is short (the test above leaves it out): faces laid out in grids find
// it, and rays that touch a bulge of a face or cut a corner have to be met there, too.
TEST(CurvedFaces, ShortCrossingsAreFound) {
  constexpr int kSide = test::kInstrumented ? 8 : 16;
  std::size_t compared = 0, few = 0;
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    if (kind == CellKind::tetrahedron4) continue;
    const ZooMesh mesh = random_cell(kind, 0.2, static_cast<unsigned>(k));
    const Scene scene =
        cube_scene(k % 2 == 0 ? Projection::perspective : Projection::orthographic, kSide, kSide);
    const Projector projector(scene.camera, scene.image);
    const Frame frame(mesh, scene, projector);
    std::vector<RealPoint> nodes;
    for (const NodeId node : mesh.cell_nodes(0)) {
      const auto p = mesh.position(node);
      nodes.push_back({p[0], p[1], p[2]});
    }
    const test::CurvedCellTruth truth(kind, nodes);
    std::vector<CellCrossing> crossings;
    scan_cell(frame, 0, {0, 0, kSide, kSide}, crossings);
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const auto origin = projector.origin(x + 0.5, y + 0.5),
                   direction = projector.direction(x + 0.5, y + 0.5);
        const auto expected = truth.crossings({origin[0], origin[1], origin[2]},
                                              {direction[0], direction[1], direction[2]});
        std::vector<double> found;
        for (const CellCrossing& c : crossings)
          if (c.x == x && c.y == y) found.insert(found.end(), {c.front, c.back});
        ASSERT_EQ(found.size(), expected.size()) << kind_name(kind) << " " << x << " " << y;
        for (std::size_t i = 0; i < found.size(); ++i) {
          const double other = found[i ^ 1U];
          const double length = std::abs(found[i] - other);
          EXPECT_NEAR(found[i], static_cast<double>(expected[i].t), 1e-12 + 1e-13 / length)
              << kind_name(kind) << " " << x << " " << y;
          ++compared;
          if (length < 0.1) ++few;
        }
      }
  }
  EXPECT_GT(compared, static_cast<std::size_t>(5 * kSide * kSide));
  EXPECT_GT(few, 4U);
}

// Where the nodes are moved at random, places move no farther along the ray than is said.
TEST(CurvedFaces, DoubtsHoldWhatDisplacementsDo) {
  constexpr double kDisplaced = 1e-4;
  constexpr int kSide = 24;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> offset(-1, 1);
  std::size_t certain = 0, all = 0;
  double closest = 0;
  for (const CellKind kind : {CellKind::tetrahedron10, CellKind::tetrahedron20, CellKind::prism24,
                              CellKind::brick20, CellKind::brick32}) {
    const ZooMesh mesh = random_cell(kind, 0.2, static_cast<unsigned>(kind));
    // shape functions sum up to 8 at most without their signs
    const ZooMesh displaced = test::moved(mesh, [&](Position p) {
      for (double& x : p) x += kDisplaced / 14 * offset(random);
      return p;
    });
    const Scene scene = cube_scene(Projection::perspective, kSide, kSide);
    const Projector projector(scene.camera, scene.image);
    const Frame frame(mesh, scene, projector);
    const Frame other(displaced, scene, projector);
    const CellSurface surface = cell_surface(kind, mesh.cell_nodes(0));
    const TileRect tile{0, 0, kSide, kSide};
    CurvedFaces faces(frame, 0, surface), moved(other, 0, surface);
    for (int y = 0; y < kSide; ++y) {
      const auto begin_row = [&](CurvedFaces& f, const Frame& of) {
        std::array<bool, CellSurface::kMostCorners> above{};
        for (std::size_t k = 0; k < surface.corner_count; ++k)
          above[k] = of.nodes[surface.nodes[k]].y <= y + 0.5;
        f.begin_row(y + 0.5, tile, above.data());
      };
      begin_row(faces, frame);
      begin_row(moved, other);
      const auto no_straight_edge = [](std::size_t) { return false; };
      for (int x = 0; x < kSide; ++x) {
        std::vector<std::pair<double, std::size_t>> places;
        moved.at_pixel(x, no_straight_edge, [&](double t, std::size_t face, double, double) {
          places.emplace_back(t, face);
        });
        faces.at_pixel(x, no_straight_edge, [&](double t, std::size_t face, double u, double v) {
          double nearest = std::numeric_limits<double>::infinity();
          for (const auto& [t2, face2] : places)
            if (face2 == face) nearest = std::min(nearest, std::abs(t2 - t));
          ++all;
          // not past an edge, and not where it may not meet the face at all
          const double doubt = faces.doubt(face, u, v, x, kDisplaced);
          if (!std::isfinite(nearest) || !std::isfinite(doubt)) return;
          ++certain;
          const double by = nearest * projector.ray_scale(x + 0.5, y + 0.5);
          EXPECT_LE(by, doubt) << kind_name(kind) << ' ' << x << ' ' << y;
          closest = std::max(closest, by / doubt);
        });
      }
    }
  }
  EXPECT_GT(certain, 400U);
  EXPECT_GT(certain, all * 3 / 4);
  EXPECT_GT(closest, 0.05);
}

// The reference coordinates of a place are those of its point.
TEST(CurvedFaces, ReferenceCoordinatesAreThoseOfThePlace) {
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    const ZooMesh mesh = random_cell(kind, 0.15, static_cast<unsigned>(50 + k));
    const Scene scene = cube_scene(Projection::perspective, 24, 24);
    const Projector projector(scene.camera, scene.image);
    const Frame frame(mesh, scene, projector);
    std::vector<CellCrossing> crossings;
    scan_cell(frame, 0, {0, 0, 24, 24}, crossings);
    EXPECT_GT(crossings.size(), 20U);
    for (const CellCrossing& c : crossings)
      for (const auto& [t, xi] :
           {std::pair{c.front, c.front_reference}, {c.back, c.back_reference}}) {
        if (std::isnan(xi[0])) continue;
        std::array<double, kMaxNodesPerCell> shape;
        shape_functions<double>(kind, xi, shape);
        const auto origin = projector.origin(c.x + 0.5, c.y + 0.5),
                   direction = projector.direction(c.x + 0.5, c.y + 0.5);
        for (std::size_t a = 0; a < 3; ++a) {
          double sum = 0;
          for (std::size_t n = 0; n < node_count(kind); ++n)
            sum += shape[n] * mesh.position(mesh.cell_nodes(0)[n])[a];
          EXPECT_NEAR(sum, origin[a] + t * direction[a], 1e-9) << kind_name(kind);
        }
      }
  }
}

// Both cells of a face find the same crossings of it, bit for bit, by the kernel's rules and by
// those for curved faces, in front of the eye and beside it.
TEST(CurvedFaces, NeighboursFindTheSameCrossings) {
  const auto warped = [](const Position& p) { return test::warped(p, 0.05); };
  for (const ZooMesh& straight :
       {test::mixed_columns(3), test::of_order(test::mixed_columns(2), CellOrder::quadratic),
        test::of_order(test::structured(2, Cut::bricks), CellOrder::cubic)}) {
    ZooMesh mesh = test::moved(straight, warped);
    test::add_node_field(mesh, "f", [](const Position&) { return 0.5; });
    const FaceAdjacency adjacency = build_face_adjacency(mesh);
    const auto offsets = face_offsets(mesh);
    for (const bool inside : {false, true}) {
      Scene scene = cube_scene(Projection::perspective, 40, 30);
      if (inside) scene.camera.eye = {0.52, 0.47, 0.55};
      const Projector projector(scene.camera, scene.image);
      const Frame frame(mesh, scene, projector);
      // by the face's lower cell, what either says
      std::map<std::tuple<CellId, std::size_t, int, int, double>, int> said;
      for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
        std::vector<CellCrossing> crossings;
        scan_cell(frame, cell, {0, 0, 40, 30}, crossings);
        for (const CellCrossing& c : crossings)
          for (const auto& [t, face] : {std::pair{c.front, c.front_face}, {c.back, c.back_face}}) {
            const CellId other = adjacency.neighbors[offsets[cell] + face];
            // what lies wholly behind the eye is not met
            if (other == kNoCell || t < 0) continue;
            std::size_t key = offsets[cell] + face;
            for (std::size_t f = 0; f < face_count(mesh.kinds[other]); ++f)
              if (adjacency.neighbors[offsets[other] + f] == cell)
                key = std::min(key, static_cast<std::size_t>(offsets[other] + f));
            ++said[{std::min(cell, other), key, c.x, c.y, t}];
          }
      }
      EXPECT_GT(said.size(), 400U);
      for (const auto& [key, count] : said) EXPECT_EQ(count % 2, 0);
    }
  }
}

}  // namespace
}  // namespace hiac
