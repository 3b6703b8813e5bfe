#include "hiac/preview/methods/cell_triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "hiac/geometry/predicates.hpp"
#include "tests/preview/drawn.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::preview {
namespace {

// Sum of the lengths that the triangles of flat values have at a screen point, and how many cover
// it. `doubtful` where an edge is nearer than a millionth of a pixel.
struct Covered {
  double length = 0;
  int triangles = 0;
  bool doubtful = false;
};

// A corner of a record's triangle, as the shaders have it.
std::array<double, 2> place(const float* record, std::size_t corner) {
  const float* coarse = record + (corner < 2 ? 2 * corner : 8);
  const float* fine = coarse + (corner < 2 ? 4 : 2);
  return {double{coarse[0]} + double{fine[0]}, double{coarse[1]} + double{fine[1]}};
}

// The length that a record has in the mean of its corners with these shares.
double length(const float* record, RecordShape shape, const std::array<double, 3>& shares) {
  double height = 1;
  for (std::size_t k = 0; k < 3; ++k)
    height = std::min(height, record[kSteep + k] * (shares[k] + 1e-20));
  const float* of = record + kFirstValue;
  const std::size_t n = shape.values;
  const double at_corners = shares[0] * of[0] + shares[1] * of[n] + of[2 * n];
  if (shape != kChord) return at_corners + height * of[3 * n];
  // from that side to the other, between the places where the field has the slab's ends
  const float* rest = of + 4;
  const auto place = [&](double field) {
    return std::clamp((field - at_corners) * rest[1], 0.0, height * rest[0]);
  };
  return std::abs(place(rest[3]) - place(rest[2]));
}

Covered cover(const TriangleBuffer& buffer, double x, double y) {
  Covered result;
  for (std::size_t t = 0; t < buffer.triangles(); ++t) {
    const float* record = buffer.records().data() + t * buffer.shape().floats();
    std::array<double, 3> px, py, area;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = place(record, k);
      px[k] = at[0] - x;
      py[k] = at[1] - y;
    }
    double sum = 0;
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      area[k] = px[i] * py[j] - py[i] * px[j];
      inside &= area[k] >= double{record[kLeast + k]};
      sum += area[k];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      const double side = std::hypot(px[j] - px[i], py[j] - py[i]);
      // near the edge, and within the triangle's reach
      if (std::abs(area[k]) < 2e-6 * side && area[i] > -2e-6 * side && area[j] > -2e-6 * side)
        result.doubtful = true;
    }
    if (!inside) continue;
    ++result.triangles;
    result.length += length(record, buffer.shape(), {area[0] / sum, area[1] / sum, area[2] / sum});
  }
  return result;
}

// The chord of a tetrahedron on the ray of a screen point: between its faces' planes.
double chord(const std::array<std::array<double, 3>, 4>& p, const Projector& projector, double x,
             double y) {
  const auto o = projector.origin(x, y), d = projector.direction(x, y);
  double enter = projector.near(), leave = projector.far();
  for (std::size_t f = 0; f < 4; ++f) {
    const auto &a = p[(f + 1) % 4], &b = p[(f + 2) % 4], &c = p[(f + 3) % 4];
    std::array<double, 3> n{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      n[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    }
    double inner = 0, at = 0, along = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      inner += n[k] * (p[f][k] - a[k]);
      at += n[k] * (o[k] - a[k]);
      along += n[k] * d[k];
    }
    if (inner < 0) {
      at = -at;
      along = -along;
    }
    if (along > 0) enter = std::max(enter, -at / along);
    if (along < 0) leave = std::min(leave, -at / along);
    if (along == 0 && at < 0) return 0;
  }
  return std::max(0.0, leave - enter) * projector.ray_scale(x, y);
}

struct Setting {
  const char* name;
  bool lattice;
  std::vector<double> levels;
  Method method;
  RecordShape shape;
};

