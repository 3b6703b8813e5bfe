#include "hiac/render/bounds/skin_errors.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/base/rounding.hpp"
#include "hiac/base/special_values.hpp"
#include "hiac/element/gradient/gradient_bound.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/render/bounds/normal_doubt.hpp"

namespace hiac {
namespace {

// By order: of the largest value in a cell, where shape functions interpolate it. Up to 32 products
// are summed, 44 roundings at most, of magnitudes that sum to 1.5, 4.8 and 14.4 (kCurvedRounding).
constexpr std::array<double, 3> kShapeRounding{128, 384, 1024};

EndDoubts end_doubts_of(const Frame& frame, CellId cell) {
  const CellKind kind = frame.mesh.kinds[cell];
  const auto nodes = relative_positions(frame.mesh, cell, frame.projector);
  return {kind, std::span(nodes).first(node_count(kind))};
}

double skin_value_error(const CellField& field, double gradient, double off, CellKind kind) {
  RayDisplacement moved;
  moved.aside = off;
  const FieldRounding rounding{kShapeRounding[static_cast<std::size_t>(order_of(kind)) - 1], 0};
  return field_error({field.least, field.most}, gradient, moved, rounding);
}

// How far a function's value may be off, any channel, if the scalar is by `error`.
double skin_color_error(const PiecewiseLinear<3>& colors, double value, double error) {
  const auto exact = colors(value);
  const std::size_t first = colors.interval_of(value - error),
                    last = colors.interval_of(value + error);
  double most = 0, rounding = 0;
  const auto include = [&](std::size_t interval, double s) {
    const auto& piece = colors.piece(interval);
    for (std::size_t c = 0; c < 3; ++c) {
      most = std::max(most, std::abs(piece.channel(c, s) - exact[c]));
      rounding = std::max(
          rounding,
          8 * kUnit * (std::abs(piece.value[c]) + std::abs(piece.slope[c] * (s - piece.anchor))));
    }
  };
  include(first, value - error);
  include(last, value + error);
  for (std::size_t k = first; k < last; ++k) {  // the bends and steps between the two
    include(k, colors.breakpoints()[k]);
    include(k + 1, colors.breakpoints()[k]);
  }
  return most + rounding;
}

}  // namespace

void SkinErrors::enter(CellId cell, const TileRect& tile, std::span<const CellCrossing> rays) {
  cell_ = cell;
  displacement_ = displacement_in_world(frame_, cell);
  end_doubts_ = end_doubts_of(frame_, cell);
  normal_doubts_.fill(std::nullopt);
  values_.reset();
  doubts_.clear();
  append_outline_doubts(frame_, cell, tile, displacement_.at_ends, doubts_);
  add_clipped(tile, rays);
  std::ranges::stable_sort(doubts_, {}, &OutlineDoubt::at);
  hidden_.clear();
  for (const OutlineDoubt& doubt : doubts_)
    if (is_hidden(doubts_at(doubt.at)) && (hidden_.empty() || hidden_.back() != doubt.at))
      hidden_.push_back(doubt.at);
}

// The doubt about a point on a face, along the ray, world units.
double SkinErrors::place_doubt(std::size_t face, int x, int y, double curved_doubt) const {
  if (!std::isnan(curved_doubt)) return curved_doubt + displacement_.along;
  const Vector direction = frame_.projector.direction(pixel_center(x), pixel_center(y));
  return end_doubts_.through(face, direction, displacement_);
}

// Pixels in which rounding decides whether the view clips the skin.
void SkinErrors::add_clipped(const TileRect& tile, std::span<const CellCrossing> rays) {
  const Projector& projector = frame_.projector;
  for (const CellCrossing& ray : rays) {
    const double scale = projector.ray_scale(pixel_center(ray.x), pixel_center(ray.y));
    const auto look_at = [&](std::uint8_t face, double t, double curved_doubt) {
      if ((frame_.skin.on(cell_) >> face & 1U) == 0) return;
      const double moved = place_doubt(face, ray.x, ray.y, curved_doubt) / scale;
      if (std::abs(t - projector.near()) <= moved || std::abs(t - projector.far()) <= moved)
        doubts_.push_back({tile.index(ray.x, ray.y), kInfinity, nullptr});
    };
    look_at(ray.front_face, ray.front, ray.front_doubt);
    look_at(ray.back_face, ray.back, ray.back_doubt);
  }
}

std::span<const OutlineDoubt> SkinErrors::doubts_at(std::size_t at) const {
  const auto found = std::ranges::equal_range(doubts_, at, {}, &OutlineDoubt::at);
  return {found.begin(), found.end()};
}

// Whether nothing is known of a pixel: beside several edges, the ray may meet any of several faces.
bool SkinErrors::is_hidden(std::span<const OutlineDoubt> doubts) {
  return doubts.size() > 1 || (!doubts.empty() && !std::isfinite(doubts.front().angle));
}

double SkinErrors::normal_doubt(const SkinCrossing& crossing, double moved) {
  if (!std::isnan(crossing.reference[0]))
    return curved_normal_doubt(frame_, cell_, crossing.face, crossing.reference,
                               moved + 2 * displacement_.at_ends);
  auto& doubt = normal_doubts_[crossing.face];
  if (!doubt) doubt = planar_normal_doubt(frame_, cell_, crossing.face);
  return *doubt;
}

SkinErrors::CellValues SkinErrors::values_in(CellId cell, double aside) const {
  const CellKind kind = frame_.mesh.kinds[cell];
  const auto nodes = relative_positions(frame_.mesh, cell, frame_.projector);
  CellValues values{cell_field(frame_.mesh, cell, *frame_.skin.field), 0, aside};
  if (values.nodes.least < values.nodes.most)
    values.gradient = GradientBound(kind, std::span(nodes).first(node_count(kind)),
                                    frame_.straightness)(values.nodes);
  return values;
}

double SkinErrors::value_error(double moved) {
  if (!values_) values_ = values_in(cell_, displacement_.aside);
  return skin_value_error(values_->nodes, values_->gradient, values_->aside + moved,
                          frame_.mesh.kinds[cell_]);
}

// Adds the doubts of a point on another cell's face that the ray may meet instead. Returns false if
// nothing is known of it.
bool SkinErrors::add_other(const OutlineDoubt& doubt, const SkinCrossing& crossing, double& moved,
                           double& value) const {
  if (frame_.skin.field && frame_.skin.field->location != FieldLocation::node) return false;
  const SkinSide& side = *doubt.other;
  const RayDisplacement displacement = displacement_in_world(frame_, side.cell);
  const Vector direction =
      frame_.projector.direction(pixel_center(crossing.x), pixel_center(crossing.y));
  const double there = end_doubts_of(frame_, side.cell).through(side.face, direction, displacement);
  if (!std::isfinite(there)) return false;
  moved += there;
  if (!frame_.skin.field) return true;
  const CellValues values = values_in(side.cell, displacement.aside);
  value += skin_value_error(values.nodes, values.gradient, values.aside + there,
                            frame_.mesh.kinds[side.cell]);
  return true;
}

void SkinErrors::add(const SkinCrossing& crossing, std::size_t at, const ShadedPoint& seen,
                     double value, SegmentDetails& details) {
  const double largest = frame_.skin.largest_light;
  const double scale =
      frame_.projector.ray_scale(pixel_center(crossing.x), pixel_center(crossing.y));
  double moved = place_doubt(crossing.face, crossing.x, crossing.y, crossing.doubt);
  const auto doubts = doubts_at(at);
  bool is_whole = is_hidden(doubts) || !std::isfinite(moved);
  double angle = is_whole ? kInfinity : normal_doubt(crossing, moved);
  double value_doubt = is_whole || !frame_.skin.field ? 0 : value_error(moved);
  if (!doubts.empty() && !is_whole) {
    const OutlineDoubt& doubt = doubts.front();
    angle += doubt.angle;
    is_whole = doubt.other != nullptr && !add_other(doubt, crossing, moved, value_doubt);
  }
  details.moved = moved / scale;
  details.in_doubt = largest;
  if (is_whole) {
    details.radiance_error = largest;
    details.transparency_error = 1;
    return;
  }
  SurfaceLook look = frame_.skin.look;
  look.color = seen.color;
  ErrorBound bound = shade_bound(look, frame_.skin.lights, seen.normal, seen.ray, angle);
  if (frame_.skin.field) {
    double reflected = look.ambient;
    for (const FrameLight& light : frame_.skin.lights)
      reflected += std::ranges::max(light.color) * look.diffuse;
    bound.radiance += (1 - seen.shade.transparency + bound.transparency) * reflected *
                      skin_color_error(frame_.skin.colors, value, value_doubt);
  }
  details.radiance_error = std::min(bound.radiance, largest);
  details.transparency_error = std::min(bound.transparency, 1.0);
}

}  // namespace hiac
