#include "hiac/render/bounds/error_bound.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/base/rounding.hpp"
#include "hiac/base/special_values.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/render/bounds/pixel_error.hpp"

namespace hiac {
namespace {

// J^-T g without the determinant, and the sum of the magnitudes of its terms.
struct Cofactors {
  Vector sum{};
  double size = 0;
};

Cofactors cofactors(const std::array<Vector, 3>& columns, const Vector& g) {
  Cofactors result;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector& a = columns[(k + 1) % 3];
    const Vector& b = columns[(k + 2) % 3];
    const Vector c = cross(a, b);
    for (std::size_t i = 0; i < 3; ++i) result.sum[i] += g[k] * c[i];
    result.size += std::abs(g[k]) * length(a) * length(b);
  }
  return result;
}

// Bounds of one transfer function on the values of a cell, for any channel.
struct FunctionBounds {
  double most = 0, slope = 0, jump = 0, rounding = 0, pieces = 0;
};

template <std::size_t N>
double step_at(const TransferTable<N>& table, std::size_t k) {
  double step = 0;
  for (std::size_t c = 0; c < N; ++c) {
    const auto value = [&](std::size_t i) {
      return table.value[c][i] + table.slope[c][i] * (table.lower[k] - table.anchor[i]);
    };
    step = std::max(step, std::abs(value(k) - value(k - 1)));
  }
  return step;
}

template <std::size_t N>
FunctionBounds function_bounds(const TransferTable<N>& table, ValueRange range,
                               const Arithmetic& numbers) {
  FunctionBounds f;
  const auto value = [&](std::size_t c, std::size_t k, double s) {
    return table.value[c][k] + table.slope[c][k] * (s - table.anchor[k]);
  };
  for (std::size_t k = 0; k < table.intervals(); ++k) {
    const double low = std::max(table.lower[k], range.least);
    const double high = std::min(table.upper[k], range.most);
    if (low > high) continue;
    f.pieces += 1;
    const double reach =
        std::max(std::abs(low - table.anchor[k]), std::abs(high - table.anchor[k]));
    for (std::size_t c = 0; c < N; ++c) {
      const double slope = std::abs(table.slope[c][k]);
      f.most = std::max({f.most, std::abs(value(c, k, low)), std::abs(value(c, k, high))});
      f.slope = std::max(f.slope, slope);
      f.rounding =
          std::max(f.rounding, numbers.function * (std::abs(table.value[c][k]) + slope * reach));
    }
  }
  for (std::size_t k = 1; k < table.intervals(); ++k)
    if (range.least <= table.lower[k] && table.lower[k] <= range.most)
      f.jump += jump_at(table, k, f.rounding);
  f.most += f.rounding;
  return f;
}

// A bound of the length on which a linear field is within its error of a value that it takes along
// a segment.
double doubtful_length(double length, double error, double change) {
  if (error == 0) return 0;
  return 2 * error < change ? length * 2 * error / change : length;
}

// The error of a linear field along a segment whose ends are off by `along`.
double moved_by(double length, double along, double change) {
  if (along == 0) return 0;
  return 4 * along < length ? 2 * change * along / length : change;
}

// An upper bound of e^x - 1.
double exponential_growth(double x) { return x < 0.5 ? x + x * x : kInfinity; }

// An upper bound of x / (1 - x).
double inflated(double x) { return x < 0.5 ? x + 2 * x * x : kInfinity; }

// A bound of the error of c^s, which is 0 for c < 0, if c is wrong by `error`: by the mean value
// theorem away from 0.
double highlight_error(double s, double c, double error) {
  if (c < -error) return 0;
  if (s < 1 && c <= 2 * error) return std::pow(c + error, s);
  const double steepest = s < 1 ? c - error : std::min(1.0, c + error);
  return s * std::pow(steepest, s - 1) * error;
}

}  // namespace

CellOptics cell_optics(const OpticsTables& optics, ValueRange color, ValueRange extinction,
                       const Arithmetic& numbers) {
  const FunctionBounds t = function_bounds(optics.extinction, extinction, numbers);
  const FunctionBounds c = function_bounds(optics.color, color, numbers);
  return {t.most,     t.slope,    t.jump,
          t.rounding, c.most,     c.slope,
          c.jump,     c.rounding, t.pieces + (optics.same_field ? 0 : c.pieces)};
}

