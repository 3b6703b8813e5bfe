#include "hiac/preview/methods/shaders.hpp"

#include "hiac/preview/methods/triangle_buffer.hpp"

namespace hiac::preview {
namespace {

constexpr const char* kVertex = R"(
layout(location = 0) in vec2 corner;
layout(location = 1) in vec4 record[RECORD];
uniform vec4 part;  // corner and size, pixels
flat out vec4 data[RECORD];

void main() {
  gl_Position = vec4((corner - part.xy) / part.zw * 2.0 - 1.0, 0.0, 1.0);
  data = record;
}
)";

// Edge functions without contraction: the neighbour, which runs along an edge the other way, finds
// the same number with the other sign.
constexpr const char* kFragmentHead = R"(
flat in vec4 data[RECORD];
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
  precise vec2 a = (data[0].xy - pixel) + data[1].xy;
  precise vec2 b = (data[0].zw - pixel) + data[1].zw;
  precise vec2 c = (data[2].xy - pixel) + data[2].zw;
  precise vec3 area = vec3(b.x, c.x, a.x) * vec3(c.y, a.y, b.y) -
                      vec3(b.y, c.y, a.y) * vec3(c.x, a.x, b.x);
  if (any(lessThan(area, LEAST))) discard;
  vec3 share = area * (1.0 / (area.x + area.y + area.z));
  vec3 heights = share * STEEP;
  float height = min(min(heights.x, heights.y), heights.z + OPEN);
  HEAD head = C_HEAD + share.x * A_HEAD + share.y * B_HEAD + height * PEAK_HEAD;
  TAIL tail = C_TAIL + share.x * A_TAIL + share.y * B_TAIL + height * PEAK_TAIL;
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

// Numbers of the record that follow one another, as a float or vector in GLSL.
std::string slice(std::size_t first, std::size_t count) {
  const auto number = [](std::size_t k) {
    return "data[" + std::to_string(k / 4) + "]." + "xyzw"[k % 4];
  };
  if (count == 1) return number(first);
  std::string text = "vec" + std::to_string(count) + "(" + number(first);
  for (std::size_t k = 1; k < count; ++k) text += ", " + number(first + k);
  return text + ")";
}

std::string defines_of(std::size_t values) {
  const std::size_t head = values == kFlatValues ? 2 : 4, tail = values - head;
  std::string text = "#define RECORD " + std::to_string(record_attributes(values)) +
                     "\n#define HEAD vec" + std::to_string(head) + "\n#define TAIL vec" +
                     std::to_string(tail) + "\n#define LEAST " + slice(kLeast, 3) +
                     "\n#define OPEN " + slice(kOpen, 1) + "\n#define STEEP " + slice(kSteep, 3) +
                     "\n";
  std::size_t at = kFirstValue;
  for (const char* name : {"A", "B", "C", "PEAK"}) {
    text += std::string("#define ") + name + "_HEAD " + slice(at, head) + "\n#define " + name +
            "_TAIL " + slice(at + head, tail) + "\n";
    at += values;
  }
  return text;
}

}  // namespace

std::size_t record_attributes(std::size_t values) { return (record_floats(values) + 3) / 4; }

Shaders shaders_of(Method method, Glow glow, bool perspective) {
  const bool interpolated = method == Method::interpolated_opacity;
  const bool flat = interpolated || !perspective;
  const std::string head =
      "#version 450 core\n" + defines_of(flat ? kFlatValues : kPerspectiveValues);
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
