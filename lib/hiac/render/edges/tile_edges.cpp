#include "hiac/render/edges/tile_edges.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "hiac/frame/tiles/screen_bounds.hpp"
#include "hiac/render/edges/strip_coverage.hpp"
#include "hiac/render/pixels/compositor.hpp"

namespace hiac {
namespace {

// The end of a piece that is nearer to its place s, if it is within `reach`, of the piece's length.
NodeId end_near(const EdgePiece& piece, double s, double reach) {
  if (std::min(s, 1 - s) > reach) return kNoNode;
  return piece.ends[s < 0.5 ? 0 : 1];
}

// The place along the whole edge of a place along its piece on the screen: in perspective the
// depths tell how far into the picture the piece runs.
double along_edge(const EdgePiece& piece, double s, bool perspective) {
  if (perspective) {
    const double a = (1 - s) * piece.depth0, b = s * piece.depth1;
    s = b / (a + b);
  }
  return piece.from + s * (piece.to - piece.from);
}

void set_light(SegmentDetails& details, const PlainRadiance& light) {
  details.light = std::ranges::max(light.rgb);
  details.transparency = light.transparency;
}

}  // namespace

TileEdges::TileEdges(const Frame& frame, const ScreenEdges& edges, const TileRect& tile)
    : frame_(frame), look_(edges.look()), tile_(tile) {
  edges.visit_in(tile, [&](const EdgePiece& piece) { add(piece); });
  if (empty()) return;
  sort_by_pixel();
  transparency_.assign(kTilePlane, 1);
  layers_of_.assign(kTilePlane, 0);
}

Strip TileEdges::strip_of(const EdgePiece& piece) const {
  return {piece.x0, piece.y0, piece.x1, piece.y1, look_.width};
}

void TileEdges::add(const EdgePiece& piece) {
  const TileRect& tile = tile_;
  const Strip strip = strip_of(piece);
  const double dx = piece.x1 - piece.x0, dy = piece.y1 - piece.y0, square = dx * dx + dy * dy;
  const double reach = look_.width / 2 + 0.5;
  const bool perspective = frame_.projector.perspective();
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
      const double t = perspective ? -1 / depth : depth;
      const NodeId node = end_near(piece, s, reach / std::sqrt(square));
      fragments_.push_back(
          {tile.index(x, y), share, {&piece, along_edge(piece, s, perspective), t, node}});
      left_.add(tile.index(x, y));
    }
  }
}

void TileEdges::sort_by_pixel() {
  first_.assign(kTilePlane + 1, 0);
  for (const Fragment& fragment : fragments_) ++first_[fragment.at + 1];
  for (std::size_t at = 0; at + 1 < first_.size(); ++at) first_[at + 1] += first_[at];
  std::vector<Fragment> sorted(fragments_.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const Fragment& fragment : fragments_) sorted[next[fragment.at]++] = fragment;
  fragments_ = std::move(sorted);
  for (std::size_t at = 0; at + 1 < first_.size(); ++at)
    if (first_[at + 1] - first_[at] > 1)
      std::ranges::stable_sort(
          std::span(fragments_).subspan(first_[at], first_[at + 1] - first_[at]), {},
          [](const Fragment& f) { return f.place.t; });
}

bool TileEdges::may_meet(CellId cell) const {
  if (empty()) return false;
  const ScreenBounds bounds = screen_bounds(frame_, cell);
  int x0 = tile_.x0, y0 = tile_.y0, x1 = tile_.x1, y1 = tile_.y1;
  if (bounds.in_front) {  // a pixel more on all sides than the cell can reach by rounding
    x0 = first_center(bounds.x0, x0, x1, 1);
    x1 = first_center(bounds.x1 + 1, x0, x1);
    y0 = first_center(bounds.y0, y0, y1, 1);
    y1 = first_center(bounds.y1 + 1, y0, y1);
  }
  if (x0 >= x1) return false;
  const std::uint64_t columns = (~std::uint64_t{0} >> (64 - (x1 - x0))) << (x0 - tile_.x0);
  for (int y = y0; y < y1; ++y)
    if ((left_.row(y - tile_.y0) & columns) != 0) return true;
  return false;
}

void TileEdges::append_rest(const TileTarget& to) {
  for (std::uint32_t k = 0; k < fragments_.size(); ++k) {
    if (fragments_[k].is_taken) continue;
    fragments_[k].is_taken = true;
    taken_.assign(1, k);
    add_layer(to, fragments_[k].at, fragments_[k].place.t, fragments_[k].place.t);
  }
  settle(to);
}

// Adds the fragments in taken_ at a depth of a pixel's ray; in a group at a place in its order.
void TileEdges::add_layer(const TileTarget& to, std::size_t at, double at_parameter, double depth) {
  if (!to.is_seen(at)) return;
  SegmentDetails details;
  details.front = details.back = details.first = details.mean = depth;
  details.part = RayPart::edge;
  if (to.group != nullptr) {
    in_group_.push_back({at, at_parameter, taken_, to.group->segments.size()});
    if (frame_.with_details) describe(to, at, details);
    return composite(to, at, at_parameter, at_parameter, {});
  }
  const PlainRadiance light = light_of(opacity_of(at, taken_));
  if (frame_.with_details) {
    set_light(details, light);
    describe(to, at, details);
  }
  composite(to, at, depth, depth, light);
}

void TileEdges::settle(const TileTarget& to) {
  std::ranges::stable_sort(in_group_, {},
                           [](const Taken& taken) { return std::tuple(taken.at, taken.t); });
  for (const Taken& taken : in_group_) {
    const PlainRadiance light = light_of(opacity_of(taken.at, taken.fragments));
    to.group->segments[taken.entry].light = light;
    if (frame_.with_details) set_light(to.group->details[taken.entry], light);
  }
  in_group_.clear();
}

// The opacity of fragments behind all others of their pixel.
double TileEdges::opacity_of(std::size_t at, std::span<const std::uint32_t> fragments) {
  double opacity = std::min(fragments_[fragments.front()].share, 1.0) * look_.opacity;
  if (first_[at + 1] - first_[at] > 1) {
    if (layers_of_[at] == 0) {
      layers_.emplace_back();
      layers_of_[at] = static_cast<std::uint32_t>(layers_.size());
    }
    strips_.clear();
    for (const std::uint32_t k : fragments)
      strips_.push_back({strip_of(*fragments_[k].place.piece), fragments_[k].share});
    opacity = layers_[layers_of_[at] - 1].add(strips_, pixel_center(tile_.column(at)),
                                              pixel_center(tile_.row(at)), look_.opacity);
  }
  transparency_[at] *= 1 - opacity;
  return opacity;
}

PlainRadiance TileEdges::light_of(double opacity) const {
  return {{opacity * look_.color[0], opacity * look_.color[1], opacity * look_.color[2]},
          1 - opacity};
}

}  // namespace hiac
