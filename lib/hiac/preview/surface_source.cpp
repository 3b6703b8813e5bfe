#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hiac/preview/exact_shaders.hpp"

namespace hiac::preview {
namespace {

std::string number(double v) { return fmt::format("{:.9e}", std::clamp(v, -1e30, 1e30)); }

std::string exact_vec3(const std::array<double, 3>& v) {
  return fmt::format("vec3({}, {}, {})", number(v[0]), number(v[1]), number(v[2]));
}

// Isosurfaces in the order of their fields, and there by ascending value. What is below a value has
// a rank below that of the surface.
constexpr const char* kSurfaces = R"(
struct Surface {
  double value;
  uint place;        // in the scene
  vec4 color;        // and the logarithm of the transparency
  vec4 phong;        // ambient, diffuse, specular, shininess
};
layout(std430, binding = 6) readonly buffer Surfaces { Surface surfaces[]; };
)";

constexpr const char* kSurfaceSetup = R"(
layout(std430, binding = 5) readonly buffer Closed { uint closed[]; };

// How many surfaces of a field have values below v, or, with `equal`, at most v.
float rank_of(int f, double v, bool equal) {
  uint low = kFirstSurface[f], high = kFirstSurface[f + 1];
  while (low < high) {
    uint middle = (low + high) / 2u;
    double value = surfaces[middle].value;
    if (equal ? value <= v : value < v)
      low = middle + 1u;
    else
      high = middle;
  }
  return float(low - kFirstSurface[f]);
}

// What is known beforehand of the sides of a cell's faces, as Isosurfaces (frame) has it, so that
// both cells at a face say the same of it: of how many surfaces a whole face is not below, and of
// how many it is not below everywhere. And the surfaces' normals in camera coordinates.
void set_surfaces(uint i, uint base, int slots[4]) {
  dvec3 e1 = camera(1) - camera(0), e2 = camera(2) - camera(0), e3 = camera(3) - camera(0);
  dvec3 n1 = cross(e2, e3), n2 = cross(e3, e1), n3 = cross(e1, e2);
  for (int f = 0; f < SURFACE_FIELDS; ++f) {
    uvec2 v[4];
    for (int k = 0; k < 4; ++k) v[k] = bits_of(value_of(kSurfaceField[f], i, k));
    uint shut = closed[i * uint(CLOSED_WORDS) + uint(f / 8)] >> (4 * (f % 8));
    vec4 above, reached;
    for (int k = 0; k < 4; ++k) {
      ivec3 c = kFace[k];
      double a = of_bits(v[c.x]), b = of_bits(v[c.y]), d = of_bits(v[c.z]);
      reached[slots[k]] = rank_of(f, max(max(a, b), d), false);
      // a face on which a surface lies whole, touched from below on both sides, counts as below it
      bool is_shut = (shut & (1u << entry[k])) != 0u;
      above[slots[k]] = rank_of(f, min(min(a, b), d), !is_shut);
    }
    double v0 = of_bits(v[0]);
    dvec3 g = (of_bits(v[1]) - v0) * n1 + (of_bits(v[2]) - v0) * n2 + (of_bits(v[3]) - v0) * n3;
    double l = length(g);
    uint to = base + uint(SURFACE_AT(f));
    dvec3 normal = l > 0.0lf ? g / l : dvec3(0.0lf, 0.0lf, 1.0lf);
    records[to] = vec4(normal, 0.0);
    records[to + 1u] = vec4(normal - dvec3(vec3(normal)), 0.0);
    records[to + 2u] = above;
    records[to + 3u] = reached;
  }
}
)";

constexpr const char* kPower = R"(
// x to a power, for x from 0 to 1. Near 1 single precision does not tell x from its neighbours, of
// which large powers differ.
float power(double x, float exponent) {
  float rest = max(float(1.0lf - x), 0.0);
  if (rest > 0.125) return pow(float(x), exponent);
  float series = 1.0 / 8.0;
  for (int k = 7; k >= 1; --k) series = 1.0 / float(k) + rest * series;
  return exp(-exponent * rest * series);
}
)";

