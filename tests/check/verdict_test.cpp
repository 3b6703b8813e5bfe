// The figures of cells compared with those of the Verdict library in VTK.

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <vtkHexahedron.h>
#include <vtkMeshQuality.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkTetra.h>

#include "hiac/check/quality/cell_quality.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::test {
namespace {

using enum QualityFigure;

/// Cells of a kind with corners moved at random, some of them nearly flat, folded
/// or inside out.
template <typename VtkCell, typename Compare>
void for_each_cell(CellKind kind, const Compare& compare) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 500; ++round) {
    const double amount = 0.1 + 0.6 * (round % 10) / 10.0;
    std::vector<Position> places;
    Cell cell{kind, {}};
    vtkNew<VtkCell> theirs;
    for (const auto& p : reference_nodes(kind)) {
      const auto n = static_cast<NodeId>(places.size());
      Position q = p;
      for (double& x : q) x += amount * unit(random);
      if (round % 7 == 0) q[2] *= 0.01;
      if (round % 5 == 0) q[0] = -q[0];
      cell.nodes.push_back(n);
      places.push_back(q);
      theirs->GetPoints()->SetPoint(n, q.data());
    }
    compare(make_mesh(places, {cell}), theirs.Get());
  }
}

double ours(const ZooMesh& mesh, QualityFigure figure) { return quality_of(mesh, 0, figure, 1); }

void expect_near(double mine, double theirs, const char* what) {
  EXPECT_NEAR(mine, theirs, 1e-9 * std::max(1.0, std::abs(theirs))) << what;
}

/// By VTK's table of a cell's edges: its own ratio for hexahedra leaves edges out in version 9.1.
double edge_ratio_of(vtkCell* cell) {
  double least = 1e300, most = 0;
  for (int e = 0; e < cell->GetNumberOfEdges(); ++e) {
    const double square = cell->GetEdge(e)->GetLength2();
    least = std::min(least, square);
    most = std::max(most, square);
  }
  return std::sqrt(most / least);
}

TEST(Verdict, Tetrahedra) {
  using Q = vtkMeshQuality;
  for_each_cell<vtkTetra>(CellKind::tetrahedron4, [](const ZooMesh& mesh, vtkCell* cell) {
    expect_near(ours(mesh, volume), Q::TetVolume(cell), "volume");
    expect_near(ours(mesh, edge_ratio), Q::TetEdgeRatio(cell), "edge_ratio");
    expect_near(ours(mesh, aspect_ratio), std::abs(Q::TetAspectRatio(cell)), "aspect_ratio");
    if (ours(mesh, volume) > 0) {
      expect_near(ours(mesh, scaled_jacobian), Q::TetScaledJacobian(cell), "scaled_jacobian");
      expect_near(ours(mesh, radius_ratio), Q::TetRadiusRatio(cell), "radius_ratio");
      expect_near(ours(mesh, condition), Q::TetCondition(cell), "condition");
    } else {
      EXPECT_TRUE(std::isnan(ours(mesh, condition)));
    }
  });
}

TEST(Verdict, Bricks) {
  using Q = vtkMeshQuality;
  int folded = 0;
  for_each_cell<vtkHexahedron>(CellKind::brick8, [&](const ZooMesh& mesh, vtkCell* cell) {
    expect_near(ours(mesh, edge_ratio), edge_ratio_of(cell), "edge_ratio");
    expect_near(ours(mesh, scaled_jacobian), Q::HexScaledJacobian(cell), "scaled_jacobian");
    if (std::isnan(ours(mesh, condition)))
      ++folded;
    else
      expect_near(ours(mesh, condition), Q::HexCondition(cell), "condition");
  });
  EXPECT_GT(folded, 50);
  EXPECT_LT(folded, 450);
}

}  // namespace
}  // namespace hiac::test
