#include "tools/common/render/render_command.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/frame/renderable.hpp"
#include "hiac/geometry/box.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/mesh/parted/parted_index.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/render/explain_pixel.hpp"
#include "hiac/scene/camera_path.hpp"
#include "hiac/session/session.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/common/picture/frames.hpp"
#include "tools/common/picture/order_facts.hpp"
#include "tools/common/picture/picture_annotation.hpp"
#include "tools/common/picture/picture_command.hpp"
#include "tools/common/picture/picture_output.hpp"
#include "tools/common/picture/pixel_report.hpp"
#include "tools/common/render/color_bar_file.hpp"
#include "tools/common/render/mesh_series.hpp"
#include "tools/common/render/movie.hpp"
#include "tools/common/render/picture_behind.hpp"
#include "tools/common/render/picture_options.hpp"
#include "tools/common/render/picture_report.hpp"
#include "tools/common/render/render_files.hpp"
#include "tools/common/render/render_options.hpp"
#include "tools/common/render/several_pictures.hpp"
#include "tools/common/render/shared_shots.hpp"
#include "tools/common/render/shots.hpp"
#include "tools/common/text_output.hpp"
#include "tools/common/tool.hpp"

namespace {

using namespace hiac;
using namespace hiac::tools;

using Options = RenderOptions;

using Json = nlohmann::ordered_json;

// Makes pictures of one mesh, or of one after the other.
class Renderer {
 public:
  Renderer(Tool& tool, const Options& options) : tool_(tool), options_(options) {}

  // Begins with a mesh, or goes on with another one.
  void show(ZooFile file) {
    if (session_ && session_->take_step(file.mesh)) {
      tool_.detail("the geometry is that of the step before: its orders are used again");
      return;
    }
    session_.reset();  // its memory is free while the next one is prepared
    session_.emplace(std::move(file.mesh), tool_.monitor());
    is_new_ = true;
    const std::optional<GivenOrders> given = given_orders(options_, file);
    if (!given) return;
    refuse_overlap_beside(options_, *given);
    session_->use_orders(given->subject, given->chunks);
  }

  [[nodiscard]] const ZooMesh& mesh() const { return session_->mesh(); }

  // Throws unless the mesh can be drawn, where need be without some of its cells.
  void check(const Scene& scene) {
    if (options_.overlap && std::exchange(is_new_, false))
      session_->look_for_overlaps(scene.render.planarity);
    if (options_.skip_invalid)
      note_skipped(tool_, session_->skip_invalid_cells(scene), mesh().cell_count());
    else
      hint_at_skip_invalid(options_, [&] { session_->require_drawable(scene); });
  }

  // Throws unless there is, or will be, an order for the scene.
  void require_order(const Scene& scene) { session_->require_order(scene); }

  // One pixel of a scene of one frame, in place of a picture.
  void explain(const Scene& scene) {
    const auto at = parse_pixel(options_.pixel);
    const Explanation found = session_->explain(scene, at[0], at[1], !options_.no_background);
    note_order(*found.order);
    tool_.facts()["order"] = order_facts(*found.order);
    tool_.facts()["pixel"] = pixel_json(*found.pixel, scene);
    if (options_.role->writes && tool_.common().json != "-")
      write_text("-", pixel_table(*found.pixel, scene));
  }

