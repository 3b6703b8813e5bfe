#include "tools/common/picture_command.hpp"

#include <array>
#include <charconv>
#include <span>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/frame/renderable.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/order/order_file.hpp"
#include "hiac/scene/camera_path.hpp"
#include "tools/common/frames.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/common/order_facts.hpp"
#include "tools/common/specification.hpp"

namespace hiac::tools {
namespace {

// WxH as overrides of the specification.
void add_size(const std::string& size, std::vector<std::string>& overrides) {
  if (size.empty()) return;
  const std::size_t cross = size.find('x');
  if (cross == std::string::npos || cross == 0 || cross + 1 == size.size())
    throw UsageError("--size: expected WIDTHxHEIGHT, as 1024x768 (found " + size + ")");
  overrides.push_back("image.width=" + size.substr(0, cross));
  overrides.push_back("image.height=" + size.substr(cross + 1));
}

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
  app.add_option("MESH", command.input, "Zoo mesh; - or none: stdin");
  app.add_option("--view", command.view, "Image specification (TOML)")
      ->required()
      ->type_name("SPEC");
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
               "Leave out cells that are partly turned inside out instead of refusing the mesh");
  app.add_flag("--linear", command.linear,
               "Write linear values instead of sRGB into integer images");
}

ParsedScene specification_of(Tool& tool, PictureCommand& command) {
  add_size(command.size, command.overrides);
  ParsedScene parsed = read_specification(command.view, command.overrides);
  for (const std::string& line : parsed.notes) tool.note(line);
  return parsed;
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
    throw InputError(input_name(command.input),
                     fmt::format("{}; --skip-invalid leaves such cells out", error.what()));
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
