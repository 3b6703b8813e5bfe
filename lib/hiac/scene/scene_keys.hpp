#pragma once

#include <span>

#include "hiac/scene/scene.hpp"
#include "hiac/scene/toml/spec_key.hpp"

namespace hiac {

/// The keys of each table of a specification, in the order in which they are read and written; the
/// camera's are in camera_keys.hpp, the transfer functions' in color_source.hpp and
/// extinction_source.hpp.
std::span<const SpecKey<ImageSize>> image_keys();
std::span<const SpecKey<Volume>> volume_keys();
std::span<const SpecKey<Isosurface>> isosurface_keys();
std::span<const SpecKey<Skin>> skin_keys();
std::span<const SpecKey<Edges>> edge_keys();
std::span<const SpecKey<Light>> light_keys();
std::span<const SpecKey<Background>> background_keys();
std::span<const SpecKey<RenderSettings>> render_keys();

/// The tables themselves.
std::span<const SpecKey<Scene>> scene_keys();

}  // namespace hiac
