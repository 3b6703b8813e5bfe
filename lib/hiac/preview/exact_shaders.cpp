#include "hiac/preview/exact_shaders.hpp"

#include <fmt/format.h>

namespace hiac::preview {

std::string defines_of(const ExactVariant& variant) {
  return fmt::format(
      "#define PERSPECTIVE {}\n#define NEAR {}\n#define CLIPPED {}\n#define DOUBLE {}\n"
      "#define FIELDS {}\n#define RECORD {}\n#define SURFACE_FIELDS {}\n#define STORED {}\n"
      "#define FIELD_AT(f) (8 + (f) * (DOUBLE == 1 ? 3 : 2) - ((f) > 0 ? 1 : 0))\n"
      "#define SURFACE_AT(f) (FIELD_AT(FIELDS) + 4 * (f))\n"
      "#if STORED\n#define DATA(k) records[row + uint(k)]\n#else\n"
      "#define DATA(k) data[k]\n#endif\n",
      static_cast<int>(variant.perspective), static_cast<int>(variant.near),
      static_cast<int>(variant.clipped || variant.near), static_cast<int>(variant.fine),
      variant.fields, variant.record(), variant.surface_fields, static_cast<int>(variant.stored));
}

// Four vertices a cell. Both triangles, (0, 1, 2) and (0, 2, 3), take the first one's data; those
// of the others are not used. Attributes hold as much of the record as they can: llvmpipe fetches
// them several times as fast as it reads memory.
std::string exact_vertex_source(const ExactVariant& variant) {
  return "#version 450 core\n" + defines_of(variant) +
         fmt::format("#define ATTRIBUTES {}\n", variant.attributes()) + R"(
layout(location = 0) in vec2 corner;  // pixels from the part's corner
uniform vec2 scale;                   // two over the part's size, pixels
#if STORED
flat out uint row;
#else
layout(location = 1) in vec4 record[ATTRIBUTES];
#if ATTRIBUTES < RECORD
layout(std430, binding = 4) readonly buffer Records { vec4 records[]; };
#endif
flat out vec4 data[RECORD];
#endif

void main() {
#if STORED
  row = uint(gl_VertexID >> 2) * uint(RECORD);
#else
  for (int k = 0; k < ATTRIBUTES; ++k) data[k] = record[k];
#if ATTRIBUTES < RECORD
  int base = (gl_VertexID >> 2) * RECORD;
  for (int k = ATTRIBUTES; k < RECORD; ++k) data[k] = records[base + k];
#endif
#endif
  gl_Position = vec4(corner * scale - 1.0, 0.0, 1.0);
}
)";
}

// Pieces of at most half an optical depth: then no term of the series that is left out matters in
// single precision, and none of the brackets cancels (linear_piece_series.hpp has the derivation).
std::string exact_integral_source() {
  return R"(
const float kThin = 0.5;

struct Weights {
  float opacity;
  float front, back;
};

float series_rho(float d, float q) {
  return 1.0 / 3.0 + q * (1.0 / 30.0 + q * (1.0 / 840.0)) +
         d * (1.0 / 15.0 + q * (1.0 / 210.0 + q * (1.0 / 7560.0)) +
              d * (1.0 / 105.0 + q * (1.0 / 1890.0) +
                   d * (1.0 / 945.0 + q * (1.0 / 20790.0) + d * (1.0 / 10395.0))));
}

// Of a piece whose densities are b at the front and a at the back, (a + b) / 2 <= kThin.
Weights weights_of(float b, float a) {
  float s = 0.25 * (a + b), d = 0.25 * (a - b), q = s * s;
  float sinhc = 1.0 + q * (1.0 / 6.0 + q * (1.0 / 120.0 + q * (1.0 / 5040.0)));
  float even = s * sinhc;
  float h = 1.0 - (even - q * (0.5 + q * (1.0 / 24.0 + q * (1.0 / 720.0))));  // exp(-s)
  // Not as 1 less the transparency: the rounding of 1 would add up over the cells of a ray.
  float opacity = 2.0 * h * even;
  float rho = series_rho(d, q);
#if EMISSION
  return Weights(opacity, 0.5 * h * (sinhc + 0.5 * a * rho), 0.5 * h * (sinhc - 0.5 * b * rho));
#else
  float kappa = 1.0 / 3.0 + q * (1.0 / 30.0 + q * (1.0 / 840.0));
  float odd = q * kappa - d * rho;
  return Weights(opacity, h * (even + odd), h * (even - odd));
#endif
}
)";
}

}  // namespace hiac::preview
