#include "tools/common/render/mesh_series.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/geometry/box.hpp"
#include "hiac/session/field_range.hpp"
#include "hiac/session/starter/starter_field.hpp"
#include "tools/common/as_option.hpp"
#include "tools/common/foreign_mesh.hpp"
#include "tools/common/steps/number_pattern.hpp"
#include "tools/common/steps/step_choice.hpp"

namespace hiac::tools {
namespace {

bool is_pattern(const std::string& input) {
  std::error_code error;
  return !number_places(input).empty() && !std::filesystem::exists(input, error);
}

std::vector<std::string> reading_options(const PictureCommand& command) {
  if (command.block.empty()) return {};
  return {"--block=" + command.block};
}

std::vector<SeriesStep> steps_of(Tool& tool, const PictureCommand& command,
                                 const SeriesOptions& options) {
  const StepChoice choice(options.steps.empty() ? "all" : options.steps);
  std::vector<SeriesStep> steps;
  if (!options.further.empty()) {
    std::vector<std::string> paths{command.input};
    paths.insert(paths.end(), options.further.begin(), options.further.end());
    for (const std::size_t k : choice.among(paths.size(), "the list of meshes"))
      steps.push_back({k, paths[k], std::nullopt});
    return steps;
  }
  if (is_pattern(command.input)) {
    const NumberPattern pattern("MESH", command.input);
    for (const std::size_t number : choice.among(pattern.existing(), command.input))
      steps.push_back({number, pattern.path_of(number), std::nullopt});
    return steps;
  }
  if (is_stdout(command.input))
    throw UsageError("--steps: stdin holds one step (a file, or a pattern, expected)");
  const bool is_foreign = is_foreign_mesh(command.input);
  const std::size_t count =
      is_foreign ? step_count(tool, {command.input, command.conversion}, reading_options(command))
                 : 1;
  for (const std::size_t step : choice.among(count, command.input))
    steps.push_back(
        {step, command.input, is_foreign ? std::optional<std::size_t>(step) : std::nullopt});
  return steps;
}

}  // namespace

void add_series_options(CLI::App& app, SeriesOptions& options) {
  app.add_option("FURTHER", options.further,
                 "Further meshes: MESH and these are the time steps of a series");
  app.add_option("--steps", options.steps,
                 "Draw these time steps of MESH, a picture a step, with one range of values: of a "
                 "foreign file, of the files that a pattern as run-%04d.zoo names, or of several "
                 "files (numbered from 0), of which all are drawn without this option")
      ->type_name(kStepsType);
}

bool is_series(const SeriesOptions& options, const std::string& input) {
  return !options.steps.empty() || !options.further.empty() || is_pattern(input);
}

MeshSeries::MeshSeries(Tool& tool, const PictureCommand& command, const SeriesOptions& options)
    : tool_(tool), command_(command), steps_(steps_of(tool, command, options)) {}

std::string MeshSeries::name_of(std::size_t k) const {
  const SeriesStep& step = steps_[k];
  return step.step ? fmt::format("{}, step {}", step.path, *step.step) : step.path;
}

ZooFile MeshSeries::read(std::size_t k) {
  const bool is_silent = std::exchange(is_told_, true) && !tool_.common().verbose;
  return mesh_of_step(tool_, command_, steps_[k].path, steps_[k].step, is_silent);
}

// Does `work` on every mesh; a field that one of them does not have is told with the step's name.
template <typename Work>
void MeshSeries::with_each(const Work& work) {
  tool_.frames().begin("steps", size());
  for (std::size_t k = 0; k < size(); ++k) {
    const ZooFile file = read(k);
    as_option(name_of(k) + ": ", [&] { work(file.mesh); });
    tool_.frames().advance();
  }
}

ParsedScene MeshSeries::starter(PictureCommand& command) {
  const std::size_t last = size() - 1;
  const ZooFile file = read(last);
  const std::string field = as_option("--", [&] {
    return starter::choose_field(file.mesh, command.starter.field, name_of(last)).field.name;
  });
  starter::SeriesRange range(field);
  Box box = box_of_cells(file.mesh);
  with_each([&](const ZooMesh& mesh) {
    range.add(mesh);
    if (mesh.cell_count() > 0) box.include(box_of_cells(mesh));
  });
  command.starter.range = range.range();
  if (file.mesh.cell_count() > 0) command.starter.box = box;
  return starter_scene(tool_, command, file.mesh);
}

ParsedScene MeshSeries::scene(PictureCommand& command, std::optional<ParsedScene> parsed) {
  if (!parsed) parsed = starter(command);
  parsed->notes.clear();  // they have been told, or say nothing of a starter view
  FieldRanges ranges(*parsed);
  if (ranges.are_open()) with_each([&](const ZooMesh& mesh) { ranges.add(mesh); });
  parsed = with_names(command, [&] { return ranges.place(*std::move(parsed)); });
  for (const std::string& line : parsed->notes) tool_.note(line);
  return *std::move(parsed);
}

}  // namespace hiac::tools
