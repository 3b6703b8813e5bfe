#pragma once

#include <string>

#include "hiac/base/glow.hpp"
#include "hiac/preview/methods/method.hpp"

namespace hiac::preview {

/// The shaders of a method for vertices as triangle_buffer.hpp has them. Attributes: 0 the grown
/// corner; 1 to 3 the places of a triangle's corners; 4 to 6 their first values, 7 to 9 the others
/// (two and three flat, four and four in perspective); 10 to 12 the
/// rest of their places. What a triangle's first vertex has is used.
struct Shaders {
  std::string vertex, fragment;
};
Shaders shaders_of(Method method, Glow glow, bool perspective);

}  // namespace hiac::preview