double gradient_length(const std::array<Vector, 3>& edges, const Vector& differences) {
  const double rounding = 16 * kUnit * length(edges[0]) * length(edges[1]) * length(edges[2]);
  const double volume = std::abs(dot(edges[0], cross(edges[1], edges[2]))) - rounding;
  const Cofactors c = cofactors(edges, differences);
  return volume > 0 ? (length(c.sum) + 16 * kUnit * c.size) / volume : kInfinity;
}

double gradient_condition(const std::array<Vector, 3>& columns, const Vector& gradient) {
  const Cofactors c = cofactors(columns, gradient);
  const double size = length(c.sum);
  return size > 0 ? inflated(32 * kUnit * c.size / size) / (32 * kUnit) : kInfinity;
}

double field_error(ValueRange range, double gradient, const RayDisplacement& moved,
                   const FieldRounding& rounding, const Arithmetic& numbers) {
  const double difference = range.most - range.least;
  if (difference == 0) return 0;
  const double largest = std::max(std::abs(range.least), std::abs(range.most));
  return std::min(difference, gradient * moved.aside +
                                  numbers.unit * (rounding.of_values * largest +
                                                  rounding.of_range * moved.spread * difference));
}

template <std::size_t N>
double jump_at(const TransferTable<N>& function, std::size_t k, double rounding) {
  const double step = step_at(function, k);
  return step > 2 * rounding ? step : 0;
}

template double jump_at(const TransferTable<1>&, std::size_t, double);
template double jump_at(const TransferTable<3>&, std::size_t, double);

template <std::size_t N>
FieldDoubt linear_doubt(const TransferTable<N>& function, double jump, double rounding,
                        const std::array<long double, 2>& ends, double length, double along,
                        double error) {
  const auto [least, most] = std::minmax(ends[0], ends[1]);
  const auto change = static_cast<double>(most - least);
  FieldDoubt doubt{error + moved_by(length, along, change), 0};
  if (doubt.error == 0 || jump == 0) return doubt;
  double jumps = 0;
  for (std::size_t k = 1; k < function.intervals(); ++k)
    if (least - doubt.error <= function.lower[k] && function.lower[k] <= most + doubt.error)
      jumps += jump_at(function, k, rounding);
  if (jumps > 0) doubt.jumped = jumps * doubtful_length(length, doubt.error, change);
  return doubt;
}

template FieldDoubt linear_doubt(const TransferTable<1>&, double, double,
                                 const std::array<long double, 2>&, double, double, double);
template FieldDoubt linear_doubt(const TransferTable<3>&, double, double,
                                 const std::array<long double, 2>&, double, double, double);

ErrorBound segment_bound(const CellOptics& cell, bool emission, const SegmentFacts& s,
                         const Arithmetic& numbers) {
  const double tau_error =
      cell.tau_slope * s.extinction.error + cell.tau_rounding + 8 * numbers.unit * cell.tau_most;
  const double jumped_depth = s.extinction.jumped;
  const double depth = s.length * tau_error + jumped_depth;
  const double relative = cell.pieces * numbers.piece;
  const double color_error =
      cell.color_slope * s.color.error + cell.color_rounding + 8 * numbers.unit * cell.color_most;
  const double jumped = s.color.jumped;
  const double zeta = s.transparency;
  ErrorBound bound;
  bound.transparency =
      std::min(1.0, zeta * relative + (zeta > 0 ? zeta * exponential_growth(depth) : 0) + kUnit);
  const double most = 1 + exponential_growth(depth);  // bound of e^(A - A')
  if (emission) {
    // int |g' e^-A' - g e^-A|
    bound.radiance = s.length * (color_error + cell.color_most * (depth + relative)) + jumped;
    if (std::isfinite(most))
      bound.radiance = std::min(
          bound.radiance,
          s.seen * (most * color_error + cell.color_most * (most - 1 + relative)) + most * jumped);
  } else if (std::isfinite(most)) {
    // Let d be the error of tau, which holds everywhere, and j the depth that jumps add. Then
    // int |tau' - tau| e^-A' is at most j plus e^(A - A') d int e^-A, and int tau |e^-A' - e^-A| is
    // at most the opacity times e^(d L + j) - 1. It is also at most the opacity times e^j - 1 plus
    // e^j int tau e^-A (e^(d t) - 1), which by parts is at most e^(d L + j) d int e^-A.
    const double weight = std::min(1.0, s.opacity + depth);
    const double seen = most * s.seen * tau_error;
    const double behind =
        std::min(weight * (most - 1), weight * exponential_growth(jumped_depth) + seen);
    bound.radiance = weight * (color_error + cell.color_most * relative) + cell.tau_most * jumped +
                     cell.color_most * (jumped_depth + seen + behind);
  } else {
    bound.radiance = kInfinity;
  }
  if (!emission) bound.radiance = std::min(bound.radiance, 1.001 * cell.color_most);
  return bound;
}