  // One picture of a scene of one frame, into its file or into the film, and the facts of its
  // making.
  Json render(const Scene& scene, const PictureRequest& request,
              const PictureAnnotation& annotation, const std::string& path, Movie* movie) {
    Picture picture = with_names(options_, [&] { return session_->picture(scene, request); });
    require_numbers(picture.image);
    note_order(*picture.order);
    Json facts = note_work(tool_, options_.makes_several(), scene, *picture.statistics);
    const RenderStatistics& met = *picture.statistics;
    warn_of_empty(tool_, options_, mesh(), scene,
                  {met.covered_pixels, met.largest_optical_depth, request.part.has_value()}, path);
    if (options_.strict) require_truth(path, met);
    facts["order"] = order_facts(*picture.order);
    // a picture that this process has drawn alone is its own
    if (!options_.role->writes && request.crew != nullptr) return facts;
    annotation.draw(picture.image, scene, request.part);
    if (movie != nullptr)
      tool_.timed("write", [&] { movie->add(picture.image); });
    else
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
  std::optional<Session> session_;
  bool is_new_ = false;  // has not been searched for overlaps
};

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
  if (options.engine == "preview")
    throw UsageError("--engine preview: one process draws it (hiac-render expected)");
}

void explain(Tool& tool, Options options) {
  RunFiles files{{options.input, options.view, options.order}, {}};
  if (!options.save_view.empty())
    files.outputs.push_back({"--save-view", options.save_view, FileKind::specification});
  tool.claim(std::move(files));
  parse_pixel(options.pixel);
  std::optional<ParsedScene> parsed = specification_of(tool, options);
  if (parsed) check_frame_options(options, parsed->scene);
  Renderer renderer(tool, options);
  renderer.show(mesh_of(tool, options));
  const Scene scene = scene_for(tool, options, std::move(parsed), renderer.mesh()).scene;
  check_frame_options(options, scene);
  with_names(options, [&] {
    renderer.check(scene);
    note_model(tool, false, renderer.mesh(), scene);
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

// Throws where the options do not fit the scene; of a single mesh claims the files of all frames.
void fit_to(Tool& tool, const Options& options, const Scene& scene, Request& request) {
  request.picture = picture_request(options.picture, scene.image);
  request.picture.background = !options.no_background;
  request.picture.crew = options.role->crew;
  const PixelRect part = require_possible(request.picture, scene.image);
  request.under = read_picture_behind(options.under, {part.width, part.height});
  if (request.under) request.picture.under = &*request.under;
  check_frame_options(options, scene);
  if (options.all_frames && !options.has_steps)
    claim_render_files(tool, options, shots_of_frames(options, scene));
}

// Renders the shots, which are in the order of their steps; `read` reads a step.
template <typename Read>
void render_shots(Tool& tool, const Options& options, const Scene& scene,
                  const PictureRequest& request, std::span<const Shot> shots,
                  const std::optional<PictureAnnotation>& annotation, Renderer& renderer,
                  Movie* movie, const Read& read) {
  const std::string kind = options.kind_of_shots();
  for (std::size_t k = 0; k < shots.size(); ++k) {
    const Shot& shot = shots[k];
    if (k == 0 || shots[k - 1].step != shot.step) {
      read(shot);
      for (std::size_t same = k; same < shots.size() && shots[same].step == shot.step; ++same)
        renderer.require_order(scene_of_shot(scene, shots[same]));
    }
    Json facts;
    if (options.has_steps) facts["step"] = shot.step_number;
    if (shot.frame) facts["frame"] = *shot.frame;
    facts["file"] = movie != nullptr ? options.output : shot.path;
    facts.update(
        renderer.render(scene_of_shot(scene, shot), request, *annotation, shot.path, movie));
    tool.facts()[kind].push_back(std::move(facts));
    tool.note_frame(shot.path);
  }
}

// Hands out the frames to the processes, each of which makes its own alone, with their orders.
void hand_out_frames(Tool& tool, const Options& options, const Scene& scene, PictureRequest request,
                     std::span<const Shot> shots, const PictureAnnotation& annotation,
                     Renderer& renderer) {
  if (shots.empty()) return;
  for (const Shot& shot : shots) renderer.require_order(scene_of_shot(scene, shot));
  request.crew = nullptr;
  std::size_t noted = 0;
  const auto draw = [&](std::size_t k) {
    const std::size_t warned = tool.warnings().size();
    const Shot& shot = shots[k];
    Json facts{{"frame", *shot.frame}, {"file", shot.path}};
    facts.update(
        renderer.render(scene_of_shot(scene, shot), request, annotation, shot.path, nullptr));
    tool.frames().advance(k - noted);  // others have been handed to other processes
    tool.note_frame(shot.path);
    noted = k + 1;
    const auto& warnings = tool.warnings();
    return ShotReport{k,
                      std::move(facts),
                      {warnings.begin() + static_cast<std::ptrdiff_t>(warned), warnings.end()},
                      true};
  };
  for (ShotReport& report : share_shots(*options.role->all, shots.size(), draw)) {
    if (!report.is_own)
      for (const std::string& warning : report.warnings) tool.warn(warning);
    tool.facts()[options.kind_of_shots()].push_back(std::move(report.facts));
  }
  tool.frames().advance(shots.size() - noted);
}

// What is said of a mesh before its first picture, and what is drawn beside that.
void introduce(Tool& tool, const Options& options, const Scene& scene, Renderer& renderer,
               const std::string& path) {
  with_names(options, [&] { renderer.check(scene); });
  note_model(tool, options.has_steps, renderer.mesh(), scene);
  warn_of_invisible(tool, options, renderer.mesh(), scene, path);
}

// Writes the colour bar of a whole mesh where one is wanted.
void write_color_bar_of(Tool& tool, const Options& options, const ZooMesh& mesh,
                        const ParsedScene& view) {
  if (writes_color_bar(options))
    write_color_bar(tool, options, mesh, box_of_nodes(mesh).diagonal(), view);
}

// What is drawn on every picture: units and names of fields are those of the first mesh.
void annotate(Tool& tool, const Options& options, const ParsedScene& view, const Renderer& renderer,
              std::optional<PictureAnnotation>& annotation) {
  annotation.emplace(tool, options, view, renderer.mesh(), chosen_frames(view.scene, options.frame),
                     has_integer_pictures(options));
}

// Pictures of the steps of a series.
void render_steps(Tool& tool, Options& options, std::optional<ParsedScene> parsed,
                  Request& request) {
  MeshSeries series(tool, options, options.series);
  const bool early = parsed.has_value();
  const ParsedScene view = series.scene(options, std::move(parsed));
  const Scene& scene = view.scene;
  if (!early) fit_to(tool, options, scene, request);
  const std::unique_ptr<Movie> movie = movie_of(options);
  const std::vector<Shot> shots = shots_of_steps(options, scene, series);
  claim_render_files(tool, options, shots);
  Renderer renderer(tool, options);
  std::optional<PictureAnnotation> annotation;
  const auto show = [&](const Shot& shot) {
    options.input = series[shot.step].path;  // errors name the step's own file
    renderer.show(series.read(shot.step));
    introduce(tool, options, scene, renderer, shot.path);
    if (annotation) return;
    annotate(tool, options, view, renderer, annotation);
    write_color_bar_of(tool, options, renderer.mesh(), view);
  };
  tool.frames().begin(options.kind_of_shots(), shots.size());
  render_shots(tool, options, scene, request.picture, shots, annotation, renderer, movie.get(),
               show);
  if (movie) tool.timed("write", [&] { movie->finish(); });
}

// Pictures of one mesh.
void render_mesh(Tool& tool, Options& options, std::optional<ParsedScene> parsed,
                 Request& request) {
  const bool early = parsed.has_value();
  Renderer renderer(tool, options);
  renderer.show(mesh_of(tool, options));
  const ParsedScene view = scene_for(tool, options, std::move(parsed), renderer.mesh());
  const Scene& scene = view.scene;
  if (!early) fit_to(tool, options, scene, request);
  introduce(tool, options, scene, renderer, options.output);
  std::optional<PictureAnnotation> annotation;
  annotate(tool, options, view, renderer, annotation);
  write_color_bar_of(tool, options, renderer.mesh(), view);
  if (scene.path) {
    const std::unique_ptr<Movie> movie = movie_of(options);
    const std::vector<Shot> shots = shots_of_frames(options, scene);
    tool.frames().begin(options.kind_of_shots(), shots.size());
    const std::span all(shots);
    const std::size_t shared =
        is_movie(options.output) ? shots.size() : shared_shots(options.role->all, shots.size());
    render_shots(tool, options, scene, request.picture, all.first(shared), annotation, renderer,
                 movie.get(), [](const Shot&) {});
    hand_out_frames(tool, options, scene, request.picture, all.subspan(shared), *annotation,
                    renderer);
    if (movie) tool.timed("write", [&] { movie->finish(); });
    return;
  }
  Json facts = renderer.render(scene, request.picture, *annotation, options.output, nullptr);
  facts.erase("seconds");  // the run's own, stage by stage, stay
  tool.facts().update(facts);
}

// Claims the files of a run that makes the colour bar alone.
void claim_color_bar_files(Tool& tool, const Options& options) {
  RunFiles files{{options.input, options.view}, {}};
  if (!options.save_view.empty())
    files.outputs.push_back({"--save-view", options.save_view, FileKind::specification});
  add_image(files.outputs, "--colorbar", options.color_bar);
  tool.claim(std::move(files));
  require_known_image_extension(options.color_bar);
}

// The colour bar without a picture.
void draw_color_bar_alone(Tool& tool, Options options) {
  claim_color_bar_files(tool, options);
  std::optional<ParsedScene> parsed = specification_of(tool, options);
  const ZooFile file = mesh_of(tool, options);
  const ParsedScene view = scene_for(tool, options, std::move(parsed), file.mesh);
  write_color_bar_of(tool, options, file.mesh, view);
}

// Throws where the options of the outputs do not fit one another, or the outputs cannot be written.
void check_outputs(Tool& tool, Options& options) {
  claim_render_files(tool, options);
  if (options.output.empty()) throw UsageError("--output is required");
  check_several(options);
  if (!is_movie(options.output)) check_picture_output(tool, options);
  if (!options.color_bar.empty()) require_known_image_extension(options.color_bar);
  if (!options.picture.channels.empty()) require_room_for_channels(picture_format(options));
}

void draw_pictures(Tool& tool, Options options) {
  options.has_steps = is_series(options.series, options.input);
  check_outputs(tool, options);
  std::optional<ParsedScene> parsed = specification_of(tool, options);
  Request request;  // what can be refused is, before the mesh is read
  if (parsed) fit_to(tool, options, parsed->scene, request);
  if (options.has_steps)
    render_steps(tool, options, std::move(parsed), request);
  else
    render_mesh(tool, options, std::move(parsed), request);
}

// Whether no picture is wanted but the colour bar.
bool wants_color_bar_alone(const Options& options) {
  return options.output.empty() && !options.color_bar.empty();
}

// A mesh in parts: what needs the whole mesh in one process is refused.
void draw_parts(Tool& tool, Options options) {
  for (const char* option : {"--order", "--overlap", "--skip-invalid", "--threshold", "--block",
                             "--convert", "--pixel", "--steps", "FURTHER", "--save-view"})
    if (tool.app().get_option(option)->count() > 0)
      throw UsageError(fmt::format("{}: not for a mesh in parts ({})", option, options.input));
  if (options.view.empty())
    throw UsageError(
        fmt::format("--view is required for a mesh in parts ({}); `hiac-info MESH --starter-view "
                    "-o FILE` makes one of the whole mesh",
                    options.input));
  if (wants_color_bar_alone(options)) {
    refuse_picture_options(tool.app());
    claim_color_bar_files(tool, options);
  } else {
    check_outputs(tool, options);
  }
  options.role->draw_parts(tool, options);
}

}  // namespace

namespace hiac::tools {

int render_command(Tool& tool, int argc, char** argv, const RenderRole& role) {
  Options options;
  options.role = &role;
  add_render_options(tool.app(), options);
  return tool.run(argc, argv, [&] {
    refuse_preview_options(options);
    if (!role.writes) {
      tool.leave_report();
      options.save_view.clear();
    }
    if (role.draw_parts && options.input.ends_with(kPartedExtension))
      draw_parts(tool, options);
    else if (tool.app().count("--pixel") > 0)
      explain(tool, options);
    else if (wants_color_bar_alone(options)) {
      refuse_picture_options(tool.app());
      draw_color_bar_alone(tool, options);
    } else {
      draw_pictures(tool, options);
    }
  });
}

}  // namespace hiac::tools
