#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <ranges>

#include "hiac/geometry/predicates.hpp"
#include "hiac/geometry/view.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The depth of a point along its ray. It increases along every ray except for rounding, so that it
/// cannot decide an order exactly.
class Depth {
 public:
  explicit Depth(const View& view) : view_(view) {
    if (view.perspective) return;
    const auto& d = view.direction;
    const double length = std::hypot(d[0], d[1], d[2]);
    for (std::size_t c = 0; c < 3; ++c) view_.direction[c] = d[c] / length;
  }

  /// Returns the distance to the eye or, in a parallel view, the coordinate along its direction, in
  /// units of two world units, so that no finite coordinates overflow.
  [[nodiscard]] double operator()(Point3 p) const {
    if (view_.perspective)
      return std::hypot(p[0] / 2 - view_.eye[0] / 2, p[1] / 2 - view_.eye[1] / 2,
                        p[2] / 2 - view_.eye[2] / 2);
    const auto& d = view_.direction;
    return p[0] / 2 * d[0] + p[1] / 2 * d[1] + p[2] / 2 * d[2];
  }

 private:
  View view_;
};

/// Returns the mean position of some nodes.
template <std::ranges::sized_range Nodes>
std::array<double, 3> mean_position(const ZooMesh& mesh, const Nodes& nodes) {
  std::array<double, 3> sum{};
  const auto count = static_cast<double>(std::ranges::size(nodes));
  for (const NodeId node : nodes)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += mesh.position(node)[c] / count;
  return sum;
}

/// Returns the depth of the mean of a cell's corners.
inline double centroid_depth(const ZooMesh& mesh, CellId cell, const Depth& depth) {
  return depth(mean_position(mesh, mesh.cell_nodes(cell).first(corner_count(mesh.kinds[cell]))));
}

}  // namespace hiac
