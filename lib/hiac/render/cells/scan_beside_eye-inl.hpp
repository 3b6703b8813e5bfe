// Scan conversion of cells that reach beside or behind the eye, compiled once for every instruction
// set. Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_SCAN_BESIDE_EYE_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_SCAN_BESIDE_EYE_INL
#    undef HIAC_RENDER_SCAN_BESIDE_EYE_INL
#  else
#    define HIAC_RENDER_SCAN_BESIDE_EYE_INL
#  endif

#  include <algorithm>
#  include <array>
#  include <bit>
#  include <cmath>
#  include <limits>
#  include <vector>

#  include <hwy/highway.h>

#  include "hiac/frame/tiles/pixel_mask.hpp"
#  include "hiac/render/cells/edge_crossings-inl.hpp"
#  include "hiac/render/cells/ray_crossings-inl.hpp"
#  include "hiac/render/cells/surface_depth-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Triangles off the screen are seen edge-on (kEdgeOnWidth) when they are narrower than this,
// relative to their distance from the eye.
constexpr double kEdgeOn = 64 * std::numeric_limits<double>::epsilon();

// The distance of a point from a plane through the eye, or 0 if it is no more than rounding
// relative to the distance from the eye. Projector does the same for coordinates close to pixel
// centres.
HWY_INLINE double straightened(double distance, double from_eye) {
  constexpr double kRounding = 32 * std::numeric_limits<double>::epsilon();
  return std::abs(distance) <= kRounding * from_eye ? 0 : distance;
}

using Vector = std::array<double, 3>;

// Scans a cell beside the eye, row by row.
class LineScan {
 public:
  LineScan(const Frame& frame, const CellSurface& surface, CurvedFaces* curved,
           const TileRect& tile, const PixelMask* only)
      : frame_(frame),
        surface_(surface),
        curved_(curved),
        tile_(tile),
        only_(only),
        nodes_(projected_nodes(frame, surface)),
        depth_(surface, nodes_) {
    for (std::size_t k = 0; k < surface.corner_count; ++k) {
      camera_[k] = frame.projector.camera_coordinates(frame.mesh.position(surface.nodes[k]));
      projectable_[k] = !std::isnan(nodes_[k].depth);
    }
  }

  void scan(std::vector<CellCrossing>& crossings) {
    const bool in_corners_hull = curved_ == nullptr || !curved_->has_curved_edges();
    if (in_corners_hull && outside_tile()) return;
    for (int y = tile_.y0; y < tile_.y1; ++y)
      if (only_ == nullptr || only_->row(y - tile_.y0) != 0) scan_row(y, crossings);
  }

 private:
  // Whether all corners lie outside one of the planes through the eye and the tile's borders: the
  // tile's pixels see only what lies inside all four.
  [[nodiscard]] bool outside_tile() const {
    const auto [left, top] = frame_.projector.slopes(tile_.x0, tile_.y0);
    const auto [right, bottom] = frame_.projector.slopes(tile_.x1, tile_.y1);
    bool left_of = true, right_of = true, above = true, below = true, behind = true;
    for (std::size_t k = 0; k < surface_.corner_count; ++k) {
      const auto& [x, y, z] = camera_[k];
      left_of = left_of && x < left * z;
      right_of = right_of && x > right * z;
      above = above && y > top * z;
      below = below && y < bottom * z;
      behind = behind && z < 0;
    }
    return left_of || right_of || above || below || behind;
  }

  void scan_row(int y, std::vector<CellCrossing>& crossings) {
    const double center = pixel_center(y), slope = frame_.projector.slopes(0, center)[1];
    std::array<bool, CellSurface::kMostCorners> above;
    for (std::size_t k = 0; k < surface_.corner_count; ++k) {
      const auto& [right, up, forward] = camera_[k];
      height_[k] = straightened(up - slope * forward, std::abs(right) + std::abs(forward));
      above[k] = projectable_[k] ? is_above(nodes_[k], center) : height_[k] >= 0;
    }
    std::uint32_t crossed = 0;
    for (std::size_t e = 0; e < surface_.edge_count; ++e)
      if (above[surface_.edges[e][0]] != above[surface_.edges[e][1]]) crossed |= 1U << e;
    const RowSection section(surface_, curved_, crossed);
    if (!cut_edges(crossed, center) && curved_ == nullptr) return;
    if (curved_ != nullptr) curved_->begin_row(center, tile_, above.data());
    for (int x = tile_.x0; x < tile_.x1; ++x) {
      set_sides(crossed, x);
      RayCrossings ray;
      for (std::size_t i = 0; i < section.triangle_count; ++i) {
        const CrossedTriangle& t = section.triangles[i];
        if (edges_[t.e].left_of_pixel != edges_[t.f].left_of_pixel)
          ray.add(parameter(t, pixel_center(x), center), surface_.triangles[t.triangle].face);
      }
      if (curved_ != nullptr)
        curved_->at_pixel(
            x, [&](std::size_t e) { return edges_[e].left_of_pixel; },
            [&](double t, std::uint8_t face, double u, double v) { ray.add(t, face, u, v); });
      ray.append_to(crossings, curved_, x, y);
    }
  }

