#pragma once

#include <array>
#include <string>

#include "hiac/scene/scene.hpp"

namespace hiac {

/// The text of a specification to start from: every key with a comment, and every section that is
/// off as a comment. The colour is the preset over the range instead of the points of
/// scene.volume.color, which has none; a range of one value shows the preset's middle.
std::string starter_text(const Scene& scene, const std::string& preset,
                         const std::array<double, 2>& range);

}  // namespace hiac
