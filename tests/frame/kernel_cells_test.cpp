#include "hiac/frame/kernel_cells.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/shape_functions.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using test::Position;

// A cell of its reference nodes.
ZooMesh reference_cell(CellKind kind) {
  const auto reference = reference_nodes(kind);
  test::Cell cell{kind, {}};
  for (NodeId node = 0; node < reference.size(); ++node) cell.nodes.push_back(node);
  return test::make_mesh({reference.begin(), reference.end()}, {cell});
}

CellKernel kernel_for(const ZooMesh& mesh, const std::vector<ProjectedNode>& nodes,
                      double straightness = 1e-10) {
  const auto kernels = kernel_cells(mesh, nodes, straightness);
  EXPECT_EQ(kernels.size(), 1U);
  return kernels[0];
}

// All corners on the screen apart, none in front of another.
std::vector<ProjectedNode> spread_nodes(std::size_t count) {
  std::vector<ProjectedNode> nodes{{3, 4, 1}, {50, 7, 2}, {11, 60, 3}, {24, 21, 4}};
  nodes.resize(count, {20, 20, 2});
  return nodes;
}

TEST(KernelCells, TetrahedraHaveTheKernelOfTheirOrder) {
  EXPECT_EQ(kernel_for(reference_cell(CellKind::tetrahedron4), spread_nodes(4)),
            CellKernel::linear);
  EXPECT_EQ(kernel_for(reference_cell(CellKind::tetrahedron10), spread_nodes(10)),
            CellKernel::quadratic);
  EXPECT_EQ(kernel_for(reference_cell(CellKind::tetrahedron20), spread_nodes(20)),
            CellKernel::cubic);
  for (const CellKind kind : {CellKind::pyramid5, CellKind::prism6, CellKind::wedge7,
                              CellKind::brick8, CellKind::prism15, CellKind::brick32})
    EXPECT_EQ(kernel_for(reference_cell(kind), spread_nodes(node_count(kind))),
              CellKernel::none_planar)
        << kind_name(kind);
}

TEST(KernelCells, TetrahedraWithACornerBesideTheEyeHaveNone) {
  for (std::size_t k = 0; k < 4; ++k) {
    auto nodes = spread_nodes(4);
    nodes[k].depth = std::nan("");
    EXPECT_EQ(kernel_for(reference_cell(CellKind::tetrahedron4), nodes), CellKernel::none_planar);
  }
}

// Three corners on a line of the screen but for a width in pixels: it is the triangle's area
// divided by its longest extent along an axis.
TEST(KernelCells, TetrahedraWithAThinFaceHaveNone) {
  const ZooMesh mesh = reference_cell(CellKind::tetrahedron4);
  for (std::size_t apex = 0; apex < 4; ++apex)
    for (const bool turned : {false, true})
      for (const bool first : {false, true})
        for (const double width : {1.01, 0.99, -0.99, -1.01, 0.66, 0.64, -0.64}) {
          const double aside = width * 0x1p-13;
          // the corners of the face, one of them beside the middle of the others
          std::vector<ProjectedNode> face{{0, 0, 1}, {40, 0, 1}, {first ? 13.0 : 26.0, aside, 1}};
          std::rotate(face.begin(), face.begin() + (first ? 1 : 2), face.end());
          std::vector<ProjectedNode> nodes;
          for (std::size_t k = 0, next = 0; k < 4; ++k)
            nodes.push_back(k == apex ? ProjectedNode{17, 31, 2} : face[next++]);
          if (turned)
            for (ProjectedNode& p : nodes) std::swap(p.x, p.y);
          // extents count from the first corner, as far as to the end of the line or less
          double longest = 0;
          for (const ProjectedNode& p : face)
            longest = std::max(longest, std::abs(p.x - face[0].x));
          const double area = std::abs(aside) * 40;
          const bool thin = !(area > 0x1p-13 * longest);
          EXPECT_EQ(kernel_for(mesh, nodes), thin ? CellKernel::none_planar : CellKernel::linear)
              << apex << ' ' << turned << ' ' << width;
        }
}

TEST(KernelCells, TetrahedraWithBentEdgesHaveNone) {
  for (const CellKind kind : {CellKind::tetrahedron10, CellKind::tetrahedron20}) {
    const auto straight = reference_cell(kind);
    const auto nodes = spread_nodes(node_count(kind));
    const CellKernel kernel =
        kind == CellKind::tetrahedron10 ? CellKernel::quadratic : CellKernel::cubic;
    std::vector<double> xyz(straight.xyz.begin(), straight.xyz.end());
    ZooMesh bent = straight;
    xyz[3 * 4 + 2] += 0.01;  // the first node of an edge of length 1
    bent.xyz = std::move(xyz);
    EXPECT_EQ(kernel_for(bent, nodes, 0.0099), CellKernel::none_curved);
    EXPECT_EQ(kernel_for(bent, nodes, 0.0101), kernel);
  }
}

TEST(KernelCells, OfCellsWithATwistedFaceAreNone) {
  ZooMesh mesh = reference_cell(CellKind::brick8);
  std::vector<double> xyz(mesh.xyz.begin(), mesh.xyz.end());
  xyz[2] -= 0.1;
  mesh.xyz = std::move(xyz);
  EXPECT_EQ(kernel_for(mesh, spread_nodes(8)), CellKernel::none_curved);
  EXPECT_EQ(kernel_for(mesh, spread_nodes(8), 0.2), CellKernel::none_planar);
}

}  // namespace
}  // namespace hiac
