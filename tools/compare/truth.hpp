#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "hiac/image/image.hpp"
#include "tools/common/picture/picture_command.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// Adds --truth, the command's input (empty: two images are compared), and what goes with it.
void add_truth_options(CLI::App& app, PictureCommand& command);

/// The picture that should be there, and how far it may be from the exact one.
struct Truth {
  Image image;                  ///< with the picture's colour channels
  std::optional<double> error;  ///< none: no bound is claimed
};

/// Renders the truth for a picture, which was read from `path`, in the picture's size.
///
/// The truth is composited over the specification's background unless the command says otherwise,
/// or the picture is one of integers whose alpha varies: those hold no background. An alpha that is
/// 1 everywhere says nothing of the medium; it is taken off the picture. Notes what was decided.
Truth render_truth(Tool& tool, PictureCommand command, Image& picture, const std::string& path);

}  // namespace hiac::tools
