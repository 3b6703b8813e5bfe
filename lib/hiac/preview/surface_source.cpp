#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "hiac/preview/exact_shaders.hpp"

namespace hiac::preview {
namespace {

std::string number(double v) { return fmt::format("{:.9e}", std::clamp(v, -1e30, 1e30)); }

std::string vec3(const std::array<double, 3>& v) {
  return fmt::format("vec3({}, {}, {})", number(v[0]), number(v[1]), number(v[2]));
}

// A surface's value as shaders see its field.
std::string value_text(const DrawnScene& scene, std::size_t s) {
  const DrawnField& field = scene.fields[scene.surfaces[s]];
  return fmt::format("{:.17e}lf", field.scaled(scene.isosurfaces.surfaces[s].value));
}

constexpr const char* kSetup = R"(
layout(std430, binding = 5) readonly buffer Closed { uint closed[]; };

// What is known beforehand of the sides of a cell's faces, as Isosurfaces (frame) has it, so that
// both cells at a face say the same of it: 1 not below the surface, 2 below it, 0 it depends. And
// the surfaces' normals in camera coordinates.
void set_surfaces(uint i, uint base, int slots[4]) {
  vec4 sides = vec4(0.0);
  dvec3 e1 = camera[1] - camera[0], e2 = camera[2] - camera[0], e3 = camera[3] - camera[0];
  dvec3 n1 = cross(e2, e3), n2 = cross(e3, e1), n3 = cross(e1, e2);
  for (int s = 0; s < SURFACES; ++s) {
    double v[4];
    for (int k = 0; k < 4; ++k) v[k] = value_of(kSurfaceField[s], i, k) - kSurfaceValue[s];
    int both = 0;
    for (int k = 0; k < 4; ++k) {
      ivec3 f = kFace[k];
      double least = min(min(v[f.x], v[f.y]), v[f.z]), most = max(max(v[f.x], v[f.y]), v[f.z]);
      int side = least >= 0.0lf ? 1 : (most > 0.0lf ? 0 : 2);
      // a face on which the surface lies whole, touched from below on both sides
      if ((closed[i] & (1u << (4u * uint(s) + entry[k]))) != 0u) side = 2;
      both += side << (2 * slots[k]);
    }
    sides[s / 3] += float(both << (8 * (s % 3)));
    dvec3 g = (v[1] - v[0]) * n1 + (v[2] - v[0]) * n2 + (v[3] - v[0]) * n3;
    double l = length(g);
    records[base + uint(SURFACE_AT(s))] = vec4(l > 0.0lf ? g / l : dvec3(0.0lf, 0.0lf, 1.0lf), 0.0);
  }
  records[base + uint(SURFACE_AT(-1))] = sides;
}
)";

constexpr const char* kMeet = R"(
// The slot of the face of a kind whose limit is v.
int slot_of(real v[4], int kinds, real limit, int wanted) {
  int kind[4] = int[](kinds / 9, kinds % 3, (kinds / 3) % 3, 1);
  for (int k = 0; k < 4; ++k)
    if (kind[k] == wanted && v[k] == limit) return k;
  return -1;  // the eye's own plane
}

real on_side(real offset, int side) {
  if (side == 1) return max(offset, real(0));
  return side == 2 ? min(offset, real(-1e-30)) : offset;
}

// A place along the ray that is linear in its length.
real place_of(real d) {
#if PERSPECTIVE
  return d / (real(1) - d);
#else
  return d;
#endif
}

real value_at(int field, vec2 at, real d) {
  vec4 high, low;
  for (int f = 0; f < FIELDS; ++f)
    if (f == field) {
      high = data[FIELD_AT(f) - 2];
      low = data[FIELD_AT(f) - 1];
    }
  dvec4 p = dvec4(high) + dvec4(low);
  real value = p.x + p.y * double(at.x) + p.z * double(at.y) + p.w * d;
#if PERSPECTIVE
  value /= real(1) - d;
#endif
  return value;
}

// Where the segment from `entry` to `exit`, a part of the ray in the cell from `front` to `back`,
// meets the surfaces. `first`, `last`: the slots of the faces at front and back.
void meet_surfaces(vec2 at, real front, real back, real entry, real exit, int first, int last,
                   out real crossed[SURFACES]) {
  vec4 sides = data[SURFACE_AT(-1) - 2];
  real begin = place_of(front), end = place_of(back);
  real from = place_of(entry), to = place_of(exit);
  for (int s = 0; s < SURFACES; ++s) {
    int both = (int(sides[s / 3]) >> (8 * (s % 3))) & 255;
    int side_front = first < 0 ? 0 : (both >> (2 * first)) & 3;
    int side_back = last < 0 ? 0 : (both >> (2 * last)) & 3;
    real a = on_side(value_at(kSurfaceField[s], at, front) - kSurfaceValue[s], side_front);
    real b = on_side(value_at(kSurfaceField[s], at, back) - kSurfaceValue[s], side_back);
    crossed[s] = real(2);
    if ((a >= real(0)) == (b >= real(0))) continue;
    real place = begin + (end - begin) * min(a / (a - b), real(1));
    real share = (place - from) / (to - from);
    // between the clipping planes, which a face of the cell may lie in
    if (place >= from - abs(from) * real(1e-12) && place <= to + abs(to) * real(1e-12))
      crossed[s] = clamp(share, real(0), real(1));
  }
}

struct Nearest {
  real share;
  int which;
};

// Of several at one place the first of the scene.
Nearest nearest_of(real crossed[SURFACES]) {
  Nearest nearest = Nearest(real(2), 0);
  for (int s = 0; s < SURFACES; ++s)
    if (crossed[s] < nearest.share) nearest = Nearest(crossed[s], s);
  return nearest;
}

// Phong's shading by what `lights_on` says of the scene's lights; alpha grows at an angle as that
// of glass does.
vec4 lit_surface(vec3 normal, vec3 color, vec4 phong, float log_transparency) {
  vec2 at = gl_FragCoord.xy + vec2(part.xy) - rays.xy;
#if PERSPECTIVE
  vec3 ray = normalize(vec3(at.x * rays.z, -at.y * rays.z, 1.0));
#else
  vec3 ray = vec3(0.0, 0.0, 1.0);
#endif
  float away = dot(normal, ray), facing = abs(away);
  vec3 light = phong.x * color + lights_on(normal, ray, away, color, phong);
  float opacity = 1.0 - exp(log_transparency / max(facing, 1e-30));
  return vec4(light * opacity, opacity);
}
)";

