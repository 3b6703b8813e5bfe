#include "hiac/tetrahedralize/cell_cut.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

using Position = std::array<double, 3>;

// Six times the volume, positive as ShapeTopology says.
double turn(const Position& a, const Position& b, const Position& c, const Position& d) {
  const auto minus = [&](const Position& p, std::size_t k) { return p[k] - a[k]; };
  return minus(b, 0) * (minus(c, 1) * minus(d, 2) - minus(c, 2) * minus(d, 1)) -
         minus(b, 1) * (minus(c, 0) * minus(d, 2) - minus(c, 2) * minus(d, 0)) +
         minus(b, 2) * (minus(c, 0) * minus(d, 1) - minus(c, 1) * minus(d, 0));
}

// Six times the volume of a shape's reference cell, by the divergence theorem over its faces.
double reference_volume(CellKind kind) {
  const auto x = reference_nodes(kind);
  double sum = 0;
  for (const ShapeFace& face : topology_of(kind).faces)
    for (std::size_t k = 2; k < face.corner_count; ++k)
      sum += turn({0, 0, 0}, x[face.corners[0]], x[face.corners[k - 1]], x[face.corners[k]]);
  return sum;
}

constexpr std::array kLinear{CellKind::tetrahedron4, CellKind::pyramid5, CellKind::prism6,
                             CellKind::wedge7, CellKind::brick8};

TEST(CellCut, FillsEveryShapeHoweverItsNodesAreNumbered) {
  std::mt19937_64 random(7);
  for (const CellKind kind : kLinear) {
    std::vector<NodeId> nodes(corner_count(kind));
    std::iota(nodes.begin(), nodes.end(), 100);
    const auto x = reference_nodes(kind);
    for (int trial = 0; trial < 200; ++trial) {
      std::shuffle(nodes.begin(), nodes.end(), random);
      double volume = 0;
      const CellCut cut = cut_cell(kind, nodes);
      for (const auto& [a, b, c, d] : cut.all()) {
        const double part = turn(x[a], x[b], x[c], x[d]);
        EXPECT_GT(part, 0) << kind_name(kind);
        volume += part;
      }
      EXPECT_NEAR(volume, reference_volume(kind), 1e-15) << kind_name(kind);
    }
  }
}

TEST(CellCut, AroundTheCenterFillsEveryShapeToo) {
  std::mt19937_64 random(8);
  for (const CellKind kind : kLinear) {
    std::vector<NodeId> nodes(corner_count(kind));
    std::iota(nodes.begin(), nodes.end(), 100);
    std::vector<Position> x(reference_nodes(kind).begin(), reference_nodes(kind).end());
    Position center{};
    for (const Position& corner : x)
      for (std::size_t c = 0; c < 3; ++c) center[c] += corner[c] / static_cast<double>(x.size());
    const auto at = [&](std::uint8_t k) { return k == kCellCenter ? center : x[k]; };
    for (int trial = 0; trial < 50; ++trial) {
      std::shuffle(nodes.begin(), nodes.end(), random);
      double volume = 0;
      const CellCut cut = *cut_cell_at(kCellCenter, kind, nodes, {});
      for (const auto& [a, b, c, d] : cut.all()) {
        const double part = turn(at(a), at(b), at(c), at(d));
        EXPECT_GT(part, 0) << kind_name(kind);
        volume += part;
      }
      EXPECT_NEAR(volume, reference_volume(kind), 1e-15) << kind_name(kind);
    }
  }
}

// The triangles of a cut that lie on one face, as sets of corners.
std::set<std::set<NodeId>> triangles_on(const ShapeFace& face, const CellCut& cut,
                                        const std::vector<NodeId>& nodes) {
  const std::set<std::uint8_t> corners(face.corners.begin(),
                                       face.corners.begin() + face.corner_count);
  std::set<std::set<NodeId>> triangles;
  for (const CornerTetrahedron& t : cut.all())
    for (std::size_t apart = 0; apart < 4; ++apart) {
      std::set<NodeId> triangle;
      bool on_face = true;
      for (std::size_t k = 0; k < 4; ++k) {
        if (k == apart) continue;
        on_face = on_face && corners.contains(t[k]);
        if (on_face) triangle.insert(nodes[t[k]]);
      }
      if (on_face) triangles.insert(triangle);
    }
  return triangles;
}

