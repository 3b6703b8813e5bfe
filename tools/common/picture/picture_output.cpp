#include "tools/common/picture/picture_output.hpp"

#include "hiac/image/image_io.hpp"
#include "hiac/scene/specification.hpp"
#include "tools/common/picture/frames.hpp"
#include "tools/common/version.hpp"

namespace hiac::tools {

std::string path_of_frame(const PictureCommand& command, std::uint32_t frame) {
  const bool numbered = command.all_frames || has_frame_number(command.output);
  return numbered ? frame_path(command.output, frame) : command.output;
}

std::vector<std::pair<std::string, std::string>> picture_attributes(const std::string& program,
                                                                    const std::string& mesh_hash,
                                                                    const Scene& scene,
                                                                    const Annotation& annotation) {
  return {{"Software", program + " " + version_text()},
          {"hiac:mesh", mesh_hash},
          {"hiac:specification", to_toml(scene, annotation)}};
}

void write_picture(Tool& tool, const PictureCommand& command, const std::string& program,
                   const std::string& path, const Image& image, const std::string& mesh_hash,
                   const Scene& scene, const Annotation& annotation) {
  tool.timed("write", [&] {
    write_image(picture_path(path), image,
                {.linear = command.linear,
                 .background_included = !command.no_background,
                 .attributes = picture_attributes(program, mesh_hash, scene, annotation),
                 .depth = command.depth,
                 .format = command.format});
  });
}

}  // namespace hiac::tools
