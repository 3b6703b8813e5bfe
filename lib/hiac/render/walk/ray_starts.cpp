#include "hiac/render/walk/ray_starts.hpp"

#include <algorithm>
#include <mutex>
#include <optional>
#include <tuple>

#include "hiac/base/parallel.hpp"
#include "hiac/frame/tiles/tile.hpp"

namespace hiac {
namespace {

constexpr std::size_t kFacesPerRange = std::size_t{1} << 11;

struct PixelHit {
  std::uint32_t pixel;
  BoundaryHit hit;
};

// The depth of a face at a point, if that lies in the face.
std::optional<double> depth_at(const RayScene& scene, const std::array<NodeId, 3>& corners,
                               double x, double y) {
  const auto node = [&](std::size_t k) -> const RayNode& { return scene.nodes[corners[k]]; };
  const bool left = is_left(node(0), corners[0], node(1), corners[1], x, y);
  if (is_left(node(1), corners[1], node(2), corners[2], x, y) != left ||
      is_left(node(2), corners[2], node(0), corners[0], x, y) != left)
    return std::nullopt;
  double sum = 0, weighted = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const RayNode &a = node((k + 1) % 3), &b = node((k + 2) % 3);
    const double weight = std::abs((a.x - x) * (b.y - y) - (a.y - y) * (b.x - x));
    sum += weight;
    weighted += weight * (node(k).depth - node(0).depth);
  }
  return sum > 0 ? node(0).depth + weighted / sum : node(0).depth;
}

void add_hits(const RayScene& scene, ImageSize size, std::uint32_t face,
              std::vector<PixelHit>& hits) {
  const std::array<NodeId, 3>& corners = scene.mesh.boundary()[face].corners;
  const RayNode &a = scene.nodes[corners[0]], &b = scene.nodes[corners[1]],
                &c = scene.nodes[corners[2]];
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
  const int width = static_cast<int>(size.width), height = static_cast<int>(size.height);
  const int x0 = first_center(left, 0, width), y0 = first_center(top, 0, height);
  for (int y = y0; y < height && pixel_center(y) <= bottom; ++y)
    for (int x = x0; x < width && pixel_center(x) <= right; ++x)
      if (const auto depth = depth_at(scene, corners, pixel_center(x), pixel_center(y)))
        hits.push_back({static_cast<std::uint32_t>(y) * size.width + static_cast<std::uint32_t>(x),
                        {face, *depth}});
}

}  // namespace

RayStarts::RayStarts(const RayScene& scene, ImageSize size) : width_(size.width) {
  std::vector<std::vector<PixelHit>> found;
  std::mutex joining;
  parallel_for(scene.mesh.boundary().size(), kFacesPerRange, [&](IndexRange range) {
    std::vector<PixelHit> here;
    for (std::size_t face = range.begin; face < range.end; ++face)
      add_hits(scene, size, static_cast<std::uint32_t>(face), here);
    const std::scoped_lock lock(joining);
    found.push_back(std::move(here));
  });
  // a counting sort by pixel, then each pixel's few hits by depth
  first_.assign(width_ * size.height + 1, 0);
  for (const auto& part : found)
    for (const PixelHit& at : part) ++first_[at.pixel + 1];
  for (std::size_t pixel = 1; pixel < first_.size(); ++pixel) first_[pixel] += first_[pixel - 1];
  hits_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const auto& part : found)
    for (const PixelHit& at : part) hits_[next[at.pixel]++] = at.hit;
  for (std::size_t pixel = 0; pixel + 1 < first_.size(); ++pixel)
    std::sort(hits_.begin() + first_[pixel], hits_.begin() + first_[pixel + 1],
              [](const BoundaryHit& a, const BoundaryHit& b) {
                return std::tie(a.depth, a.face) < std::tie(b.depth, b.face);
              });
}

}  // namespace hiac
