#pragma once

#include <optional>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "hiac/annotate/annotation_facts.hpp"
#include "hiac/frame/crop.hpp"
#include "hiac/scene/annotation.hpp"
#include "hiac/scene/scene.hpp"
#include "hiac/session/session.hpp"

namespace hiac::python {

/// A picture, and what its file says and shows beside it.
struct DrawnPicture {
  Picture picture;
  Scene scene;  ///< of one frame
  Annotation annotation;
  AnnotationFacts facts;
  PixelRect part;
  bool background = true;
  std::vector<std::string> warnings;  ///< why something may not be seen
};

/// Draws the annotation that the picture's numbers have (annotation.formats = "all").
void annotate_numbers(DrawnPicture& drawn);

void bind_picture(pybind11::module_& module);

}  // namespace hiac::python
