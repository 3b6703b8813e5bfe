#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "hiac/mesh/zoo_container.hpp"
#include "hiac/scene/specification.hpp"
#include "tools/common/picture/picture_command.hpp"

namespace hiac::tools {

/// Which time steps are drawn, as given on the command line.
struct SeriesOptions {
  std::string steps;                 ///< --steps; empty: not given
  std::vector<std::string> further;  ///< meshes behind the first one
};

/// Adds --steps and the meshes behind the first one.
void add_series_options(CLI::App& app, SeriesOptions& options);

/// Whether they, or a pattern in place of the mesh's name, ask for the steps of a series.
bool is_series(const SeriesOptions& options, const std::string& input);

/// One step of a series.
struct SeriesStep {
  std::size_t number;               ///< in the foreign file, in the file's name, or of the file
  std::string path;                 ///< of the file that holds it
  std::optional<std::size_t> step;  ///< of a foreign file that holds several
};

/// The meshes of a series: steps of a foreign file, files that a pattern names, or several files.
/// Every mesh is read when it is asked for, and none is kept.
class MeshSeries {
 public:
  /// Throws UsageError where the options do not fit the input, and whatever reading it throws.
  MeshSeries(Tool& tool, const PictureCommand& command, const SeriesOptions& options);

  [[nodiscard]] std::size_t size() const { return steps_.size(); }
  [[nodiscard]] const SeriesStep& operator[](std::size_t k) const { return steps_[k]; }
  /// How errors call a step: its file, with the step's number where the file holds several.
  [[nodiscard]] std::string name_of(std::size_t k) const;

  /// Reads step `k`. What is said of the conversion of a foreign file is said once.
  ZooFile read(std::size_t k);

  /// The one scene of the whole series: of the specification, with transfer functions over the
  /// ranges of all steps; or of a starter view, whose field and extinction are those of the last
  /// step, whose range is that of all steps, and whose camera sees all of them. Reads the steps for
  /// that where it has to.
  ParsedScene scene(PictureCommand& command, std::optional<ParsedScene> parsed);

 private:
  template <typename Work>
  void with_each(const Work& work);
  ParsedScene starter(PictureCommand& command);

  Tool& tool_;
  const PictureCommand& command_;
  std::vector<SeriesStep> steps_;
  bool is_told_ = false;
};

}  // namespace hiac::tools
