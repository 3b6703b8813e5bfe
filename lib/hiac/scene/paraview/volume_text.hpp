#pragma once

#include <string>
#include <vector>

#include "hiac/scene/paraview/color_function.hpp"
#include "hiac/scene/paraview/state_document.hpp"

namespace hiac::paraview {

/// The tables [volume.color] and [volume.extinction] of a representation as volume. Appends a line
/// to `notes` for the law of the extinction and one for the colours. Throws InputError for one that
/// is malformed or has no equal.
std::string volume_text(const StateDocument& state, const Proxy& shown,
                        std::vector<std::string>& notes);

/// The keys of a colour table, without its head, of a representation that a colour function
/// colours.
std::string color_text(const StateDocument& state, const Proxy& shown, ColorSteps steps,
                       std::vector<std::string>& notes);

/// An array of a representation's property as a field of the mesh, NAME@node or NAME@cell. Throws
/// InputError for one that belongs to neither.
std::string field_of(const Proxy& proxy, const char* property);

}  // namespace hiac::paraview
