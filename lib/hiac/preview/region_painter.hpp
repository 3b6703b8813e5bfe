#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hiac/frame/crop.hpp"
#include "hiac/preview/context.hpp"
#include "hiac/preview/gl_objects.hpp"
#include "hiac/preview/region_vertex.hpp"

namespace hiac::preview {

/// Draws triangles of homogeneous regions with a method's shaders.
///
/// A method is a text in GLSL that defines two functions; colours are linear:
///
///     vec4 at_vertex(float length, float tau_front, float tau_back,
///                    vec3 kappa_front, vec3 kappa_back)
///         // of a vertex: anything that the method wants to have interpolated on the screen
///     vec4 shade(float length, float tau_front, float tau_back,
///                vec3 kappa_front, vec3 kappa_back, vec4 at_vertex)
///         // of a pixel, from what is interpolated: colour premultiplied by alpha, and alpha
///
/// Interpolation is linear on the screen. Beside a narrow triangle's edge the rasteriser may ask
/// for values a little outside it: a method clamps what must not be negative.
class RegionPainter {
 public:
  /// The context has to outlive it. Throws DriverError when the driver refuses the shaders.
  RegionPainter(const Context& context, const std::string& method);

  /// Draws over the target that has begun (float_target.hpp) as that part. `fill` is called until
  /// it returns false; each time the triangles that it appends to the empty vector are drawn, in
  /// order. Returns how many triangles were drawn. Throws DriverError.
  std::uint64_t draw(const PixelRect& part, const RegionFill& fill);

 private:
  const Context& context_;
  ProgramName program_;
  Buffer buffer_;
  VertexArrayName layout_;
};

}  // namespace hiac::preview
