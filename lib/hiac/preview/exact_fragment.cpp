#include "hiac/preview/exact_shaders.hpp"
#include "hiac/preview/shader_text.hpp"

namespace hiac::preview {
namespace {

constexpr const char* kDoubleExtremes = R"(
double lesser(double a, double b) { return min(a, b); }
double greater(double a, double b) { return max(a, b); }
double between(double x, double low, double high) { return clamp(x, low, high); }
)";

// Where the ray enters and leaves the cell, and the fields there.
constexpr const char* kFaces = R"(
uniform vec3 rays;  // center_x, center_y less the part's corner, 1 / pixels per unit
#if STORED
layout(std430, binding = 4) readonly buffer Records { vec4 records[]; };
flat in uint row;
#else
flat in vec4 data[RECORD];
#endif
out vec4 light;

const float kFarAlong = 1e30;

struct Segment {
  real length;  // world units
  real extinction_front, extinction_back;  // the fields' values
  real color_front, color_back;
};

// d of the four faces at the pixel: entered ones, less those that are left.
real4 meet_faces(vec2 at) {
  precise vec4 coarse = DATA(2) + DATA(3) * at.x + DATA(4) * at.y;
#if DOUBLE
  return dvec4(coarse) + (dvec4(DATA(5)) + dvec4(DATA(6)) * double(at.x) +
                               dvec4(DATA(7)) * double(at.y));
#else
  precise vec4 rest = DATA(5) + DATA(6) * at.x + DATA(7) * at.y;
  precise vec4 all = coarse + rest;
  return all;
#endif
}

// Returns the side of a face, -1 entered, 1 left, 0 beside the ray, and removes it from `sides`,
// where the sides of several faces are the digits of a number to base 3.
float take_side(inout float sides, float weight) {
  float side = sides > 0.5 * weight ? 1.0 : (sides < -0.5 * weight ? -1.0 : 0.0);
  sides -= weight * side;
  return side;
}

// Limits the segment by a face on any side.
void limit(float side, real v, inout real entry, inout real exit) {
  if (side < 0.0) entry = greater(entry, v);
  if (side > 0.0) exit = lesser(exit, -v);
  if (side == 0.0 && v <= real(0)) entry = real(kFarAlong);
}

)";

constexpr const char* kMeetSegment = R"(
// A field where the ray enters and leaves; `front` and `back` are t / t_ref there in perspective.
void ends_of(int f, vec2 at, real entry, real exit, real front, real back, out real first,
             out real last) {
  vec4 q = DATA(FIELD_AT(f));
#if DOUBLE
  dvec4 p = dvec4(q) + dvec4(DATA(FIELD_AT(f) + 1));
  double base = p.x + p.y * double(at.x) + p.z * double(at.y);
  first = base + p.w * entry;
  last = base + p.w * exit;
#else
  float base = q.x + q.y * at.x + q.z * at.y;
  first = base + q.w * entry;
  last = base + q.w * exit;
#endif
  vec2 range = f == 0 ? DATA(1).zw : DATA(FIELD_AT(f) + (DOUBLE == 1 ? 2 : 1)).xy;
  first = between(first * front, real(range.x), real(range.y));
  last = between(last * back, real(range.x), real(range.y));
}

bool meet(out Segment segment) {
  vec2 at = gl_FragCoord.xy - 0.5 - DATA(0).xy;
  real4 v = meet_faces(at);
  float sides = DATA(0).w;
  real exit = -v.w;
#if NEAR
  real entry = -real(kFarAlong);
  float side_x = take_side(sides, 9.0);
  limit(side_x, v.x, entry, exit);
#else
  const float side_x = -1.0;
  real entry = v.x;
#endif
  float side_z = take_side(sides, 3.0), side_y = sides;
  limit(side_y, v.y, entry, exit);
  limit(side_z, v.z, entry, exit);
#if SURFACE_FIELDS > 0
  real whole_entry = entry, whole_exit = exit;
  vec4 all = vec4(side_x, side_y, side_z, 1.0);
  int first = slot_of(v, all, entry, -1.0), last = slot_of(v, all, -exit, 1.0);
#endif
#if CLIPPED
  entry = max(entry, real(DATA(1).x));
  exit = min(exit, real(DATA(1).y));
#endif
  if (!(entry < exit)) return false;
#if SURFACE_FIELDS > 0
  begin_surfaces(at, max(whole_entry, real(-1e9)), whole_exit, entry, exit, first, last);
#endif
  segment.length = exit - entry;
#if PERSPECTIVE
  real front = real(1) / (real(1) - entry), back = real(1) / (real(1) - exit);
  vec2 slopes = (gl_FragCoord.xy - rays.xy) * rays.z;
  segment.length *= real(DATA(0).z * sqrt(1.0 + dot(slopes, slopes))) * front * back;
#else
  const real front = real(1), back = real(1);
#endif
  ends_of(EXTINCTION, at, entry, exit, front, back, segment.extinction_front,
          segment.extinction_back);
#if COLOR != EXTINCTION
  ends_of(COLOR, at, entry, exit, front, back, segment.color_front, segment.color_back);
#endif
  return true;
}
)";

