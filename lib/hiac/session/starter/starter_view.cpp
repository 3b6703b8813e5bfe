#include "hiac/session/starter_view.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/colormaps/built_in_colormaps.hpp"
#include "hiac/scene/specification.hpp"
#include "hiac/scene/starter_text.hpp"
#include "hiac/session/session.hpp"
#include "hiac/session/starter/feature_lines.hpp"
#include "hiac/session/starter/measured_depth.hpp"
#include "hiac/session/starter/starter_camera.hpp"
#include "hiac/session/starter/starter_field.hpp"

namespace hiac {
namespace {

using namespace starter;

/// The extinction at the lower end of the range, of that at the upper: nothing fades entirely.
constexpr double kFloor = 0.4;
constexpr double kDepth = 1, kDepthBetweenSurfaces = 0.3;
/// A model that covers less of the picture is looked at from other sides, and in a flatter picture.
constexpr double kLeastCoverage = 0.25;

/// Raised corners, the usual one first.
constexpr Vec kTowardsEye[] = {{0.55, -0.75, 0.45}, {0.75, 0.55, 0.45}, {0.3, -0.9, 0.35},
                               {0.9, -0.3, 0.35},   {0.35, -0.5, 0.8},  {0.5, 0.35, 0.8},
                               {0.04, -0.95, 0.3},  {0.95, 0.04, 0.3}};

/// Whether the extinction is the same everywhere.
bool is_uniform(const Choice& choice) { return choice.is_height || !(choice.low < choice.high); }

/// The share of the whole extinction at a corner of a cell.
class Share {
 public:
  Share(const ZooMesh& mesh, const Choice& choice) : mesh_(mesh), choice_(choice) {}

  double operator()(CellId cell, std::size_t corner) const {
    if (is_uniform(choice_)) return 1;
    const double t =
        (value(cell, corner) / 2 - choice_.low / 2) / (choice_.high / 2 - choice_.low / 2);
    return kFloor + (1 - kFloor) * std::clamp(t, 0.0, 1.0);
  }

 private:
  [[nodiscard]] double value(CellId cell, std::size_t corner) const {
    const auto& values = choice_.field.values;
    switch (choice_.field.location) {
      case FieldLocation::node:
        return values[mesh_.cell_nodes(cell)[corner]];
      case FieldLocation::cell:
        return values[cell];
      default:
        return values[mesh_.elems[cell] + corner];
    }
  }

