#include "tests/preview/exact_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "hiac/frame/renderable.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/order/order_basis.hpp"
#include "hiac/preview/preview.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/scene/view_of.hpp"

namespace hiac::test {
namespace {

SweepError difference(const Image& a, const Image& b) {
  SweepError error;
  double squares = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    const double off = std::abs(a.values()[i] - b.values()[i]);
    // not a number is the largest error of all
    error.largest = std::max(error.largest, std::isnan(off) ? HUGE_VAL : off);
    squares += off * off;
  }
  error.rms = std::sqrt(squares / static_cast<double>(a.values().size()));
  if (std::isnan(error.rms)) error.rms = HUGE_VAL;
  return error;
}

bool is_empty(const Image& image) {
  return std::ranges::all_of(image.values(), [](double v) { return v == 0; });
}

// What shaders are compiled for, but for the camera.
bool same_but_for_cameras(const Scene& a, const Scene& b) {
  return a.image.width == b.image.width && a.image.height == b.image.height &&
         a.volume.glow == b.volume.glow;
}

struct Box {
  std::array<double, 3> low, high, center;
  double diagonal = 0;
};

Box box_of(const ZooMesh& mesh) {
  Box box;
  box.low.fill(std::numeric_limits<double>::infinity());
  box.high.fill(-std::numeric_limits<double>::infinity());
  for (const NodeId node : mesh.nodes)
    for (std::size_t c = 0; c < 3; ++c) {
      box.low[c] = std::min(box.low[c], mesh.position(node)[c]);
      box.high[c] = std::max(box.high[c], mesh.position(node)[c]);
    }
  for (std::size_t c = 0; c < 3; ++c) box.center[c] = 0.5 * (box.low[c] + box.high[c]);
  box.diagonal =
      std::hypot(box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]);
  return box;
}

}  // namespace

void SweepError::include(const SweepError& other) {
  largest = std::max(largest, other.largest);
  rms = std::max(rms, other.rms);
}

SweepRow sweep(const preview::Context& context, const std::string& name, const ZooMesh& mesh,
               const std::vector<Scene>& scenes, const std::vector<CellId>& invalid) {
  SweepRow row{.name = name, .cells = mesh.cell_count(), .single = {}, .fine = {}};
  const OrderBasis basis = order_basis(mesh, build_face_adjacency(mesh));
  std::unique_ptr<preview::Preview> single, fine;
  const Scene* compiled = nullptr;
  for (const Scene& scene : scenes) {
    const VisibilityOrder order = without_cells(
        exact_order(basis, view_of(scene.camera), scene.render.planarity).order, invalid);
    if (!order.groups.empty()) {
      ++row.in_groups;
      continue;
    }
    if (compiled == nullptr || !same_but_for_cameras(*compiled, scene)) {
      single = std::make_unique<preview::Preview>(context, mesh, scene);
      fine = std::make_unique<preview::Preview>(context, mesh, scene,
                                                preview::PreviewOptions{.fine = true});
      compiled = &scene;
    }
    const Image truth = render(mesh, order, scene, false).image;
    row.single.include(difference(single->draw(scene.camera, order, {}, false).image, truth));
    row.fine.include(difference(fine->draw(scene.camera, order, {}, false).image, truth));
    ++row.pictures;
    row.empty += is_empty(truth) ? 1 : 0;
  }
  return row;
}

void print_row(const SweepRow& row, bool first) {
  if (first)
    std::printf(
        "| scene | tetrahedra | pictures | single precision | double |\n|---|---|---|---|---|\n");
  std::printf("| %s | %zu | %zu | %.1e / %.1e | %.1e / %.1e |", row.name.c_str(), row.cells,
              row.pictures, row.single.largest, row.single.rms, row.fine.largest, row.fine.rms);
  if (row.in_groups > 0) std::printf(" %zu with visibility cycles", row.in_groups);
  if (row.empty > 0) std::printf(" %zu empty", row.empty);
  std::printf("\n");
  std::fflush(stdout);
}

std::vector<Scene> views_of(const ZooMesh& mesh, const Scene& scene, bool both_glows) {
  const Box box = box_of(mesh);
  std::vector<Scene> of_glow[2];
  const auto add = [&](Glow glow, Projection projection, const std::array<double, 3>& from,
                       double distance) {
    Scene view = scene;
    view.camera = {};
    view.camera.projection = projection;
    for (std::size_t c = 0; c < 3; ++c)
      view.camera.eye[c] = box.center[c] + distance * box.diagonal * from[c];
    view.camera.look_at = box.center;
    view.camera.up =
        std::abs(from[2]) < 0.9 ? std::array<double, 3>{0, 0, 1} : std::array<double, 3>{0, 1, 0};
    view.camera.fov = distance < 0.5 ? 80 : 40;
    view.camera.height = 0.9 * box.diagonal;
    for (const Glow g : {Glow::chromaticity, Glow::emission}) {
      if (g != glow && !both_glows) continue;
      view.volume.glow = g;
      // emission is a colour per length: pictures stay as bright as others
      if (g == Glow::emission && view.volume.color)
        for (auto& point : view.volume.color->points)
          for (double& channel : point.value) channel *= 2 / box.diagonal;
      of_glow[g == Glow::emission ? 1 : 0].push_back(view);
    }
  };
  add(Glow::chromaticity, Projection::orthographic, {0.55, -0.7, 0.45}, 2);
  add(Glow::emission, Projection::perspective, {-0.4, -0.5, 0.77}, 1.3);
  add(Glow::emission, Projection::orthographic, {0, 0, 1}, 2);
  add(Glow::chromaticity, Projection::perspective, {1, 0, 0}, 1.3);
  add(Glow::chromaticity, Projection::perspective, {0.3, 0.2, -0.1}, 0.05);
  of_glow[0].insert(of_glow[0].end(), of_glow[1].begin(), of_glow[1].end());
  return of_glow[0];
}

}  // namespace hiac::test
