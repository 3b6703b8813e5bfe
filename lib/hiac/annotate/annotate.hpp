#pragma once

#include <string>
#include <vector>

#include "hiac/annotate/annotation_facts.hpp"
#include "hiac/annotate/part_layout.hpp"
#include "hiac/frame/crop.hpp"
#include "hiac/image/image.hpp"
#include "hiac/scene/annotation.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// An annotation of the pictures of one scene, made ready: all that can be refused is.
class Annotator {
 public:
  /// Of a scene of one frame. Throws InputError "key `annotation...`: ..." for what cannot be
  /// drawn: a part that does not fit the picture, a time that nobody knows.
  Annotator(const Annotation& annotation, const Scene& scene, const AnnotationFacts& facts);

  /// The parts' keys and where they are in the whole picture.
  [[nodiscard]] const std::vector<AnnotationPart>& parts() const { return parts_; }
  [[nodiscard]] const std::vector<PixelBox>& boxes() const { return boxes_; }

  /// What a reader of the picture may not like, one line each: parts that overlap, small letters.
  [[nodiscard]] std::vector<std::string> doubts() const;

  /// The colours of a part, which follow the scene's background below it.
  [[nodiscard]] Ink ink(std::size_t part) const;

  /// Draws on a picture, or on that part of it which `picture` is. `opaque`: the background is a
  /// part of the picture, whose A tells nothing then. Channels other than R G B (Y) and A, and
  /// pixels without ink, stay as they are to the last bit.
  void draw(Image& picture, const PixelRect& part, bool opaque) const;

 private:
  Annotation annotation_;
  ImageSize size_;
  Background background_;
  int em_;
  std::vector<AnnotationPart> parts_;
  std::vector<PixelBox> boxes_;
};

}  // namespace hiac