constexpr const char* kCrossings = R"(
// The slot of the face on a side whose limit is v.
int slot_of(real4 v, vec4 sides, real limit, float wanted) {
  if (sides.x == wanted && v.x == limit) return 0;
  if (sides.y == wanted && v.y == limit) return 1;
  if (sides.z == wanted && v.z == limit) return 2;
  return sides.w == wanted && v.w == limit ? 3 : -1;  // -1: the eye's own plane
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
      high = DATA(FIELD_AT(f));
      low = DATA(FIELD_AT(f) + 1);
    }
  dvec4 p = dvec4(high) + dvec4(low);
  real value = p.x + p.y * double(at.x) + p.z * double(at.y) + p.w * d;
#if PERSPECTIVE
  value /= real(1) - d;
#endif
  return value;
}

// A segment, a part of the ray in the cell from `front` to `back`. `first`, `last`: the slots of the
// faces there.
struct Chord {
  vec2 at;
  real front, back;
  real begin, end;  // places
  real from, to;    // of the segment
  int first, last;
};
Chord chord;

void begin_surfaces(vec2 at, real front, real back, real entry, real exit, int first, int last) {
  chord = Chord(at, front, back, place_of(front), place_of(back), place_of(entry), place_of(exit),
                first, last);
}

// Where a segment meets a surface: the share of the segment, 2 for nowhere; the surface's place in
// the scene, its number here, and the number of its field among those of surfaces.
struct Crossing {
  real share;
  uint place;
  int number, field;
};

float of_slot(vec4 v, int slot) {
  return slot < 2 ? (slot == 0 ? v.x : v.y) : (slot == 2 ? v.z : v.w);
}

// 1: the face in a slot is not below the surface of that rank, 2: it is below it, 0: it depends.
int side_of(vec4 above, vec4 reached, int slot, int rank) {
  if (slot < 0) return 0;
  if (float(rank) < of_slot(above, slot)) return 1;
  return float(rank) < of_slot(reached, slot) ? 0 : 2;
}

// The share of the segment at which a field that is a at the chord's begin and b at its end,
// less the surface's value, passes it.
real passage(real a, real b) {
  if ((a >= real(0)) == (b >= real(0))) return real(2);
  real place = chord.begin + (chord.end - chord.begin) * min(a / (a - b), real(1));
  // between the clipping planes, which a face of the cell may lie in
  if (!(place >= chord.from - abs(chord.from) * real(1e-12) &&
        place <= chord.to + abs(chord.to) * real(1e-12)))
    return real(2);
  return clamp((place - chord.from) / (chord.to - chord.from), real(0), real(1));
}

bool is_before(Crossing a, Crossing b) {
  return a.share < b.share || (a.share == b.share && a.place < b.place);
}

// The crossing after another one. Of several at one place the first of the scene comes first.
Crossing next_crossing(Crossing last) {
  Crossing next = Crossing(real(2), 0u, 0, 0);
  for (int f = 0; f < SURFACE_FIELDS; ++f) {
    vec4 above = DATA(SURFACE_AT(f) + 2), reached = DATA(SURFACE_AT(f) + 3);
    vec4 highest = max(above, reached);
    int low = int(min(min(above.x, above.y), min(above.z, above.w)));
    int high = int(max(max(highest.x, highest.y), max(highest.z, highest.w)));
    if (low >= high) continue;  // no surface is between the cell's corners
    real front = value_at(kSurfaceField[f], chord.at, chord.front);
    real back = value_at(kSurfaceField[f], chord.at, chord.back);
    for (int rank = low; rank < high; ++rank) {
      int number = int(kFirstSurface[f]) + rank;
      real value = surfaces[number].value;
      real a = on_side(front - value, side_of(above, reached, chord.first, rank));
      real b = on_side(back - value, side_of(above, reached, chord.last, rank));
      Crossing here = Crossing(passage(a, b), surfaces[number].place, number, f);
      if (here.share <= real(1) && is_before(last, here) && is_before(here, next)) next = here;
    }
  }
  return next;
}

// Phong's shading by what `lights_on` says of the scene's lights; alpha grows at an angle as that
// of glass does.
vec4 lit_surface(dvec3 normal, vec3 color, vec4 phong, float log_transparency) {
#if PERSPECTIVE
  dvec2 at = dvec2(gl_FragCoord.xy - rays.xy) * double(rays.z);
  dvec3 ray = normalize(dvec3(at.x, -at.y, 1.0lf));
#else
  dvec3 ray = dvec3(0.0lf, 0.0lf, 1.0lf);
#endif
  double away = dot(normal, ray);
  float facing = float(abs(away));
  vec3 light = phong.x * color + lights_on(normal, ray, away, color, phong);
  float opacity = 1.0 - exp(log_transparency / max(facing, 1e-30));
  return vec4(light * opacity, opacity);
}
)";

