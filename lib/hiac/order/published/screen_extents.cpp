#include "hiac/order/published/screen_extents.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hiac/base/parallel.hpp"
#include "hiac/geometry/box.hpp"
#include "hiac/geometry/predicates.hpp"
#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

constexpr std::size_t kScreenExtentsGrain = 1 << 13;
// A bound of the rounding of window coordinates to float, including their computation.
constexpr float kWidening = 4e-7F;
// One window suffices if every node's depth exceeds this fraction of its distance from the axis.
constexpr double kWellBefore = 1e-2;
// A node whose depth is less than this fraction of its distance from the axis has no place on a
// window.
constexpr double kBarelyBefore = 1e-6;

// A node's place on a window, if it lies in front of the eye, and the sides of the window beyond
// which it lies (beyond the plane through the eye and that side).
struct SeenNode {
  float x, y;
  bool before;
  std::uint8_t outside;  // a bit per side
};

// A projection plane: three orthogonal axes, the third of which points towards the plane.
class ProjectionPlane {
 public:
  ProjectionPlane(const View& view, const Vector& towards, const Vector& origin)
      : axis_(unit(towards)), origin_(origin), perspective_(view.perspective) {
    Vector other{};
    const auto size = [&](std::size_t c) { return std::abs(axis_[c]); };
    other[size(0) <= size(1) ? (size(0) <= size(2) ? 0U : 2U) : (size(1) <= size(2) ? 1U : 2U)] = 1;
    right_ = unit(cross(axis_, other));
    up_ = cross(axis_, right_);
  }

  // The coordinates of a point along the axes, relative to the origin.
  [[nodiscard]] Vector seen(Point3 p) const {
    const Vector v{p[0] - origin_[0], p[1] - origin_[1], p[2] - origin_[2]};
    return {dot(v, right_), dot(v, up_), dot(v, axis_)};
  }

  [[nodiscard]] bool all_well_before(const ZooMesh& mesh) const {
    for (NodeId node = 0; node < mesh.node_count(); ++node) {
      const Vector p = seen(mesh.position(node));
      if (!(p[2] > kWellBefore * (std::abs(p[0]) + std::abs(p[1])))) return false;
    }
    return true;
  }

  // Makes the window just large enough for all nodes.
  void fit(const ZooMesh& mesh) {
    Vector low{1, 1, 0}, high{-1, -1, 0};
    bool first = true;
    for (NodeId node = 0; node < mesh.node_count(); ++node) {
      Vector p = seen(mesh.position(node));
      for (std::size_t c = 0; c < 2; ++c) {
        if (perspective_) p[c] /= p[2];
        low[c] = first ? p[c] : std::min(low[c], p[c]);
        high[c] = first ? p[c] : std::max(high[c], p[c]);
      }
      first = false;
    }
    fitted_ = true;
    for (std::size_t c = 0; c < 2; ++c) {
      middle_[c] = low[c] / 2 + high[c] / 2;
      half_[c] = high[c] > low[c] ? high[c] / 2 - low[c] / 2 : 1;
    }
  }

  [[nodiscard]] SeenNode place(Point3 position) const {
    const Vector p = seen(position);
    const double scale = perspective_ ? p[2] : 1;
    SeenNode node{0, 0, true, fitted_ ? std::uint8_t{0} : outside(p)};
    node.before = !perspective_ || p[2] > kBarelyBefore * (std::abs(p[0]) + std::abs(p[1]));
    if (!node.before) return node;
    node.x = static_cast<float>((p[0] / scale - middle_[0]) / half_[0]);
    node.y = static_cast<float>((p[1] / scale - middle_[1]) / half_[1]);
    return node;
  }

 private:
  // The sides beyond which a point lies by more than rounding.
  static std::uint8_t outside(const Vector& p) {
    const double side = p[2] + 1e-9 * (std::abs(p[0]) + std::abs(p[1]) + std::abs(p[2]));
    return static_cast<std::uint8_t>((p[0] > side ? 1U : 0U) | (-p[0] > side ? 2U : 0U) |
                                     (p[1] > side ? 4U : 0U) | (-p[1] > side ? 8U : 0U));
  }

