#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hiac/scene/colormaps/colormap_preset.hpp"

namespace hiac {

/// The colour map of this name among those that need no file, over the scalars 0 to 1: matplotlib's
/// tables, and ParaView's maps of a few nodes. Case, blanks, hyphens and underscores do not matter.
/// Its numbers are display (sRGB) values.
std::optional<ColormapPreset> built_in_colormap(std::string_view name);

/// The names of all of them, as documentation writes them.
std::vector<std::string> built_in_colormap_names();

}  // namespace hiac
