#pragma once

#include <cstddef>
#include <string>

#include "hiac/base/transfer_function.hpp"
#include "hiac/preview/methods/method.hpp"
#include "hiac/preview/methods/triangle_buffer.hpp"

namespace hiac::preview {

/// The shaders of a method for triangles as triangle_buffer.hpp has them. Attributes: 0 the corner
/// for the rasteriser; from 1 on the triangle's record, four floats each, of which those of a
/// triangle's first vertex are used.
struct Shaders {
  std::string vertex, fragment;
};
Shaders shaders_of(Method method, Glow glow, RecordShape shape);

/// Attributes that a record takes.
std::size_t record_attributes(RecordShape shape);

}  // namespace hiac::preview
