#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// Reasons why a picture shows nothing, or nothing of a part, that are known before it is drawn:
/// no extinction and no surface, extinction that is zero for all values of its field, points of a
/// transfer function that its field's values do not meet, isosurfaces of values that the field does
/// not have. One line each, with what to change. The fields exist.
std::vector<std::string> invisible_parts(const ZooMesh& mesh, const Scene& scene);

/// What is known of a picture that has been drawn.
struct DrawnFacts {
  std::uint64_t covered_pixels;
  double largest_optical_depth;
  bool is_part;  ///< only a part of the picture was drawn
};

/// The reason why a drawn picture of a scene of one frame shows nothing: a camera that looks away,
/// a clipping slab that misses the mesh, a mesh smaller than a pixel, a medium too thin to change
/// any 8-bit value. One line with what to change; none for a picture in which something is seen.
std::optional<std::string> reason_of_empty(const ZooMesh& mesh, const Scene& scene,
                                           const DrawnFacts& drawn);

}  // namespace hiac
