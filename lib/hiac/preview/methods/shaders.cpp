#include "hiac/preview/methods/shaders.hpp"

namespace hiac::preview {
namespace {

constexpr const char* kVertex = R"(
layout(location = 0) in vec2 grown;
layout(location = 1) in vec2 place_a;
layout(location = 2) in vec2 place_b;
layout(location = 3) in vec2 place_c;
layout(location = 4) in HEAD head_a;
layout(location = 5) in HEAD head_b;
layout(location = 6) in HEAD head_c;
layout(location = 7) in TAIL tail_a;
layout(location = 8) in TAIL tail_b;
layout(location = 9) in TAIL tail_c;
layout(location = 10) in vec2 fine_a;
layout(location = 11) in vec2 fine_b;
layout(location = 12) in vec2 fine_c;
uniform vec4 part;  // corner and size, pixels
flat out vec4 places_ab;
flat out vec4 fine_ab;
flat out vec4 places_c;
flat out vec3 least;
flat out HEAD from_a_head;
flat out HEAD from_b_head;
flat out HEAD from_c_head;
flat out TAIL from_a_tail;
flat out TAIL from_b_tail;
flat out TAIL from_c_tail;

// A pixel's centre on an edge belongs to the triangle that a step right and a much smaller one down
// leads into: there 0 is enough, else the edge function has to be positive.
float least_of(vec2 along) {
  return along.y < 0.0 || (along.y == 0.0 && along.x > 0.0) ? 0.0 : 1.2e-38;
}

void main() {
  gl_Position = vec4((grown - part.xy) / part.zw * 2.0 - 1.0, 0.0, 1.0);
  places_ab = vec4(place_a, place_b);
  fine_ab = vec4(fine_a, fine_b) * FINE;
  places_c = vec4(place_c, fine_c * FINE);
  least = vec3(least_of((place_c - place_b) + (fine_c - fine_b) * FINE),
               least_of((place_a - place_c) + (fine_a - fine_c) * FINE),
               least_of((place_b - place_a) + (fine_b - fine_a) * FINE));
  from_a_head = head_a - head_c;
  from_b_head = head_b - head_c;
  from_c_head = head_c;
  from_a_tail = tail_a - tail_c;
  from_b_tail = tail_b - tail_c;
  from_c_tail = tail_c;
}
)";

// Edge functions without contraction: the neighbour, which runs along an edge the other way, finds
// the same number with the other sign.
constexpr const char* kFragmentHead = R"(
flat in vec4 places_ab;
flat in vec4 fine_ab;
flat in vec4 places_c;
flat in vec3 least;
flat in HEAD from_a_head;
flat in HEAD from_b_head;
flat in HEAD from_c_head;
flat in TAIL from_a_tail;
flat in TAIL from_b_tail;
flat in TAIL from_c_tail;
uniform vec4 part;
uniform vec4 eye;  // the picture's centre, pixels; one over the pixels per unit at distance 1
out vec4 light;

// 1 - exp(-x), also of small x
float opacity(float x) {
  if (x > 0.5) return 1.0 - exp(-x);
  return x * (1.0 - x * (1.0 / 2.0 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 -
         x * (1.0 / 720.0 - x * (1.0 / 5040.0 - x * (1.0 / 40320.0))))))));
}

void main() {
  vec2 pixel = gl_FragCoord.xy + part.xy;
  // the first difference is exact
  precise vec2 a = (places_ab.xy - pixel) + fine_ab.xy;
  precise vec2 b = (places_ab.zw - pixel) + fine_ab.zw;
  precise vec2 c = (places_c.xy - pixel) + places_c.zw;
  precise vec3 area = vec3(b.x, c.x, a.x) * vec3(c.y, a.y, b.y) -
                      vec3(b.y, c.y, a.y) * vec3(c.x, a.x, b.x);
  if (area.x < least.x || area.y < least.y || area.z < least.z) discard;
  float one = 1.0 / (area.x + area.y + area.z);
  float in_a = area.x * one, in_b = area.y * one;
  HEAD head = from_c_head + in_a * from_a_head + in_b * from_b_head;
  TAIL tail = from_c_tail + in_a * from_a_tail + in_b * from_b_tail;
)";

constexpr const char* kInterpolated = R"(
  float alpha = head.x;
  vec3 color = tail;
)";

constexpr const char* kFlat = R"(
  float along = head.x, depth = along * head.y;
  vec3 color = tail;
)";

// Extinctions at the ends are (tau / t) / (1 / t).
constexpr const char* kPerspective = R"(
  vec2 slope = (pixel - eye.xy) * eye.z;
  float product = head.y * head.z;
  float along = head.x * sqrt(1.0 + dot(slope, slope)) / product;
  float depth = along * (0.5 * (head.w * head.z + tail.x * head.y) / product);
  vec3 color = tail.yzw * (2.0 / (head.y + head.z));
)";

constexpr const char* kExponential = R"(
  float alpha = opacity(min(depth, 1e30));
)";

}  // namespace

Shaders shaders_of(Method method, Glow glow, bool perspective) {
  const bool interpolated = method == Method::interpolated_opacity;
  const bool flat = interpolated || !perspective;
  const std::string head =
      std::string("#version 450 core\n#define FINE 9.5367431640625e-07  // kFine\n") +
      (flat ? "#define HEAD vec2\n#define TAIL vec3\n" : "#define HEAD vec4\n#define TAIL vec4\n");
  std::string fragment = head + kFragmentHead;
  if (interpolated)
    fragment += kInterpolated;
  else
    fragment += std::string(flat ? kFlat : kPerspective) + kExponential;
  if (glow == Glow::chromaticity)
    fragment += "  light = vec4(alpha * color, alpha);\n}\n";
  else if (interpolated)
    fragment += "  light = vec4(color, alpha);\n}\n";
  else
    fragment +=
        "  float ratio = depth > 1e-30 ? alpha / min(depth, 1e30) : 1.0;\n"
        "  light = vec4(along * ratio * color, alpha);\n}\n";
  return {head + kVertex, fragment};
}

}  // namespace hiac::preview
