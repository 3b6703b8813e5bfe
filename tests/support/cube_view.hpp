#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace hiac::test {

/// A specification's text: the unit cube seen past one of its corners, coloured by the field "f",
/// whose values are in [0, 1], as is the field of its extinction.
inline std::string cube_view(std::uint32_t width, std::uint32_t height,
                             std::string_view extinction_field = "f") {
  return fmt::format(R"([image]
width = {}
height = {}
[camera]
eye = [2.3, 1.9, 1.4]
look_at = [0.5, 0.5, 0.5]
up = [0.0, 0.0, 1.0]
fov = 35.0
[volume.color]
field = "f"
points = [[0.0, 0.1, 0.2, 0.9], [1.0, 0.9, 0.1, 0.1]]
[volume.extinction]
field = "{}"
points = [[0.0, 0.1], [1.0, 3.0]]
)",
                     width, height, extinction_field);
}

/// The same with the extinction of the field "g", an isosurface of "f", and a background.
inline std::string cube_view_with_surface(std::uint32_t width, std::uint32_t height) {
  return cube_view(width, height, "g") + R"([[isosurface]]
field = "f"
value = 0.5
opacity = 0.25
[background]
color = [0.25, 0.5, 0.75]
)";
}

}  // namespace hiac::test
