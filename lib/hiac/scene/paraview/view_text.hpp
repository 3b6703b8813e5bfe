#pragma once

#include <string>

#include "hiac/scene/paraview/state_document.hpp"

namespace hiac::paraview {

/// A display colour of a property, 0 to 1 each, as linear RGB in TOML.
std::string linear_color(const Proxy& proxy, const char* property);

/// The table [camera] of a view: ParaView's view angle is vertical, its parallel scale half the
/// height. Throws InputError for a camera that is malformed.
std::string camera_text(const Proxy& view);

/// The table [image] of a view's size.
std::string image_text(const Proxy& view);

/// The table [background] of a view, which the palette's colours are for where the view says so.
/// What has no equal (textures) is appended to `omitted`.
std::string background_text(const StateDocument& state, const Proxy& view,
                            std::vector<std::string>& omitted);

}  // namespace hiac::paraview
