#include "hiac/render/edges/screen_edges.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "hiac/render/edges/chosen_edges.hpp"

namespace hiac {
namespace {

using Point = std::array<double, 3>;

constexpr std::size_t kPieces = 16;
// Of a piece's farther end: how near the eye plane a piece in perspective may come.
constexpr double kNearest = 1e-6;

// A point of an edge, whose nodes divide it evenly: Lagrange's interpolation.
Point point_on(std::span<const Point> nodes, double s) {
  const double last = static_cast<double>(nodes.size() - 1);
  Point point{};
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    double weight = 1;
    for (std::size_t j = 0; j < nodes.size(); ++j)
      if (j != k)
        weight *=
            (s * last - static_cast<double>(j)) / (static_cast<double>(k) - static_cast<double>(j));
    for (std::size_t c = 0; c < 3; ++c) point[c] += weight * nodes[k][c];
  }
  return point;
}

Point between(const Point& a, const Point& b, double s) {
  return {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])};
}

// The part of a piece within the range of depths, as shares of its length: from one depth to
// another. None if nothing is left.
std::optional<std::array<double, 2>> clip(double from, double to, double near, double far) {
  if (std::max(from, to) < near || std::min(from, to) > far) return std::nullopt;
  const auto at = [&](double depth) { return (depth - from) / (to - from); };
  std::array<double, 2> kept{0, 1};
  if (from < near) kept[0] = at(near);
  if (from > far) kept[0] = at(far);
  if (to < near) kept[1] = at(near);
  if (to > far) kept[1] = at(far);
  return kept;
}

ProjectedNode on_screen(const Projector& projector, const Point& p) {
  const bool perspective = projector.perspective();
  const double scale = projector.pixels_per_unit() / (perspective ? p[2] : 1);
  const Projector::Axes axes = projector.axes();
  return {axes.center_x + scale * p[0], axes.center_y - scale * p[1],
          perspective ? -1 / p[2] : p[2]};
}

}  // namespace

ScreenEdges::ScreenEdges(const Frame& frame, const Scene& scene) {
  if (!scene.edges) return;
  look_ = *scene.edges;
  MeshEdges of_mesh = mesh_edges(frame.mesh, look_);
  boundary_ = std::move(of_mesh.boundary);
  add_all(frame, of_mesh.edges);
  deal_out(scene.image);
}

ScreenEdges::ScreenEdges(const Frame& frame, const Scene& scene, std::vector<std::uint8_t> boundary,
                         std::span<const EdgeNodes> edges)
    : look_(*scene.edges), boundary_(std::move(boundary)) {
  add_all(frame, edges);
  deal_out(scene.image);
}

void ScreenEdges::add_all(const Frame& frame, std::span<const EdgeNodes> edges) {
  for (const EdgeNodes& edge : edges) {
    std::array<Point, 4> nodes;
    for (std::size_t k = 0; k < edge.count; ++k)
      nodes[k] = frame.projector.camera_coordinates(frame.mesh.position(edge.nodes[k]));
    const std::array<NodeId, 2> both{edge.nodes[0], edge.nodes[edge.count - 1]};
    if (!is_curved(frame.mesh, edge, frame.straightness)) {
      add(frame, std::array{nodes[0], nodes[edge.count - 1]}, 0, 1, both);
      continue;
    }
    for (std::size_t k = 0; k < kPieces; ++k)
      add(frame, std::span(nodes).first(edge.count), static_cast<double>(k) / kPieces,
          static_cast<double>(k + 1) / kPieces, both);
  }
}

// Adds the piece of an edge between two places along it, by the edge's nodes in camera coordinates.
void ScreenEdges::add(const Frame& frame, std::span<const Point> nodes, double from, double to,
                      const std::array<NodeId, 2>& edge) {
  const Projector& projector = frame.projector;
  Point a = point_on(nodes, from), b = point_on(nodes, to);
  double near = projector.near();
  if (projector.perspective()) near = std::max(near, kNearest * std::max(a[2], b[2]));
  if (projector.perspective() && !(std::max(a[2], b[2]) > 0)) return;
  const auto kept = clip(a[2], b[2], near, projector.far());
  if (!kept) return;
  const auto [low, high] = *kept;
  const Point whole_a = a, whole_b = b;
  if (low > 0) a = between(whole_a, whole_b, low);
  if (high < 1) b = between(whole_a, whole_b, high);
  const ProjectedNode p = on_screen(projector, a), q = on_screen(projector, b);
  const double length = to - from;
  from += low * length;
  to -= (1 - high) * length;
  pieces_.push_back({p.x,
                     p.y,
                     p.depth,
                     q.x,
                     q.y,
                     q.depth,
                     from,
                     to,
                     edge,
                     {from == 0 ? edge[0] : kNoNode, to == 1 ? edge[1] : kNoNode}});
}

// Calls visit(tile) for the tiles that the box around a piece meets.
template <typename Visit>
void ScreenEdges::visit_tiles(const EdgePiece& piece, ImageSize size, const Visit& visit) const {
  const double reach = look_.width / 2;
  // pixels whose squares the box meets
  const auto range = [&](double a, double b, std::uint32_t side) {
    const double low = std::floor(std::min(a, b) - reach), high = std::ceil(std::max(a, b) + reach);
    return std::array{static_cast<int>(std::clamp(low, 0.0, static_cast<double>(side))),
                      static_cast<int>(std::clamp(high, 0.0, static_cast<double>(side)))};
  };
  const auto [x0, x1] = range(piece.x0, piece.x1, size.width);
  const auto [y0, y1] = range(piece.y0, piece.y1, size.height);
  if (x0 >= x1 || y0 >= y1) return;
  constexpr int kWidth = kTileWidth, kHeight = kTileHeight;
  for (int row = y0 / kHeight; row <= (y1 - 1) / kHeight; ++row)
    for (int column = x0 / kWidth; column <= (x1 - 1) / kWidth; ++column)
      visit(tile_at(column * kWidth, row * kHeight));
}

void ScreenEdges::deal_out(ImageSize size) {
  columns_ = (size.width + kTileWidth - 1) / kTileWidth;
  const std::size_t tiles = columns_ * ((size.height + kTileHeight - 1) / kTileHeight);
  first_.assign(tiles + 1, 0);
  for (const EdgePiece& piece : pieces_)
    visit_tiles(piece, size, [&](std::size_t tile) { ++first_[tile + 1]; });
  for (std::size_t tile = 0; tile < tiles; ++tile) first_[tile + 1] += first_[tile];
  in_tile_.resize(first_.back());
  std::vector<std::uint64_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t k = 0; k < pieces_.size(); ++k)
    visit_tiles(pieces_[k], size, [&](std::size_t tile) { in_tile_[next[tile]++] = k; });
}

}  // namespace hiac
