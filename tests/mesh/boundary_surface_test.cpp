#include "hiac/mesh/boundary_surface.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include <gmock/gmock.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

using Position = std::array<double, 3>;
using Map = std::function<Position(const Position&)>;
using testing::ElementsAre;

const Map kAsIs = [](const Position& p) { return p; };

/// Cells of one kind, side by side along x by their reference cells, moved by a map; nodes at one
/// place are one node.
ZooMesh cells_of(CellKind kind, int count, const Map& map) {
  ZooMesh mesh;
  std::map<Position, NodeId> numbers;
  std::vector<double> xyz;
  std::vector<NodeId> nodes;
  std::vector<std::uint64_t> elems{0};
  for (int cell = 0; cell < count; ++cell) {
    for (const Position& at : reference_nodes(kind)) {
      const Position p{at[0] + cell, at[1], at[2]};
      const auto [known, is_new] = numbers.emplace(p, static_cast<NodeId>(numbers.size()));
      nodes.push_back(known->second);
      const Position moved = map(p);
      if (is_new) xyz.insert(xyz.end(), moved.begin(), moved.end());
    }
    elems.push_back(nodes.size());
  }
  mesh.xyz = std::move(xyz);
  mesh.nodes = std::move(nodes);
  mesh.elems = std::move(elems);
  mesh.kinds = std::vector<CellKind>(static_cast<std::size_t>(count), kind);
  return mesh;
}

Position point_of(const BoundarySurface& surface, std::uint32_t point) {
  return {surface.xyz[3 * point], surface.xyz[3 * point + 1], surface.xyz[3 * point + 2]};
}

double volume_of(const BoundarySurface& surface) {
  double six = 0;
  for (const auto& t : surface.triangles) {
    const Position a = point_of(surface, t[0]), b = point_of(surface, t[1]),
                   c = point_of(surface, t[2]);
    six += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six / 6;
}

/// Every edge has one triangle on either side, every point a triangle.
void expect_closed(const BoundarySurface& surface) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::set<std::uint32_t> points;
  for (const auto& t : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_TRUE(edges.emplace(t[k], t[(k + 1) % 3]).second);
      points.insert(t[k]);
    }
  for (const auto& [a, b] : edges) EXPECT_TRUE(edges.contains({b, a}));
  EXPECT_EQ(points.size(), surface.xyz.size() / 3);
}

TEST(BoundarySurface, OfEveryKindIsClosedAndHasItsVolume) {
  constexpr std::array<double, kShapeCount> kVolumes{1.0 / 6, 1.0 / 3, 0.5, 1, 1};
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    SCOPED_TRACE(kind_name(kind));
    std::size_t at_level_0 = 0;
    for (const ShapeFace& face : topology_of(kind).faces) at_level_0 += face.corner_count - 2U;
    for (unsigned levels = 0; levels <= 3; ++levels)
      for (const double mirrored : {1.0, -1.0}) {
        const ZooMesh mesh = cells_of(kind, 1, [&](const Position& p) {
          return Position{mirrored * p[0], p[1], p[2]};
        });
        const BoundarySurface surface = boundary_surface(mesh, levels);
        EXPECT_EQ(surface.triangles.size(), at_level_0 << (2 * levels));
        expect_closed(surface);
        EXPECT_NEAR(volume_of(surface), kVolumes[static_cast<std::size_t>(shape_of(kind))], 1e-14);
      }
  }
}

TEST(BoundarySurface, FacesBetweenCellsAreNone) {
  for (const CellKind kind : {CellKind::brick8, CellKind::brick20, CellKind::brick32}) {
    ZooMesh mesh = cells_of(kind, 3, kAsIs);
    for (const bool known : {false, true}) {
      if (known) mesh.adjacency = build_face_adjacency(mesh);
      const BoundarySurface surface = boundary_surface(mesh, 1);
      EXPECT_EQ(surface.triangles.size(), 14U * 8);
      expect_closed(surface);
      EXPECT_NEAR(volume_of(surface), 3, 1e-14);
    }
  }
}

// Chords of the parabola x (1 - x) in m equal steps have the area (1 - 1 / m^2) / 6 below them.
TEST(BoundarySurface, CurvedFacesFollowTheirCells) {
  const auto arched = [](const Position& p) {
    return Position{p[0], p[1], p[2] * (1 + 0.6 * p[0] * (2 - p[0]))};
  };
  const ZooMesh one = cells_of(CellKind::brick20, 1, [&](const Position& p) {
    return arched({2 * p[0], p[1], p[2]});
  });
  EXPECT_EQ(default_boundary_levels(one), 2U);
  EXPECT_EQ(default_boundary_levels(cells_of(CellKind::brick8, 1, kAsIs)), 0U);
  for (unsigned levels = 0; levels <= 4; ++levels) {
    const double m = std::pow(2, levels);
    const double truth = 2 + 0.6 * 8.0 / 6 * (1 - 1 / (m * m));
    const BoundarySurface surface = boundary_surface(one, levels);
    expect_closed(surface);
    EXPECT_NEAR(volume_of(surface), truth, 1e-13) << levels;
  }
}

