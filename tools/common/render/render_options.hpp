#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "tools/common/picture/picture_command.hpp"
#include "tools/common/render/mesh_series.hpp"
#include "tools/common/render/picture_options.hpp"
#include "tools/common/render/render_command.hpp"

namespace hiac::tools {

/// What the command that makes pictures is told.
struct RenderOptions : PictureCommand {
  std::string under, color_bar, pixel, engine, method;
  double color_bar_length = 0;  // 0: a round number near a tenth of the diagonal
  PictureOptions picture;
  SeriesOptions series;
  std::optional<double> rate;  // pictures per second of a film
  bool has_steps = false;      // pictures are of the steps of a series
  const RenderRole* role = nullptr;

  [[nodiscard]] bool makes_several() const { return all_frames || has_steps; }
  /// What the facts call them.
  [[nodiscard]] std::string kind_of_shots() const {
    return has_steps && !all_frames ? "steps" : "frames";
  }
};

/// Adds its options.
void add_render_options(CLI::App& app, RenderOptions& options);

}  // namespace hiac::tools