// One tetrahedron, sliced: its slabs' lengths add up to the chord, at every point, and no slab
// covers a point twice.
void expect_chords(const Setting& setting) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  int points = 0;
  std::uint64_t slabs = 0;
  for (int i = 0; i < 600; ++i) {
    std::vector<test::Position> corners;
    for (int k = 0; k < 4; ++k) {
      corners.push_back({any(random), any(random), any(random)});
      if (setting.lattice)
        for (double& x : corners.back()) x = std::floor(4 * x) / 4;
    }
    if (orientation(corners[0], corners[1], corners[2], corners[3]) == 0) continue;
    ZooMesh mesh = test::make_mesh(corners, {{CellKind::tetrahedron4, {0, 1, 2, 3}}});
    test::add_node_field(mesh, "f", [&](const test::Position&) {
      return setting.lattice ? std::floor(4 * any(random)) / 4 : any(random);
    });
    Scene scene = test::smooth_scene(Projection::orthographic, Glow::chromaticity);
    if (setting.lattice) {
      scene.camera.eye = {0.5, 0.5, 3};
      scene.camera.up = {0, 1, 0};
    }
    scene.volume.extinction->points.clear();
    for (const double level : setting.levels)
      scene.volume.extinction->points.push_back({level, {2 + level}});
    const Projector projector(scene.camera, scene.image);
    const Frame frame(mesh, scene, projector);
    const RecordShape shape = record_shape(frame, setting.method);
    EXPECT_EQ(shape, setting.shape) << setting.name;
    RegionFiller filler(frame, setting.method, shape, whole_picture(scene.image));
    TriangleBuffer buffer(shape);
    RegionCounts counts;
    filler.fill(std::vector<CellId>{0}, buffer, counts);
    slabs += counts.slabs;
    std::array<std::array<double, 3>, 4> p;
    std::copy_n(corners.begin(), 4, p.begin());
    for (int n = 0; n < 40; ++n) {
      // a point of the tetrahedron, so that its chord is not 0
      std::array<double, 4> share;
      double sum = 0;
      for (double& s : share) sum += s = any(random);
      std::array<double, 3> inside{};
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t c = 0; c < 3; ++c) inside[c] += share[k] / sum * p[k][c];
      ProjectedNode at{};
      ASSERT_TRUE(projector.project(inside, at));
      // triangles that contain no pixel's centre are left out
      const double x = std::floor(at.x) + 0.5, y = std::floor(at.y) + 0.5;
      const Covered covered = cover(buffer, x, y);
      if (covered.doubtful) continue;
      ++points;
      ASSERT_NEAR(covered.length, chord(p, projector, x, y), 3e-5)
          << setting.name << ", tetrahedron " << i << ", " << covered.triangles << " triangles";
      ASSERT_LE(static_cast<std::uint64_t>(covered.triangles), counts.whole + counts.slabs);
    }
  }
  EXPECT_GT(points, 10000);
  if (setting.levels.size() > 1) {
    EXPECT_GT(slabs, 1000U);
  }
}

TEST(CellTriangles, SlabsAddUpToTheTetrahedron) {
  const std::vector<double> levels{0.2, 0.4, 0.5, 0.50001, 0.9};
  expect_chords({"whole", false, {-1}, Method::exact_at_vertices, kFlat});
  expect_chords({"sliced", false, levels, Method::exact_at_vertices, kFlat});
  expect_chords({"whole, by rays", false, {-1}, Method::mean_color, kChord});
  expect_chords({"sliced, by rays", false, levels, Method::mean_color, kChord});
  const std::vector<double> near{0.3, 0.3 + 1e-9};
  expect_chords({"one thin slab", false, near, Method::exact_at_vertices, kFlat});
  expect_chords({"one thin slab, by rays", false, near, Method::mean_color, kChord});
}

