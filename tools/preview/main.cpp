// hiac-preview: a picture of a mesh by graphics hardware. hiac-render --engine preview runs it.

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/seconds.hpp"
#include "hiac/frame/crop.hpp"
#include "hiac/frame/renderable.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/order/algorithm.hpp"
#include "hiac/preview/context.hpp"
#include "hiac/preview/drawn_mesh.hpp"
#include "hiac/preview/preview.hpp"
#include "hiac/scene/camera_path.hpp"
#include "hiac/session/scene_orders.hpp"
#include "hiac/tetrahedralize/subdivide_cells.hpp"
#include "tools/common/as_option.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/common/picture/frames.hpp"
#include "tools/common/picture/order_facts.hpp"
#include "tools/common/picture/picture_annotation.hpp"
#include "tools/common/picture/picture_command.hpp"
#include "tools/common/picture/picture_output.hpp"
#include "tools/common/tool.hpp"

namespace {

using namespace hiac;
using namespace hiac::tools;
using preview::Context;
using preview::Preview;
using preview::PreviewStatistics;

using Json = nlohmann::ordered_json;

struct Options : PictureCommand {
  std::string method = "exact", algorithm, device, precision = "single", crop;
  unsigned levels = 2;
  bool list_devices = false;
};

// The mesh that is drawn; says what it approximates.
preview::DrawnMesh mesh_to_draw(Tool& tool, const ZooMesh& mesh, unsigned levels) {
  preview::DrawnMesh drawn =
      tool.timed("tetrahedralize", [&] { return preview::drawn_mesh(mesh, levels); });
  if (drawn.approximated > 0) {
    tool.warn(
        fmt::format("{} of {} cells are no linear tetrahedra and are approximated: {} linear "
                    "tetrahedra are drawn, edges halved {} times{}",
                    drawn.approximated, mesh.cell_count(), drawn.mesh.cell_count(), drawn.halvings,
                    drawn.halvings > 0 ? " (--levels)" : ""));
    tool.facts()["approximated_cells"] = drawn.approximated;
    tool.facts()["levels"] = drawn.halvings;
  }
  return drawn;
}

// How the frames of one mesh are ordered, but for the cells that are left out.
void prepare_orders(SceneOrders& orders, const Options& options, const Scene& scene,
                    std::optional<GivenOrders> given) {
  if (!options.algorithm.empty())
    orders.sort_by({.algorithm = parse_algorithm(options.algorithm, "--algorithm"), .tiling = {}});
  if (given) {
    refuse_overlap_beside(options, *given);
    orders.use(std::move(*given));
  }
  if (options.overlap) orders.look_for_overlaps(scene.render.planarity);
}

struct TimedOrder {
  MeshOrder order;
  double seconds = 0;
};

// Of one of the paper's methods.
Json region_facts(const PreviewStatistics& statistics) {
  const preview::RegionCounts& r = statistics.regions;
  return {{"cells", r.cells},
          {"whole_tetrahedra", r.whole},
          {"slabs", r.slabs},
          {"regions", r.regions},
          {"triangles", statistics.triangles},
          {"surface_polygons", r.surfaces},
          {"vertices", r.vertices},
          {"reverted_to_M1", r.reverted},
          {"left_uncut", r.uncut}};
}

// What a drawn picture shows, by its alpha.
DrawnFacts facts_of(const Image& image, bool is_part) {
  DrawnFacts facts{0, 0, is_part};
  const auto alpha = image.channel_index("A");
  double largest = 0;
  for (std::size_t y = 0; y < image.height(); ++y)
    for (std::size_t x = 0; x < image.width(); ++x) {
      const double opacity = image.at(x, y, *alpha);
      if (opacity > 0) ++facts.covered_pixels;
      largest = std::max(largest, opacity);
    }
  facts.largest_optical_depth = -std::log1p(-std::min(largest, 1.0));
  return facts;
}

// Draws the frames of one scene.
class Previewer {
 public:
  Previewer(Tool& tool, const Options& options, const Scene& scene,
            const PictureAnnotation& annotation, const ZooMesh& mesh, SceneOrders& orders)
      : tool_(tool),
        options_(options),
        scene_(scene),
        annotation_(annotation),
        mesh_(mesh),
        orders_(orders),
        context_(as_option("--device: ", [&] { return Context(options.device); })),
        preview_(
            context_, mesh, scene,
            {.method = preview::method_of(options.method), .fine = options.precision == "double"}),
        mesh_hash_(content_hash(mesh)) {
    tool.facts()["device"] = context_.device().name;
    tool.detail(
        fmt::format("drawn by {} ({})", context_.device().name, context_.device().platform));
    if (!options.crop.empty()) part_ = parse_crop(options.crop);
  }

