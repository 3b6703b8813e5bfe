#include "tools/common/picture/picture_command.hpp"

#include <array>
#include <charconv>
#include <span>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/frame/renderable.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/mesh/metadata_keys.hpp"
#include "hiac/order/order_file.hpp"
#include "hiac/scene/camera_path.hpp"
#include "hiac/scene/paraview/paraview_view.hpp"
#include "hiac/session/session.hpp"
#include "tools/common/as_option.hpp"
#include "tools/common/foreign_mesh.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/common/picture/frames.hpp"
#include "tools/common/picture/order_facts.hpp"
#include "tools/common/picture/paraview_input.hpp"
#include "tools/common/picture/picture_size.hpp"
#include "tools/common/picture/specification.hpp"
#include "tools/common/text_output.hpp"
#include "tools/common/threshold.hpp"

namespace hiac::tools {
namespace {

// Numbers of pixels with commas between; false where the text is something else.
bool parse_pixels(const std::string& text, std::span<std::uint32_t> numbers) {
  const char *at = text.data(), *end = text.data() + text.size();
  for (std::uint32_t& number : numbers) {
    const auto [next, error] = std::from_chars(at, end, number);
    const bool last = &number == &numbers.back();
    if (error != std::errc() || (last ? next != end : next == end || *next != ',')) return false;
    at = last ? next : next + 1;
  }
  return true;
}

// A picture on stdout needs a format, and stdout for itself.
void require_room_on_stdout(const Tool& tool, const PictureCommand& command) {
  if (command.format.empty())
    throw UsageError("-o -: the picture's format is not known (--format EXTENSION expected)");
  if (command.format == ".f32") throw UsageError("--format .f32: is several files (-o - is one)");
  if (command.all_frames)
    throw UsageError("--frames: a picture a frame does not fit stdout (-o FILE expected)");
  if (tool.common().json == "-")
    throw UsageError("--json -: stdout carries the picture (a file for --json expected)");
  if (isatty(STDOUT_FILENO) != 0)
    throw UsageError("a picture is not printed on a terminal (-o FILE expected, or a pipe)");
}

}  // namespace

void add_picture_command(CLI::App& app, PictureCommand& command, const std::string& name) {
  app.add_option("MESH", command.input, kMeshHelp);
  add_conversion(app, command.conversion);
  add_threshold(app, command.threshold);
  app.add_option("--block", command.block, "Draw only this block of a foreign file")
      ->type_name("NAME");
  app.add_option(
         "--view", command.view,
         "Image specification (TOML), a picture made by one (.png .exr .tiff), or a state or "
         "camera "
         "of ParaView (.pvsm, FILE.pvsm#VIEW, .pvcc); without it the picture is of a starter view")
      ->type_name("SPEC");
  app.add_option("--save-view", command.save_view,
                 "Keep the starter view in this file, without --set")
      ->type_name("FILE");
  add_starter_options(app, command.starter);
  auto* order =
      app.add_option("--order", command.order,
                     "Order file of hiac-sort; without it " + name + " sorts the mesh first")
          ->type_name("FILE");
  app.add_flag("--overlap", command.overlap, kOverlapHelp)->excludes(order);
  app.add_option("-o,--output", command.output,
                 "Image: " + image_extensions() + "; - with --format: stdout")
      ->type_name("IMAGE");
  app.add_option("--format", command.format,
                 "Write the picture in the format of this extension, whatever the name says")
      ->type_name("EXTENSION");
  app.add_option("--size", command.size, "Size in pixels instead of the specification's")
      ->type_name("WxH");
  app.add_option("--set", command.overrides, "Override KEY=VALUE of the specification; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  auto* one =
      app.add_option("--frame", command.frame, "Render this frame of a camera path, counted from 0")
          ->type_name("N");
  app.add_flag("--frames", command.all_frames,
               "Render all frames of a camera path into numbered files: part.png gives "
               "part-0000.png and so on, part-%03d.png gives part-000.png")
      ->excludes(one);
  app.add_flag("--no-background", command.no_background,
               "Leave the background out, so that images can be composited later");
  app.add_option("--depth", command.depth,
                 "Bits per sample: 8, 16, or for .tiff also 32 (floating point); default: 8")
      ->type_name("BITS");
  app.add_flag("--skip-invalid", command.skip_invalid,
               "Leave out cells that are partly turned inside out instead of refusing the mesh; "
               "starter views do so unless --strict is given");
  app.add_flag("--linear", command.linear,
               "Write linear values instead of sRGB into integer images");
  app.add_flag("--strict", command.strict,
               "End with exit code 1 and without a picture where the picture may mislead: nothing, "
               "or nothing of a part of the specification, is seen; or ray segments were met out "
               "of order");
}

std::optional<ParsedScene> specification_of(Tool& tool, PictureCommand& command) {
  if (command.view.empty()) return std::nullopt;
  if (!command.save_view.empty())
    throw UsageError("--save-view: only for the starter view (found beside --view)");
  const bool is_camera = command.view.ends_with(".pvcc");  // of a starter view
  if (!is_camera && are_given(command.starter))
    throw UsageError(
        "--field, --preset, --isovalues, --dark: only for the starter view (found "
        "beside --view)");
  if (!command.size.empty()) {
    const ImageSize size = parse_size(command.size);
    command.overrides.push_back(fmt::format("image.width={}", size.width));
    command.overrides.push_back(fmt::format("image.height={}", size.height));
  }
  std::optional<ParsedScene> parsed = is_paraview_file(command.view)
                                          ? paraview_specification(tool, command)
                                          : read_specification(command.view, command.overrides);
  if (!parsed) return std::nullopt;
  for (const std::string& line : parsed->notes) tool.note(line);
  return parsed;
}

ZooFile mesh_of(Tool& tool, const PictureCommand& command) {
  return mesh_of_step(tool, command, command.input, std::nullopt, false);
}

ZooFile mesh_of_step(Tool& tool, const PictureCommand& command, const std::string& path,
                     std::optional<std::size_t> step, bool is_silent) {
  const MeshInput input{path, command.conversion, is_silent, !command.strict};
  if (is_foreign_mesh(path)) {
    std::vector<std::string> further;
    if (step) further.push_back(fmt::format("--step={}", *step));
    if (!command.block.empty()) further.push_back("--block=" + command.block);
    if (!command.threshold.empty()) further.push_back("--threshold=" + command.threshold);
    return tool.timed("read",
                      [&] { return read_any_mesh(tool, input, MeshNumbers::checked, further); });
  }
  if (!command.block.empty())
    throw UsageError(
        fmt::format("--block {}: {} is a zoo container, which has no blocks (only for "
                    "foreign files)",
                    command.block, input_name(path)));
  ZooFile file = tool.timed("read", [&] { return read_any_mesh(tool, input); });
  for (const auto& [key, how] : file.mesh.metadata)
    if (key == kApproximated) tool.note(fmt::format("{}: {}", input_name(path), how));
  // an order that is stored with the mesh is of all its cells
  if (apply_threshold(tool, file.mesh, command.threshold)) file.extras.clear();
  return file;
}

ParsedScene starter_scene(Tool& tool, PictureCommand& command, const ZooMesh& mesh) {
  const std::string subject = input_name(command.input);
  if (!command.size.empty()) command.starter.size = parse_size(command.size);
  const StarterView view = make_view(tool, mesh, subject, command.starter);
  command.view = "starter view";
  // a first picture shows what it can, and says what it leaves out
  command.skip_invalid |= !command.strict;
  if (!command.save_view.empty()) write_text(command.save_view, file_text(view, subject));
  return as_option("--set ",
                   [&] { return parse_scene(view.text, command.view, "", command.overrides); });
}

ParsedScene scene_for(Tool& tool, PictureCommand& command, std::optional<ParsedScene> parsed,
                      const ZooMesh& mesh) {
  if (!parsed) parsed = starter_scene(tool, command, mesh);
  parsed->notes.clear();  // they have been told, or say nothing of a starter view
  parsed = with_names(command, [&] { return with_field_ranges(*std::move(parsed), mesh); });
  for (const std::string& line : parsed->notes) tool.note(line);
  return *std::move(parsed);
}

namespace {

void warn_of_picture(Tool& tool, const PictureCommand& command, const std::string& path,
                     const std::string& line) {
  tool.warn(path != command.output ? fmt::format("{}: {}", path, line) : line);
}

void require_visible(const PictureCommand& command, const std::string& path,
                     const std::string& line) {
  if (command.strict)
    throw JudgementError(fmt::format("{}: not written: {} (--strict)", path, line));
}

}  // namespace

void warn_of_invisible(Tool& tool, const PictureCommand& command, const ZooMesh& mesh,
                       const Scene& scene, const std::string& path) {
  const std::vector<std::string> lines = invisible_parts(mesh, scene);
  for (const std::string& line : lines) warn_of_picture(tool, command, path, line);
  if (!lines.empty()) require_visible(command, path, lines.front());
}

void warn_of_empty(Tool& tool, const PictureCommand& command, const ZooMesh& mesh,
                   const Scene& scene, const DrawnFacts& drawn, const std::string& path) {
  const std::optional<std::string> line = reason_of_empty(mesh, scene, drawn);
  if (!line) return;
  warn_of_picture(tool, command, path, *line);
  require_visible(command, path, *line);
}

// Pictures are numbered when all frames are wanted, and there is one without a camera path.
void check_frame_options(const PictureCommand& command, const Scene& scene) {
  if (scene.path && !command.all_frames && !command.frame)
    throw UsageError(
        fmt::format("{}: holds a camera path of {} frames: --frames renders all "
                    "frames, --frame N one",
                    command.view, frame_count(scene)));
  if (!scene.path && command.all_frames)
    throw UsageError(
        fmt::format("--frames: {} has no camera path (keyframes [[camera]], or a "
                    "[turntable])",
                    command.view));
  if (command.frame) chosen_frames(scene, command.frame);
  if (command.all_frames) frame_path(command.output, 0);
}

void check_picture_output(const Tool& tool, PictureCommand& command) {
  if (command.output.empty()) throw UsageError("--output is required");
  if (!command.format.empty() && !command.format.starts_with('.'))
    command.format.insert(command.format.begin(), '.');
  if (command.output == "-") require_room_on_stdout(tool, command);
  require_known_image_extension(picture_format(command), command.depth);
}

const std::string& picture_format(const PictureCommand& command) {
  return command.format.empty() ? command.output : command.format;
}

std::string picture_path(const std::string& output) {
  return output == "-" ? "/dev/stdout" : output;
}

void add_picture_files(RunFiles& files, const PictureCommand& command, const Scene* scene,
                       const std::vector<std::string>& further_channels) {
  for (const std::string& input : {command.input, command.view, command.order})
    files.inputs.push_back(input);
  if (!command.save_view.empty())
    files.outputs.push_back({"--save-view", command.save_view, FileKind::specification});
  if (scene == nullptr || !command.all_frames) {
    add_image(files.outputs, "-o", command.output, further_channels);
    return;
  }
  for (const std::uint32_t frame : chosen_frames(*scene, command.frame))
    add_image(files.outputs, "-o", frame_path(command.output, frame), further_channels);
}

std::optional<GivenOrders> given_orders(const PictureCommand& command, const ZooFile& file) {
  if (!command.order.empty()) return GivenOrders{command.order, read_order_chunks(command.order)};
  GivenOrders orders{input_name(command.input), {}};
  for (const ExtraChunk& chunk : file.extras)
    if (chunk.type == kOrderChunk) orders.chunks.push_back(chunk);
  if (orders.chunks.empty()) return std::nullopt;
  return orders;
}

void refuse_overlap_beside(const PictureCommand& command, const GivenOrders& given) {
  if (command.overlap)
    throw UsageError("--overlap: " + given.subject +
                     " already has an order (hiac-sort --overlap makes a new one)");
}

void hint_at_skip_invalid(const PictureCommand& command, const std::function<void()>& check) {
  try {
    check();
  } catch (const InvalidCellError& error) {
    throw InputError(
        input_name(command.input),
        fmt::format("{}; --skip-invalid leaves such cells out, and hiac-convert --invalid "
                    "cut divides them into tetrahedra",
                    error.what()));
  }
}

void note_skipped(Tool& tool, const std::vector<CellId>& skipped, std::size_t cells) {
  tool.facts()["skipped_cells"] = skipped.size();
  if (!skipped.empty())
    tool.warn(fmt::format(
        "{} of {} cells are partly turned inside out and are left out, the first is cell "
        "{}: the picture has holes there",
        skipped.size(), cells, skipped.front()));
}

PixelRect parse_crop(const std::string& text) {
  std::array<std::uint32_t, 4> numbers{};
  if (!parse_pixels(text, numbers))
    throw UsageError("--crop: expected X,Y,WIDTH,HEIGHT in pixels, as 300,200,64,64 (found " +
                     text + ")");
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

std::array<std::uint32_t, 2> parse_pixel(const std::string& text) {
  std::array<std::uint32_t, 2> numbers{};
  if (!parse_pixels(text, numbers))
    throw UsageError("--pixel: expected a column and a row, as 300,200 (found " + text + ")");
  return numbers;
}

}  // namespace hiac::tools