// The diagonal of a warped quadrilateral goes through its node of least number, from either cell.
TEST(BoundarySurface, QuadrilateralsAreCutThroughTheirLeastNode) {
  const ZooMesh mesh = cells_of(CellKind::brick8, 1, kAsIs);
  for (const auto& t : boundary_surface(mesh, 0).triangles) {
    // points are numbered as faces meet them: by position
    const BoundarySurface surface = boundary_surface(mesh, 0);
    std::array<NodeId, 3> nodes{};
    for (std::size_t k = 0; k < 3; ++k)
      for (NodeId n = 0; n < 8; ++n)
        if (std::ranges::equal(mesh.position(n), point_of(surface, t[k]))) nodes[k] = n;
    std::size_t shared = 0;  // faces, as sets of nodes, that have all three
    for (const ShapeFace& face : topology_of(CellKind::brick8).faces) {
      std::set<NodeId> of_face;
      for (const std::uint8_t corner : face.corners) of_face.insert(mesh.cell_nodes(0)[corner]);
      if (!std::ranges::all_of(nodes, [&](NodeId n) { return of_face.contains(n); })) continue;
      ++shared;
      EXPECT_THAT(nodes, testing::Contains(*of_face.begin()));
    }
    EXPECT_EQ(shared, 1U);
  }
}

TEST(BoundarySurface, CarriesFields) {
  for (const CellKind kind : {CellKind::tetrahedron10, CellKind::brick20, CellKind::wedge18,
                              CellKind::pyramid21, CellKind::prism6}) {
    SCOPED_TRACE(kind_name(kind));
    ZooMesh mesh = cells_of(kind, 2, kAsIs);
    const bool complete = kind == CellKind::tetrahedron10 || kind == CellKind::brick20;
    const auto truth = [&](std::span<const double> p) {
      return 1 + p[0] - 2 * p[1] + 3 * p[2] + (complete ? p[0] * p[0] - p[1] * p[2] : 0);
    };
    std::vector<double> vectors, corners;
    for (NodeId n = 0; n < mesh.node_count(); ++n) {
      vectors.push_back(truth(mesh.position(n)));
      vectors.push_back(7);
    }
    // the cells disagree: what both have at a point gets the mean
    for (CellId cell = 0; cell < 2; ++cell)
      for (std::size_t i = 0; i < mesh.cell_nodes(cell).size(); ++i) corners.push_back(10.0 * cell);
    mesh.fields.push_back({"v", "m", FieldLocation::node, 2, std::move(vectors)});
    mesh.fields.push_back({"c", "", FieldLocation::cell, 1, std::vector<double>{4, 5}});
    mesh.fields.push_back({"d", "", FieldLocation::corner, 1, std::move(corners)});
    const BoundarySurface surface = boundary_surface(mesh, 2);
    ASSERT_EQ(surface.fields.size(), 3U);
    EXPECT_THAT(surface.averaged, ElementsAre("d"));
    EXPECT_EQ(surface.fields[0].unit, "m");
    EXPECT_EQ(surface.fields[0].location, FieldLocation::node);
    EXPECT_EQ(surface.fields[1].location, FieldLocation::cell);
    std::vector<std::set<double>> cells_at(surface.xyz.size() / 3);
    ASSERT_EQ(surface.fields[1].values.size(), surface.triangles.size());
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      for (const std::uint32_t point : surface.triangles[t])
        cells_at[point].insert(surface.fields[1].values[t]);
    for (std::uint32_t p = 0; p < cells_at.size(); ++p) {
      EXPECT_NEAR(surface.fields[0].values[2 * p], truth(point_of(surface, p)), 1e-13);
      EXPECT_NEAR(surface.fields[0].values[2 * p + 1], 7, 1e-13);
      const double mean = surface.fields[2].values[p];
      if (cells_at[p].size() == 1) {
        EXPECT_NEAR(mean, *cells_at[p].begin() == 4 ? 0 : 10, 1e-13);
      } else {
        EXPECT_TRUE(mean > 0 && mean < 10) << mean;
      }
    }
  }
}

}  // namespace
}  // namespace hiac
