// Cells cut into tetrahedra of positive volume: volumes against closed forms, fields against the
// functions that they are.
#include "hiac/tetrahedralize/cut_cells.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "hiac/frame/renderable.hpp"
#include "hiac/mesh/parts/keep_cells.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using test::Position;

double determinant(const Position& a, const Position& b, const Position& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

Position between(const ZooMesh& mesh, NodeId from, NodeId to) {
  Position edge;
  for (std::size_t c = 0; c < 3; ++c) edge[c] = mesh.position(to)[c] - mesh.position(from)[c];
  return edge;
}

/// A trilinear brick's volume: under a bilinear face lies as much as under the mean of its two
/// divisions into triangles (J. Grandy, "Efficient computation of volume of hexahedral cells",
/// 1997).
double brick_volume(const ZooMesh& mesh, CellId cell) {
  double twelve = 0;
  for (const ShapeFace& face : topology_of(CellShape::brick).faces)
    for (std::size_t k = 0; k < 4; ++k) {
      Position corners[3];
      for (std::size_t i = 0; i < 3; ++i) {
        const auto at = mesh.position(mesh.cell_nodes(cell)[face.corners[(k + i) % 4]]);
        std::copy(at.begin(), at.end(), corners[i].begin());
      }
      twelve += determinant(corners[0], corners[1], corners[2]);
    }
  return twelve / 12;
}

double tetrahedron_volume(const ZooMesh& mesh, CellId cell) {
  const auto n = mesh.cell_nodes(cell);
  return determinant(between(mesh, n[0], n[1]), between(mesh, n[0], n[2]),
                     between(mesh, n[0], n[3])) /
         6;
}

/// 3^3 bricks whose inner nodes are moved so far that some are turned inside out in part.
ZooMesh tangled(unsigned seed, bool mirrored) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> off(-0.25, 0.25);
  ZooMesh mesh = test::moved(test::structured(3, test::Cut::bricks), [&](const Position& p) {
    Position q = p;
    const bool inside =
        std::all_of(p.begin(), p.end(), [](double x) { return x > 0.01 && x < 0.99; });
    for (std::size_t c = 0; c < 3; ++c)
      if (inside) q[c] += off(random);
    if (mirrored) q[0] = -q[0];
    return q;
  });
  test::add_node_field(mesh, "f",
                       [](const Position& p) { return 1 + p[0] - 2 * p[1] + 0.5 * p[2]; });
  std::vector<double> numbers, corners;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    numbers.push_back(cell);
    for (const NodeId node : mesh.cell_nodes(cell)) {
      const auto p = mesh.position(node);
      corners.push_back(p[0] + p[1] + cell);
    }
  }
  mesh.fields.push_back({"number", "", FieldLocation::cell, 1, std::move(numbers)});
  mesh.fields.push_back({"corner", "", FieldLocation::corner, 1, std::move(corners)});
  return mesh;
}

void expect_fields(const ZooMesh& mesh) {
  for (NodeId node = 0; node < mesh.node_count(); ++node) {
    const auto p = mesh.position(node);
    EXPECT_NEAR(mesh.fields[0].values[node], 1 + p[0] - 2 * p[1] + 0.5 * p[2], 1e-14);
  }
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    for (std::uint64_t e = mesh.elems[cell]; e < mesh.elems[cell + 1]; ++e) {
      const auto p = mesh.position(mesh.nodes[e]);
      EXPECT_NEAR(mesh.fields[2].values[e], p[0] + p[1] + mesh.fields[1].values[cell], 1e-13);
    }
}

TEST(CutCells, TetrahedraArePositiveAndTheChangeOfVolumeIsStated) {
  bool any_centre = false;
  for (unsigned seed = 1; seed <= 12; ++seed)
    for (const bool mirrored : {false, true}) {
      SCOPED_TRACE(seed);
      const ZooMesh mesh = tangled(seed, mirrored);
      const std::vector<CellId> invalid = invalid_cells(mesh, 1e-10);
      ASSERT_FALSE(invalid.empty());
      const CutMesh cut = cut_cells(mesh, invalid);
      validate(cut.mesh, "cut");
      expect_fields(cut.mesh);
      EXPECT_TRUE(invalid_cells(cut.mesh, 1e-10).empty());
      std::vector<double> filled(mesh.cell_count(), 0.0);
      for (CellId cell = 0; cell < cut.mesh.cell_count(); ++cell) {
        const auto parent = static_cast<CellId>(cut.mesh.fields[1].values[cell]);
        if (cut.mesh.kinds[cell] == CellKind::brick8) {
          EXPECT_NEAR(brick_volume(cut.mesh, cell), brick_volume(mesh, parent), 1e-15);
          filled[parent] = -1;
          continue;
        }
        EXPECT_GT(tetrahedron_volume(cut.mesh, cell), 0);
        filled[parent] += tetrahedron_volume(cut.mesh, cell);
      }
      double change = 0, volume = 0;
      for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
        volume += std::abs(brick_volume(mesh, cell));
        const bool is_cut = std::ranges::binary_search(invalid, cell);
        EXPECT_EQ(filled[cell] < 0, !is_cut);
        if (is_cut) change += std::abs(filled[cell] - std::abs(brick_volume(mesh, cell)));
      }
      EXPECT_NEAR(cut.volume_change, change, 1e-13);
      EXPECT_NEAR(cut.volume, volume, 1e-13);
      EXPECT_EQ(cut.tetrahedra + mesh.cell_count() - invalid.size(), cut.mesh.cell_count());
      any_centre = any_centre || cut.mesh.node_count() > mesh.node_count();
    }
  EXPECT_TRUE(any_centre);
}

TEST(CutCells, WithoutInvalidCellsNothingChanges) {
  const ZooMesh mesh = test::structured(2, test::Cut::pyramids);
  const CutMesh cut = cut_cells(mesh, {});
  EXPECT_TRUE(std::ranges::equal(cut.mesh.nodes.view(), mesh.nodes.view()));
  EXPECT_TRUE(std::ranges::equal(cut.mesh.xyz.view(), mesh.xyz.view()));
  EXPECT_TRUE(std::ranges::equal(cut.mesh.elems.view(), mesh.elems.view()));
  EXPECT_EQ(cut.volume_change, 0);
  EXPECT_NEAR(cut.volume, 1, 1e-14);
}

TEST(CutCells, LeftOutCellsTakeTheirNodesWithThem) {
  const ZooMesh mesh = tangled(1, false);
  std::vector<bool> keep(mesh.cell_count(), false);
  keep[5] = true;
  const ZooMesh left = keep_cells(mesh, keep);
  validate(left, "left");
  ASSERT_EQ(left.cell_count(), 1U);
  EXPECT_EQ(left.node_count(), 8U);
  EXPECT_EQ(left.fields[1].values[0], 5);
  EXPECT_EQ(brick_volume(left, 0), brick_volume(mesh, 5));
  expect_fields(left);
}

}  // namespace
}  // namespace hiac