std::string light_source(const FrameLight& light, std::size_t index) {
  std::string text = "  {\n";
  if (light.headlight)
    text += "    double to_light = abs(away), towards_eye = 1.0lf;\n";
  else
    text += fmt::format(
        "    dvec3 direction = lights[{}];\n"
        "    double to_light = (away > 0.0lf ? -1.0lf : 1.0lf) * dot(normal, direction);\n"
        "    double towards_eye = -dot(ray, direction);\n",
        index);
  return text + fmt::format(
                    "    if (to_light > 0.0lf) {{\n"
                    "      double mirrored = 2.0lf * to_light * abs(away) - towards_eye;\n"
                    "      float shine = mirrored > 0.0lf && phong.z > 0.0\n"
                    "          ? phong.z * power(mirrored, phong.w) : 0.0;\n"
                    "      sum += {} * (phong.y * float(to_light) * color + shine);\n"
                    "    }}\n  }}\n",
                    exact_vec3(light.color));
}

// Which fields have surfaces, and where these begin among all.
std::string constants(const DrawnScene& scene) {
  std::vector<std::string> fields, firsts{"0u"};
  std::size_t first = 0;
  for (const SurfaceField& of_field : scene.surface_fields) {
    fields.push_back(std::to_string(of_field.field));
    first += of_field.surfaces.size();
    firsts.push_back(std::to_string(first) + "u");
  }
  return fmt::format(
      "#define CLOSED_WORDS {}\nconst int kSurfaceField[SURFACE_FIELDS] = int[]({});\n"
      "const uint kFirstSurface[SURFACE_FIELDS + 1] = uint[]({});\n",
      closed_words(scene), fmt::join(fields, ", "), fmt::join(firsts, ", "));
}

}  // namespace

std::size_t closed_words(const DrawnScene& scene) { return (scene.surface_fields.size() + 7) / 8; }

std::vector<DeviceSurface> device_surfaces(const DrawnScene& scene) {
  std::vector<DeviceSurface> all;
  const auto single = [](double v) { return static_cast<float>(std::clamp(v, -1e30, 1e30)); };
  for (const SurfaceField& of_field : scene.surface_fields)
    for (const std::size_t s : of_field.surfaces) {
      const FrameIsosurface& surface = scene.isosurfaces.surfaces[s];
      all.push_back({scene.surface_values[s],
                     static_cast<std::uint32_t>(s),
                     0,
                     {single(surface.color[0]), single(surface.color[1]), single(surface.color[2]),
                      single(surface.log_transparency)},
                     {single(surface.ambient), single(surface.diffuse), single(surface.specular),
                      single(surface.shininess)}});
    }
  return all;
}

std::string surface_setup_source(const ExactVariant& variant, const DrawnScene& scene) {
  return variant.surface_fields == 0 ? "" : constants(scene) + kSurfaces + kSurfaceSetup;
}

std::string surface_fragment_source(const ExactVariant& variant, const DrawnScene& scene) {
  if (variant.surface_fields == 0) return "";
  const auto& lights = scene.isosurfaces.lights;
  std::string text =
      constants(scene) + kSurfaces + kPower +
      fmt::format("uniform dvec3 lights[{}];\n", std::max<std::size_t>(lights.size(), 1)) +
      "vec3 lights_on(dvec3 normal, dvec3 ray, double away, vec3 color, vec4 phong) {\n"
      "  vec3 sum = vec3(0.0);\n";
  for (std::size_t k = 0; k < lights.size(); ++k) text += light_source(lights[k], k);
  text += std::string("  return sum;\n}\n") + kCrossings +
          "vec4 surface_light(Crossing at) {\n  dvec3 normal;\n";
  for (std::size_t f = 0; f < scene.surface_fields.size(); ++f)
    text += fmt::format(
        "  if (at.field == {0})\n"
        "    normal = dvec3(DATA(SURFACE_AT({0})).xyz) + dvec3(DATA(SURFACE_AT({0}) + 1).xyz);\n",
        f);
  return text +
         "  Surface s = surfaces[at.number];\n"
         "  return lit_surface(normal, s.color.rgb, s.phong, s.color.w);\n}\n";
}

}  // namespace hiac::preview
