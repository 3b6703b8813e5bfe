// Real meshes, ordered and drawn from all sides: no ray segment may be met out of order, unless
// cells overlap, which is proven of the very segments. Where some are, the order is made again with
// the cells that overlap known to it: then what does not overlap has to be in order.
//
// By default those of a few thousand cells; HIAC_ALL_DATA=1 in the environment takes all of them
// and prints what became of each.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <optional>
#include <vector>

#include "hiac/check/overlap.hpp"
#include "hiac/frame/projection.hpp"
#include "hiac/frame/renderable.hpp"
#include "hiac/geometry/box.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/order/order_basis.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/render/explain_pixel.hpp"
#include "hiac/scene/view_of.hpp"
#include "tests/formats/files.hpp"
#include "tests/support/cell_distance.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::formats {
namespace {

namespace fs = std::filesystem;
using test::Position;
using test::operator+;
using test::operator*;

constexpr std::size_t kMostCells = test::kInstrumented ? 150 : 1200;
constexpr std::uintmax_t kMostBytes = 2'000'000;

// Violations of a mesh that are looked into, one by one.
constexpr std::size_t kMostJudged = 40;

// Direction i of n, spread evenly over the sphere (a Fibonacci lattice).
Position direction(int i, int n) {
  const double z = 1 - (2 * i + 1.0) / n, angle = 2 * std::numbers::pi * i / std::numbers::phi;
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// Ten parallel views, three of them along the axes, and ten in perspective, one from the middle.
std::vector<Camera> cameras_around(const Box& box) {
  std::vector<Camera> cameras;
  Position center;
  for (std::size_t c = 0; c < 3; ++c) center[c] = 0.5 * (box.low[c] + box.high[c]);
  const auto add = [&](Projection projection, const Position& from, double distance) {
    Camera camera;
    camera.projection = projection;
    for (std::size_t c = 0; c < 3; ++c)
      camera.eye[c] = center[c] + distance * box.diagonal() * from[c];
    camera.look_at = center;
    camera.up = std::abs(from[2]) < 0.9 ? Position{0, 0, 1} : Position{0, 1, 0};
    camera.fov = 40;
    camera.height = box.diagonal();
    cameras.push_back(camera);
  };
  for (const Position& axis : {Position{1, 0, 0}, {0, -1, 0}, {0, 0, 1}})
    add(Projection::orthographic, axis, 2);
  for (int i = 0; i < 7; ++i) add(Projection::orthographic, direction(i, 7), 2);
  for (int i = 0; i < 9; ++i) add(Projection::perspective, direction(i, 9), 1.6);
  add(Projection::perspective, direction(1, 3), 0.01);
  return cameras;
}

Scene scene_of(const Camera& camera) {
  Scene scene;
  scene.image = {48, 48};
  scene.camera = camera;
  scene.volume.color = ColorTransfer{"shade", {{0, {0.1, 0.2, 0.9}}, {1, {0.9, 0.1, 0.1}}}};
  scene.volume.extinction = ExtinctionTransfer{"shade", {{0, {0.01}}}};
  return scene;
}

struct Outcome {
  std::string refused;                 // why there is no picture
  std::size_t cells = 0, skipped = 0;  // skipped: turned inside out in part
  std::uint64_t segments = 0, violations = 0, largest_group = 1;
  // of what violations are left with the cells that overlap known to the order
  std::size_t judged = 0, overlapping = 0;
};

// Whether a segment that is out of order overlaps one in front of it, and the point between is in
// both cells by their own maps: then it is the mesh that is wrong, and no order is right.
bool cells_overlap_at(const ZooMesh& mesh, const Projector& projector,
                      const PixelExplanation& pixel, std::size_t out_of_order) {
  const PixelSegment& late = pixel.segments[out_of_order];
  const double x = pixel.x + 0.5, y = pixel.y + 0.5;
  const auto origin = test::vec(projector.origin(x, y)),
             direction = test::vec(projector.direction(x, y));
  const double size = box_of_cells(mesh).diagonal();
  for (std::size_t k = 0; k < out_of_order; ++k) {
    const PixelSegment& early = pixel.segments[k];
    const double front = std::max(early.front.depth, late.front.depth),
                 back = std::min(early.back.depth, late.back.depth);
    if (back - front <= 1e-9 * size) continue;
    const long double t = 0.5L * (front + back) - projector.distance(0);
    const auto between = origin + t * direction;
    if (std::max(test::distance_from(mesh, early.cell, between),
                 test::distance_from(mesh, late.cell, between)) < 1e-9 * size)
      return true;
  }
  return false;
}

void judge_violations(const ZooMesh& mesh, const VisibilityOrder& order, const Scene& scene,
                      Outcome& outcome) {
  const std::array channels{Channel::witness};
  const RenderResult picture = render(mesh, order, scene, false, nullptr, channels);
  const Projector projector(scene.camera, scene.image);
  for (std::uint32_t y = 0; y < scene.image.height; ++y)
    for (std::uint32_t x = 0; x < scene.image.width; ++x) {
      if (picture.image.values()[5 * (y * scene.image.width + x) + 4] == 0) continue;
      if (outcome.judged >= kMostJudged) return;
      const PixelExplanation pixel = explain_pixel(mesh, order, scene, x, y, false);
      for (std::size_t k = 0; k < pixel.segments.size(); ++k) {
        if (!pixel.segments[k].out_of_order) continue;
        ++outcome.judged;
        if (cells_overlap_at(mesh, projector, pixel, k)) ++outcome.overlapping;
      }
    }
}

Outcome draw_from_all_sides(ZooMesh mesh) {
  Outcome outcome;
  outcome.cells = mesh.cell_count();
  const Box box = box_of_cells(mesh);
  mesh.fields.clear();
  test::add_node_field(mesh, "shade", [&](const Position& p) {
    return 0.5 + 0.5 * std::sin(7 * (p[0] + 2 * p[1] + 3 * p[2]) / box.diagonal());
  });
  const auto cameras = cameras_around(box);
  try {
    check_renderable(mesh, scene_of(cameras[0]), InvalidCells::skipped);
  } catch (const InputError& error) {
    outcome.refused = error.what();
    return outcome;
  }
  const std::vector<CellId> invalid = invalid_cells(mesh, scene_of(cameras[0]).render.planarity);
  outcome.skipped = invalid.size();
  const OrderBasis basis = order_basis(mesh, build_face_adjacency(mesh));
  std::optional<OrderBasis> knowing;  // what overlaps
  for (const Camera& camera : cameras) {
    const Scene scene = scene_of(camera);
    const double planarity = scene.render.planarity;
    const OrderResult sorted = exact_order(basis, view_of(camera), planarity);
    outcome.largest_group = std::max(outcome.largest_group, sorted.statistics.largest_group);
    const RenderStatistics drawn =
        render(mesh, without_cells(sorted.order, invalid), scene, false).statistics;
    outcome.segments += drawn.segments;
    outcome.violations += drawn.violations;
    if (drawn.violations == 0 || outcome.judged >= kMostJudged) continue;
    if (!knowing) {
      knowing = basis;
      knowing->overlaps = overlapping_cells(basis, planarity);
    }
    const VisibilityOrder order =
        without_cells(exact_order(*knowing, view_of(camera), planarity).order, invalid);
    judge_violations(mesh, order, scene, outcome);
  }
  return outcome;
}

std::vector<std::string> data_files() {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(data_dir()))
    if (entry.is_regular_file()) files.push_back(entry.path().string());
  std::ranges::sort(files);
  return files;
}

// Files of quadratic cells, many of them curved.
const std::array kQuadratic{
    "exodus/mfem_cube/simple-cube-tet10.e",

    "gmsh/quadratic/quadraticsphere.msh",    "gmsh/with_data/adaptive_tet10.msh",

    "nasty/curved/sphereCube.vtk",           "vtk_xml/analytic/QuadraticHexahedron.vtu",
    "vtk_xml/analytic/QuadraticPyramid.vtu", "vtk_xml/analytic/QuadraticTetra.vtu",
    "vtk_xml/fe_results/dataset.vtu",        "vtk_xml/fe_results/notch_disp.vtu"};

// Whatever of them is there: drawn in order, and what is claimed of errors is of use.
TEST(DataRendering, QuadraticMeshesAreDrawnInOrder) {
  std::size_t drawn = 0;
  for (const char* name : kQuadratic) {
    const fs::path path = fs::path(data_dir()) / name;
    if (!fs::exists(path) || (test::kInstrumented && fs::file_size(path) > kMostBytes)) continue;
    ZooMesh mesh = read_any(path.string()).mesh;
    const Box box = box_of_cells(mesh);
    test::add_node_field(mesh, "shade", [&](const Position& p) {
      return 0.5 + 0.5 * std::sin(7 * (p[0] + 2 * p[1] + 3 * p[2]) / box.diagonal());
    });
    const OrderBasis basis = order_basis(mesh, build_face_adjacency(mesh));
    const auto cameras = cameras_around(box);
    const std::vector<CellId> invalid = invalid_cells(mesh, Scene{}.render.planarity);
    std::vector<double> claims;
    for (const std::size_t k : {4U, 12U}) {
      if (k == 12 && fs::file_size(path) > kMostBytes) continue;
      const Scene scene = scene_of(cameras[k]);
      const OrderResult sorted = exact_order(basis, view_of(cameras[k]), scene.render.planarity);
      const std::array channels{Channel::error};
      const RenderResult result =
          render(mesh, without_cells(sorted.order, invalid), scene, false, nullptr, channels);
      EXPECT_EQ(result.statistics.violations, 0U) << name;
      for (std::size_t i = 0; i + 4 < result.image.values().size(); i += 5)
        if (result.image.values()[i + 3] > 0) claims.push_back(result.image.values()[i + 4]);
    }
    ASSERT_FALSE(claims.empty()) << name;
    std::ranges::sort(claims);
    EXPECT_LT(claims[claims.size() * 9 / 10], 1e-6) << name;
    ++drawn;
  }
  if (drawn == 0) GTEST_SKIP() << "none of the files is in " << data_dir();
}

TEST(DataRendering, NoSegmentIsOutOfOrder) {
  if (!fs::exists(data_dir())) GTEST_SKIP() << data_dir() << " is not there";
  const bool all = std::getenv("HIAC_ALL_DATA") != nullptr;
  std::size_t drawn = 0, number = 0;
  for (const std::string& path : data_files()) {
    if (!all && (fs::file_size(path) > kMostBytes || number++ % (4 / test::tried(4)) != 0))
      continue;
    const std::string name = fs::relative(path, data_dir()).string();
    Reading reading;
    try {
      reading = read_any(path);
    } catch (const InputError& error) {
      if (all) std::printf("%s | not read: %s\n", name.c_str(), error.what());
      continue;
    }
    if (!all && reading.mesh.cell_count() > kMostCells) continue;
    const Outcome outcome = draw_from_all_sides(std::move(reading.mesh));
    if (all)
      std::printf(
          "%s | %zu cells, %zu skipped | %s%lu segments, %lu violations (%zu of %zu looked into "
          "are cells that overlap), largest group %lu\n",
          name.c_str(), outcome.cells, outcome.skipped,
          outcome.refused.empty() ? "" : ("refused: " + outcome.refused + " | ").c_str(),
          outcome.segments, outcome.violations, outcome.overlapping, outcome.judged,
          outcome.largest_group);
    if (!outcome.refused.empty()) continue;
    ++drawn;
    EXPECT_GT(outcome.segments, 0U) << name;
    // of two cells that overlap on a ray there is no right order
    EXPECT_EQ(outcome.overlapping, outcome.judged) << name;
  }
  EXPECT_GT(drawn, test::tried(20));
}

}  // namespace
}  // namespace hiac::formats
