#include "hiac/preview/exact_shaders.hpp"

namespace hiac::preview {
namespace {

// The convex outline of a cell's projection as four corners, the last two the same where it is a
// triangle; grown, because rasterisers snap corners to fractions of a pixel: the rays' arithmetic
// decides what a cell covers.
constexpr const char* kOutline = R"(
// How far pixels of a cell are from its anchor. It does not depend on the part that is drawn, so
// that a pixel is the same in all parts.
double reach_of() {
  if (!whole) return max(center.x, center.y) + 2.0lf;
  dvec2 most = max(max(abs(at(0)), abs(at(1))), max(abs(at(2)), abs(at(3))));
  return max(most.x, most.y) + 2.0lf;
}

// The rectangle from `low` to `high`, the part's at most.
bool rectangle(vec2 low, vec2 high, out vec2 corner[4]) {
  vec2 first = vec2(part.xy - anchor) - 0.5, last = first + vec2(part.zw);
  low = max(low, first);
  high = min(high, last);
  corner[0] = low;
  corner[1] = vec2(high.x, low.y);
  corner[2] = high;
  corner[3] = vec2(low.x, high.y);
  return low.x < high.x && low.y < high.y;
}

#if NEAR
// A cell with corners beside or behind the eye: whether it may be seen at all.
bool outline_of_near(out vec2 corner[4]) {
  dvec2 low = (dvec2(part.xy) - 1.0lf - center.xy) / center.z;
  dvec2 high = (dvec2(part.xy + part.zw) + 1.0lf - center.xy) / center.z;
  bvec4 beside = bvec4(true);
  for (int k = 0; k < 4; ++k) {
    dvec3 p = camera(k);
    if (p.x >= low.x * p.z) beside.x = false;
    if (p.x <= high.x * p.z) beside.y = false;
    if (-p.y >= low.y * p.z) beside.z = false;
    if (-p.y <= high.y * p.z) beside.w = false;
  }
  return rectangle(vec2(-1e9), vec2(1e9), corner) && !any(beside);
}
#endif

// A narrow outline: the rectangle along its longest side that holds it.
void narrow_outline(vec2 p[4], out vec2 corner[4]) {
  vec2 run = vec2(1.0, 0.0);
  float longest = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = i + 1; j < 4; ++j) {
      vec2 edge = p[j] - p[i];
      float l = dot(edge, edge);
      if (l > longest) {
        longest = l;
        run = edge;
      }
    }
  run = longest > 0.0 ? run * inversesqrt(longest) : vec2(1.0, 0.0);
  vec2 across = vec2(-run.y, run.x);
  vec2 low = vec2(1e30), high = vec2(-1e30);
  for (int k = 0; k < 4; ++k) {
    vec2 q = vec2(dot(run, p[k] - p[0]), dot(across, p[k] - p[0]));
    low = min(low, q);
    high = max(high, q);
  }
  low -= kGrow;
  high += kGrow;
  corner[0] = p[0] + run * low.x + across * low.y;
  corner[1] = p[0] + run * high.x + across * low.y;
  corner[2] = p[0] + run * high.x + across * high.y;
  corner[3] = p[0] + run * low.x + across * high.y;
}

// A polygon of `count` corners with every side moved outwards; false where a corner is so sharp
// that it would go far.
bool grown(vec2 polygon[4], int count, out vec2 corner[4]) {
  float twice = 0.0;
  for (int k = 0; k < count; ++k) {
    vec2 a = polygon[k] - polygon[0], b = polygon[(k + 1) % count] - polygon[0];
    twice += a.x * b.y - b.x * a.y;
  }
  float turn = twice < 0.0 ? -1.0 : 1.0;
  vec2 outward[4];
  for (int k = 0; k < count; ++k) {
    vec2 edge = polygon[(k + 1) % count] - polygon[k];
    float l = dot(edge, edge);
    if (!(l > 1e-6)) return false;
    outward[k] = turn * vec2(edge.y, -edge.x) * inversesqrt(l);
  }
  for (int k = 0; k < count; ++k) {
    vec2 a = outward[(k + count - 1) % count], b = outward[k];
    float open = 1.0 + dot(a, b);
    if (!(open > 2e-3)) return false;
    corner[k] = polygon[k] + kGrow * (a + b) / open;
  }
  if (count == 3) corner[3] = corner[2];
  return true;
}

bool outline_of(out vec2 corner[4]) {
#if NEAR
  if (!whole) return outline_of_near(corner);
#endif
  vec2 p[4];
  vec2 low = vec2(1e30), high = vec2(-1e30);
  for (int k = 0; k < 4; ++k) {
    p[k] = vec2(at(k));
    low = min(low, p[k]);
    high = max(high, p[k]);
  }
  vec2 first = vec2(part.xy - anchor) - 1.5, last = first + vec2(part.zw) + 2.0;
  if (any(greaterThan(low, last)) || any(lessThan(high, first))) return false;
  if (max(max(-low.x, -low.y), max(high.x, high.y)) > kFar)
    return rectangle(low - 1.0, high + 1.0, corner);
  int positive = 0;
  for (int k = 0; k < 4; ++k) positive += lambda(k) >= 0.0lf ? 1 : 0;
  vec2 polygon[4];
  if (positive == 2) {
    int up = 0, down = 1;  // corners of either sign alternate around the outline
    for (int k = 0; k < 4; ++k) {
      if (lambda(k) >= 0.0lf) {
        polygon[up] = p[k];
        up += 2;
      } else {
        polygon[down] = p[k];
        down += 2;
      }
    }
    // Both triangles meet at the shorter diagonal: blocks of pixels along it are drawn twice.
    vec2 one = polygon[2] - polygon[0], two = polygon[3] - polygon[1];
    if (dot(two, two) < dot(one, one))
      polygon = vec2[](polygon[1], polygon[2], polygon[3], polygon[0]);
  } else {
    int n = 0;  // the one corner of its sign lies inside
    for (int k = 0; k < 4; ++k)
      if ((lambda(k) >= 0.0lf) == (positive == 3) && n < 3) polygon[n++] = p[k];
    if (n < 3) return false;
    polygon[3] = polygon[2];
  }
  if (!grown(polygon, positive == 2 ? 4 : 3, corner)) narrow_outline(p, corner);
  return true;
}
)";

}  // namespace

std::string exact_outline_source() { return kOutline; }

}  // namespace hiac::preview
