#pragma once

namespace hiac::preview {

/// GLSL that several shaders share: the lesser and the greater of two numbers, the second one where
/// one is NaN. GLSL's min and max say nothing of NaN either, but Mesa's llvmpipe takes two
/// instructions more for them to be the other number.
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