double edge_bound(const CellOptics& cell, bool emission, double length) {
  const double depth = std::min(1.0, cell.tau_most * length);
  const double light = cell.color_most * (emission ? length : depth);
  return std::max(depth, light);
}

ErrorBound cut_bound(const CellOptics& cell, bool emission, double largest_light,
                     const CutFacts& cut, const ErrorBound& shade) {
  const bool doubtful =
      std::abs(cut.front) < cut.front_error || std::abs(cut.back) < cut.back_error;
  if (doubtful) return whole_bound(cell, emission, largest_light, cut.length);
  if (!cut.crossed) return {};
  const double moved = cut_doubt(cut);
  const double volume = cell.color_most * moved * (emission ? 1 : cell.tau_most) +
                        std::min(1.0, cell.tau_most * moved) * largest_light;
  return {shade.radiance + volume, shade.transparency};
}

ErrorBound whole_bound(const CellOptics& cell, bool emission, double largest_light, double length) {
  return {largest_light + cell.color_most * (emission ? length : 1), 1};
}

double cut_doubt(const CutFacts& cut) {
  return doubtful_length(cut.length, std::max(cut.front_error, cut.back_error),
                         std::abs(cut.front - cut.back)) +
         2 * cut.along;
}

ErrorBound shade_bound(const SurfaceLook& surface, std::span<const FrameLight> lights,
                       const std::array<double, 3>& normal, const std::array<double, 3>& ray,
                       double angle, const Arithmetic& numbers) {
  const double facing = std::abs(dot(normal, ray)),
               most_color = *std::ranges::max_element(surface.color);
  angle = std::min(2.0, angle + 16 * numbers.unit);
  const auto transparency = [&](double cosine) {
    return std::exp(surface.log_transparency / std::max(cosine, 1e-300));
  };
  const double here = transparency(facing);
  // wide enough for the differences below to be representable in doubles
  const double band = std::max(angle, 0x1p-50 * facing);
  const double low = transparency(std::max(0.0, facing - band));
  const double high = transparency(facing + band);
  const double side = dot(normal, ray) > 0 ? -1 : 1;
  double light = surface.ambient * most_color, light_error = 0;
  for (const FrameLight& l : lights) {
    const double strength = *std::ranges::max_element(l.color);
    const double to_light = l.headlight ? facing : side * dot(normal, l.direction);
    light += strength * (surface.diffuse * most_color + surface.specular);
    const double towards_eye = l.headlight ? 1 : -dot(ray, l.direction);
    // a highlight begins abruptly at the terminator
    const double highlight =
        std::abs(to_light) <= 2 * angle
            ? 1
            : highlight_error(surface.shininess, 2 * to_light * facing - towards_eye, 6 * angle);
    // the surface may be seen from its other side, which lights other than the headlight illuminate
    const bool either_side = !l.headlight && facing <= angle;
    light_error += strength * (surface.diffuse * most_color * (either_side ? 1 : 2 * angle) +
                               surface.specular * (either_side ? 1 : std::min(1.0, highlight)));
  }
  ErrorBound bound;
  bound.transparency = std::max(high - here, here - low) + 8 * kUnit;
  bound.radiance = (1 - here) * (light_error + 32 * kUnit * light) + light * bound.transparency;
  return bound;
}

double pixel_error(const Frame& frame, const PixelDetails& pixel, double transparency, bool ended,
                   double background) {
  return pixel_error(frame.largest_light, pixel, transparency, ended, background);
}

double pixel_error(double largest_light, const PixelDetails& pixel, double transparency, bool ended,
                   double background) {
  const double left = ended ? transparency : 0;
  // the scene behind replaces the background, and either may be wrong by what the other lacks
  const double behind = left * std::max(largest_light, background) +
                        (ended ? pixel.transparency_error * largest_light : 0);
  const double lost = pixel.transparency_error + pixel.open_edge;
  return std::max(pixel.radiance_error + pixel.open_edge + behind + lost * background,
                  lost + left) +
         4 * kUnit * (1 + background);
}

void count_edges_at_jumps(const Frame& frame, SegmentDetails& details) {
  if (frame.color_field().location == FieldLocation::node &&
      frame.extinction.location == FieldLocation::node)
    return;
  details.radiance_error += details.front_edge + details.back_edge;
  details.transparency_error += details.front_edge + details.back_edge;
}

}  // namespace hiac