  // The frames in order; the next one's order is made while one is drawn.
  void draw(const std::vector<Scene>& frames, const std::vector<std::string>& paths) {
    std::future<TimedOrder> next = order_of(frames.front());
    for (std::size_t k = 0; k < frames.size(); ++k) {
      const TimedOrder made = next.get();
      if (k + 1 < frames.size()) next = order_of(frames[k + 1]);
      tool_.add_seconds("order", made.seconds);
      Json facts = draw_one(frames[k], made.order, paths[k]);
      if (!scene_.path) {
        tool_.facts().update(facts);
        return;
      }
      facts["file"] = paths[k];
      tool_.facts()["frames"].push_back(std::move(facts));
      tool_.frames().advance();
    }
  }

 private:
  std::future<TimedOrder> order_of(const Scene& frame) {
    return std::async(std::launch::async, [this, &frame] {
      const double start = seconds_now();
      MeshOrder order = orders_.of(frame);
      return TimedOrder{std::move(order), seconds_now() - start};
    });
  }

  Json draw_one(const Scene& frame, const MeshOrder& order, const std::string& path) {
    preview::PreviewResult result =
        preview_.draw(frame.camera, order.record.order, part_, !options_.no_background);
    require_numbers(result.image);
    // what glows without absorbing has no alpha
    if (frame.volume.glow != Glow::emission)
      warn_of_empty(tool_, options_, mesh_, frame, facts_of(result.image, part_.has_value()), path);
    const PreviewStatistics& s = result.statistics;
    tool_.add_seconds("upload", s.upload_seconds);
    tool_.add_seconds("regions", s.regions_seconds);
    tool_.add_seconds("draw", s.draw_seconds);
    tool_.add_seconds("read_back", s.read_seconds);
    if (s.groups > 0)
      tool_.warn(
          fmt::format("{} cells are in {} visibility cycles and are drawn in the order of "
                      "their centroids: the picture may be wrong there",
                      s.cells_in_groups, s.groups));
    if (s.regions.reverted > 0)
      tool_.note(fmt::format("M2 fell back to M1 at {} of {} vertices: beyond its tables",
                             s.regions.reverted, s.regions.vertices));
    annotation_.draw(result.image, frame, part_);
    write_picture(tool_, options_, "hiac-preview", path, result.image, mesh_hash_, frame,
                  annotation_.wanted());
    Json facts{{"order", order_facts(order)}, {"parts", s.parts}};
    if (options_.method != "exact") facts["regions"] = region_facts(s);
    return facts;
  }