TEST(CellCut, CutsQuadrilateralsThroughTheirLeastNode) {
  std::mt19937_64 random(8);
  for (const CellKind kind : kLinear) {
    std::vector<NodeId> nodes(corner_count(kind));
    std::iota(nodes.begin(), nodes.end(), 0);
    for (int trial = 0; trial < 50; ++trial) {
      std::shuffle(nodes.begin(), nodes.end(), random);
      const CellCut cut = cut_cell(kind, nodes);
      for (const ShapeFace& face : topology_of(kind).faces) {
        const auto triangles = triangles_on(face, cut, nodes);
        ASSERT_EQ(triangles_on(face, *cut_cell_at(kCellCenter, kind, nodes, {}), nodes), triangles);
        ASSERT_EQ(triangles.size(), face.corner_count - 2U) << kind_name(kind);
        NodeId least = nodes[face.corners[0]];
        for (std::size_t k = 1; k < face.corner_count; ++k)
          least = std::min(least, nodes[face.corners[k]]);
        for (const auto& triangle : triangles) EXPECT_TRUE(triangle.contains(least));
      }
    }
  }
}

// Whatever diagonals are asked for, every apex that there is gives tetrahedra that fill the shape
// and have those diagonals.
TEST(CellCut, FillsShapesWithAnyDiagonals) {
  std::mt19937_64 random(9);
  for (const CellKind kind : kLinear) {
    if (kind == CellKind::tetrahedron4) continue;
    std::vector<NodeId> nodes(corner_count(kind));
    std::iota(nodes.begin(), nodes.end(), 0);
    const auto x = reference_nodes(kind);
    std::size_t cuts = 0;
    for (unsigned long long bits = 0; bits < 64; ++bits) {
      std::shuffle(nodes.begin(), nodes.end(), random);
      const CellCut around = *cut_cell_at(kCellCenter, kind, nodes, bits);
      for (std::uint8_t apex = 0; apex < nodes.size(); ++apex) {
        const auto cut = cut_cell_at(apex, kind, nodes, bits);
        if (!cut) continue;
        ++cuts;
        double volume = 0;
        for (const auto& [a, b, c, d] : cut->all()) volume += turn(x[a], x[b], x[c], x[d]);
        EXPECT_NEAR(volume, reference_volume(kind), 1e-15) << kind_name(kind);
        const auto faces = topology_of(kind).faces;
        for (std::size_t f = 0; f < faces.size(); ++f) {
          const auto triangles = triangles_on(faces[f], *cut, nodes);
          EXPECT_EQ(triangles, triangles_on(faces[f], around, nodes));
          if (faces[f].corner_count == 3) continue;
          NodeId least = nodes[faces[f].corners[0]];
          for (std::size_t k = 1; k < 4; ++k) least = std::min(least, nodes[faces[f].corners[k]]);
          for (const auto& triangle : triangles)
            EXPECT_TRUE(triangle.contains(least) || std::bitset<6>(bits)[f]);
        }
      }
    }
    EXPECT_GT(cuts, 20U) << kind_name(kind);
  }
}

TEST(CellCut, MakesAsManyAsItSays) {
  const std::vector<NodeId> nodes{0, 1, 2, 3, 4, 5, 6, 7};
  EXPECT_EQ(cut_cell(CellKind::brick8, nodes).count, 6U);
  EXPECT_EQ(cut_cell(CellKind::prism6, nodes).count, 3U);
  EXPECT_EQ(cut_cell(CellKind::pyramid5, nodes).count, 2U);
  EXPECT_EQ(cut_cell(CellKind::tetrahedron4, nodes).count, 1U);
  std::vector<NodeId> wedge{1, 2, 3, 4, 5, 6, 0};
  EXPECT_EQ(cut_cell(CellKind::wedge7, wedge).count, 4U);
  wedge = {1, 2, 3, 4, 5, 0, 6};
  EXPECT_EQ(cut_cell(CellKind::wedge7, wedge).count, 5U);
}

}  // namespace
}  // namespace hiac
