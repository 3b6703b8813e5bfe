#include "tools/common/render/render_files.hpp"

#include <string>
#include <utility>

#include "tools/common/picture/picture_output.hpp"
#include "tools/common/render/movie.hpp"
#include "tools/common/render/picture_options.hpp"

namespace hiac::tools {

void claim_render_files(Tool& tool, const RenderOptions& options,
                        const std::vector<Shot>& pictures) {
  RunFiles files;
  const std::vector<std::string> channels = further_channels(options.picture);
  add_picture_files(files, options, nullptr, channels);
  if (!pictures.empty() && !is_movie(options.output)) {
    std::erase_if(files.outputs, [](const RunOutput& output) { return output.option == "-o"; });
    for (const Shot& shot : pictures) add_image(files.outputs, "-o", shot.path, channels);
  }
  for (const std::string& mesh : options.series.further) files.inputs.push_back(mesh);
  for (std::string& part : image_parts(options.under)) files.inputs.push_back(std::move(part));
  add_image(files.outputs, "--colorbar", options.color_bar);
  tool.claim(std::move(files));
}

}  // namespace hiac::tools
