#pragma once

#include <string>

#include "formats/vtk/legacy/legacy_layout.hpp"

namespace hiac::formats::vtk {

/// Finds the names under which VTK's reader stores the arrays, and which arrays it replaces: of
/// several with one name it keeps the last. Notes say which names are changed or occur more than
/// once. Throws InputError(subject, ...) for a name of which VTK makes different ones.
void name_arrays(LegacyLayout& layout, const std::string& subject);

}  // namespace hiac::formats::vtk
