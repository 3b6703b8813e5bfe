// hiac-convert: a foreign finite-element file to a zoo mesh, and a zoo mesh to VTU.
#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "formats/common/cells/keep_corners.hpp"
#include "formats/common/io/named_file.hpp"
#include "formats/common/mesh/select_fields.hpp"
#include "formats/common/pieces/piece_field.hpp"
#include "formats/registry.hpp"
#include "formats/zoo/zoo_format.hpp"
#include "hiac/base/error.hpp"
#include "hiac/base/output_file.hpp"
#include "hiac/mesh/boundary_surface.hpp"
#include "hiac/mesh/file_descriptor.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "hiac/partition/partition.hpp"
#include "tools/common/as_option.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/common/number_text.hpp"
#include "tools/common/plain_text.hpp"
#include "tools/common/steps/number_pattern.hpp"
#include "tools/common/steps/step_choice.hpp"
#include "tools/common/tool.hpp"
#include "tools/common/version.hpp"
#include "tools/convert/edits.hpp"
#include "tools/convert/invalid_cells.hpp"
#include "tools/convert/listing.hpp"
#include "tools/convert/option_names.hpp"
#include "tools/convert/parted_output.hpp"
#include "tools/convert/spooled_input.hpp"
#include "tools/convert/step_adjacency.hpp"
#include "tools/convert/tell.hpp"

namespace hiac::tools {
namespace {

constexpr const char* kExamples =
    "  hiac-convert run.vtu -o run.zoo\n"
    "  hiac-convert --list run.vtu\n"
    "  hiac-convert run.vtk --field velocity:magnitude=speed | hiac-sort --view v.toml\n"
    "  hiac-convert run.vtu --derive 'speed=magnitude(velocity)' -o run.zoo\n"
    "  hiac-convert run.exo --steps all -o run-%04d.zoo\n"
    "  hiac-convert run.zoo -o run.vtu\n"
    "  hiac-convert run.zoo --levels 3 -o boundary.ply\n"
    "  hiac-convert run.zoo --parts 8 -o run.zparts\n"
    "  hiac-convert run.pvtu --keep-parts -o run.zparts";

struct Options {
  std::string input;
  std::string output;
  std::string format;
  bool list_formats = false;
  bool list = false;
  std::vector<std::string> fields;
  Edits edits;
  std::string time;
  std::optional<std::size_t> step;
  std::string steps;
  std::optional<std::string> block;
  bool corners_only = false;
  bool skip_unsupported = false;
  bool approximate = false;
  bool allow_external = false;
  bool adjacency = true;
  std::optional<InvalidCellsFate> invalid;
  std::optional<unsigned> levels;
  Parting parting;

