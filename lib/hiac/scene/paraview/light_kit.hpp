#pragma once

#include <string>

#include "hiac/scene/paraview/state_document.hpp"

namespace hiac::paraview {

/// The tables [[light]] of a view's light kit, "" where the view has it switched off: a key light,
/// a fill light, two back lights and a headlight, with the directions, colours and intensities that
/// vtkLightKit gives them for the view's camera. Throws InputError for a kit that is malformed.
std::string light_kit_text(const Proxy& view);

}  // namespace hiac::paraview
