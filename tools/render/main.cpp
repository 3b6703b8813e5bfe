// hiac-render: a picture of a mesh.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/annotate/color_bar.hpp"
#include "hiac/annotate/ticks.hpp"
#include "hiac/base/error.hpp"
#include "hiac/base/finite_range.hpp"
#include "hiac/base/progress.hpp"
#include "hiac/frame/renderable.hpp"
#include "hiac/geometry/box.hpp"
#include "hiac/image/composite.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/render/explain_pixel.hpp"
#include "hiac/scene/camera_path.hpp"
#include "hiac/session/session.hpp"
#include "tools/common/as_option.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/common/picture/frames.hpp"
#include "tools/common/picture/order_facts.hpp"
#include "tools/common/picture/picture_annotation.hpp"
#include "tools/common/picture/picture_command.hpp"
#include "tools/common/picture/picture_output.hpp"
#include "tools/common/text_output.hpp"
#include "tools/common/tool.hpp"
#include "tools/render/become_preview.hpp"
#include "tools/render/picture_options.hpp"
#include "tools/render/pixel_report.hpp"

namespace {

using namespace hiac;
using namespace hiac::tools;

struct Options : PictureCommand {
  std::string under, color_bar, pixel, engine, method;
  double color_bar_length = 0;  // 0: a round number near a tenth of the diagonal
  PictureOptions picture;
};

using Json = nlohmann::ordered_json;

void note_field(Tool& tool, const ZooMesh& mesh, const std::string& role, const std::string& name) {
  const Field field = scalar_field(mesh, name);
  const FiniteRange range(field.values.view());
  tool.facts()["fields"][role] = {{"name", name}, {"minimum", range.low}, {"maximum", range.high}};
  tool.note(fmt::format("{} by {} from {:g} to {:g}", role, name, range.low, range.high));
}

// What a user needs to choose extinctions, but for the optical depth.
void note_model(Tool& tool, const ZooMesh& mesh, const Scene& scene) {
  if (scene.volume.color) note_field(tool, mesh, "colour", scene.volume.color->field);
  if (scene.volume.extinction) note_field(tool, mesh, "extinction", scene.volume.extinction->field);
  const double size = box_of_nodes(mesh).diagonal();
  tool.facts()["cells"] = mesh.cell_count();
  tool.facts()["diagonal"] = size;
  tool.note(fmt::format("diagonal {:g}", size));
}

Json note_work(Tool& tool, bool one_of_many, const RenderStatistics& s) {
  tool.add_seconds("prepare", s.prepare_seconds);
  tool.add_seconds("tiles", s.tile_seconds);
  const std::string depths = fmt::format("optical depth {:.3g} in the mean, {:.3g} at most",
                                         s.mean_optical_depth, s.largest_optical_depth);
  one_of_many ? tool.detail(depths) : tool.note(depths);
  tool.detail(fmt::format("{} segments in {:.3f} s", s.segments, s.tile_seconds));
  if (s.splatted_cells > 0) {
    const std::string splats = fmt::format("{} cells splatted", s.splatted_cells);
    one_of_many ? tool.detail(splats) : tool.note(splats);
  }
  if (s.violations > 0)
    tool.warn(fmt::format(
        "{} ray segments were met out of order: the picture is wrong there (cells "
        "overlap, or the order does not fit; --overlap keeps the cells in order that do "
        "not overlap)",
        s.violations));
  return {{"segments", s.segments},
          {"covered_pixels", s.covered_pixels},
          {"splatted_cells", s.splatted_cells},
          {"witness_violations", s.violations},
          {"optical_depth", {{"mean", s.mean_optical_depth}, {"largest", s.largest_optical_depth}}},
          {"seconds", s.prepare_seconds + s.tile_seconds}};
}

// With --strict, what is otherwise told leaves no picture behind.
void require_truth(const std::string& path, const RenderStatistics& s) {
  if (s.violations > 0)
    throw JudgementError(
        fmt::format("{}: not written: {} ray segments were met out of order "
                    "(--strict)",
                    path, s.violations));
}

// Makes pictures of one mesh.
class Renderer {
 public:
  Renderer(Tool& tool, const Options& options, const ZooFile& file)
      : tool_(tool), options_(options), session_(file.mesh, tool.monitor()) {
    const std::optional<GivenOrders> given = given_orders(options, file);
    if (!given) return;
    refuse_overlap_beside(options, *given);
    session_.use_orders(given->subject, given->chunks);
  }

