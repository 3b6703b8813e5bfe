#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "hiac/annotate/annotate.hpp"
#include "hiac/scene/specification.hpp"
#include "tools/common/picture/picture_command.hpp"

namespace hiac::tools {

/// The annotation of the pictures that a command makes: none where the specification has none, or
/// where the format stores floating-point numbers and `annotation.formats` does not ask for it.
class PictureAnnotation {
 public:
  /// Tries it on the scene's frames, notes what will be drawn, and warns of what may not be liked.
  /// `has_integers`: the pictures' format stores whole numbers.
  /// Throws InputError for what cannot be drawn.
  PictureAnnotation(Tool& tool, const PictureCommand& command, const ParsedScene& view,
                    const ZooMesh& mesh, std::span<const std::uint32_t> frames, bool has_integers);

  /// Draws on a picture, or on the part of it that `image` is, of a scene of one frame.
  void draw(Image& image, const Scene& scene, const std::optional<PixelRect>& part) const;

  /// What the specification says, for the picture's file.
  [[nodiscard]] const Annotation& wanted() const { return annotation_; }

 private:
  bool draws_, opaque_;
  Annotation annotation_;
  AnnotationFacts facts_;
};

}  // namespace hiac::tools