  const ZooMesh& mesh_;
  const Choice& choice_;
};

struct Framing {
  ImageSize size;
  Camera camera;
  MeasuredDepth depth;
};

/// The first view that the model covers enough of, or the one that it covers most of.
Framing framing_of(const Sight& sight, const Choice& choice,
                   const std::optional<ImageSize>& asked) {
  constexpr ImageSize kSize{1024, 768};
  const Share share(sight.mesh, choice);
  std::optional<Framing> best;
  const auto consider = [&](const ImageSize& size, const Vec& towards_eye) {
    Framing framing{size, camera_around(sight, size, towards_eye), {}};
    framing.depth = measure_depth(sight.mesh, framing.camera, size, share);
    if (!best || framing.depth.coverage > best->depth.coverage) best = std::move(framing);
    return best->depth.coverage >= kLeastCoverage;
  };
  for (const Vec& towards_eye : kTowardsEye)
    if (consider(asked.value_or(kSize), towards_eye)) return *best;
  if (!asked)
    for (const Vec& towards_eye : kTowardsEye)
      if (consider(fitting_size(sight, kSize, towards_eye), towards_eye)) return *best;
  return *best;
}

/// Feature edges over the medium: light lines on a dark background. None, with a note, where there
/// are more of them than the picture can hold.
std::optional<Edges> lines_over(const ZooMesh& mesh, const Framing& framing, bool dark,
                                std::vector<std::string>& notes) {
  constexpr double kMostCovered = 0.25;
  constexpr double kLight = 0.6;
  Edges edges;
  edges.width = 1;
  if (dark) edges.color = {kLight, kLight, kLight};
  const double pixels = framing.depth.coverage * framing.size.width * framing.size.height;
  if (edges.width * line_length(mesh, edges, framing.camera, framing.size) <= kMostCovered * pixels)
    return edges;
  notes.emplace_back(
      "leaves the feature edges out: they would cover much of the model ([edges] draws them)");
  return std::nullopt;
}

ExtinctionTransfer extinction_over(const Choice& choice, double largest) {
  if (is_uniform(choice)) return {choice.field.name, {{choice.low, {largest}}}};
  return {choice.field.name,
          {{choice.low, {rounded(kFloor * largest, largest)}}, {choice.high, {largest}}}};
}

std::vector<Isosurface> surfaces_over(const Choice& choice, std::uint32_t count,
                                      const ColormapPreset& preset) {
  std::vector<Isosurface> surfaces;
  for (std::uint32_t i = 1; i <= count && choice.low < choice.high; ++i) {
    const double t = static_cast<double>(i) / (count + 1);
    Isosurface surface;
    surface.field = choice.field.name;
    surface.value = rounded((1 - t) * choice.low + t * choice.high, choice.high - choice.low);
    surface.color = preset_color(preset, t, ColorEncoding::srgb);
    for (double& channel : surface.color) channel = rounded(channel, 1);
    surface.opacity = count == 1 ? 0.8 : 0.5;
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

ColormapPreset preset_of(const std::string& name) {
  if (auto preset = built_in_colormap(name)) return *std::move(preset);
  throw UsageError(fmt::format("preset {}: no colour map of this name (expected one of {})", name,
                               fmt::join(built_in_colormap_names(), ", ")));
}

}  // namespace

StarterView make_starter_view(const ZooMesh& mesh, const std::string& subject,
                              const StarterOptions& options) {
  if (mesh.cell_count() == 0) throw InputError(subject, "no cells to look at");
  if (!has_extent(mesh))
    throw InputError(subject, "nothing to look at (all nodes lie at one point)");
  const ColormapPreset preset = preset_of(options.preset);
  Choice choice = choose_field(mesh, options.field, subject);
  if (options.range) show_range(choice, *options.range);
  const Framing framing =
      framing_of(options.box ? Sight(mesh, *options.box) : Sight(mesh), choice, options.size);
  StarterView view;
  view.notes = std::move(choice.notes);
  Scene& scene = view.scene;
  scene.image = framing.size;
  scene.camera = framing.camera;
  const double wanted = options.isovalues > 0 ? kDepthBetweenSurfaces : kDepth;
  const double whole = wanted / framing.depth.mean;
  const bool measured = framing.depth.mean > 0 && std::isfinite(whole);
  if (!measured)
    view.notes.emplace_back("no ray of a coarse grid meets a cell: the extinction is 1");
  scene.volume.color.emplace().field = choice.field.name;
  scene.volume.extinction = extinction_over(choice, measured ? rounded(whole, whole) : 1);
  scene.isosurfaces = surfaces_over(choice, options.isovalues, preset);
  if (choice.is_height && options.isovalues == 0) {
    scene.skin.emplace();
    scene.edges.emplace();
    view.notes.emplace_back(
        "shows the solid model with its feature edges ([skin] and [edges]; without them the "
        "medium)");
  } else {
    scene.edges = lines_over(mesh, framing, options.dark, view.notes);
  }
  const double backdrop = options.dark ? 0.01 : 1;
  scene.background.color = {backdrop, backdrop, backdrop};
  view.text = starter_text(scene, options.preset, {choice.low, choice.high});
  view.scene = parse_scene(view.text, subject).scene;
  return view;
}

Scene starter_view(const ZooMesh& mesh, const std::string& subject) {
  return make_starter_view(mesh, subject).scene;
}

}  // namespace hiac
