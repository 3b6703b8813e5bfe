#include "hiac/tetrahedralize/meshing/surface_meshing.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "tests/tetrahedralize/surfaces.hpp"

namespace hiac {
namespace {

using Position = std::array<double, 3>;

Position minus(std::span<const double, 3> a, std::span<const double, 3> b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Position& a, const Position& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Position cross(const Position& a, const Position& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double volume_of(const ZooMesh& mesh, CellId cell) {
  const auto n = mesh.cell_nodes(cell);
  const auto edge = [&](std::size_t k) { return minus(mesh.position(n[k]), mesh.position(n[0])); };
  return dot(edge(1), cross(edge(2), edge(3))) / 6;
}

double volume_of(const ZooMesh& mesh) {
  double sum = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    EXPECT_GT(volume_of(mesh, cell), 0) << cell;
    sum += volume_of(mesh, cell);
  }
  return sum;
}

// Circumradius over shortest edge.
double shape_of(const ZooMesh& mesh, CellId cell) {
  const auto n = mesh.cell_nodes(cell);
  const auto edge = [&](std::size_t k) { return minus(mesh.position(n[k]), mesh.position(n[0])); };
  const Position a = edge(1), b = edge(2), c = edge(3);
  const Position bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  Position sum{};
  for (std::size_t k = 0; k < 3; ++k)
    sum[k] = dot(a, a) * bc[k] + dot(b, b) * ca[k] + dot(c, c) * ab[k];
  const double radius = std::sqrt(dot(sum, sum)) / std::abs(2 * dot(a, bc));
  double shortest = INFINITY;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Position e = minus(mesh.position(n[i]), mesh.position(n[j]));
      shortest = std::min(shortest, std::sqrt(dot(e, e)));
    }
  return radius / shortest;
}

TEST(SurfaceMeshing, FillsABoxWithoutNewPoints) {
  const ZooMesh mesh = mesh_surface(test::box_surface({0, 0, 0}, {1, 2, 3}), {});
  validate(mesh, "box");
  EXPECT_EQ(mesh.node_count(), 8U);
  EXPECT_NEAR(volume_of(mesh), 6, 1e-14);
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].name, "region");
  for (const double region : mesh.fields[0].values) EXPECT_EQ(region, 1);
}

TEST(SurfaceMeshing, KeepsVolumesAndShapesBelowTheirBounds) {
  const Surface box = test::box_surface({0, 0, 0}, {1, 2, 3});
  const ZooMesh mesh =
      mesh_surface(box, {.quality = 1.5, .max_volume = 0.02, .preserve_surface = false});
  EXPECT_NEAR(volume_of(mesh), 6, 1e-12);
  std::size_t round = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    EXPECT_LE(volume_of(mesh, cell), 0.02 * (1 + 1e-9));
    round += shape_of(mesh, cell) <= 1.5 + 1e-9 ? 1 : 0;
  }
  // TetGen's promise excepts what sharp angles of the surface force
  EXPECT_GE(round, mesh.cell_count() * 99 / 100);
}

TEST(SurfaceMeshing, PreservesTheSurface) {
  const Surface box = test::box_surface({0, 0, 0}, {1, 1, 1});
  for (const bool preserve : {false, true}) {
    const ZooMesh mesh =
        mesh_surface(box, {.quality = 1.5, .max_volume = 0.01, .preserve_surface = preserve});
    EXPECT_NEAR(volume_of(mesh), 1, 1e-13);
    std::size_t on_surface = 0;
    for (NodeId node = 0; node < mesh.node_count(); ++node)
      on_surface +=
          std::ranges::any_of(mesh.position(node), [](double v) { return v == 0 || v == 1; }) ? 1
                                                                                              : 0;
    EXPECT_EQ(on_surface == 8, preserve);
  }
}

TEST(SurfaceMeshing, LeavesHolesAndNamesRegions) {
  Surface nested =
      test::with(test::box_surface({0, 0, 0}, {3, 3, 3}), test::box_surface({1, 1, 1}, {2, 2, 2}));
  EXPECT_NEAR(volume_of(mesh_surface(nested, {})), 27, 1e-12);
  Surface hollow = nested;
  hollow.holes.push_back({1.5, 1.5, 1.5});
  EXPECT_NEAR(volume_of(mesh_surface(hollow, {})), 26, 1e-12);
  nested.regions.push_back({{0.5, 0.5, 0.5}, 7, -1});
  nested.regions.push_back({{1.5, 1.5, 1.5}, 9, 0.05});
  const ZooMesh mesh = mesh_surface(nested, {});
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].name, "region");
  double inner = 0, outer = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const double region = mesh.fields[0].values[cell];
    EXPECT_TRUE(region == 7 || region == 9);
    (region == 9 ? inner : outer) += volume_of(mesh, cell);
    if (region == 9) {
      EXPECT_LE(volume_of(mesh, cell), 0.05 * (1 + 1e-9));
    }
  }
  EXPECT_NEAR(inner, 1, 1e-13);
  EXPECT_NEAR(outer, 26, 1e-12);
}

TEST(SurfaceMeshing, WhatIsNotClosedOrIntersectsIsRefused) {
  Surface open = test::box_surface({0, 0, 0}, {1, 1, 1});
  open.facets.resize(10);
  try {
    mesh_surface(open, {});
    ADD_FAILURE();
  } catch (const JudgementError& error) {
    EXPECT_STREQ(error.what(), "the surface encloses nothing (a closed surface expected)");
  }
  const Surface crossing = test::with(test::box_surface({0, 0, 0}, {1, 1, 1}),
                                      test::box_surface({0.5, 0.25, 0.25}, {2, 0.75, 0.75}));
  EXPECT_THROW(mesh_surface(crossing, {}), JudgementError);
}

}  // namespace
}  // namespace hiac
