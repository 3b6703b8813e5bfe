#include "hiac/render/edges/tile_edges.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "hiac/render/edges/strip_coverage.hpp"
#include "hiac/render/pixels/compositor.hpp"

namespace hiac {
namespace {

// The end of a piece that is nearer to its place s, if it is within `reach`, of the piece's length.
NodeId end_near(const EdgePiece& piece, double s, double reach) {
  if (std::min(s, 1 - s) > reach) return kNoNode;
  return piece.ends[s < 0.5 ? 0 : 1];
}

}  // namespace

TileEdges::TileEdges(const Frame& frame, const ScreenEdges& edges, const TileRect& tile)
    : frame_(frame), look_(edges.look()) {
  edges.visit_in(tile, [&](const EdgePiece& piece) { add(piece, tile); });
  if (empty()) return;
  std::ranges::stable_sort(fragments_, {},
                           [](const Fragment& f) { return std::tuple(f.at, f.place.t); });
  transparency_.assign(kTileStride * kTileHeight, 1);
  first_.assign(kTileStride * kTileHeight + 1, 0);
  for (const Fragment& fragment : fragments_) ++first_[fragment.at + 1];
  for (std::size_t at = 0; at + 1 < first_.size(); ++at) first_[at + 1] += first_[at];
}

void TileEdges::add(const EdgePiece& piece, const TileRect& tile) {
  const Strip strip{piece.x0, piece.y0, piece.x1, piece.y1, look_.width};
  const double dx = piece.x1 - piece.x0, dy = piece.y1 - piece.y0, square = dx * dx + dy * dy;
  const double reach = look_.width / 2 + 0.5;
  const auto range = [&](double a, double b, int low, int high) {
    return std::array{first_center(std::min(a, b) - reach, low, high),
                      first_center(std::max(a, b) + reach, low, high)};
  };
  const auto [x0, x1] = range(piece.x0, piece.x1, tile.x0, tile.x1);
  const auto [y0, y1] = range(piece.y0, piece.y1, tile.y0, tile.y1);
  // no pixel's square reaches farther from its centre than 0.7072
  const double aside = (look_.width / 2 + 0.7072) * std::sqrt(square);
  for (int y = y0; y < y1; ++y) {
    const double center_y = pixel_center(y);
    int first = x0, last = x1;
    if (dy != 0) {  // where the row passes the strip
      const double middle = piece.x0 + dx * (center_y - piece.y0) / dy, half = aside / std::abs(dy);
      first = first_center(middle - half, x0, x1);
      last = first_center(middle + half, x0, x1);
    }
    for (int x = first; x < last; ++x) {
      const double center_x = pixel_center(x);
      const double share = strip_coverage(strip, center_x, center_y);
      if (!(share > 0)) continue;
      const double s =
          std::clamp(((center_x - piece.x0) * dx + (center_y - piece.y0) * dy) / square, 0.0, 1.0);
      const double depth = piece.depth0 + s * (piece.depth1 - piece.depth0);
      const double t = frame_.projector.perspective() ? -1 / depth : depth;
      const NodeId node = end_near(piece, s, reach / std::sqrt(square));
      fragments_.push_back({tile.index(x, y), share, {&piece, t, node}});
    }
  }
}

void TileEdges::append_rest(const TileTarget& to) {
  for (const Fragment& fragment : fragments_)
    if (fragment.share > 0)
      take(to, fragment.at, fragment.place.t, false, [](const Place&) { return true; });
}

void TileEdges::composite_share(const TileTarget& to, std::size_t at, double at_parameter,
                                double share) {
  if (!to.is_seen(at)) return;
  const double opacity = std::min(share, 1.0) * look_.opacity;
  transparency_[at] *= 1 - opacity;
  const PlainRadiance light{
      {opacity * look_.color[0], opacity * look_.color[1], opacity * look_.color[2]}, 1 - opacity};
  if (frame_.with_details) {
    SegmentDetails details;
    details.front = details.back = details.first = details.mean = at_parameter;
    details.light = std::ranges::max(light.rgb);
    details.transparency = light.transparency;
    details.part = RayPart::edge;
    describe(to, at, details);
  }
  composite(to, at, at_parameter, at_parameter, light);
}

}  // namespace hiac
