#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

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
  std::size_t surface_fields = 0;  ///< fields with isosurfaces, which need `fine`: see on_side
  /// Fragments read the cell's record from memory: it is too long for a driver to hand on.
  bool stored = false;

  /// A cell's record is a row of vectors of four floats. Where a field begins in it: its function
  /// of the place, what that is more in double precision, and its range (the first's is elsewhere).
  [[nodiscard]] std::size_t field_at(std::size_t field) const {
    return 8 + field * (fine ? 3U : 2U) - (field > 0 ? 1U : 0U);
  }
  /// Behind the fields, four vectors for each field with isosurfaces: their normal, what that is
  /// more in double precision, and for every
  /// face how many of them it is not below, and how many it reaches above.
  [[nodiscard]] std::size_t record() const { return field_at(fields) + 4 * surface_fields; }
  /// How many of the record's vectors are attributes of vertices. Every driver has at least 16
  /// attributes, one of which is the outline's corner.
  [[nodiscard]] std::size_t attributes() const { return std::min<std::size_t>(record(), 15); }

  bool operator==(const ExactVariant&) const = default;
};

/// The shaders' sources in GLSL 4.50. The compute shader prepares a cell's record, the vertex
/// shader hands it on for the triangles of the cell's outline, and the fragment shader meets the
/// ray with the cell and integrates.
std::string exact_setup_source(const ExactVariant& variant, const DrawnScene& scene);
std::string exact_vertex_source(const ExactVariant& variant);
std::string exact_fragment_source(const ExactVariant& variant, const DrawnScene& scene);

/// What transfer functions of many intervals are looked up in: floats for buffer textures of
/// GL_RGBA32F, of the texture units 0 and 1; empty where a function needs none.
std::vector<std::vector<float>> transfer_texels(const DrawnScene& scene);

/// An isosurface in the buffer that the shaders read, field by field in the order of
/// DrawnScene::surface_fields.
struct DeviceSurface {
  double value;                ///< scaled as its field
  std::uint32_t place;         ///< in the scene
  std::uint32_t padding;       ///< what follows is aligned to 16 bytes
  std::array<float, 4> color;  ///< and the logarithm of the transparency
  std::array<float, 4> phong;  ///< ambient, diffuse, specular, shininess
};
std::vector<DeviceSurface> device_surfaces(const DrawnScene& scene);

/// Four bits a field of surfaces tell at which of a cell's faces a surface is closed: the numbers
/// of 32 bits that a cell has of these.
std::size_t closed_words(const DrawnScene& scene);

/// Parts of these.
std::string defines_of(const ExactVariant& variant);
std::string exact_outline_source();
std::string exact_integral_source();
std::string surface_setup_source(const ExactVariant& variant, const DrawnScene& scene);
std::string surface_fragment_source(const ExactVariant& variant, const DrawnScene& scene);
std::string transfer_source(const ExactVariant& variant, const DrawnScene& scene);

}  // namespace hiac::preview
