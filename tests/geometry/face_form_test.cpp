#include "hiac/geometry/face_form.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/shape_functions.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

constexpr double kStraightness = 1e-10;

// Cells with straight edges and planar faces, some node of which is moved by about as much as
// counts.
class NearlyStraightCells {
 public:
  ZooMesh next(CellKind kind) {
    const auto reference = reference_nodes(kind);
    std::vector<test::Position> positions(reference.begin(), reference.end());
    test::Cell cell{kind, {}};
    for (NodeId i = 0; i < positions.size(); ++i) cell.nodes.push_back(i);
    std::array<test::Position, 3> columns;
    for (test::Position& column : columns)
      for (double& x : column) x = number_(random_);
    for (test::Position& p : positions) {
      const test::Position xi = p;
      for (std::size_t a = 0; a < 3; ++a)
        p[a] = xi[0] * columns[0][a] + xi[1] * columns[1][a] + xi[2] * columns[2][a];
    }
    const std::size_t moved = random_() % (2 * positions.size());
    const double by = std::pow(10.0, -9.75 + number_(random_));
    if (moved < positions.size())
      for (double& x : positions[moved]) x += by * number_(random_);
    return test::make_mesh(positions, {cell});
  }

 private:
  std::mt19937 random_{5};
  std::uniform_real_distribution<double> number_{-1, 1};
};

// By their lengths.
bool is_curved_by_length(const ZooMesh& mesh, const EdgeNodes& edge) {
  const auto at = [&](std::size_t k) { return mesh.position(edge.nodes[k]); };
  const std::size_t last = edge.count - 1;
  const auto distance = [](const auto& a, const auto& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  };
  for (std::size_t k = 1; k < last; ++k) {
    const double s = static_cast<double>(k) / static_cast<double>(last);
    std::array<double, 3> straight;
    for (std::size_t a = 0; a < 3; ++a) straight[a] = at(0)[a] + s * (at(last)[a] - at(0)[a]);
    if (distance(at(k), straight) > kStraightness * distance(at(last), at(0))) return true;
  }
  return false;
}

TEST(FaceForm, CurvedEdgesAreOffByALength) {
  NearlyStraightCells cells;
  std::size_t curved = 0, straight = 0;
  for (int trial = 0; trial < 200; ++trial)
    for (std::size_t k = 0; k < kKindCount; ++k) {
      const auto kind = static_cast<CellKind>(k);
      const ZooMesh mesh = cells.next(kind);
      for (std::size_t e = 0; e < edge_count(kind); ++e) {
        const EdgeNodes edge = edge_nodes(kind, mesh.cell_nodes(0), e);
        const bool is = is_curved(mesh, edge, kStraightness);
        EXPECT_EQ(is, is_curved_by_length(mesh, edge)) << kind_name(kind) << " edge " << e;
        ++(is ? curved : straight);
      }
    }
  EXPECT_GT(curved, 100);
  EXPECT_GT(straight, 100);
}

// A cell's answer is that of its faces.
TEST(FaceForm, ACellHasCurvedFacesWhereAFaceIsCurved) {
  NearlyStraightCells cells;
  std::array<std::array<std::size_t, 2>, kKindCount> count{};
  for (int trial = 0; trial < 200; ++trial)
    for (std::size_t k = 0; k < kKindCount; ++k) {
      const auto kind = static_cast<CellKind>(k);
      const ZooMesh mesh = cells.next(kind);
      bool is_curved = false;
      for (std::size_t f = 0; f < face_count(kind); ++f)
        is_curved = is_curved || face_form(mesh, 0, f, kStraightness).curved;
      EXPECT_EQ(has_curved_faces(mesh, 0, kStraightness), is_curved) << kind_name(kind);
      ++count[k][is_curved ? 1 : 0];
    }
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    EXPECT_GT(count[k][0], 10) << kind_name(kind);
    // triangles are planar
    EXPECT_GE(count[k][1], kind == CellKind::tetrahedron4 ? 0U : 10U) << kind_name(kind);
  }
}

