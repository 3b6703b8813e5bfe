#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <CLI/CLI.hpp>

#include "hiac/base/progress.hpp"
#include "hiac/render/supersampling.hpp"

namespace hiac::tools {

/// Which part of the picture is wanted, and how many rays a pixel, as given on the command line.
struct PictureOptions {
  std::string crop, filter = "box";
  std::optional<std::uint32_t> samples;
};

/// Adds --crop, --samples and --filter.
void add_picture_options(CLI::App& app, PictureOptions& options);

/// X,Y, as --pixel has it: column and row of a pixel. Throws UsageError when it is something else.
std::array<std::uint32_t, 2> parse_pixel(const std::string& text);

/// What they say of a picture.
struct PictureChoice {
  PixelRect part;
  std::optional<Supersampling> sampling;
};

/// Throws UsageError when they do not fit the picture.
PictureChoice picture_choice(const PictureOptions& options, ImageSize size);

RenderResult render_choice(const ZooMesh& mesh, const VisibilityOrder& order, const Scene& scene,
                           const PictureChoice& choice, std::span<const Channel> channels,
                           bool with_background, Progress* progress);

}  // namespace hiac::tools