  [[nodiscard]] bool from_stdin() const { return input.empty() || input == "-"; }
  [[nodiscard]] bool to_stdout() const { return output.empty() || output == "-"; }
};

void add_options(CLI::App& app, Options& options) {
  app.add_option(
      "INPUT", options.input,
      "The file or pipe to convert; - or none: stdin, which carries a zoo stream or, with "
      "--format, any format that is one file");
  app.add_option(
         "-o,--output", options.output,
         "Output file; its extension chooses the format (.zoo, .vtu, .vtkhdf, .msh; .zparts: "
         "an index and a file for each part; .stl, .ply, .vtp: the boundary alone); - or none: a "
         "zoo stream to stdout")
      ->type_name("FILE");
  app.add_option("--format", options.format,
                 "Read INPUT as this format instead of detecting the format")
      ->type_name("NAME");
  app.add_flag("--list-formats", options.list_formats, "Print a table of the formats");
  app.add_flag("--list", options.list, "Print the contents of INPUT; convert nothing");
  app.add_option("--field", options.fields,
                 "Convert this field and give it the name NEW; FIELD:x and FIELD:magnitude are "
                 "scalars of a vector field, FIELD:von_mises of a tensor field; repeatable "
                 "(default: all fields)")
      ->type_name("NAME[=NEW]")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  options.edits.add_options(app);
  CLI::Option* time = app.add_option("--time", options.time,
                                     "Convert the step at this time; nearest:T: the nearest to T")
                          ->type_name("T");
  CLI::Option* step =
      app.add_option("--step", options.step, "Convert the step with this number, counted from 0")
          ->excludes(time);
  app.add_option("--steps", options.steps,
                 "Convert several steps, each into a file of its own: -o has a place for the "
                 "step's number, as -o run-%04d.zoo")
      ->excludes(time)
      ->excludes(step)
      ->excludes("--list")
      ->type_name(kStepsType);
  app.add_option("--block", options.block, "Convert only this block")->type_name("NAME");
  app.add_flag("--corners-only", options.corners_only,
               "Keep only the corner nodes of quadratic and cubic cells, which become linear");
  app.add_flag("--skip-unsupported", options.skip_unsupported,
               "Leave out volume cells that cannot be converted");
  app.add_flag("--approximate", options.approximate,
               "Re-interpolate cells of order 4 and more (and cells whose centre nodes matter) to "
               "the nearest kind, divide polyhedra into tetrahedra and pyramids, and state the "
               "largest error that this makes");
  app.add_flag("--allow-external", options.allow_external,
               "Read files that INPUT names (by links of HDF5, in XDMF, PVD, VTM, include lines) "
               "wherever they lie, not only in its folder");
  app.add_option("--invalid", options.invalid,
                 "What becomes of cells that are partly turned inside out, which cannot be drawn: "
                 "refuse the mesh, skip them, or cut them into tetrahedra of positive volume and "
                 "state how much volume that changes (default: they are converted as they are)")
      ->type_name("refuse|skip|cut")
      ->transform(CLI::CheckedTransformer(
                      std::map<std::string, InvalidCellsFate>{{"refuse", InvalidCellsFate::refuse},
                                                              {"skip", InvalidCellsFate::skip},
                                                              {"cut", InvalidCellsFate::cut}},
                      CLI::ignore_case)
                      .description(""));
  app.add_option("--levels", options.levels,
                 "With .stl, .ply, .vtp: halve the edges of the boundary's faces N times, which "
                 "makes 4^N triangles of one (default: 0 if all cells are linear, otherwise 2)")
      ->check(CLI::Range(0U, kMostBoundaryLevels))
      ->type_name("N");
  options.parting.add_options(app);
  app.add_flag("--adjacency,!--no-adjacency", options.adjacency,
               "Store which cells share faces, so that later stages start faster (default: yes)");
}

/// T or nearest:T.
void read_time(const std::string& text, formats::ReadOptions& options) {
  constexpr std::string_view kNearest = "nearest:";
  std::string_view number = text;
  options.nearest_time = number.starts_with(kNearest);
  if (options.nearest_time) number.remove_prefix(kNearest.size());
  options.time = number_in(number);
  if (!options.time)
    throw UsageError(fmt::format("--time {}: a number, or nearest:NUMBER expected", text));
}

formats::ReadOptions read_options(const Options& options) {
  formats::ReadOptions result;
  if (!options.time.empty()) read_time(options.time, result);
  result.step = options.step;
  result.block = options.block;
  result.skip_unsupported = options.skip_unsupported;
  result.corners_of_unsupported = options.corners_only;
  result.approximate = options.approximate;
  return result;
}

const formats::Format& format_of(const Options& options, const std::string& path) {
  if (options.format.empty()) return formats::format_to_read(path);
  const formats::Format& format =
      *as_option("--", [&] { return &formats::format_named(options.format); });
  if (!format.read)
    throw UsageError(fmt::format("--format {}: files of this format are not read", options.format));
  return format;
}

/// stdin, or a pipe that INPUT names.
FileDescriptor open_stream(const Options& options) {
  if (options.from_stdin()) return FileDescriptor(dup(STDIN_FILENO));
  std::error_code error;
  if (std::filesystem::is_character_file(options.input, error))
    throw InputError(options.input, "is a device (a file or a pipe expected)");
  return open_to_read(options.input);
}

/// Does `work(format, path, told)` on the input file; a pipe is kept in a file first, and `told`
/// puts the pipe's name in place of the file's in a text. Errors do so, too.
template <typename Work>
auto with_input(const Options& options, const Work& work) {
  std::optional<formats::PieceMarking> marking;
  if (options.parting.keep) marking.emplace();
  const bool is_pipe = options.from_stdin() || is_stream(options.input);
  const auto folder = std::filesystem::path(options.input).parent_path();
  formats::set_named_files({folder.empty() ? "." : folder.string(), options.allow_external});
  if (!is_pipe)
    return work(format_of(options, options.input), options.input,
                [](std::string text) { return text; });
  const std::string subject = input_name(options.input);
  const SpooledInput spooled(open_stream(options).number(), subject);
  // a pipe has no folder: nothing lies in the file's own name
  formats::set_named_files({spooled.path(), options.allow_external});
  try {
    return work(format_of(options, spooled.path()), spooled.path(),
                [&](std::string text) { return spooled.told(std::move(text)); });
  } catch (const InputError& error) {
    throw InputError(spooled.told(error.what()));
  } catch (const UsageError& error) {
    throw UsageError(spooled.told(error.what()));
  }
}

void require_input(const Options& options) {
  if (options.input.empty() && isatty(STDIN_FILENO) != 0)
    throw UsageError("no INPUT (a file expected, or a zoo stream on stdin; see --help)");
}

/// Whether stdin is to be read as a zoo stream, without a detour through a file.
bool is_zoo_stream(const Options& options) {
  return options.from_stdin() && (options.format.empty() || options.format == "zoo");
}

/// What `work` returns. The readers' messages name members of ReadOptions; the user knows options.
template <typename Work>
auto with_options_named(const Work& work) try {
  return work();
} catch (const InputError& error) {
  throw InputError(with_option_names(error.what()));
} catch (const UsageError& error) {
  throw UsageError(with_option_names(error.what()));
}

/// Reads by a format; `told` as with_input has it. The readers' messages on wrong usage begin with
/// what was asked for: an option without dashes.
template <typename Told>
formats::Reading read_by(const formats::Format& format, const std::string& path,
                         const formats::ReadOptions& wanted, const Told& told) {
  formats::Reading reading = as_option("--", [&] { return format.read(path, wanted); });
  for (std::string& note : reading.notes) note = told(std::move(note));
  for (auto& [key, text] : reading.mesh.metadata) text = told(std::move(text));
  return reading;
}

formats::Reading read_input(const Options& options) {
  const formats::ReadOptions wanted = read_options(options);
  if (is_zoo_stream(options)) {
    ZooFile stream = read_zoo_stream(STDIN_FILENO, "stdin");
    return as_option("--", [&] { return formats::reading_of(std::move(stream), wanted, "stdin"); });
  }
  return with_input(options, [&](const auto& format, const std::string& path, const auto& told) {
    return read_by(format, path, wanted, told);
  });
}

void list_input(Tool& tool, const Options& options) {
  formats::Inventory inventory =
      is_zoo_stream(options)
          ? formats::inventory_of(read_zoo_stream(STDIN_FILENO, "stdin").mesh)
          : with_input(options, [](const auto& format, const std::string& path, const auto& told) {
              formats::Inventory found = format.inspect(path);
              for (std::string& note : found.notes) note = told(std::move(note));
              return found;
            });
  for (std::string& note : inventory.notes) note = with_option_names(std::move(note));
  if (tool.common().json != "-") std::cout << plain_text(inventory_text(inventory));
  tool.facts()["inventory"] = inventory_facts(inventory);
}

/// Refuses a mesh on stdout that would not fit there, before anything is read.
void check_stdout(const Tool& tool, const Options& options) {
  if (!options.to_stdout()) return;
  if (isatty(STDOUT_FILENO) != 0)
    throw UsageError("a mesh is not printed on a terminal (write it with -o FILE, or pipe it on)");
  if (tool.common().json == "-")
    throw UsageError("--json -: stdout carries the mesh (a file for --json expected)");
}

/// A mesh may be written over the file that it was read from where that is of the same format.
bool keeps_format(const Options& options) {
  std::error_code error;
  if (options.from_stdin() || !std::filesystem::equivalent(options.input, options.output, error))
    return true;
  return format_of(options, options.input).name == formats::format_to_write(options.output).name;
}

/// Adds the file that -o names.
void add_output(RunFiles& files, const Options& options) {
  bool boundary = false;
  if (!options.list) options.parting.check_output(options.output);
  if (!options.list && !options.to_stdout()) {
    as_option("-o ", [&] {
      boundary = static_cast<bool>(formats::format_to_write(options.output).write_boundary);
    });
    files.outputs.push_back({"-o", options.output, FileKind::mesh, keeps_format(options)});
  }
  if (options.levels && !boundary)
    throw UsageError("--levels: only for the boundary of a mesh (-o FILE.stl, .ply or .vtp)");
}

void claim_files(Tool& tool, const Options& options) {
  RunFiles files{{options.input}, {}};
  add_output(files, options);
  tool.claim(std::move(files));
}

void note_all(Tool& tool, const std::vector<std::string>& notes) {
  for (const std::string& note : notes) tell(tool, with_option_names(note));
}

void report_mesh(Tool& tool, const ZooMesh& mesh) {
  std::array<std::size_t, kKindCount> counts{};
  for (const CellKind kind : mesh.kinds) ++counts[static_cast<std::size_t>(kind)];
  auto& facts = tool.facts();
  facts["nodes"] = mesh.node_count();
  facts["cells"] = mesh.cell_count();
  facts.erase("kinds");
  std::string kinds;
  for (std::size_t k = 0; k < kKindCount; ++k) {
    if (counts[k] == 0) continue;
    const std::string name(kind_name(static_cast<CellKind>(k)));
    facts["kinds"][name] = counts[k];
    kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", counts[k], name);
  }
  facts["fields"] = nlohmann::ordered_json::array();
  for (const Field& field : mesh.fields) facts["fields"].push_back(field.name);
  tool.detail(fmt::format("{} nodes; {}; {} fields", mesh.node_count(), kinds, mesh.fields.size()));
}

void write_output(Tool& tool, const Options& options, const ZooMesh& mesh, const Pieces& pieces) {
  if (options.to_stdout()) {
    write_zoo_stream(STDOUT_FILENO, {mesh, {}}, "stdout");
    return;
  }
  if (is_parted_output(options.output))
    return write_parts(tool, options.parting, mesh, pieces, options.input, options.output);
  const formats::Format& format = formats::format_to_write(options.output);
  if (!format.write_boundary) return note_all(tool, format.write(options.output, mesh));
  const unsigned levels = options.levels.value_or(default_boundary_levels(mesh));
  const BoundarySurface surface = boundary_surface(mesh, levels);
  tool.facts()["boundary"] = {{"triangles", surface.triangles.size()},
                              {"points", surface.xyz.size() / 3},
                              {"levels", levels}};
  tool.note(fmt::format("boundary of {} triangles and {} points (edges halved {} times)",
                        surface.triangles.size(), surface.xyz.size() / 3, levels));
  note_all(tool, format.write_boundary(options.output, surface));
}

/// Keeps the fields that are asked for, and those derived.
void select(ZooMesh& mesh, const Options& options) {
  if (options.fields.empty()) return;
  std::vector<Field> fields =
      as_option("--", [&] { return formats::select_fields(mesh, options.fields); });
  const auto derived = std::span(mesh.fields).last(options.edits.derivations.size());
  fields.insert(fields.end(), derived.begin(), derived.end());
  // the marks of pieces belong to the cells
  const auto marks = std::ranges::find(mesh.fields, formats::kPieceField, &Field::name);
  if (marks != mesh.fields.end()) fields.push_back(*marks);
  mesh.fields = std::move(fields);
}

/// What is done to the mesh that was read, and writing it.
void finish(Tool& tool, const Options& options, formats::Reading reading, StepAdjacency& known) {
  ZooMesh& mesh = reading.mesh;
  if (options.corners_only) formats::keep_corners(mesh, reading.notes);
  edit(tool, mesh, options.edits);
  select(mesh, options);
  note_all(tool, reading.notes);
  if (options.invalid)
    tool.timed("invalid cells", [&] {
      treat_invalid_cells(tool, *options.invalid, input_name(options.input), mesh);
    });
  const bool to_zoo = options.to_stdout() || is_parted_output(options.output) ||
                      formats::format_to_write(options.output).name == "zoo";
  if (!options.adjacency)
    mesh.adjacency.reset();
  else if (to_zoo && !mesh.adjacency)
    mesh.adjacency = tool.timed("adjacency", [&] { return known.of(mesh); });
  const Pieces pieces = formats::take_pieces(mesh);
  report_mesh(tool, mesh);
  tool.timed("write", [&] { write_output(tool, options, mesh, pieces); });
}

/// The options of every step: that step alone, into its file, whose name the pattern gives.
std::vector<Options> options_of_steps(const Options& options, const NumberPattern& pattern,
                                      const std::vector<std::size_t>& steps) {
  std::vector<Options> all;
  for (const std::size_t step : steps) {
    Options& one = all.emplace_back(options);
    one.step = step;
    one.output = pattern.path_of(step);
  }
  return all;
}

/// Keeps the notes that no earlier step had.
void forget_told(std::vector<std::string>& notes, std::set<std::string>& told) {
  std::erase_if(notes, [&](const std::string& note) { return !told.insert(note).second; });
}

void convert_steps(Tool& tool, const Options& options) {
  const StepChoice choice(options.steps);
  const NumberPattern pattern("-o", options.output);
  require_input(options);
  if (is_zoo_stream(options))
    throw UsageError("--steps: a zoo stream holds one step (a file, or --format NAME, expected)");
  tool.claim({{options.input}, {}});
  with_input(options, [&](const auto& format, const std::string& path, const auto& told) {
    const std::size_t count = std::max<std::size_t>(
        tool.timed("steps", [&] { return format.inspect(path); }).times.size(), 1);
    const std::vector<Options> steps =
        options_of_steps(options, pattern, choice.among(count, input_name(options.input)));
    RunFiles files{{options.input}, {}};
    for (const Options& step : steps) add_output(files, step);
    tool.claim(std::move(files));
    tool.frames().begin("steps", steps.size());
    StepAdjacency known;
    std::set<std::string> notes;
    for (const Options& step : steps) {
      formats::Reading reading =
          tool.timed("read", [&] { return read_by(format, path, read_options(step), told); });
      forget_told(reading.notes, notes);
      finish(tool, step, std::move(reading), known);
      tool.facts()["steps"].push_back({{"step", *step.step}, {"file", step.output}});
      tool.note_frame(step.output);
    }
  });
}

void convert(Tool& tool, const Options& options) {
  if (options.list_formats) {
    std::cout << formats_table();
    return;
  }
  if (!options.steps.empty()) return with_options_named([&] { convert_steps(tool, options); });
  claim_files(tool, options);
  require_input(options);
  if (options.list) return with_options_named([&] { list_input(tool, options); });
  check_stdout(tool, options);
  formats::Reading reading =
      tool.timed("read", [&] { return with_options_named([&] { return read_input(options); }); });
  StepAdjacency adjacency;
  finish(tool, options, std::move(reading), adjacency);
}

}  // namespace
}  // namespace hiac::tools

int main(int argc, char** argv) {
  using namespace hiac::tools;
  Tool tool("hiac-convert", "Converts a finite-element file to a zoo mesh, or a zoo mesh to VTU.",
            kExamples);
  tool.app().set_version_flag("--version", fmt::format("hiac-convert {}, {}, {}", version_text(),
                                                       hiac::formats::format_library_versions(),
                                                       hiac::partitioner_version()));
  Options options;
  add_options(tool.app(), options);
  return tool.run(argc, argv, [&] { convert(tool, options); });
}
