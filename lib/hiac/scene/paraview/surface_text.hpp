#pragma once

#include <string>
#include <vector>

#include "hiac/scene/paraview/state_document.hpp"

namespace hiac::paraview {

/// The tables [[isosurface]] of the representation of a Contour filter, one a value. What differs
/// is appended to `omitted`.
std::string isosurface_text(const StateDocument& state, const Proxy& shown,
                            std::vector<std::string>& omitted);

/// The table [skin], and [edges] where the representation shows them.
std::string skin_text(const StateDocument& state, const Proxy& shown,
                      std::vector<std::string>& notes, std::vector<std::string>& omitted);

}  // namespace hiac::paraview
