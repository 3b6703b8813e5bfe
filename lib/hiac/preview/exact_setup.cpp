#include "hiac/preview/exact_shaders.hpp"

namespace hiac::preview {
namespace {

// One invocation a cell, in double precision: where rays enter and leave it, as planes over the
// screen, its fields, and the outline to rasterise. Corners are taken by ascending number of their
// nodes, so that the cells on both sides of a face compute and decide alike what belongs to it.
//
// Places on the screen count from the centre of the cell's anchor pixel, (X, Y); places along the
// ray by d: orthographic d = t - t_ref, perspective d = 1 - t_ref / t, both affine over the screen
// on every plane. Fields times t_ref / t, that is 1 - d, are affine in (X, Y, d) in perspective.
constexpr const char* kCells = R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Nodes { dvec4 nodes[]; };
layout(std430, binding = 1) readonly buffer Cells { uvec4 cells[]; };
layout(std430, binding = 2) readonly buffer Numbers { uint numbers[]; };
layout(std430, binding = 3) readonly buffer Values { double values[]; };
layout(std430, binding = 4) writeonly buffer Records { vec4 records[]; };
layout(std430, binding = 7) writeonly buffer Outlines { vec4 outlines[]; };  // two a cell: (x, y) four times
uniform uint cell_count;
uniform uvec2 layouts[FIELDS];  // of a field: where its values begin; 0 by node, 1 by cell, 2 by corner
uniform dvec3 center;           // center_x, center_y, pixels per unit (Projector::Axes)
uniform dvec2 slab;             // near, far (ray parameter)
uniform ivec4 part;             // corner and size

// Of a face: the ray enters the cell, passes beside the face, or leaves the cell.
const int kEntered = -1, kBeside = 0, kLeft = 1;
// Faces narrower than this share of their length count as edge-on, and shorter ones than kShort
// where they are narrower than this share of that: the longer a face, the less well its plane is
// known.
const double kThinnest = 1.0lf / 2097152.0lf;
const double kShort = 8.0lf;                     // pixels
const double kOnLine = 1.0lf / 268435456.0lf;    // pixels: what counts as lying on a line
const float kGrow = 0.01;                        // pixels: a rasteriser snaps to 1/256
const float kFar = 4096.0;                       // pixels from the anchor
const double kLargest = 1e300lf;

// the corners of the face without corner k, ascending
const ivec3 kFace[4] = ivec3[](ivec3(1, 2, 3), ivec3(0, 2, 3), ivec3(0, 1, 3), ivec3(0, 1, 2));

// Arrays hold the bits of doubles: where an array's index is not known to the compiler, NVIDIA's
// (driver 580) keeps its doubles in single precision.
struct Bits3 {
  uvec4 xy;
  uvec2 z;
};
uvec2 bits_of(double v) { return unpackDouble2x32(v); }
uvec4 bits_of(dvec2 v) { return uvec4(unpackDouble2x32(v.x), unpackDouble2x32(v.y)); }
Bits3 bits_of(dvec3 v) { return Bits3(bits_of(v.xy), bits_of(v.z)); }
double of_bits(uvec2 b) { return packDouble2x32(b); }
dvec2 of_bits(uvec4 b) { return dvec2(packDouble2x32(b.xy), packDouble2x32(b.zw)); }
dvec3 of_bits(Bits3 b) { return dvec3(of_bits(b.xy), of_bits(b.z)); }

uint id[4];
uint entry[4];  // the corner's number in the cell
Bits3 screen_bits[4];
bool seen[4];
bool whole;
Bits3 camera_bits[4];  // right, up, forward
uvec4 at_bits[4];      // (X, Y)
uvec2 along_bits[4];   // d
uvec2 area_bits[4];    // twice, of the face without corner k; canonical sign
double thickness;
bool flat_cell;  // to rounding: no ray has a length in it
double t_ref;
ivec2 anchor;

dvec3 screen(int k) { return of_bits(screen_bits[k]); }
dvec3 camera(int k) { return of_bits(camera_bits[k]); }
dvec2 at(int k) { return of_bits(at_bits[k]); }
double along(int k) { return of_bits(along_bits[k]); }
double area(int k) { return of_bits(area_bits[k]); }
double lambda(int k) { return (k & 1) == 0 ? -area(k) : area(k); }

void put_in_order(int i, int j) {
  if (id[i] <= id[j]) return;
  uint a = id[i], b = entry[i];
  id[i] = id[j];
  entry[i] = entry[j];
  id[j] = a;
  entry[j] = b;
}

double area_of(dvec2 a, dvec2 b, dvec2 c) {
  precise double twice = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  return twice;
}

bool is_thin(ivec3 f, double twice) {
  dvec2 one = abs(screen(f.y).xy - screen(f.x).xy), two = abs(screen(f.z).xy - screen(f.x).xy);
  double longest = max(max(one.x, one.y), max(two.x, two.y));
  return !(abs(twice) > kThinnest * max(longest, kShort) * longest);
}

// A line seen edge-on as (c, gx, gy) in pixels, positive where the corner k is. What lies on it is
// on the side to the right, or below where it is horizontal: as if pixels were sampled an
// infinitesimal amount right of their centres, and infinitely less below.
dvec3 side_of(dvec2 normal, double c, bool inside_is_positive) {
  if (!inside_is_positive) {
    normal = -normal;
    c = -c;
  }
  bool on = abs(normal.x) > 1e-6lf ? normal.x > 0.0lf : normal.y > 0.0lf;
  return dvec3(c + (on ? kOnLine : -kOnLine), normal);
}

dvec3 line_of(ivec3 f, int k) {
  dvec2 a = screen(f.x).xy, b = screen(f.y).xy, c = screen(f.z).xy;
  dvec2 ab = b - a, ac = c - a, bc = c - b;
  precise double l_ab = dot(ab, ab), l_ac = dot(ac, ac), l_bc = dot(bc, bc);
  dvec2 run = ab;
  int base = f.x;
  double l = l_ab;
  if (l_ac > l) {
    run = ac;
    l = l_ac;
  }
  if (l_bc > l) {
    run = bc;
    base = f.y;
    l = l_bc;
  }
  dvec2 normal = dvec2(-run.y, run.x) / sqrt(l), on = screen(base).xy;
  double off = dot(normal, screen(k).xy - on);
#if NEAR
  if (!seen[k]) {  // no place on the screen: the side of the plane through the line and the eye
    dvec3 p = camera(k);
    off = dot(normal, dvec2(center.z * p.x + (center.x - on.x) * p.z,
                            (center.y - on.y) * p.z - center.z * p.y));
  }
#endif
  return side_of(normal, -dot(normal, at(base)), off > 0.0lf);
}

dvec3 plane_of(ivec3 f, double twice) {
  dvec2 one = screen(f.y).xy - screen(f.x).xy, two = screen(f.z).xy - screen(f.x).xy;
  double d1 = along(f.y) - along(f.x), d2 = along(f.z) - along(f.x);
  dvec2 g = dvec2(d1 * two.y - d2 * one.y, d2 * one.x - d1 * two.x) / twice;
  return dvec3(along(f.x) - dot(g, at(f.x)), g);
}

#if NEAR
// The same from camera coordinates, for faces with corners beside or behind the eye. n.P + c >= 0
// in the cell; on rays P = t (slopes, 1).
dvec3 camera_face(ivec3 f, int k, out int kind) {
  dvec3 n = cross(camera(f.y) - camera(f.x), camera(f.z) - camera(f.x));
  double c = -dot(n, camera(f.x));
  if (dot(n, camera(k)) + c < 0.0lf) {
    n = -n;
    c = -c;
  }
  dvec2 slopes = dvec2(anchor) + 0.5lf - center.xy;  // at the anchor, times pixels per unit
  dvec3 rate = dvec3(n.z + (n.x * slopes.x - n.y * slopes.y) / center.z, n.x / center.z,
                     -n.y / center.z);
  double size = length(n) * length(camera(f.x));
  if (abs(c) <= 1e-13lf * size) {  // the eye is in the face's plane
    kind = kBeside;
    double l = length(rate.yz);
    return l > 0.0lf ? side_of(rate.yz / l, rate.x / l, true) : dvec3(1.0lf, 0.0lf, 0.0lf);
  }
  kind = c > 0.0lf ? kLeft : kEntered;
  dvec3 plane = rate * (t_ref / c);
  return dvec3(plane.x + 1.0lf, plane.yz);
}

bool is_entered_near(ivec3 f, int k) {
  dvec3 n = cross(camera(f.y) - camera(f.x), camera(f.z) - camera(f.x));
  double c = -dot(n, camera(f.x));
  return dot(n, camera(k)) + c < 0.0lf ? c > 0.0lf : c < 0.0lf;
}
#endif

void load(uint i) {
  uvec4 c = cells[i];
  for (int k = 0; k < 4; ++k) {
    id[k] = c[k];
    entry[k] = uint(k);
  }
  put_in_order(0, 1);
  put_in_order(2, 3);
  put_in_order(0, 2);
  put_in_order(1, 3);
  put_in_order(1, 2);
  whole = true;
  for (int k = 0; k < 4; ++k) {
    dvec4 n = nodes[id[k]];
    seen[k] = n.w != 0.0lf;
    screen_bits[k] = bits_of(n.xyz);
    whole = whole && seen[k];
  }
}

// Reference, anchor and places; false when the cell is behind the eye.
bool place() {
  for (int k = 0; k < 4; ++k) {
    camera_bits[k] = screen_bits[k];
    if (!seen[k]) continue;
    dvec2 slopes = dvec2(screen(k).x - center.x, center.y - screen(k).y) / center.z;
#if PERSPECTIVE
    camera_bits[k] = bits_of(dvec3(slopes, 1.0lf) * (-1.0lf / screen(k).z));
#else
    camera_bits[k] = bits_of(dvec3(slopes, screen(k).z));
#endif
  }
  dvec3 middle = (screen(0) + screen(1) + screen(2) + screen(3)) * 0.25lf;
  anchor = ivec2(floor(whole ? middle.xy : center.xy));
  t_ref = whole ? middle.z : 0.0lf;
#if PERSPECTIVE
  t_ref = whole ? -1.0lf / middle.z
                : max(max(camera(0).z, camera(1).z), max(camera(2).z, camera(3).z));
  if (!(t_ref > 0.0lf)) return false;
#endif
  dvec2 zero = dvec2(anchor) + 0.5lf;
  for (int k = 0; k < 4; ++k) {
    at_bits[k] = bits_of(screen(k).xy - zero);
#if PERSPECTIVE
    along_bits[k] = bits_of(whole ? (screen(k).z - middle.z) * t_ref : 1.0lf + screen(k).z * t_ref);
#else
    along_bits[k] = bits_of(screen(k).z - t_ref);
#endif
  }
  return true;
}

void measure() {
  thickness = 0.0lf;
  for (int k = 0; k < 4; ++k) {
    ivec3 f = kFace[k];
    area_bits[k] = bits_of(area_of(screen(f.x).xy, screen(f.y).xy, screen(f.z).xy));
  }
  double most = 0.0lf;
  for (int k = 1; k < 4; ++k) {
    double part = lambda(k) * (along(k) - along(0));
    thickness += part;
    most = max(most, abs(part));
  }
  flat_cell = !(abs(thickness) > 1e-11lf * most);
}

// Planes and lines; their kinds. False when no ray meets the cell.
bool bound(out Bits3 plane[4], out int kind[4]) {
  bool any = false;
  for (int k = 0; k < 4; ++k) {
    ivec3 f = kFace[k];
    bool projected = seen[f.x] && seen[f.y] && seen[f.z];
#if NEAR
    if (!projected) {
      plane[k] = bits_of(camera_face(f, k, kind[k]));
    } else
#endif
        if (is_thin(f, area(k))) {
      kind[k] = kBeside;
      plane[k] = bits_of(line_of(f, k));
    } else {
      bool entered = (lambda(k) > 0.0lf) == (thickness > 0.0lf);
#if NEAR
      if (!whole) entered = is_entered_near(f, k);
#endif
      kind[k] = entered ? kEntered : kLeft;
      plane[k] = bits_of(plane_of(f, area(k)));
    }
    any = any || kind[k] == kLeft;
  }
  return any && !(whole && flat_cell);
}

double value_of(int field, uint i, int k) {
  uvec2 l = layouts[field];
  uint number = numbers[i];
  uint index = l.y == 0u ? id[k] : (l.y == 1u ? number : 4u * number + entry[k]);
  return values[l.x + index];
}

// A field as (q0, qx, qy, qd).
dvec4 field_of(uvec2 v[4]) {
#if NEAR
  if (!whole) {
    dvec3 e1 = camera(1) - camera(0), e2 = camera(2) - camera(0), e3 = camera(3) - camera(0);
    dvec3 n1 = cross(e2, e3), n2 = cross(e3, e1), n3 = cross(e1, e2);
    dvec3 a = ((of_bits(v[1]) - of_bits(v[0])) * n1 + (of_bits(v[2]) - of_bits(v[0])) * n2 + (of_bits(v[3]) - of_bits(v[0])) * n3) / dot(e1, n1);
    double rest = of_bits(v[0]) - dot(a, camera(0));
    dvec2 slopes = dvec2(anchor) + 0.5lf - center.xy;
    dvec3 rate = dvec3(a.z + (a.x * slopes.x - a.y * slopes.y) / center.z, a.x / center.z,
                       -a.y / center.z) * t_ref;
    return dvec4(rate.x + rest, rate.yz, -rest);
  }
#endif
  uvec2 q[4];
  for (int k = 0; k < 4; ++k) {
#if PERSPECTIVE
    q[k] = bits_of(of_bits(v[k]) * (1.0lf - along(k)));
#else
    q[k] = v[k];
#endif
  }
  double sum = 0.0lf;
  for (int k = 1; k < 4; ++k) sum += lambda(k) * (of_bits(q[k]) - of_bits(q[0]));
  double qd = sum / thickness;
  ivec3 f = kFace[0];
  double twice = area(0);
  for (int k = 1; k < 4; ++k)
    if (abs(area(k)) > abs(twice)) {
      f = kFace[k];
      twice = area(k);
    }
  double r0 = of_bits(q[f.x]) - qd * along(f.x);
  double r1 = of_bits(q[f.y]) - qd * along(f.y) - r0, r2 = of_bits(q[f.z]) - qd * along(f.z) - r0;
  dvec2 one = at(f.y) - at(f.x), two = at(f.z) - at(f.x);
  dvec2 g = dvec2(r1 * two.y - r2 * one.y, r2 * one.x - r1 * two.x) / twice;
  return dvec4(r0 - dot(g, at(f.x)), g, qd);
}

// Numbers in two of single precision. The first ones are whole multiples of `grain`: sums of such
// multiples of pixels are exact.
vec3 split(dvec3 v, float grain, out vec3 rest) {
  dvec3 high = round(v / double(grain)) * double(grain);
  rest = vec3(v - high);
  return vec3(high);
}

float grain_of(dvec3 plane, double reach) {
  double most = max(abs(plane.x), reach * max(abs(plane.y), abs(plane.z)));
  int e = clamp(int(ceil(log2(float(most)))) + 1, -80, 120);
  return uintBitsToFloat(uint(e - 22 + 127) << 23);
}
)";

constexpr const char* kSetupMain = R"(
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= cell_count) return;
  uint base = i * uint(RECORD);
  vec2 outline[4] = vec2[](vec2(0.0), vec2(0.0), vec2(0.0), vec2(0.0));
  load(i);
  Bits3 plane[4];
  int kind[4];
  bool drawn = place();
  if (drawn) {
    measure();
    drawn = bound(plane, kind) && outline_of(outline);
  }
  // counted from the part's corner, as in the record: pixels need no uniform for it, which llvmpipe
  // reads for each of eight pixels apart
  vec2 from = vec2(anchor - part.xy), zero = from + 0.5;
  outlines[2u * i] = drawn ? vec4(outline[0] + zero, outline[1] + zero) : vec4(0.0);
  outlines[2u * i + 1u] = drawn ? vec4(outline[2] + zero, outline[3] + zero) : vec4(0.0);
  if (!drawn) return;
  double reach = reach_of();
  vec4 high[3], low[3];
  float sides = 0.0;
  int slot = 0;
  // a face that is always entered or always left needs no digit
  float weight[4] = float[](NEAR == 1 ? 9.0 : 0.0, 1.0, 3.0, 0.0);
  int slots[4];
  for (int wanted = kEntered; wanted <= kLeft; ++wanted)
    for (int k = 0; k < 4; ++k) {
      if (kind[k] != wanted) continue;
      dvec3 p = of_bits(plane[k]);
      if (wanted == kLeft) p = -p;
      float grain = grain_of(p, reach);
      vec3 rest, main_part = split(p, grain, rest);
      for (int c = 0; c < 3; ++c) {
        high[c][slot] = main_part[c];
        low[c][slot] = rest[c];
      }
      slots[k] = slot;
      sides += weight[slot] * float(wanted);
      ++slot;
    }
  records[base] = vec4(from, float(t_ref), sides);
  for (int c = 0; c < 3; ++c) {
    records[base + 2u + uint(c)] = high[c];
    records[base + 5u + uint(c)] = low[c];
  }
