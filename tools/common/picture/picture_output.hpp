#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hiac/image/image.hpp"
#include "hiac/scene/scene.hpp"
#include "tools/common/picture/picture_command.hpp"

namespace hiac::tools {

/// The file of a frame of a scene with a camera path: numbered where several are made, or where the
/// output has a place for the number.
std::string path_of_frame(const PictureCommand& command, std::uint32_t frame);

/// The texts in a picture's file that say what it was made of. `program`: that made it, by name;
/// `mesh_hash`: content_hash.
std::vector<std::pair<std::string, std::string>> picture_attributes(const std::string& program,
                                                                    const std::string& mesh_hash,
                                                                    const Scene& scene,
                                                                    const Annotation& annotation);

/// Writes a picture of a scene of one frame as the command has it, with what it was made of in the
/// file's attributes (picture_attributes); a stage "write".
void write_picture(Tool& tool, const PictureCommand& command, const std::string& program,
                   const std::string& path, const Image& image, const std::string& mesh_hash,
                   const Scene& scene, const Annotation& annotation);

}  // namespace hiac::tools
