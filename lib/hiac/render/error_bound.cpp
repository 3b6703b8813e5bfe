#include "hiac/render/error_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

constexpr double kUnit = 0x1p-53;
constexpr double kPieceError = 2e-14;
constexpr double kSnapPixels = 0x1p-38;  // projection.cpp, kCenterRounding
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// J^-T g without the determinant, and the sum of what was added up.
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

template <std::size_t N>
void add_function(const TransferTable<N>& table, ValueRange range, double& most, double& slope,
                  double& jump, double& pieces) {
  const auto value = [&](std::size_t c, std::size_t k, double s) {
    return table.value[c][k] + table.slope[c][k] * (s - table.anchor[k]);
  };
  for (std::size_t k = 0; k < table.intervals(); ++k) {
    const double low = std::max(table.lower[k], range.least);
    const double high = std::min(table.upper[k], range.most);
    if (low > high) continue;
    pieces += 1;
    double step = 0;
    for (std::size_t c = 0; c < N; ++c) {
      most = std::max({most, std::abs(value(c, k, low)), std::abs(value(c, k, high))});
      slope = std::max(slope, std::abs(table.slope[c][k]));
      if (k > 0 && table.lower[k] >= range.least)
        step = std::max(step, std::abs(value(c, k, low) - value(c, k - 1, table.lower[k])));
    }
    if (step > 16 * kUnit * most) jump += step;
  }
}

// On how much of a segment a linear field is within its error of a value.
double doubtful_length(double length, double error, double change) {
  return 2 * error < change ? length * 2 * error / change : length;
}

double exponential_growth(double x) { return x < 0.5 ? x + x * x : kInfinity; }

}  // namespace

CellOptics cell_optics(const OpticsTables& optics, ValueRange color, ValueRange extinction) {
  CellOptics cell;
  double color_pieces = 0;
  add_function(optics.extinction, extinction, cell.tau_most, cell.tau_slope, cell.tau_jump,
               cell.pieces);
  add_function(optics.color, color, cell.color_most, cell.color_slope, cell.color_jump,
               color_pieces);
  if (!optics.same_field) cell.pieces += color_pieces;
  return cell;
}

double steepest(CellKind kind, const CellMap& map, double range) {
  const auto order = static_cast<double>(order_of(kind));
  return 16 * order * order * map.steepness() * range;
}

double displacement(const Frame& frame, CellId cell) {
  const Projector& projector = frame.projector;
  double reach = 0, aside = 0, moved = 0;
  const auto at_center = [](double x) { return x - std::floor(x) == 0.5; };
  for (const NodeId node : frame.mesh.cell_nodes(cell)) {
    const Vector c = projector.camera_coordinates(frame.mesh.position(node));
    reach = std::max(reach, length(c));
    const ProjectedNode& p = frame.nodes[node];
    if (std::isnan(p.depth)) {
      moved = kSnapPixels;
      continue;
    }
    aside = std::max({aside, std::abs(p.x), std::abs(p.y)});
    if (at_center(p.x) || at_center(p.y)) moved = kSnapPixels;
  }
  const double pixels = moved + 16 * kUnit * aside;
  return 32 * kUnit * reach +
         pixels * (projector.perspective() ? reach : 1) / projector.pixels_per_unit();
}

double gradient_length(const std::array<Vector, 3>& edges, const Vector& differences) {
  const double volume = std::abs(dot(edges[0], cross(edges[1], edges[2])));
  const double size = length(cofactors(edges, differences).sum);
  return volume > 0 ? size / volume : kInfinity;
}

double gradient_condition(const std::array<Vector, 3>& columns, const Vector& gradient) {
  const Cofactors c = cofactors(columns, gradient);
  const double size = length(c.sum);
  return size > 0 ? c.size / size : kInfinity;
}

double field_error(ValueRange range, double gradient, double aside) {
  const double largest = std::max(std::abs(range.least), std::abs(range.most));
  const double moved = range.most > range.least ? gradient * aside : 0;
  return std::min(range.most - range.least, moved) + 24 * kUnit * largest;
}

