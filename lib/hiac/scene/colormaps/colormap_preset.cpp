// Interpolation of ParaView's colour maps, and their approximation by piecewise-linear RGB.
// Based on: K. Moreland, "Diverging Color Maps for Scientific Visualization", ISVC 2009, and the
// definitions of vtkColorTransferFunction.

#include "hiac/scene/colormaps/colormap_preset.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "hiac/scene/colormaps/color_space.hpp"

namespace hiac {
namespace {

using namespace color_space;

using std::numbers::pi;
using Point = PiecewiseLinear<3>::Point;

/// A section of a colour map: coordinates of a colour space that are linear from `from` (t = 0) to
/// `to` (t = 1).
struct ColorPath {
  ColorSpace space;
  double begin;  ///< the scalars of the section, begin < end
  double end;
  Triple from;
  Triple to;
  ColorEncoding encoding = ColorEncoding::linear;  ///< of the colours that the space converts to
};

/// Exactly a at t = 0 and b at t = 1.
double between(double a, double b, double t) { return (1 - t) * a + t * b; }
Range between(double a, double b, const Range& t) { return Range(a) + t * Range(b - a); }

template <typename T>
std::array<T, 3> encoded_color_at(const ColorPath& path, const T& t) {
  std::array<T, 3> at;
  for (std::size_t c = 0; c < 3; ++c) at[c] = between(path.from[c], path.to[c], t);
  switch (path.space) {
    case ColorSpace::lab:
      return lab_to_rgb(at);
    case ColorSpace::diverging:
      return msh_to_rgb(at);
    case ColorSpace::hsv:
    case ColorSpace::hsv_wrapped:
      return hsv_to_rgb(at);
    default:
      return at;
  }
}

template <typename T>
std::array<T, 3> decoded(std::array<T, 3> color, ColorEncoding encoding) {
  if (encoding == ColorEncoding::srgb)
    for (T& channel : color) channel = gamma_decoded(channel);
  return color;
}

template <typename T>
std::array<T, 3> color_at(const ColorPath& path, const T& t) {
  return decoded(encoded_color_at(path, t), path.encoding);
}

// From nodes to paths ---------------------------------------------------------------------------

/// Returns the hue with which a colour without saturation should start, so that the path to a
/// saturated one rotates no farther than Moreland allows.
double adjusted_hue(const Triple& msh, double unsaturated_magnitude) {
  if (msh[0] >= unsaturated_magnitude - 0.1) return msh[2];
  const double spin = msh[1] *
                      std::sqrt(unsaturated_magnitude * unsaturated_magnitude - msh[0] * msh[0]) /
                      (msh[0] * std::sin(msh[1]));
  return msh[2] > -0.3 * pi ? msh[2] + spin : msh[2] - spin;
}

/// Returns the angle between two directions, between 0 and pi.
double angle_between(double a, double b) {
  const double difference = std::fmod(std::fabs(a - b), 2 * pi);
  return difference > pi ? 2 * pi - difference : difference;
}

constexpr double kUnsaturated = 0.05;

ColorPath diverging_path(double begin, double end, Triple from, Triple to) {
  if (from[1] < kUnsaturated && to[1] > kUnsaturated)
    from[2] = adjusted_hue(to, from[0]);
  else if (to[1] < kUnsaturated && from[1] > kUnsaturated)
    to[2] = adjusted_hue(from, to[0]);
  return {ColorSpace::diverging, begin, end, from, to};
}

/// Puts white, or a brighter grey, between two saturated colours of different hue.
void append_diverging(const ColormapPreset::Node& a, const ColormapPreset::Node& b,
                      std::vector<ColorPath>& paths) {
  const Triple from = lab_to_msh(rgb_to_lab(a.rgb));
  const Triple to = lab_to_msh(rgb_to_lab(b.rgb));
  const bool distinct =
      from[1] > kUnsaturated && to[1] > kUnsaturated && angle_between(from[2], to[2]) > 0.33 * pi;
  if (!distinct) {
    paths.push_back(diverging_path(a.scalar, b.scalar, from, to));
    return;
  }
  const Triple middle{std::max({88.0, from[0], to[0]}), 0, 0};
  const double half = 0.5 * (a.scalar + b.scalar);
  paths.push_back(diverging_path(a.scalar, half, from, middle));
  paths.push_back(diverging_path(half, b.scalar, middle, to));
}

ColorPath hsv_path(const ColormapPreset::Node& a, const ColormapPreset::Node& b, bool wrapped) {
  Triple from = rgb_to_hsv(a.rgb);
  Triple to = rgb_to_hsv(b.rgb);
  if (wrapped && std::fabs(from[0] - to[0]) > 0.5) {
    if (from[0] > to[0])
      from[0] -= 1;
    else
      to[0] -= 1;
  }
  return {ColorSpace::hsv, a.scalar, b.scalar, from, to};
}

/// Returns the paths between neighbouring nodes, in order; there is none where two nodes make a
/// step.
std::vector<ColorPath> paths_of(const ColormapPreset& preset, ColorEncoding encoding) {
  std::vector<ColorPath> paths;
  for (std::size_t i = 0; i + 1 < preset.nodes.size(); ++i) {
    const auto& a = preset.nodes[i];
    const auto& b = preset.nodes[i + 1];
    if (!(a.scalar < b.scalar)) continue;
    switch (preset.space) {
      case ColorSpace::rgb:
        paths.push_back({ColorSpace::rgb, a.scalar, b.scalar, a.rgb, b.rgb});
        break;
      case ColorSpace::step:  // an interval has the colour of its upper end
        paths.push_back({ColorSpace::step, a.scalar, b.scalar, b.rgb, b.rgb});
        break;
      case ColorSpace::lab:
        paths.push_back(
            {ColorSpace::lab, a.scalar, b.scalar, rgb_to_lab(a.rgb), rgb_to_lab(b.rgb)});
        break;
      case ColorSpace::hsv:
      case ColorSpace::hsv_wrapped:
        paths.push_back(hsv_path(a, b, preset.space == ColorSpace::hsv_wrapped));
        break;
      case ColorSpace::diverging:
        append_diverging(a, b, paths);
        break;
    }
  }
  for (ColorPath& path : paths) path.encoding = encoding;
  return paths;
}

// Chords in place of paths -----------------------------------------------------------------------

/// A straight line in RGB over the part [t0, t1] of a path.
struct Chord {
  double t0;
  double t1;
  Triple from;
  Triple to;
};

/// Covers the rounding errors of bounds that are evaluated in double precision: some hundred
/// operations on numbers up to 1e2, whose errors are multiplied by slopes of at most 13 (sRGB near
/// black).
constexpr double kRoundingMargin = 1e-11;

/// How far apart two values of a channel are: in what the numbers are, linear or display values.
double difference(double a, double b, ColorEncoding encoding) {
  if (encoding == ColorEncoding::linear) return std::fabs(a - b);
  return std::fabs(gamma_encoded(std::max(a, 0.0)) - gamma_encoded(std::max(b, 0.0)));
}

/// The largest factor from differences of linear values of at least `least` to `difference`: the
/// slope of sRGB's function, which decreases.
double steepness(double least, ColorEncoding encoding) {
  if (encoding == ColorEncoding::linear) return 1;
  return least > 0.0031308 ? 1.055 / 2.4 * std::pow(least, 1 / 2.4 - 1) : 12.92;
}

/// Bounds |path - chord|, as `difference` measures it, over [t0, t1] by the smaller one of plain
/// interval arithmetic and, where the path is continuous, the mean value form. The chord's line may
/// begin before and end after that.
double difference_bound(const ColorPath& path, const Chord& chord, double t0, double t1) {
  const std::array<Range, 3> whole = color_at(path, Range({t0, t1}, {1, 1}));
  const double middle = 0.5 * (t0 + t1);
  const Triple center = color_at(path, middle);
  double bound = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double slope = (chord.to[c] - chord.from[c]) / (chord.t1 - chord.t0);
    const auto line = [&](double t) { return chord.from[c] + slope * (t - chord.t0); };
    const auto [low, high] = std::minmax({line(t0), line(t1)});
    double channel = (whole[c].value + Interval{-high, -low}).largest();
    if (whole[c].continuous) {
      const double steepest = (whole[c].slope + Interval{-slope, -slope}).largest();
      channel = std::min(channel, std::fabs(center[c] - line(middle)) + 0.5 * (t1 - t0) * steepest);
    }
    bound = std::max(bound, channel * steepness(std::min(whole[c].value.low, low), path.encoding));
  }
  return bound + kRoundingMargin;
}

/// CIELAB and sRGB have jumps of less than 2e-6 where their definitions switch formulas: parts this
/// short are not divided further.
constexpr double kShortest = 1e-12;

/// Bounds |path - chord| over [t0, t1], by bisection until the bound is within the tolerance; the
/// bound exceeds the tolerance if the chord fails.
double proven_bound(const ColorPath& path, const Chord& chord, double t0, double t1,
                    double tolerance) {
  const double bound = difference_bound(path, chord, t0, t1);
  if (bound <= tolerance || t1 - t0 < kShortest) return bound;
  const double middle = 0.5 * (t0 + t1);
  const double position = (middle - chord.t0) / (chord.t1 - chord.t0);
  const Triple color = color_at(path, middle);
  for (std::size_t c = 0; c < 3; ++c) {
    const double line = chord.from[c] + position * (chord.to[c] - chord.from[c]);
    if (difference(color[c], line, path.encoding) > tolerance) return bound;
  }
  const double left = proven_bound(path, chord, t0, middle, tolerance);
  if (left > tolerance) return left;
  return std::max(left, proven_bound(path, chord, middle, t1, tolerance));
}

/// Appends the points of chords that follow the path after chord.t0 up to and including chord.t1;
/// returns the bound that they reach.
double append_chords(const ColorPath& path, const Chord& chord, double tolerance,
                     std::vector<Point>& points) {
  const double bound = proven_bound(path, chord, chord.t0, chord.t1, tolerance);
  if (bound <= tolerance || chord.t1 - chord.t0 < kShortest) {
    const bool at_end = chord.t1 == 1;  // exactly there, where a step may follow
    points.push_back(
        {at_end ? path.end : path.begin + chord.t1 * (path.end - path.begin), chord.to});
    return bound;
  }
  const double middle = 0.5 * (chord.t0 + chord.t1);
  const Triple color = color_at(path, middle);
  const double left = append_chords(path, {chord.t0, middle, chord.from, color}, tolerance, points);
  const double right = append_chords(path, {middle, chord.t1, color, chord.to}, tolerance, points);
  return std::max(left, right);
}

bool same_color(const Triple& a, const Triple& b) {
  constexpr double kSame = 1e-12;  // the rounding error of a conversion and its inverse
  for (std::size_t c = 0; c < 3; ++c)
    if (std::fabs(a[c] - b[c]) > kSame) return false;
  return true;
}

bool is_straight(const ColorPath& path) {
  return path.space == ColorSpace::step ||
         (path.space == ColorSpace::rgb && path.encoding == ColorEncoding::linear);
}

/// Appends a point unless it repeats the last one.
void append_distinct(std::vector<Point>& points, const Point& point) {
  if (points.empty() || points.back().scalar != point.scalar ||
      !same_color(points.back().value, point.value))
    points.push_back(point);
}

/// The colours below the first node and above the last: the nodes' colours or, where a path begins
/// or ends, the path's own, which differ slightly after conversions there and back.
std::array<Triple, 2> outer_colors(const ColormapPreset& preset,
                                   const std::vector<ColorPath>& paths, ColorEncoding encoding) {
  const auto& first = preset.nodes.front();
  const auto& last = preset.nodes.back();
  std::array<Triple, 2> colors{decoded(first.rgb, encoding), decoded(last.rgb, encoding)};
  if (paths.empty() || preset.space == ColorSpace::step) return colors;
  if (preset.nodes[1].scalar > first.scalar) colors[0] = color_at(paths.front(), 0.0);
  if (preset.nodes[preset.nodes.size() - 2].scalar < last.scalar)
    colors[1] = color_at(paths.back(), 1.0);
  return colors;
}

// Fewer points ------------------------------------------------------------------------------------

/// The point between `first` and `last`, not counting these, at which the line through them differs
/// most on a display, and by how much.
std::pair<std::size_t, double> farthest(const std::vector<Point>& points, std::size_t first,
                                        std::size_t last) {
  std::pair<std::size_t, double> found{first, 0};
  const Point& a = points[first];
  const Point& b = points[last];
  for (std::size_t i = first + 1; i < last; ++i) {
    const double t = (points[i].scalar - a.scalar) / (b.scalar - a.scalar);
    for (std::size_t c = 0; c < 3; ++c) {
      const double line = between(a.value[c], b.value[c], t);
      const double distance = difference(points[i].value[c], line, ColorEncoding::srgb);
      if (distance > found.second) found = {i, distance};
    }
  }
  return found;
}

/// Marks the points of [first, last], none of them a step, that lines between the others miss by
/// more than the tolerance (D. Douglas and T. Peucker, 1973).
void mark_needed(const std::vector<Point>& points, std::size_t first, std::size_t last,
                 double tolerance, std::vector<bool>& needed) {
  std::vector<std::pair<std::size_t, std::size_t>> parts{{first, last}};
  while (!parts.empty()) {
    const auto [begin, end] = parts.back();
    parts.pop_back();
    needed[begin] = needed[end] = true;
    const auto [split, distance] = farthest(points, begin, end);
    if (distance <= tolerance) continue;
    parts.emplace_back(begin, split);
    parts.emplace_back(split, end);
  }
}

/// The points without those that the tolerance does not need.
std::vector<Point> thinned_out(const std::vector<Point>& points, double tolerance) {
  std::vector<bool> needed(points.size(), false);
  for (std::size_t first = 0; first < points.size();) {
    std::size_t last = first;
    while (last + 1 < points.size() && points[last + 1].scalar > points[last].scalar) ++last;
    mark_needed(points, first, last, tolerance, needed);
    first = last + 1;
  }
  std::vector<Point> kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (needed[i]) kept.push_back(points[i]);
  return kept;
}

/// Bounds the difference of all paths from the lines between points, within the tolerance if they
/// are.
double bound_of_points(const std::vector<ColorPath>& paths, const std::vector<Point>& points,
                       double tolerance) {
  double bound = 0;
  std::size_t at = 0;
  for (const ColorPath& path : paths) {
    const double extent = path.end - path.begin;
    while (at > 0 && points[at].scalar > path.begin) --at;
    for (; at + 1 < points.size() && points[at].scalar < path.end; ++at) {
      const Point& a = points[at];
      const Point& b = points[at + 1];
      if (b.scalar <= path.begin || b.scalar == a.scalar) continue;
      const Chord chord{(a.scalar - path.begin) / extent, (b.scalar - path.begin) / extent, a.value,
                        b.value};
      bound = std::max(bound, proven_bound(path, chord, std::max(chord.t0, 0.0),
                                           std::min(chord.t1, 1.0), tolerance));
    }
  }
  return bound;
}

/// Leaves out points where the result is proven to be within the tolerance all the same.
void thin_out(const std::vector<ColorPath>& paths, double tolerance, LinearizedPreset& linear) {
  std::vector<Point> fewer = thinned_out(linear.points, 0.75 * tolerance);
  const double bound = bound_of_points(paths, fewer, tolerance);
  if (bound > tolerance) return;
  linear = {std::move(fewer), bound};
}

}  // namespace

