#include "hiac/render/cells/volume_along_ray.hpp"

#include <algorithm>
#include <limits>

#include "hiac/optics/polynomial_piece.hpp"

namespace hiac {
namespace {

// The largest world length per unit of the ray parameter in a tile.
double longest_unit(const Projector& projector, const TileRect& tile) {
  double longest = 0;
  for (const int x : {tile.x0, tile.x1})
    for (const int y : {tile.y0, tile.y1}) longest = std::max(longest, projector.ray_scale(x, y));
  return longest;
}

}  // namespace

VolumeAlongRay::VolumeAlongRay(const Frame& frame, const TileRect& tile)
    : frame_(frame),
      optics_(frame.optics),
      glow_(optics_.emission ? Glow::emission : Glow::chromaticity),
      longest_(frame.depth * longest_unit(frame.projector, tile)),
      count_(optics_.same_field ? 1 : 2) {}

void VolumeAlongRay::enter(CellId cell) {
  extinction_ = cell_scalars(frame_.mesh, cell, frame_.extinction, optics_.extinction);
  color_ = optics_.same_field ? extinction_
                              : cell_scalars(frame_.mesh, cell, frame_.color, optics_.color);
  shares_ = tolerance_shares(order_of(frame_.mesh.kinds[cell]));
  set_allowed_errors(frame_, longest_, shares_.field * frame_.tolerance, color_, extinction_);
  fields_ = {extinction_.nodes, color_.nodes};
  is_uniform_ = is_flat(optics_.extinction, extinction_) && is_flat(optics_.color, color_);
}

bool VolumeAlongRay::is_empty() const {
  return is_empty_space(optics_, color_.intervals, extinction_.intervals);
}

PlainRadiance VolumeAlongRay::radiance(const RayStretch& stretch, double scale,
                                       const FieldAlongRay& field, double visible) {
  quadrature_ = {};
  const double length = (stretch.back - stretch.front) * scale;
  return is_uniform_ ? uniform(length) : integrated(stretch, length, field, visible);
}

PlainRadiance VolumeAlongRay::uniform(double length) const {
  const double depth = optics_.extinction_function(extinction_.nodes.least)[0] * length;
  const auto color = optics_.color_function(color_.nodes.least);
  const LinearPieceWeights weights = linear_piece_by_rule(optics_.rule, glow_, depth, depth);
  const double weight = (weights.front + weights.back) * (optics_.emission ? length : 1);
  return {{weight * color[0], weight * color[1], weight * color[2]}, weights.transparency};
}

PlainRadiance VolumeAlongRay::integrated(const RayStretch& stretch, double length,
                                         const FieldAlongRay& field, double visible) {
  const double tolerance = allowed_error(stretch.front, stretch.back, visible);
  field.along(stretch, pieces_);
  if (optics_.unsliced) return unsliced(length);
  PlainRadiance radiance;
  for (const FieldAlongRay::Piece& piece : pieces_) {
    const double share = piece.end - piece.begin;
    const PolynomialSegment segment{piece.fields[optics_.same_field ? 0 : 1], piece.fields[0],
                                    share * length};
    if (optics_.rule != PieceRule::exact) {
      radiance.add_behind(integrate_segment_by_rule(optics_.rule, segment, optics_.color_function,
                                                    optics_.extinction_function, glow_));
      continue;
    }
    const SegmentRadiance r =
        integrate_segment(segment, optics_.color_function, optics_.extinction_function, glow_,
                          std::max(share * tolerance, std::numeric_limits<double>::min()));
    radiance.add_behind({r.rgb, r.transparency});
    quadrature_.radiance += r.error + quadrature_.transparency * std::ranges::max(r.rgb);
    quadrature_.transparency += r.transparency_error;
  }
  return radiance;
}

// The radiance from the fields at both ends of pieces_.
PlainRadiance VolumeAlongRay::unsliced(double length) const {
  const std::size_t color = optics_.same_field ? 0 : 1;
  const auto &front = pieces_.front().fields, &back = pieces_.back().fields;
  return integrate_unsliced(optics_.rule, length, optics_.color_function(evaluate(front[color], 0)),
                            optics_.color_function(evaluate(back[color], 1)),
                            optics_.extinction_function(evaluate(front[0], 0))[0],
                            optics_.extinction_function(evaluate(back[0], 1))[0], glow_);
}

}  // namespace hiac
