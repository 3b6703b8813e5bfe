#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include "tests/support/meshes.hpp"

namespace hiac::view::test {

/// A specification's picture and camera, for the unit cube; what is drawn follows it.
inline const std::string kSmallView = R"([image]
width = 40
height = 30
[camera]
eye = [0.5, -3.0, 0.5]
look_at = [0.5, 0.5, 0.5]
up = [0, 0, 1]
fov = 30.0
)";

/// The unit cube in tetrahedra, with the fields f = x and g = 10 y + 5.
inline std::shared_ptr<const ZooMesh> mesh_of_f_and_g(std::size_t divisions) {
  ZooMesh mesh = hiac::test::structured(divisions, hiac::test::Cut::tetrahedra);
  hiac::test::add_node_field(mesh, "f", [](auto&& p) { return p[0]; });
  hiac::test::add_node_field(mesh, "g", [](auto&& p) { return 10 * p[1] + 5; });
  return std::make_shared<const ZooMesh>(std::move(mesh));
}

}  // namespace hiac::view::test