std::array<double, 3> preset_color(const ColormapPreset& preset, double scalar,
                                   ColorEncoding encoding) {
  const std::vector<ColorPath> paths = paths_of(preset, encoding);
  const auto [below, above] = outer_colors(preset, paths, encoding);
  if (scalar < preset.nodes.front().scalar) return below;
  const auto after = std::upper_bound(paths.begin(), paths.end(), scalar,
                                      [](double s, const ColorPath& p) { return s < p.end; });
  if (after == paths.end()) return above;
  return color_at(*after, (scalar - after->begin) / (after->end - after->begin));
}

LinearizedPreset linearize(const ColormapPreset& preset, double low, double high, double tolerance,
                           ColorEncoding encoding) {
  if (!(low < high) || !(tolerance > 0))
    throw std::invalid_argument("a colour map's range must grow and its tolerance be positive");
  const std::vector<ColorPath> paths = paths_of(preset, encoding);
  const auto [below, above] = outer_colors(preset, paths, encoding);
  // decoded maps have more points than they need: most of the tolerance is for dropping some
  const bool decodes = encoding == ColorEncoding::srgb;
  const double share = decodes ? 0.125 * tolerance : tolerance;
  LinearizedPreset result{{{preset.nodes.front().scalar, below}}, 0};
  std::vector<Point>& points = result.points;
  for (const ColorPath& path : paths) {
    const Triple end = color_at(path, 1.0);
    append_distinct(points, {path.begin, color_at(path, 0.0)});
    if (is_straight(path)) {
      points.push_back({path.end, end});
    } else {
      const Chord whole{0, 1, points.back().value, end};
      result.bound = std::max(result.bound, append_chords(path, whole, share, points));
    }
  }
  append_distinct(points, {preset.nodes.back().scalar, above});
  if (decodes) thin_out(paths, tolerance, result);
  const double first = preset.nodes.front().scalar;
  const double extent = preset.nodes.back().scalar - first;
  if (low == first && high == preset.nodes.back().scalar) return result;
  for (Point& point : points) {
    const double position = extent > 0 ? (point.scalar - first) / extent : 0;
    point.scalar = (1 - position) * low + position * high;
  }
  return result;
}

}  // namespace hiac
