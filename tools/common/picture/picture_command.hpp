#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "hiac/frame/crop.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "hiac/scene/specification.hpp"
#include "hiac/session/ordering.hpp"
#include "hiac/session/visibility.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/common/naming.hpp"
#include "tools/common/picture/starter_command.hpp"
#include "tools/common/run_files.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// What every command that makes pictures is told: of which mesh, by which specification, and into
/// which files.
struct PictureCommand {
  std::string input, conversion, view, save_view, order, output, format, size;
  std::string threshold, block;  ///< which cells are drawn
  StarterOptions starter;        ///< without a view
  std::vector<std::string> overrides;
  int depth = 0;
  bool no_background = false, linear = false, all_frames = false, skip_invalid = false;
  bool overlap = false, strict = false;
  std::optional<std::uint32_t> frame;
};

/// Adds its options. `name`: the tool's.
void add_picture_command(CLI::App& app, PictureCommand& command, const std::string& name);

/// Reads the specification with --size and --set, and notes what the parser has to say; none where
/// there is no --view, so that the mesh decides (scene_for). Throws UsageError for options that do
/// not fit.
std::optional<ParsedScene> specification_of(Tool& tool, PictureCommand& command);

/// Reads the mesh, by hiac-convert if it is not one of ours, and keeps the cells that --block and
/// --threshold choose, of which hiac-convert does the same. Throws UsageError for a block of a zoo
/// mesh, which has none.
ZooFile mesh_of(Tool& tool, const PictureCommand& command);

/// The same of one step of a series: `path` takes the place of the command's input, and `step` is
/// the number of the step in a foreign file that holds several. `is_silent`: nothing is said of it.
ZooFile mesh_of_step(Tool& tool, const PictureCommand& command, const std::string& path,
                     std::optional<std::size_t> step, bool is_silent);

/// The scene of a starter view of the mesh, which --save-view keeps; notes what it shows.
ParsedScene starter_scene(Tool& tool, PictureCommand& command, const ZooMesh& mesh);

/// The scene for a mesh: of a specification, with transfer functions over the ranges of its fields;
/// or of the mesh's starter view, which --save-view keeps. Notes what it is. Errors name the files.
ParsedScene scene_for(Tool& tool, PictureCommand& command, std::optional<ParsedScene> parsed,
                      const ZooMesh& mesh);

/// Warns of all reasons why a picture of the scene shows nothing (invisible_parts); with --strict
/// throws JudgementError of the first of them. `path` is named where it is not the command's
/// output: where there are several pictures.
void warn_of_invisible(Tool& tool, const PictureCommand& command, const ZooMesh& mesh,
                       const Scene& scene, const std::string& path);

/// The same for a picture that has been drawn (reason_of_empty).
void warn_of_empty(Tool& tool, const PictureCommand& command, const ZooMesh& mesh,
                   const Scene& scene, const DrawnFacts& drawn, const std::string& path);

/// Throws UsageError where --frame and --frames do not fit a scene.
void check_frame_options(const PictureCommand& command, const Scene& scene);

/// Refuses an output whose format is not known or cannot have its depth, and a picture on stdout
/// (-o -) that would not fit there. Makes the format begin with a point. Throws UsageError.
void check_picture_output(const Tool& tool, PictureCommand& command);

/// The extension that decides the picture's format.
const std::string& picture_format(const PictureCommand& command);

/// The output's path; stdout's for "-".
std::string picture_path(const std::string& output);

/// Adds the files of the command to those that a run reads and writes: the pictures of all frames
/// where there is a scene, the output else. `further_channels`: of the pictures, by name.
void add_picture_files(RunFiles& files, const PictureCommand& command, const Scene* scene,
                       const std::vector<std::string>& further_channels = {});

/// What `work` returns; errors name the mesh's, the specification's or the order's file
/// (naming.hpp).
template <typename Work>
auto with_names(const PictureCommand& command, const Work& work) {
  return naming(input_name(command.input), command.view, {command.order}, work);
}

/// The orders from a file or behind the mesh in the stream; none where they are made here.
std::optional<GivenOrders> given_orders(const PictureCommand& command, const ZooFile& file);

/// Throws UsageError where --overlap asks for an order although one is given.
void refuse_overlap_beside(const PictureCommand& command, const GivenOrders& given);

/// Does `check`; its InvalidCellError becomes an InputError that names --skip-invalid, too.
void hint_at_skip_invalid(const PictureCommand& command, const std::function<void()>& check);

/// Warns of the cells that --skip-invalid leaves out, of so many, and notes how many they are.
void note_skipped(Tool& tool, const std::vector<CellId>& skipped, std::size_t cells);

/// X,Y,W,H, as --crop has it. Throws UsageError when it is something else.
PixelRect parse_crop(const std::string& text);

/// X,Y, as --pixel has it: column and row of a pixel. Throws UsageError when it is something else.
std::array<std::uint32_t, 2> parse_pixel(const std::string& text);

}  // namespace hiac::tools
