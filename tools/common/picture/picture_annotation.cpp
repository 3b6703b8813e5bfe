#include "tools/common/picture/picture_annotation.hpp"

#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/scene/camera_path.hpp"

namespace hiac::tools {

PictureAnnotation::PictureAnnotation(Tool& tool, const PictureCommand& command,
                                     const ParsedScene& view, const ZooMesh& mesh,
                                     std::span<const std::uint32_t> frames, bool has_integers)
    : opaque_(!command.no_background), annotation_(view.annotation) {
  draws_ = annotation_.draws() && (annotation_.in_float_formats || has_integers);
  if (!draws_) {
    if (annotation_.draws())
      tool.note(
          "annotation: not drawn, because the format stores floating-point numbers "
          "(annotation.formats = \"all\" draws it)");
    return;
  }
  std::set<std::string> doubts;
  std::vector<std::string> names;
  with_names(command, [&] {
    facts_ = annotation_facts(mesh, view.scene.volume);
    for (const std::uint32_t frame : frames) {
      const Annotator annotator(annotation_, scene_of_frame(view.scene, frame), facts_);
      for (std::string& line : annotator.doubts()) doubts.insert(std::move(line));
      names.clear();
      for (const AnnotationPart& part : annotator.parts()) names.push_back(part.name);
    }
  });
  for (const std::string& line : doubts) tool.warn(line);
  tool.note(fmt::format("annotation: {} drawn on the picture", fmt::join(names, ", ")));
  tool.facts()["annotation"] = names;
}

void PictureAnnotation::draw(Image& image, const Scene& scene,
                             const std::optional<PixelRect>& part) const {
  if (draws_)
    Annotator(annotation_, scene, facts_)
        .draw(image, part.value_or(whole_picture(scene.image)), opaque_);
}

}  // namespace hiac::tools
