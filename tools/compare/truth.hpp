#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "hiac/image/image.hpp"
#include "hiac/scene/scene.hpp"
#include "hiac/session/session.hpp"
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

/// Renders the truth of a picture's mesh and view. The picture, which was read from `path`, loses
/// an alpha that is 1 everywhere: it says nothing of the medium.
///
/// The truth is composited over the specification's background unless the command says otherwise,
/// or the picture is one of integers whose alpha varies: those hold no background. Notes what was
/// decided.
class TruthRenderer {
 public:
  TruthRenderer(Tool& tool, PictureCommand command, Image& picture, const std::string& path);

  [[nodiscard]] const Camera& camera() const { return scene_.camera; }
  /// In the picture's size.
  Truth truth();
  /// What another camera sees, in another size, with n x n rays a pixel, without a word.
  Image picture_of(const Camera& camera, ImageSize size, std::uint32_t samples);

 private:
  Tool& tool_;
  PictureCommand command_;
  std::vector<std::string> channels_;  // the picture's
  Scene scene_;
  PictureRequest request_;
  bool is_silent_ = false;  // of findings about other views
  std::unique_ptr<Session> session_;
};

}  // namespace hiac::tools
