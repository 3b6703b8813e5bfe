#include "hiac/preview/methods/shaders.hpp"

#include "hiac/preview/shader_text.hpp"

namespace hiac::preview {
namespace {

constexpr const char* kVertex = R"(
layout(location = 0) in vec2 corner;
layout(location = 1) in vec4 record[RECORD];
uniform vec2 scale;  // two over the part's size, pixels
flat out vec4 data[RECORD];

void main() {
  gl_Position = vec4(corner * scale - 1.0, 0.0, 1.0);
  data = record;
}
)";

// Edge functions without contraction: the neighbour, which runs along an edge the other way, finds
// the same number with the other sign.
constexpr const char* kFragmentHead = R"(
flat in vec4 data[RECORD];
uniform vec3 eye;  // the picture's centre, pixels; one over the pixels per unit at distance 1
out vec4 light;

// 1 - exp(-x) to single precision, also of small x: x is n ln 2 + r with r at most ln 2 / 2, and
// the polynomial, through Chebyshev's points, is 1 - exp(-r) to a relative error of 2e-8.
float opacity(float x) {
  x = lesser(x, 87.0);
  float n = floor(x * 1.44269504 + 0.5);
  float r = x - n * 0.693147181;
  float power = intBitsToFloat((127 - int(n)) << 23);
  float square = r * r;  // terms in pairs wait for each other less than one after another
  float rest = r * ((1.0 - 0.5 * r) +
                    square * ((0.166665052 - 0.0416664649 * r) +
                              square * (0.00836915567 - 0.00139336500 * r)));
  return (1.0 - power) + power * rest;
}

void main() {
  vec2 pixel = gl_FragCoord.xy;
  // the first difference is exact
  precise vec2 a = (data[0].xy - pixel) + data[1].xy;
  precise vec2 b = (data[0].zw - pixel) + data[1].zw;
  precise vec2 c = (data[2].xy - pixel) + data[2].zw;
  precise vec3 area = vec3(b.x, c.x, a.x) * vec3(c.y, a.y, b.y) -
                      vec3(b.y, c.y, a.y) * vec3(c.x, a.x, b.x);
  bool outside = any(lessThan(area, LEAST));
  float one = 1.0 / (area.x + area.y + area.z);
  vec3 heights = (area + 1e-20) * STEEP;
  float height = lesser(lesser(heights.x, heights.y), heights.z) * one;
)";

constexpr const char* kValues = R"(
  HEAD head = C_HEAD + one * (area.x * A_HEAD + area.y * B_HEAD) + height * PEAK_HEAD;
  TAIL tail = C_TAIL + one * (area.x * A_TAIL + area.y * B_TAIL) + height * PEAK_TAIL;
)";

constexpr const char* kInterpolated = R"(
  float alpha = head.x;
  vec3 color = tail;
)";

constexpr const char* kFlatValues = R"(
  float along = head.x, depth = along * head.y;
  vec3 color = tail;
)";

// Extinctions at the ends are (tau / t) / (1 / t).
constexpr const char* kPerspectiveValues = R"(
  vec2 slope = (pixel - eye.xy) * eye.z;
  float product = head.y * head.z;
  float along = head.x * sqrt(1.0 + dot(slope, slope)) / product;
  float depth = along * (0.5 * (head.w * head.z + tail.x * head.y) / product);
  vec3 color = tail.yzw * (2.0 / (head.y + head.z));
)";

// The slab's part of the ray's way through the tetrahedron. The field is linear there, and so are
// extinction and colour in the slab: their means at its ends are what they are at the mean field.
// Slabs that follow one another have the same end, so that nothing is lost or counted twice.
constexpr const char* kOfChord = R"(
  float one_end = C_HEAD + one * (area.x * A_HEAD + area.y * B_HEAD);
  float other_end = one_end + height * PEAK_HEAD;
  vec2 ends = (RANGE - one_end) * RATE;
  float whole = height * LENGTH;
  float along = abs(between(ends.y, 0.0, whole) - between(ends.x, 0.0, whole));
  float twice = between(one_end, RANGE.x, RANGE.y) + between(other_end, RANGE.x, RANGE.y);
  float depth = along * max(EXTINCTION.x + EXTINCTION.y * twice, 0.0);
  vec3 color = COLOR + COLOR_SLOPE * twice;
)";

constexpr const char* kExponential = R"(
  float alpha = opacity(depth);
)";

// What lies outside is drawn as nothing, over which nothing changes: with a discard llvmpipe blends
// by masks, also where all of a block's pixels are inside.
constexpr const char* kEnd = R"(
  light = outside ? vec4(0.0) : inside;
}
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

std::string defines_of(RecordShape shape) {
  std::string text =
      "#version 450 core\n#define RECORD " + std::to_string(record_attributes(shape)) + "\n";
  std::size_t at = kLeast;
  const auto define = [&](const std::string& name, std::size_t count) {
    text += "#define " + name + " " + slice(at, count) + "\n";
    at += count;
  };
  define("LEAST", 3);
  define("STEEP", 3);
  // values as two vectors, or one number
  const std::size_t head = shape == kPerspective ? 4 : shape == kFlat ? 2 : 1;
  const std::size_t tail = shape.values - head;
  for (const std::string name : {"A", "B", "C", "PEAK"}) {
    define(name + "_HEAD", head);
    if (tail > 0) define(name + "_TAIL", tail);
  }
  if (tail > 0)
    return text + "#define HEAD vec" + std::to_string(head) + "\n#define TAIL vec" +
           std::to_string(tail) + "\n";
  define("LENGTH", 1);
  define("RATE", 1);
  define("RANGE", 2);
  define("EXTINCTION", 2);
  define("COLOR", 3);
  define("COLOR_SLOPE", 3);
  return text;
}

}  // namespace

std::size_t record_attributes(RecordShape shape) { return (shape.floats() + 3) / 4; }

Shaders shaders_of(Method method, Glow glow, RecordShape shape) {
  const bool interpolated = method == Method::interpolated_opacity;
  const std::string head = defines_of(shape);
  std::string fragment = head + kExtremes + kFragmentHead;
  if (shape == kChord)
    fragment += kOfChord;
  else
    fragment += std::string(kValues) + (interpolated            ? kInterpolated
                                        : shape == kPerspective ? kPerspectiveValues
                                                                : kFlatValues);
  if (!interpolated) fragment += kExponential;
  if (glow == Glow::chromaticity)
    fragment += "  vec4 inside = vec4(alpha * color, alpha);\n";
  else if (interpolated)
    fragment += "  vec4 inside = vec4(color, alpha);\n";
  else
    fragment +=
        "  float ratio = depth > 1e-30 ? alpha / min(depth, 1e30) : 1.0;\n"
        "  vec4 inside = vec4(along * ratio * color, alpha);\n";
  fragment += kEnd;
  return {head + kVertex, fragment};
}

}  // namespace hiac::preview