#if PERSPECTIVE
  vec2 clip = vec2(slab.x > 0.0lf ? 1.0lf - t_ref / slab.x : -1e9lf, 1.0lf - t_ref / slab.y);
#else
  vec2 clip = vec2(slab - t_ref);
#endif
  for (int f = 0; f < FIELDS; ++f) {
    uvec2 v[4];
    dvec2 range = dvec2(1.0lf, -1.0lf) * kLargest;
    for (int k = 0; k < 4; ++k) {
      double value = value_of(f, i, k);
      v[k] = bits_of(value);
      range = dvec2(min(range.x, value), max(range.y, value));
    }
    dvec4 q = field_of(v);
    uint to = base + uint(FIELD_AT(f));
    records[to] = vec4(q);
    if (f == 0)
      records[base + 1u] = vec4(clip, vec2(range));
    else
      records[to + (DOUBLE == 1 ? 2u : 1u)] = vec4(vec2(range), 0.0, 0.0);
#if DOUBLE
    records[to + 1u] = vec4(q - dvec4(vec4(q)));
#endif
  }
#if SURFACE_FIELDS > 0
  set_surfaces(i, base, slots);
#endif
}
)";

}  // namespace

std::string exact_setup_source(const ExactVariant& variant, const DrawnScene& scene) {
  return "#version 450 core\n" + defines_of(variant) + kCells + exact_outline_source() +
         surface_setup_source(variant, scene) + kSetupMain;
}

}  // namespace hiac::preview