  // Throws unless the mesh can be drawn, where need be without some of its cells.
  void check(const Scene& scene) {
    if (options_.overlap) session_.look_for_overlaps(scene.render.planarity);
    if (options_.skip_invalid)
      note_skipped(tool_, session_.skip_invalid_cells(scene), session_.mesh().cell_count());
    else
      hint_at_skip_invalid(options_, [&] { session_.require_drawable(scene); });
  }

  // Throws unless there is, or will be, an order for the scene.
  void require_order(const Scene& scene) { session_.require_order(scene); }

  // One pixel of a scene of one frame, in place of a picture.
  void explain(const Scene& scene) {
    const auto at = parse_pixel(options_.pixel);
    const Explanation found = session_.explain(scene, at[0], at[1], !options_.no_background);
    note_order(*found.order);
    tool_.facts()["order"] = order_facts(*found.order);
    tool_.facts()["pixel"] = pixel_json(*found.pixel, scene);
    if (tool_.common().json != "-") write_text("-", pixel_table(*found.pixel, scene));
  }

  // One picture of a scene of one frame, and the facts of its making.
  Json render(const Scene& scene, const PictureRequest& request,
              const PictureAnnotation& annotation, const std::string& path) {
    Picture picture = with_names(options_, [&] { return session_.picture(scene, request); });
    require_numbers(picture.image);
    note_order(*picture.order);
    Json facts = note_work(tool_, options_.all_frames, *picture.statistics);
    const RenderStatistics& met = *picture.statistics;
    warn_of_empty(tool_, options_, session_.mesh(), scene,
                  {met.covered_pixels, met.largest_optical_depth, request.part.has_value()}, path);
    if (options_.strict) require_truth(path, met);
    facts["order"] = order_facts(*picture.order);
    annotation.draw(picture.image, scene, request.part);
    write_picture(tool_, options_, "hiac-render", path, picture.image, picture.mesh_hash, scene,
                  annotation.wanted());
    return facts;
  }

 private:
  void note_order(const MeshOrder& order) {
    if (const std::string line = order_line(order); !line.empty()) tool_.detail(line);
  }

