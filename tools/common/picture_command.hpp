#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "hiac/frame/crop.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "hiac/scene/scene_parser.hpp"
#include "hiac/session/ordering.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// What every command that makes pictures is told: of which mesh, by which specification, and into
/// which files.
struct PictureCommand {
  std::string input, view, order, output, size;
  std::vector<std::string> overrides;
  int depth = 0;
  bool no_background = false, linear = false, all_frames = false, skip_invalid = false;
  bool overlap = false;
  std::optional<std::uint32_t> frame;
};

/// Adds its options. `name`: the tool's.
void add_picture_command(CLI::App& app, PictureCommand& command, const std::string& name);

/// Reads the specification with --size and --set, and notes what the parser has to say.
ParsedScene specification_of(Tool& tool, PictureCommand& command);

/// Throws UsageError where --frame and --frames do not fit a scene.
void check_frame_options(const PictureCommand& command, const Scene& scene);

/// The orders from a file or behind the mesh in the stream; none where they are made here.
std::optional<GivenOrders> given_orders(const PictureCommand& command, const ZooFile& file);

/// X,Y,W,H, as --crop has it. Throws UsageError when it is something else.
PixelRect parse_crop(const std::string& text);

/// X,Y, as --pixel has it: column and row of a pixel. Throws UsageError when it is something else.
std::array<std::uint32_t, 2> parse_pixel(const std::string& text);

}  // namespace hiac::tools
