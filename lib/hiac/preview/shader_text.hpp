#pragma once

namespace hiac::preview {

/// GLSL that several shaders share: the lesser and the greater of two numbers, and a number limited
/// to a range. Where one of two is NaN, the result is the second one. For GLSL's own min and max
/// Mesa's llvmpipe takes two instructions more, so that the result is never NaN where one is a
/// number.
inline constexpr const char* kExtremes = R"(
float lesser(float a, float b) {
  precise float least = a < b ? a : b;
  return least;
}
float greater(float a, float b) {
  precise float most = a > b ? a : b;
  return most;
}
float between(float x, float low, float high) { return lesser(greater(x, low), high); }
)";

}  // namespace hiac::preview