ErrorBound segment_bound(const CellOptics& cell, bool emission, const SegmentFacts& s) {
  const double tau_error = cell.tau_slope * s.extinction_error + 8 * kUnit * cell.tau_most;
  double depth = s.length * tau_error;
  if (cell.tau_jump > 0)
    depth += cell.tau_jump * doubtful_length(s.length, s.extinction_error, s.extinction_change);
  const double relative = cell.pieces * kPieceError;
  const double color_error = cell.color_slope * s.color_error + 8 * kUnit * cell.color_most;
  double jumped = 0;
  if (cell.color_jump > 0)
    jumped = cell.color_jump * doubtful_length(s.length, s.color_error, s.color_change);
  const double zeta = s.transparency;
  ErrorBound bound;
  bound.transparency =
      std::min(1.0, zeta * relative + (zeta > 0 ? zeta * exponential_growth(depth) : 0) + kUnit);
  if (emission) {
    bound.radiance = s.length * (color_error + cell.color_most * (depth + relative)) + jumped;
  } else {
    const double weight = std::min(1.0, s.opacity + depth);
    bound.radiance = weight * (color_error + cell.color_most * relative) + cell.tau_most * jumped +
                     2 * cell.color_most * depth;
    bound.radiance = std::min(bound.radiance, cell.color_most);
  }
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
  if (doubtful) return {largest_light + cell.color_most * (emission ? cut.length : 1), 1};
  if (!cut.crossed) return {};
  const double moved = doubtful_length(cut.length, std::max(cut.front_error, cut.back_error),
                                       std::abs(cut.front - cut.back));
  const double volume = cell.color_most * moved * (emission ? 1 : cell.tau_most) +
                        std::min(1.0, cell.tau_most * moved) * largest_light;
  return {shade.radiance + volume, shade.transparency};
}

ErrorBound shade_bound(const FrameIsosurface& surface, std::span<const FrameLight> lights,
                       const std::array<double, 3>& normal, const std::array<double, 3>& ray,
                       double angle) {
  const double facing = std::abs(dot(normal, ray)),
               most_color = *std::ranges::max_element(surface.color);
  angle = std::min(2.0, angle + 16 * kUnit);
  const auto transparency = [&](double cosine) {
    return std::exp(surface.log_transparency / std::max(cosine, 1e-300));
  };
  const double here = transparency(facing);
  const double low = transparency(std::max(0.0, facing - angle));
  const double high = transparency(facing + angle);
  const double side = dot(normal, ray) > 0 ? -1 : 1;
  double light = surface.ambient * most_color, light_error = 0;
  for (const FrameLight& l : lights) {
    const double strength = *std::ranges::max_element(l.color);
    const double to_light = l.headlight ? facing : side * dot(normal, l.direction);
    light += strength * (surface.diffuse * most_color + surface.specular);
    // a highlight moves by three times the normal's angle; it begins at once
    double highlight = surface.shininess >= 1 ? surface.shininess * 6 * angle
                                              : std::pow(6 * angle, surface.shininess);
    if (std::abs(to_light) <= 2 * angle) highlight = 1;
    light_error += strength * (surface.diffuse * most_color * 2 * angle +
                               surface.specular * std::min(1.0, highlight));
  }
  ErrorBound bound;
  bound.transparency = std::max(high - here, here - low) + 8 * kUnit;
  bound.radiance = (1 - here) * (light_error + 32 * kUnit * light) + light * bound.transparency;
  return bound;
}

double pixel_error(const Frame& frame, const PixelDetails& pixel, double transparency,
                   double background) {
  // where the ray was ended early there may be more
  const bool ended = transparency <= frame.least_transparency;
  const double behind = ended ? transparency * frame.largest_light : 0;
  const double lost = pixel.transparency_error + pixel.open_edge + (ended ? transparency : 0);
  return std::max(pixel.radiance_error + pixel.open_edge + behind + lost * background, lost) +
         4 * 0x1p-53 * (1 + background);
}

}  // namespace hiac
