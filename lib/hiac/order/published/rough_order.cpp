#include "hiac/order/published/rough_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hiac/base/parallel.hpp"
#include "hiac/base/parallel_sort.hpp"
#include "hiac/order/published/depth.hpp"

namespace hiac {
namespace {

constexpr std::size_t kRoughOrderGrain = 1 << 13;
// A bound of a depth's rounding error, relative to the depths and lengths from which it is
// computed.
constexpr double kDepthRounding = 1e-13;

// Returns a depth that no point of a cell falls below. A convex cell lies beyond the plane that
// passes through its nearest corner, across the line from the eye to its centroid.
double nearest_depth(const ZooMesh& mesh, std::span<const NodeId> corners, const View& view,
                     const Depth& depth) {
  std::array<double, 3> axis{};
  if (view.perspective) {
    const auto centroid = mean_position(mesh, corners);
    const double length = 2 * depth(Point3(centroid));
    for (std::size_t c = 0; c < 3; ++c) axis[c] = (centroid[c] - view.eye[c]) / length;
  }
  double nearest = std::numeric_limits<double>::infinity(), size = 0;
  for (const NodeId node : corners) {
    const Point3 p = mesh.position(node);
    const double far = depth(p);
    double near = far;
    if (view.perspective) {
      near = 0;
      for (std::size_t c = 0; c < 3; ++c) near += axis[c] * (p[c] / 2 - view.eye[c] / 2);
    }
    nearest = std::min(nearest, near);
    for (const double x : p) size = std::max(size, std::abs(x));
  }
  for (const double x : view.eye) size = std::max(size, std::abs(x));
  nearest -= kDepthRounding * size;
  // nothing is known if the eye is the centroid or coordinates are near the end of the range
  return std::isfinite(nearest) ? nearest : -std::numeric_limits<double>::infinity();
}

struct Entry {
  double rearmost;
  CellId cell;
};

}  // namespace

RoughOrder rough_order(const ZooMesh& mesh, const View& view) {
  const Depth depth(view);
  std::vector<Entry> entries(mesh.cell_count());
  const auto corners_of = [&](CellId cell) {
    return mesh.cell_nodes(cell).first(corner_count(mesh.kinds[cell]));
  };
  parallel_for(entries.size(), kRoughOrderGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      entries[i] = {-std::numeric_limits<double>::infinity(), static_cast<CellId>(i)};
      for (const NodeId node : corners_of(entries[i].cell))
        entries[i].rearmost = std::max(entries[i].rearmost, depth(mesh.position(node)));
    }
  });
  parallel_sort(entries, [](const Entry& a, const Entry& b) {
    return a.rearmost != b.rearmost ? a.rearmost > b.rearmost : a.cell < b.cell;
  });
  RoughOrder order{std::vector<CellId>(entries.size()), std::vector<double>(entries.size()),
                   std::vector<double>(entries.size())};
  parallel_for(entries.size(), kRoughOrderGrain, [&](IndexRange range) {
    for (std::size_t rank = range.begin; rank < range.end; ++rank) {
      order.cells[rank] = entries[rank].cell;
      order.rearmost[rank] = entries[rank].rearmost;
      order.frontmost[rank] = nearest_depth(mesh, corners_of(entries[rank].cell), view, depth);
    }
  });
  return order;
}

}  // namespace hiac
