#include "hiac/render/tetrahedra/higher_order_details.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/render/bounds/ray_displacement.hpp"
#include "hiac/render/cells/planar_crossing.hpp"

namespace hiac {

HigherOrderDetails::HigherOrderDetails(const Frame& frame, const TileRect& tile)
    : frame_(frame), volume_(frame, tile), errors_(frame, volume_.longest()) {}

void HigherOrderDetails::enter(CellId cell) {
  if (!frame_.with_error) return;
  const CellKind kind = frame_.mesh.kinds[cell];
  volume_.enter(cell);
  nodes_ = relative_positions(frame_.mesh, cell, frame_.projector);
  map_.emplace(kind, nodes_, frame_.straightness);
  field_.emplace(kind, *map_, volume_.fields());
  errors_.enter(cell, nodes_, volume_.color(), volume_.extinction(),
                ray_displacement(frame_, cell));
}

SegmentDetails HigherOrderDetails::describe(const Segment& segment) {
  const PlainRadiance& drawn = segment.radiance;
  SegmentDetails details{.front = segment.front, .back = segment.back, .first = segment.front};
  details.light = std::ranges::max(drawn.rgb);
  details.transparency = drawn.transparency;
  details.mean = 0.5 * (segment.front + segment.back);
  if (!frame_.with_error) return details;
  const CellCrossing crossing =
      planar_crossing(frame_.projector, segment.x, segment.y, segment.front, segment.back);
  const RayStretch stretch = stretch_of(frame_.projector, crossing);
  const PlainRadiance alone = volume_.radiance(stretch, segment.scale, *field_, segment.visible);
  for (std::size_t c = 0; c < 3; ++c)
    details.radiance_error =
        std::max(details.radiance_error, std::abs(drawn.rgb[c] - alone.rgb[c]));
  details.transparency_error = std::abs(drawn.transparency - alone.transparency);
  details.radiance_error += volume_.quadrature().radiance;
  details.transparency_error += volume_.quadrature().transparency;
  errors_.add(crossing, stretch, segment.scale, *field_, {}, details);
  return details;
}

}  // namespace hiac
