#pragma once

#include "hiac/annotate/annotation_part.hpp"

namespace hiac {

/// A line of text, shortened with an ellipsis if it would be wider than `most` pixels.
AnnotationPart caption(const std::string& name, AnnotationPlace place, const std::string& line,
                       Lettering lettering, int most);

}  // namespace hiac