std::string light_source(const FrameLight& light, std::size_t index) {
  std::string text = "  {\n";
  if (light.headlight)
    text += "    float to_light = abs(away), towards_eye = 1.0;\n";
  else
    text += fmt::format(
        "    vec3 direction = lights[{}];\n"
        "    float to_light = (away > 0.0 ? -1.0 : 1.0) * dot(normal, direction);\n"
        "    float towards_eye = -dot(ray, direction);\n",
        index);
  return text + fmt::format(
                    "    if (to_light > 0.0) {{\n"
                    "      float mirrored = 2.0 * to_light * abs(away) - towards_eye;\n"
                    "      float shine = mirrored > 0.0 && phong.z > 0.0\n"
                    "          ? phong.z * min(pow(mirrored, phong.w), 1.0) : 0.0;\n"
                    "      sum += {} * (phong.y * to_light * color + shine);\n"
                    "    }}\n  }}\n",
                    vec3(light.color));
}

std::string constants(const DrawnScene& scene) {
  std::string fields, values;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    if (s > 0) {
      fields += ", ";
      values += ", ";
    }
    fields += std::to_string(scene.surfaces[s]);
    values += value_text(scene, s);
  }
  return fmt::format(
      "const int kSurfaceField[SURFACES] = int[]({});\n"
      "const double kSurfaceValue[SURFACES] = double[]({});\n",
      fields, values);
}

}  // namespace

std::string surface_setup_source(const ExactVariant& variant, const DrawnScene& scene) {
  return variant.surfaces == 0 ? "" : constants(scene) + kSetup;
}

std::string surface_fragment_source(const ExactVariant& variant, const DrawnScene& scene) {
  if (variant.surfaces == 0) return "";
  const auto& lights = scene.isosurfaces.lights;
  std::string text =
      constants(scene) +
      fmt::format("uniform vec3 lights[{}];\n", std::max<std::size_t>(lights.size(), 1)) +
      "vec3 lights_on(vec3 normal, vec3 ray, float away, vec3 color, vec4 phong) {\n"
      "  vec3 sum = vec3(0.0);\n";
  for (std::size_t k = 0; k < lights.size(); ++k) text += light_source(lights[k], k);
  text += std::string("  return sum;\n}\n") + kMeet + "vec4 surface_light(int which) {\n";
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const FrameIsosurface& surface = scene.isosurfaces.surfaces[s];
    fmt::format_to(std::back_inserter(text),
                   "  if (which == {0}) return lit_surface(data[SURFACE_AT({0}) - 2].xyz, {1}, "
                   "vec4({2}, {3}, {4}, {5}), {6});\n",
                   s, vec3(surface.color), number(surface.ambient), number(surface.diffuse),
                   number(surface.specular), number(surface.shininess),
                   number(surface.log_transparency));
  }
  return text + "  return vec4(0.0);\n}\n";
}

}  // namespace hiac::preview