// Two triangles of an outline meet at the shorter one of its diagonals, whichever is in front, and
// their own faces are where they are said to be.
TEST(ProjectedTetrahedron, IsCutAlongTheShorterDiagonal) {
  std::mt19937_64 random(14);
  std::uniform_real_distribution<double> any(0, 10);
  const auto distance2 = [](const ScreenPoint& a, const ScreenPoint& b) {
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
  };
  std::array<int, 2> in_front{};
  for (int i = 0; i < 1000; ++i) {
    std::array<ScreenPoint, 4> points;
    std::array<double, 4> depths;
    for (std::size_t k = 0; k < 4; ++k) {
      points[k] = {any(random), any(random)};
      depths[k] = any(random);
    }
    const ProjectedTetrahedron shape = project_tetrahedron(points, depths);
    if (shape.outlines != 2) continue;
    const auto [a, b, c] = shape.outline[0];
    const auto d = shape.outline[1][2];
    ASSERT_EQ(shape.outline[1], (std::array{a, b, d}));
    ASSERT_LE(distance2(points[a], points[b]), distance2(points[c], points[d]));
    const auto& of_diagonal = shape.outline_is_front ? shape.front : shape.back;
    ASSERT_NEAR(of_diagonal[a] + of_diagonal[b], 1, 1e-12);
    ++in_front[shape.outline_is_front ? 1 : 0];
  }
  EXPECT_GT(in_front[0], 200);
  EXPECT_GT(in_front[1], 200);
}

// What needs regions, one thing at a time.
TEST(RecordShape, IsAChordWhereAPixelsRayTellsAll) {
  ZooMesh mesh = test::random_delaunay(50, 3);
  test::add_node_field(mesh, "f", test::smooth_field);
  test::add_node_field(mesh, "g", [](const test::Position& p) { return p[0]; });
  const Scene plain = test::smooth_scene(Projection::orthographic, Glow::chromaticity);
  const auto shape = [&](const Scene& scene, Method method = Method::mean_color) {
    return record_shape(Frame(mesh, scene, Projector(scene.camera, scene.image)), method);
  };
  EXPECT_EQ(shape(plain), kChord);
  EXPECT_EQ(shape(plain, Method::interpolated_opacity), kFlat);
  EXPECT_EQ(shape(plain, Method::exact_at_vertices), kFlat);
  EXPECT_EQ(shape(test::smooth_scene(Projection::perspective, Glow::chromaticity)), kPerspective);
  Scene scene = plain;
  scene.volume.extinction->field = "g";
  EXPECT_EQ(shape(scene), kFlat) << "two fields";
  scene = plain;
  scene.render.integration = Integration::approximate_unsliced;
  EXPECT_EQ(shape(scene), kFlat) << "not sliced";
  scene = plain;
  scene.camera.clip = {2.6, 3.1};
  EXPECT_EQ(shape(scene), kFlat) << "clipped";
  scene.camera.clip = {0.1, 30};
  EXPECT_EQ(shape(scene), kChord) << "a slab that clips nothing";
  scene = plain;
  scene.isosurfaces.emplace_back();
  scene.isosurfaces[0].field = "f";
  scene.isosurfaces[0].value = 0.4;
  EXPECT_EQ(shape(scene), kFlat) << "an isosurface";
  scene = plain;
  scene.volume.extinction->points = {{0.4, {1}}, {0.4 + 1e-6, {1000}}};
  EXPECT_EQ(shape(scene), kFlat) << "a steep function";
}

// A corner whose rest is half of the coarse grid's step: the largest of 16-bit numbers.
TEST(TriangleBuffer, KeepsCornersToTheFineGrid) {
  TriangleBuffer buffer(kFlat);
  const double half = kCoarse / 2;
  buffer.add({212.25 + half, 100, {}}, {300 - half, 20.1, {}}, {0.3, -half, {}});
  ASSERT_EQ(buffer.triangles(), 1U);
  std::vector<double> places;
  for (std::size_t v = 0; v < 3; ++v)
    for (const double x : place(buffer.records().data(), v)) places.push_back(x);
  for (const double place : {212.25 + half, 100.0, 300 - half, 20.1, 0.3, -half})
    EXPECT_TRUE(std::ranges::any_of(places, [&](double found) {
      return std::abs(found - place) <= kFine / 2;
    })) << place;
}

