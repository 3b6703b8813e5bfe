#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "hiac/session/session.hpp"

namespace hiac::tools {

/// Which part of the picture is wanted, and how many rays a pixel, as given on the command line.
struct PictureOptions {
  std::string crop, filter = "box", channels;
  std::optional<std::uint32_t> samples;
};

/// Adds --channels, --crop, --samples and --filter.
void add_picture_options(CLI::App& app, PictureOptions& options);

/// The names of the channels that --channels asks for. Throws UsageError.
std::vector<std::string> further_channels(const PictureOptions& options);

/// What they say of a picture. Throws UsageError when they do not fit it.
PictureRequest picture_request(const PictureOptions& options, ImageSize size);

}  // namespace hiac::tools