  Tool& tool_;
  const Options& options_;
  Session session_;
};

// Numbered pictures of the frames of a camera path.
void render_frames(Tool& tool, const Options& options, const Scene& scene,
                   const PictureRequest& request, const PictureAnnotation& annotation,
                   Renderer& renderer) {
  const std::vector<std::uint32_t> frames = chosen_frames(scene, options.frame);
  for (const std::uint32_t frame : frames) renderer.require_order(scene_of_frame(scene, frame));
  tool.frames().begin("frames", frames.size());
  for (const std::uint32_t frame : frames) {
    const std::string path = path_of_frame(options, frame);
    Json facts{{"frame", frame}, {"file", path}};
    facts.update(renderer.render(scene_of_frame(scene, frame), request, annotation, path));
    tool.facts()["frames"].push_back(std::move(facts));
    tool.frames().advance();
    const Progress::State state = tool.frames().state();
    const auto left = seconds_left(static_cast<double>(state.done),
                                   static_cast<double>(state.total), state.seconds);
    tool.note(fmt::format("{}: {} of {} frames, about {} left", path, state.done, state.total,
                          duration_text(left.value_or(0))));
  }
}

// The picture behind the new one; none: the specification's background, or nothing.
std::optional<Image> read_under(const Options& options, const ImageSize& size) {
  if (options.under.empty()) return std::nullopt;
  Image under = read_image(options.under, {.width = size.width}).image;
  if (under.width() != size.width || under.height() != size.height)
    throw InputError(options.under,
                     fmt::format("a picture of another size ({} x {} pixels expected, {} x {} "
                                 "found)",
                                 size.width, size.height, under.width(), under.height()));
  if (!color_channels(under))
    throw InputError(options.under, fmt::format("a picture without colour (channels {})",
                                                fmt::join(under.channels(), " ")));
  if (const auto bad = not_finite_in(under)) throw InputError(options.under, *bad);
  return under;
}

void write_color_bar(Tool& tool, const Options& options, const ZooMesh& mesh,
                     const ParsedScene& view) {
  const Volume& volume = view.scene.volume;
  const double size = box_of_nodes(mesh).diagonal();
  const double round_length = size > 0 ? round_below(size / 10) : 1;
  const double length = options.color_bar_length > 0 ? options.color_bar_length : round_length;
  const ColorBarLabels labels{volume.color ? field_label(mesh, volume.color->field) : "",
                              volume.extinction ? field_label(mesh, volume.extinction->field) : ""};
  const std::optional<ColorBarAnnotation>& bar = view.annotation.color_bar;
  const bool logarithmic =
      bar ? bar->logarithmic.value_or(view.color_is_logarithmic) : view.color_is_logarithmic;
  write_image(options.color_bar, as_option("--colorbar: ", [&] {
                return with_names(
                    options, [&] { return draw_color_bar(volume, labels, length, logarithmic); });
              }));
  tool.facts()["color_bar_length"] = length;
}

// Which files are read and which are written; for `scene`, once it is known, all its frames'.
void claim_files(Tool& tool, const Options& options, const Scene* scene) {
  RunFiles files;
  add_picture_files(files, options, scene, further_channels(options.picture));
  for (std::string& part : image_parts(options.under)) files.inputs.push_back(std::move(part));
  add_image(files.outputs, "--colorbar", options.color_bar);
  tool.claim(std::move(files));
}

void require_room_for_channels(const std::string& path) {
  const std::array<std::string_view, 3> roomy{".exr", ".npy", ".f32"};
  if (std::ranges::none_of(roomy, [&](std::string_view e) { return path.ends_with(e); }))
    throw UsageError("--channels: this format holds only colours (.exr, .npy or .f32 expected, " +
                     path + " found)");
}

// The preview's options reach this program only when it is not asked for.
void refuse_preview_options(const Options& options) {
  if (!options.method.empty())
    throw UsageError("--method: only for --engine preview (found " + options.method + ")");
}

void explain(Tool& tool, Options options) {
  RunFiles files{{options.input, options.view, options.order}, {}};
  if (!options.save_view.empty())
    files.outputs.push_back({"--save-view", options.save_view, FileKind::specification});
  tool.claim(std::move(files));
  parse_pixel(options.pixel);
  std::optional<ParsedScene> parsed = specification_of(tool, options);
  if (parsed) check_frame_options(options, parsed->scene);
  const ZooFile file = mesh_of(tool, options);
  Renderer renderer(tool, options, file);
  const Scene scene = scene_for(tool, options, std::move(parsed), file.mesh).scene;
  check_frame_options(options, scene);
  with_names(options, [&] {
    renderer.check(scene);
    note_model(tool, file.mesh, scene);
    renderer.explain(options.frame ? scene_of_frame(scene, *options.frame) : scene);
  });
}

// A colour bar alone is no picture of a mesh.
void refuse_picture_options(const CLI::App& app) {
  for (const char* option : {"--format", "--channels", "--crop", "--samples", "--filter", "--under",
                             "--frame", "--frames", "--depth", "--linear", "--strict", "--order",
                             "--overlap", "--no-background", "--skip-invalid", "--size"})
    if (app.get_option(option)->count() > 0)
      throw UsageError(
          fmt::format("{}: of a picture (-o IMAGE expected beside --colorbar)", option));
}

// What is asked of the pictures of a scene, and the picture behind them, which the request names.
struct Request {
  PictureRequest picture;
  std::optional<Image> under;
};

// Throws where the options do not fit the scene, and claims the files of all its frames.
void fit_to(Tool& tool, const Options& options, const Scene& scene, Request& request) {
  request.picture = picture_request(options.picture, scene.image);
  request.picture.background = !options.no_background;
  const PixelRect part = require_possible(request.picture, scene.image);
  request.under = read_under(options, {part.width, part.height});
  if (request.under) request.picture.under = &*request.under;
  check_frame_options(options, scene);
  if (options.all_frames) claim_files(tool, options, &scene);
}

// The colour bar without a picture.
void draw_color_bar_alone(Tool& tool, Options options) {
  RunFiles files{{options.input, options.view}, {}};
  if (!options.save_view.empty())
    files.outputs.push_back({"--save-view", options.save_view, FileKind::specification});
  add_image(files.outputs, "--colorbar", options.color_bar);
  tool.claim(std::move(files));
  require_known_image_extension(options.color_bar);
  std::optional<ParsedScene> parsed = specification_of(tool, options);
  const ZooFile file = mesh_of(tool, options);
  const ParsedScene view = scene_for(tool, options, std::move(parsed), file.mesh);
  write_color_bar(tool, options, file.mesh, view);
}

void render(Tool& tool, Options options) {
  claim_files(tool, options, nullptr);
  check_picture_output(tool, options);
  if (!options.color_bar.empty()) require_known_image_extension(options.color_bar);
  if (!options.picture.channels.empty()) require_room_for_channels(picture_format(options));
  std::optional<ParsedScene> parsed = specification_of(tool, options);
  const bool early = parsed.has_value();  // what can be refused is, before the mesh is read
  Request request;
  if (early) fit_to(tool, options, parsed->scene, request);
  const ZooFile file = mesh_of(tool, options);
  Renderer renderer(tool, options, file);
  const ParsedScene view = scene_for(tool, options, std::move(parsed), file.mesh);
  const Scene& scene = view.scene;
  if (!early) fit_to(tool, options, scene, request);
  with_names(options, [&] { renderer.check(scene); });
  note_model(tool, file.mesh, scene);
  const PictureAnnotation annotation(tool, options, view, file.mesh,
                                     chosen_frames(scene, options.frame));
  warn_of_invisible(tool, options, file.mesh, scene);
  if (!options.color_bar.empty()) write_color_bar(tool, options, file.mesh, view);
  if (scene.path) {
    render_frames(tool, options, scene, request.picture, annotation, renderer);
    return;
  }
  Json facts = renderer.render(scene, request.picture, annotation, options.output);
  facts.erase("seconds");  // the run's own, stage by stage, stay
  tool.facts().update(facts);
}

}  // namespace