  // An edge that the plane of the eye and a row of pixel centres crosses.
  struct CrossedEdge {
    double right, forward;  // camera coordinates of the point
    bool projectable;
    RowCrossing on_screen;  // if the edge is projectable
    // of the current pixel
    double offset;  // of the point right of the pixel's line, at its depth
    bool left_of_pixel;
  };

  // Computes the points of the crossed edges. Returns false if all of them lie behind the eye.
  bool cut_edges(std::uint32_t crossed, double center) {
    bool in_front = false;
    for (std::uint32_t rest = crossed; rest != 0; rest &= rest - 1) {
      const auto e = static_cast<std::size_t>(std::countr_zero(rest));
      const auto [a, b] = surface_.edges[e];
      const double difference = height_[a] - height_[b];
      // nodes that only their screen coordinates separate may have heights of equal sign
      const double s = difference == 0 ? 0.5 : std::clamp(height_[a] / difference, 0.0, 1.0);
      CrossedEdge& edge = edges_[e];
      edge.right = camera_[a][0] + s * (camera_[b][0] - camera_[a][0]);
      edge.forward = camera_[a][2] + s * (camera_[b][2] - camera_[a][2]);
      edge.projectable = projectable_[a] && projectable_[b];
      if (edge.projectable) edge.on_screen = cross_row(nodes_[a], nodes_[b], center, tile_);
      in_front = in_front || edge.forward > 0;
    }
    return in_front;
  }

  void set_sides(std::uint32_t crossed, int x) {
    const double slope = frame_.projector.slopes(pixel_center(x), 0)[0];
    for (std::uint32_t rest = crossed; rest != 0; rest &= rest - 1) {
      CrossedEdge& edge = edges_[static_cast<std::size_t>(std::countr_zero(rest))];
      edge.offset = straightened(edge.right - slope * edge.forward,
                                 std::abs(edge.right) + std::abs(edge.forward));
      edge.left_of_pixel = edge.projectable ? x >= edge.on_screen.column : edge.offset <= 0;
    }
  }

  // The ray parameter at which a triangle is crossed, between two of its edges.
  [[nodiscard]] double parameter(const CrossedTriangle& t, double x, double y) {
    const CrossedEdge &e = edges_[t.e], &f = edges_[t.f];
    const auto& c = surface_.triangles[t.triangle].corners;
    if (projectable_[c[0]] && projectable_[c[1]] && projectable_[c[2]])
      return -1 / depth_.at(t.triangle, e.on_screen, f.on_screen, x, y);
    const double difference = e.offset - f.offset;
    const double size =
        std::max(std::abs(e.right) + std::abs(e.forward), std::abs(f.right) + std::abs(f.forward));
    if (std::abs(difference) <= kEdgeOn * size) return std::min(e.forward, f.forward);
    const double s = std::clamp(e.offset / difference, 0.0, 1.0);
    return e.forward + s * (f.forward - e.forward);
  }

  const Frame& frame_;
  const CellSurface& surface_;
  CurvedFaces* curved_;
  const TileRect& tile_;
  const PixelMask* only_;  // the pixels in whose rows crossings are wanted; null for all
  Nodes nodes_;
  SurfaceDepth depth_;
  std::array<Vector, CellSurface::kMostCorners> camera_;
  std::array<bool, CellSurface::kMostCorners> projectable_;
  // of the current row
  std::array<double, CellSurface::kMostCorners> height_;
  std::array<CrossedEdge, CellSurface::kMostEdges> edges_;
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
