#pragma once

#include <cstddef>
#include <string>

#include "hiac/preview/drawn_fields.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::preview {

/// What the shaders of the method `exact` are compiled for: what their inner loop must not ask.
struct ExactVariant {
  bool perspective = false;
  bool near = false;     ///< some nodes lie beside or behind the eye (perspective)
  bool clipped = false;  ///< a clipping slab
  bool fine = false;     ///< double precision along rays
  std::size_t fields = 1;
  std::size_t surfaces = 0;  ///< isosurfaces; they need `fine`, which decides where they begin

  /// A cell's record is a row of vectors of four floats. Where a field begins in it: its function
  /// of the place, what that is more in double precision, and its range (the first's is elsewhere).
  [[nodiscard]] std::size_t field_at(std::size_t field) const {
    return 10 + field * (fine ? 3U : 2U) - (field > 0 ? 1U : 0U);
  }
  /// Behind the fields: for every face and surface on which side the face is, then the surfaces'
  /// normals.
  [[nodiscard]] std::size_t record() const {
    return field_at(fields) + (surfaces > 0 ? 1 + surfaces : 0);
  }

  bool operator==(const ExactVariant&) const = default;
};

/// The shaders' sources in GLSL 4.50. The compute shader prepares a cell's record, the vertex
/// shader hands it on for the triangles of the cell's outline, and the fragment shader meets the
/// ray with the cell and integrates.
std::string exact_setup_source(const ExactVariant& variant, const DrawnScene& scene);
std::string exact_vertex_source(const ExactVariant& variant);
std::string exact_fragment_source(const ExactVariant& variant, const DrawnScene& scene);

/// The most isosurfaces that they draw.
inline constexpr std::size_t kMostSurfaces = 8;

/// Parts of these.
std::string defines_of(const ExactVariant& variant);
std::string exact_outline_source();
std::string exact_integral_source();
std::string surface_setup_source(const ExactVariant& variant, const DrawnScene& scene);
std::string surface_fragment_source(const ExactVariant& variant, const DrawnScene& scene);
std::string transfer_source(const ExactVariant& variant, const DrawnScene& scene);

}  // namespace hiac::preview