int main(int argc, char** argv) {
  if (const std::optional<int> failed = become_preview(argc, argv)) return *failed;
  Tool tool(
      "hiac-render", "Makes a volume-rendered picture of a mesh.",
      "  hiac-render run.inp -o run.png   # any file that hiac-convert reads, and a starter view\n"
      "  hiac-render run.exo --convert '--step 3' --field stress --save-view run.toml -o run.png\n"
      "  hiac-render part.zoo --view view.toml -o part.png\n"
      "  hiac-render part.zoo --view view.toml --order part.order --size 2048x1536 -o part.exr\n"
      "  hiac-render part.zoo --view view.toml --set camera.fov=20 -o part.npy\n"
      "  hiac-render part.zoo --view view.toml --channels depth,error -o part.exr\n"
      "  hiac-render part.zoo --view view.toml --crop 300,200,64,64 -o detail.npy\n"
      "  hiac-render part.zoo --view view.toml --pixel 300,200\n"
      "  hiac-render part.zoo --view view.toml --samples 8 --filter bspline -o truth.exr\n"
      "  hiac-render part.zoo --view view.toml --set render.splat_below=2 -o splatted.exr\n"
      "  hiac-render near.zoo --view view.toml --under far.exr -o both.exr\n"
      "  hiac-render part.zoo --view view.toml --set annotation.colorbar.show=true -o part.png\n"
      "  hiac-render part.zoo --view view.toml --colorbar bar.png\n"
      "  hiac-render part.zoo --view turntable.toml --frames -o part-%04d.png\n"
      "  hiac-render part.zoo --view view.toml --engine preview -o quick.png");
  Options options;
  auto& app = tool.app();
  add_picture_command(app, options, "hiac-render");
  add_picture_options(app, options.picture);
  app.add_option("--under", options.under,
                 "Put this picture behind the new one instead of the background: linear values, "
                 "premultiplied by alpha")
      ->type_name("IMAGE");
  app.add_option(
         "--colorbar", options.color_bar,
         "Draw the colour map, and the opacity of a length of the medium, as a second picture, or "
         "without -o alone; [annotation.colorbar] draws one into the picture")
      ->type_name("IMAGE");
  app.add_option("--colorbar-length", options.color_bar_length,
                 "Length for --colorbar in world units; default: a round number near a tenth of "
                 "the diagonal")
      ->check(CLI::PositiveNumber)
      ->type_name("L");
  app.add_option(
         "--engine", options.engine,
         "accurate (the default), or preview: OpenGL, by hiac-preview, whose options it has "
         "then (hiac-preview --help)")
      ->check(CLI::IsMember({"accurate", "preview"}))
      ->type_name("ENGINE");
  app.add_option("--method", options.method, "For --engine preview: exact, or M0 to M3")
      ->type_name("METHOD");
  auto* pixel =
      app.add_option("--pixel", options.pixel,
                     "Explain the pixel in column X and row Y instead of making a picture: a table "
                     "of all cells on its ray, or with --json the same for programs")
          ->type_name("X,Y");
  for (const char* of_pictures :
       {"--output", "--format", "--channels", "--crop", "--samples", "--filter", "--under",
        "--frames", "--colorbar", "--colorbar-length", "--depth", "--linear", "--strict"})
    pixel->excludes(app.get_option(of_pictures));
  return tool.run(argc, argv, [&] {
    refuse_preview_options(options);
    if (pixel->count() > 0)
      explain(tool, options);
    else if (options.output.empty() && !options.color_bar.empty()) {
      refuse_picture_options(app);
      draw_color_bar_alone(tool, options);
    } else {
      render(tool, options);
    }
  });
}