  Tool& tool_;
  const Options& options_;
  const Scene& scene_;
  const PictureAnnotation& annotation_;
  const ZooMesh& mesh_;
  SceneOrders& orders_;
  Context context_;
  Preview preview_;
  std::string mesh_hash_;
  std::optional<PixelRect> part_;
};

// Leaves out what cannot be drawn, or refuses it.
std::vector<CellId> invalid_ones(Tool& tool, const Options& options, const ZooMesh& mesh,
                                 const Scene& scene) {
  if (!options.skip_invalid) {
    hint_at_skip_invalid(options, [&] { check_renderable(mesh, scene); });
    return {};
  }
  check_renderable(mesh, scene, InvalidCells::skipped);
  std::vector<CellId> skipped = invalid_cells(mesh, scene.render.planarity);
  note_skipped(tool, skipped, mesh.cell_count());
  return skipped;
}

void note_what_is_not_drawn(Tool& tool, const Options& options, const Scene& scene) {
  const Integration integration = scene.render.integration;
  if (options.method != "exact" && integration == Integration::approximate_unsliced)
    tool.note("cells are not sliced at breakpoints (render.integration)");
  else if (integration != Integration::exact)
    tool.note("render.integration is the accurate engine's: --method says how previews integrate");
  if (scene.render.splat_below > 0)
    tool.note("render.splat_below is the accurate engine's: previews splat no cells");
  if (scene.skin || scene.edges)
    tool.note("[skin] and [edges] are the accurate engine's: previews draw neither");
}

void claim_files(Tool& tool, const Options& options, const Scene* scene) {
  RunFiles files;
  add_picture_files(files, options, scene);
  tool.claim(std::move(files));
}

// Throws where the options do not fit the scene, and claims the files of all its frames.
void fit_to(Tool& tool, const Options& options, const Scene& scene) {
  if (!options.crop.empty()) require_inside(parse_crop(options.crop), scene.image);
  check_frame_options(options, scene);
  if (options.all_frames) claim_files(tool, options, &scene);
}

void draw(Tool& tool, Options options) {
  if (options.method != "exact" && options.precision != "single")
    throw UsageError("--precision " + options.precision + ": for --method exact alone");
  claim_files(tool, options, nullptr);
  check_picture_output(tool, options);
  std::optional<ParsedScene> parsed = specification_of(tool, options);
  const bool early = parsed.has_value();  // what can be refused is, before the mesh is read
  if (early) fit_to(tool, options, parsed->scene);
  const ZooFile file = mesh_of(tool, options);
  const ParsedScene view = scene_for(tool, options, std::move(parsed), file.mesh);
  const Scene& scene = view.scene;
  if (!early) fit_to(tool, options, scene);
  note_what_is_not_drawn(tool, options, scene);
  const preview::DrawnMesh drawn = mesh_to_draw(tool, file.mesh, options.levels);
  const ZooMesh& mesh = drawn.mesh;
  tool.facts()["cells"] = mesh.cell_count();
  tool.facts()["method"] = options.method;
  std::optional<GivenOrders> given = given_orders(options, file);
  if (given && drawn.approximated > 0) {
    tool.note(given->subject +
              ": the order is of other cells than the tetrahedra that are drawn, "
              "whose order is made here");
    given.reset();
  }
  SceneOrders orders(mesh, {});
  prepare_orders(orders, options, scene, std::move(given));
  orders.leave_out(with_names(options, [&] { return invalid_ones(tool, options, mesh, scene); }));
  warn_of_invisible(tool, options, mesh, scene, options.output);
  const std::vector<std::uint32_t> numbers = chosen_frames(scene, options.frame);
  const PictureAnnotation annotation(tool, options, view, file.mesh, numbers,
                                     has_integer_samples(picture_format(options), options.depth));
  std::vector<Scene> frames;
  std::vector<std::string> paths;
  for (const std::uint32_t frame : numbers) {
    frames.push_back(scene_of_frame(scene, frame));
    paths.push_back(scene.path ? path_of_frame(options, frame) : options.output);
  }
  if (scene.path) tool.frames().begin("frames", frames.size());
  Previewer(tool, options, scene, annotation, mesh, orders).draw(frames, paths);
}

void print_devices(Tool& tool) {
  const std::vector<preview::Device> devices = preview::list_devices();
  tool.facts()["devices"] = Json::array();
  for (std::size_t k = 0; k < devices.size(); ++k) {
    tool.facts()["devices"].push_back(
        {{"name", devices[k].name}, {"platform", devices[k].platform}});
    if (tool.common().json != "-")
      std::cout << fmt::format("{}  {} ({})\n", k, devices[k].name, devices[k].platform);
  }
  if (devices.empty()) const Context context;  // says what was tried
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool(
      "hiac-preview",
      "Makes a picture of a mesh by graphics hardware (OpenGL 4.5, no screen needed).",
      "  hiac-preview part.zoo --view view.toml -o part.png\n"
      "  hiac-preview part.zoo --view view.toml --algorithm centroid --size 2048x1536 -o part.exr\n"
      "  hiac-preview part.zoo --view view.toml --precision double -o part.npy\n"
      "  hiac-preview part.zoo --view turntable.toml --frames -o part-%04d.png\n"
      "  hiac-preview --list-devices\n"
      "  hiac-render part.zoo --view view.toml --engine preview -o part.png   # the same as "
      "the first");
  Options options;
  auto& app = tool.app();
  add_picture_command(app, options, "hiac-preview");
  app.add_option("--method", options.method,
                 "exact: every ray is cut at the cells' faces and at breakpoints and integrated "
                 "pixel by pixel; M0 to M3: the methods of Williams, Max and Stein's section 7, "
                 "cells as homogeneous regions")
      ->check(CLI::IsMember({"exact", "M0", "M1", "M2", "M3"}))
      ->capture_default_str()
      ->type_name("METHOD");
  auto* algorithm =
      app.add_option("--algorithm", options.algorithm,
                     "How to sort: exact, mpvo, centroid, stein or multitiled, as hiac-sort")
          ->default_str("exact")
          ->type_name("NAME");
  for (const char* other : {"--order", "--overlap"}) algorithm->excludes(app.get_option(other));
  app.add_option("--precision", options.precision,
                 "Along rays: single, or double where the driver is slower and a picture has steps "
                 "or thin shells; colours are added up in single precision")
      ->check(CLI::IsMember({"single", "double"}))
      ->capture_default_str()
      ->type_name("NAME");
  app.add_option("--levels", options.levels,
                 "How often the edges of cells of higher order are halved for linear tetrahedra")
      ->check(CLI::Range(0U, kMostSubdivisionLevels))
      ->capture_default_str()
      ->type_name("N");
  app.add_option("--crop", options.crop, "Render only the W x H pixels from column X and row Y on")
      ->type_name("X,Y,W,H");
  app.add_option("--device", options.device,
                 "The driver to draw with: its number, or a part of its name")
      ->type_name("N|NAME");
  app.add_flag("--list-devices", options.list_devices,
               "Print the drivers that can be used, and draw nothing");
  return tool.run(argc, argv,
                  [&] { options.list_devices ? print_devices(tool) : draw(tool, options); });
}