// What a buffer held before says nothing about what it holds now.
TEST(TriangleBuffer, IsAsNewWhenItIsCleared) {
  const TriangleBuffer::Corner a{1, 2, {3, 4, 5, 6, 7}}, b{30, 4, {8, 7, 6, 5, 4}},
      c{7, 40, {1, 5, 2, 6, 3}}, peak{12, 15, {9, 9, 9, 9, 9}};
  TriangleBuffer used(kFlat), fresh(kFlat);
  for (int k = 0; k < 500; ++k) used.add(a, b, c, peak);
  EXPECT_EQ(used.triangles(), 500U);
  EXPECT_EQ(used.records().size(), 500 * kFlat.floats());
  EXPECT_EQ(used.places().size(), 3000U);
  used.clear();
  EXPECT_TRUE(used.records().empty());
  used.add(a, b, c);
  fresh.add(a, b, c);
  EXPECT_TRUE(std::ranges::equal(used.places(), fresh.places()));
  const std::size_t content = kFirstValue + 4 * kFlat.values;
  EXPECT_TRUE(std::ranges::equal(used.records().first(content), fresh.records().first(content)));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(used.records()[kSteep + k], 0);
}

TEST(TriangleBuffer, CountsPlacesFromThePartsCorner) {
  const PixelRect part{100, 40, 50, 50};
  TriangleBuffer of_part(kFlat, part), of_all(kFlat);
  const TriangleBuffer::Corner a{110.3, 50.7, {}}, b{140.1, 45.2, {}}, c{99.6, 80.4, {}};
  of_part.add(a, b, c);
  of_all.add(a, b, c);
  ASSERT_EQ(of_part.triangles(), 1U);
  for (std::size_t v = 0; v < 3; ++v) {
    const auto here = place(of_part.records().data(), v), there = place(of_all.records().data(), v);
    EXPECT_EQ(here[0], there[0] - part.x);
    EXPECT_EQ(here[1], there[1] - part.y);
    EXPECT_NEAR(of_part.places()[2 * v], of_all.places()[2 * v] - static_cast<float>(part.x), 1e-4);
    EXPECT_NEAR(of_part.places()[2 * v + 1],
                of_all.places()[2 * v + 1] - static_cast<float>(part.y), 1e-4);
  }
}

TEST(TriangleBuffer, LeavesOutTrianglesBetweenPixels) {
  struct {
    std::array<double, 6> at;
    bool drawn;
  } const triangles[] = {{{10.6, 20.6, 11.4, 20.7, 11.0, 21.4}, false},   // no centre in the box
                         {{10.4, 20.4, 10.6, 20.4, 10.5, 20.7}, true},    // one inside
                         {{10.2, 20.3, 10.8, 20.9, 10.2, 20.35}, false},  // none but in the box
                         {{10.5, 20.5, 11.2, 20.6, 11.2, 20.9}, true},    // one is a corner
                         {{10.5, 20.1, 10.5, 20.9, 11.2, 20.5}, true},    // ... or on a side
                         {{-3.4, -7.4, -3.6, -7.4, -3.5, -7.7}, true},
                         {{0, 0, 30, 0.9, 30, 1}, true}};  // many in the box: not looked at
  for (const auto& [at, is_drawn] : triangles)
    for (const bool other_way : {false, true}) {
      TriangleBuffer buffer(kFlat);
      const TriangleBuffer::Corner a{at[0], at[1], {}}, b{at[2], at[3], {}}, c{at[4], at[5], {}};
      other_way ? buffer.add(a, c, b) : buffer.add(a, b, c);
      EXPECT_EQ(buffer.triangles(), is_drawn ? 1U : 0U) << at[0] << ' ' << at[1];
    }
}

TEST(CellTriangles, SlabsOfLatticesAddUpToo) {
  const std::vector<double> levels{0, 0.25, 0.375, 0.5, 0.75};
  expect_chords({"lattice, whole", true, {-1}, Method::exact_at_vertices, kFlat});
  expect_chords({"lattice, sliced", true, levels, Method::exact_at_vertices, kFlat});
  expect_chords({"lattice, whole, by rays", true, {-1}, Method::mean_color, kChord});
  expect_chords({"lattice, sliced, by rays", true, levels, Method::mean_color, kChord});
}

}  // namespace
}  // namespace hiac::preview