  Vector axis_, right_{}, up_{}, origin_;
  bool perspective_, fitted_ = false;
  std::array<double, 2> middle_{}, half_{1, 1};
};

std::vector<ProjectionPlane> windows_of(const ZooMesh& mesh, const View& view) {
  const Box box = box_of_nodes(mesh);
  Vector middle{};
  for (std::size_t c = 0; c < 3; ++c) middle[c] = box.low[c] / 2 + box.high[c] / 2;
  Vector towards = view.direction;
  if (view.perspective)
    for (std::size_t c = 0; c < 3; ++c) towards[c] = middle[c] - view.eye[c];
  if (towards != Vector{}) {
    ProjectionPlane window(view, towards, view.perspective ? view.eye : middle);
    if (!view.perspective || window.all_well_before(mesh)) {
      window.fit(mesh);
      return {window};
    }
  }
  std::vector<ProjectionPlane> sides;
  for (std::size_t c = 0; c < 3; ++c)
    for (const double sign : {-1.0, 1.0}) {
      Vector side{};
      side[c] = sign;
      sides.emplace_back(view, side, view.eye);
    }
  return sides;
}

struct Bounds {
  float low = std::numeric_limits<float>::infinity(), high = -low;

  void include(float x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

// Returns false if the window does not see the cell.
bool find_extent(std::span<const NodeId> corners, std::span<const SeenNode> nodes,
                 ScreenExtent& extent) {
  Bounds x, y, sum, difference;
  unsigned outside = ~0U;
  bool before = true;
  for (const NodeId corner : corners) {
    const SeenNode& node = nodes[corner];
    outside &= node.outside;
    before = before && node.before;
    x.include(node.x), y.include(node.y);
    sum.include(node.x + node.y), difference.include(node.x - node.y);
  }
  if (outside != 0) return false;
  // a cell that reaches behind the eye may be seen anywhere
  if (!before || !(x.low <= x.high && y.low <= y.high)) {
    extent = {-2, 2, -2, 2, -4, 4, -4, 4};
    return true;
  }
  // coordinates outside the window are less exact
  const float size = std::max({1.F, -x.low, x.high, -y.low, y.high});
  const float widening = kWidening * size;
  extent = {std::max(x.low, -1.F) - kWidening,
            std::min(x.high, 1.F) + kWidening,
            std::max(y.low, -1.F) - kWidening,
            std::min(y.high, 1.F) + kWidening,
            sum.low - widening,
            sum.high + widening,
            difference.low - widening,
            difference.high + widening};
  return true;
}

WindowCells cells_in(const ProjectionPlane& window, const ZooMesh& mesh,
                     std::span<const CellId> cells) {
  std::vector<SeenNode> nodes(mesh.node_count());
  parallel_for(nodes.size(), kScreenExtentsGrain, [&](IndexRange range) {
    for (std::size_t node = range.begin; node < range.end; ++node)
      nodes[node] = window.place(mesh.position(static_cast<NodeId>(node)));
  });
  std::vector<ScreenExtent> extents(cells.size());
  std::vector<std::uint8_t> seen(cells.size());
  parallel_for(cells.size(), kScreenExtentsGrain, [&](IndexRange range) {
    for (std::size_t rank = range.begin; rank < range.end; ++rank) {
      const CellId cell = cells[rank];
      const auto corners = mesh.cell_nodes(cell).first(corner_count(mesh.kinds[cell]));
      seen[rank] = find_extent(corners, nodes, extents[rank]) ? 1 : 0;
    }
  });
  WindowCells in_window;
  for (std::uint32_t rank = 0; rank < cells.size(); ++rank) {
    if (seen[rank] == 0) continue;
    in_window.ranks.push_back(rank);
    in_window.extents.push_back(extents[rank]);
  }
  return in_window;
}

}  // namespace

std::vector<WindowCells> screen_extents(const ZooMesh& mesh, const View& view,
                                        std::span<const CellId> cells) {
  std::vector<WindowCells> all;
  for (const ProjectionPlane& window : windows_of(mesh, view))
    all.push_back(cells_in(window, mesh, cells));
  return all;
}

}  // namespace hiac