// One function of one field along a segment: the interval at hand and how far it goes.
constexpr const char* kWalk = R"(
struct Walk {
  real from, to, rate;  // the field at the segment's ends, and segment per field
  bool up;
  int interval;
  real here;  // the field where the walk is
  real next;  // ... and where the interval ends, or the segment
  real until; // the share of the segment there
};

void begin(inout Walk w, real from, real to) {
  w.from = from;
  w.to = to;
  w.up = to >= from;
  real change = to - from;
  w.rate = change == real(0) ? real(0) : real(1) / change;
  w.here = from;
}

// `low`, `high`: of the interval.
void look_ahead(inout Walk w, real low, real high) {
  real end = w.up ? high : low;
  bool last = w.up ? end >= w.to : end <= w.to;
  w.next = last ? w.to : end;
  w.until = last ? real(1) : min((end - w.from) * w.rate, real(1));
}

// To a share that is at most `until`, where the field is known as `value` unless it is that.
void advance(inout Walk w, real share) {
  bool reached = share >= w.until;
  w.here = reached ? w.next : w.from + (w.to - w.from) * share;
  w.interval += reached ? (w.up ? 1 : -1) : 0;
}
)";

constexpr const char* kFragmentMain = R"(
void main() {
  Segment segment;
  if (!meet(segment)) discard;
  Walk w;
  begin(w, segment.extinction_front, segment.extinction_back);
  w.interval = extinction_interval(w.from);
#if SEPARATE
  Walk c;
  begin(c, segment.color_front, segment.color_back);
  c.interval = color_interval(c.from);
#endif
  vec3 sum = vec3(0.0);
  float alpha = 0.0, behind = 1.0;
  real share = real(0);
  float whole = float(segment.length);
#if SURFACE_FIELDS > 0
  Crossing nearest = next_crossing(Crossing(real(-1), 0u, 0, 0));
#endif
  for (int step = 0; step < 16384; ++step) {
    Extinction tau = extinction_at(w.interval);
    look_ahead(w, tau.low, tau.high);
#if SEPARATE
    Color kappa = color_at(c.interval);
    look_ahead(c, kappa.low, kappa.high);
    real until = min(w.until, c.until);
#if SURFACE_FIELDS > 0
    until = min(until, nearest.share);
#endif
    real tau_end = until < w.until ? w.from + (w.to - w.from) * until : w.next;
    real kappa_here = c.here;
    real kappa_end = until < c.until ? c.from + (c.to - c.from) * until : c.next;
#else
    real until = w.until;
    real tau_end = w.next, kappa_here = w.here;
#if SURFACE_FIELDS > 0
    until = min(until, nearest.share);
    if (until < w.until) tau_end = w.from + (w.to - w.from) * until;
#endif
    real kappa_end = tau_end;
#define kappa tau
#endif
    float length = max(float(until - share), 0.0) * whole;
    float b = max(tau.value + tau.slope * float(w.here - tau.low), 0.0) * length;
    float a = max(tau.value + tau.slope * float(tau_end - tau.low), 0.0) * length;
    vec3 front = kappa.color + kappa.color_slope * float(kappa_here - kappa.low);
    vec3 back = kappa.color + kappa.color_slope * float(kappa_end - kappa.low);
    // the optical depth of the first f of the piece, f (b + (a - b) f / 2), is at most kThin
    float f = a + b > 2.0 * kThin ? 2.0 * kThin / (b + greater(a, b)) : 1.0;
    float end = b + (a - b) * f;
    Weights weights = weights_of(b * f, end * f);
    vec3 tip = f < 1.0 ? front + (back - front) * f : back;
    vec3 shine = front * weights.front + tip * weights.back;
#if EMISSION
    shine *= length * f;
#endif
    alpha += behind * weights.opacity;
    sum += behind * shine;
    behind *= 1.0 - weights.opacity;
#if SURFACE_FIELDS > 0
    if (f >= 1.0 && nearest.share <= until) {
      vec4 lit = surface_light(nearest);
      sum += behind * lit.rgb;
      alpha += behind * lit.a;
      behind *= 1.0 - lit.a;
      nearest = next_crossing(nearest);
    }
    bool more = nearest.share <= real(1);
#else
    const bool more = false;
#endif
    share = f < 1.0 ? share + (until - share) * real(f) : until;
    if ((share >= real(1) && !more) || behind < 1e-12) break;
    advance(w, share);
#if SEPARATE
    advance(c, share);
#endif
  }
  light = vec4(sum, alpha);
}
)";

}  // namespace

std::string exact_fragment_source(const ExactVariant& variant, const DrawnScene& scene) {
  return "#version 450 core\n" + defines_of(variant) +
         (variant.fine ? "#define real double\n#define real4 dvec4\n"
                       : "#define real float\n#define real4 vec4\n") +
         (scene.optics.emission ? "#define EMISSION 1\n" : "#define EMISSION 0\n") +
         "#define EXTINCTION " + std::to_string(scene.extinction) + "\n#define COLOR " +
         std::to_string(scene.color) + "\n" + kExtremes + (variant.fine ? kDoubleExtremes : "") +
         kFaces + surface_fragment_source(variant, scene) + kMeetSegment + exact_integral_source() +
         transfer_source(variant, scene) + kWalk + kFragmentMain;
}

}  // namespace hiac::preview