// The centre node of a cubic tetrahedron's face, moved along its normal: as far as counts, it is
// off by more than the fraction of both edges at the face's first corner.
TEST(FaceForm, ACentreNodeMayBeOffItsFace) {
  constexpr double kFraction = 0.01;
  const auto reference = reference_nodes(CellKind::tetrahedron20);
  test::Cell cell{CellKind::tetrahedron20, {}};
  for (NodeId i = 0; i < 20; ++i) cell.nodes.push_back(i);
  for (const std::array<double, 3>& sides :
       {std::array<double, 3>{1, 1, 1}, {3, 1, 1}, {1, 3, 1}, {1, 1, 3}})
    for (std::size_t f = 0; f < 4; ++f) {
      std::vector<test::Position> positions(reference.begin(), reference.end());
      for (test::Position& p : positions)
        for (std::size_t c = 0; c < 3; ++c) p[c] *= sides[c];
      const auto& corners = topology_of(CellKind::tetrahedron20).faces[f].corners;
      std::array<std::size_t, 3> sorted{corners[0], corners[1], corners[2]};
      std::ranges::sort(sorted);
      const auto along = [&](std::size_t k) {
        std::array<double, 3> v;
        for (std::size_t c = 0; c < 3; ++c)
          v[c] = positions[sorted[k]][c] - positions[sorted[0]][c];
        return v;
      };
      const auto u = along(1), v = along(2);
      std::array<double, 3> n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                              u[0] * v[1] - u[1] * v[0]};
      const double area = std::hypot(n[0], n[1], n[2]);
      const double most =
          kFraction * std::max(std::hypot(u[0], u[1], u[2]), std::hypot(v[0], v[1], v[2]));
      for (const double by : {0.0, 0.99, -0.99, 1.01, -1.01}) {
        auto moved = positions;
        for (std::size_t c = 0; c < 3; ++c) moved[16 + f][c] += by * most * n[c] / area;
        const ZooMesh mesh = test::make_mesh(moved, {cell});
        for (std::size_t g = 0; g < 4; ++g) {
          const FaceForm form = face_form(mesh, 0, g, kFraction);
          const bool off = g == f && std::abs(by) > 1;
          EXPECT_EQ(form.curved, off) << f << ' ' << g << ' ' << by;
          EXPECT_EQ(form.shape.degree, off ? 3 : 1);
          EXPECT_EQ(form.shape.centre, off);
        }
        EXPECT_EQ(has_curved_faces(mesh, 0, kFraction), std::abs(by) > 1);
      }
    }
}

// The same corners in the same order from both cells of a face, whatever their numbers are.
TEST(FaceForm, CornersGoFromTheLowestNodeTowardsItsLowerNeighbour) {
  std::mt19937 random(9);
  for (int trial = 0; trial < 20; ++trial)
    for (std::size_t k = 0; k < kKindCount; ++k) {
      const auto kind = static_cast<CellKind>(k);
      const auto reference = reference_nodes(kind);
      std::vector<test::Position> positions(reference.begin(), reference.end());
      test::Cell cell{kind, {}};
      for (NodeId i = 0; i < positions.size(); ++i) cell.nodes.push_back(i);
      std::ranges::shuffle(cell.nodes, random);
      const ZooMesh mesh = test::make_mesh(positions, {cell});
      for (std::size_t f = 0; f < face_count(kind); ++f) {
        const FaceForm form = face_form(mesh, 0, f, kStraightness);
        const ShapeFace& face = topology_of(kind).faces[f];
        const std::size_t n = face.corner_count;
        const auto node = [&](std::size_t c) { return cell.nodes[form.corners[c % n]]; };
        const auto place = [&](std::size_t c) {
          return static_cast<std::size_t>(std::ranges::find(face.corners, form.corners[c]) -
                                          face.corners.begin());
        };
        EXPECT_LT(node(1), node(n - 1)) << kind_name(kind) << " face " << f;
        for (std::size_t c = 1; c < n; ++c) {
          EXPECT_LT(node(0), node(c)) << kind_name(kind) << " face " << f;
          const std::size_t step = (place(c) + n - place(c - 1)) % n;
          EXPECT_EQ(step, (place(1) + n - place(0)) % n);
          EXPECT_TRUE(step == 1 || step == n - 1);
        }
      }
    }
}

// By hand: of a unit square with a corner raised by h, the diagonals (1, 1, h) and (-1, 1, 0) are
// apart by h / sqrt(4 + 2 h^2).
TEST(FaceForm, DeviationIsRelativeToTheLongerDiagonal) {
  constexpr double h = 0.25;
  const std::array<std::array<double, 3>, 4> p{{{0, 0, 0}, {1, 0, 0}, {1, 1, h}, {0, 1, 0}}};
  const double expected = h / std::sqrt(4 + 2 * h * h) / std::sqrt(2 + h * h);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(quadrilateral_deviation(p[k], p[(k + 1) % 4], p[(k + 2) % 4], p[(k + 3) % 4]),
                expected, 1e-15);
  EXPECT_EQ(quadrilateral_deviation(p[0], p[0], p[0], p[0]), 0);
  EXPECT_EQ(quadrilateral_deviation(p[0], p[1], p[0], p[1]), 0);
}

}  // namespace
}  // namespace hiac
