// Depths on the triangles of cells' surfaces over the screen, compiled once for every instruction
// set. Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_SURFACE_DEPTH_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_SURFACE_DEPTH_INL
#    undef HIAC_RENDER_SURFACE_DEPTH_INL
#  else
#    define HIAC_RENDER_SURFACE_DEPTH_INL
#  endif

#  include <algorithm>
#  include <array>
#  include <cmath>

#  include <hwy/highway.h>

#  include "hiac/element/cell_surface.hpp"
#  include "hiac/frame/frame.hpp"
#  include "hiac/render/pixels/face_plane-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Where a row of pixel centres crosses an edge.
struct RowCrossing {
  double x, depth;
  int column;  // the first pixel on the crossing or right of it
};

// A triangle whose edges are less than this many pixels apart counts as seen edge-on: its position
// is then known only to the rounding of projected coordinates (an ulp is 3e-11 for the farthest
// nodes).
inline constexpr double kEdgeOnWidth = 0x1p-35;

// Depth on a triangle over the screen (face_plane-inl.hpp).
class TriangleDepth {
 public:
  TriangleDepth() = default;
  HWY_INLINE TriangleDepth(const ProjectedNode& base, const ProjectedNode& one,
                           const ProjectedNode& two)
      : base_(base) {
    const hn::CappedTag<double, 1> d;
    const auto plane = face_plane(d, hn::Set(d, one.x - base.x), hn::Set(d, one.y - base.y),
                                  hn::Set(d, two.x - base.x), hn::Set(d, two.y - base.y));
    cx_ = hn::GetLane(plane.cx);
    cy_ = hn::GetLane(plane.cy);
    gx_ = hn::GetLane(plane.gx);
    gy_ = hn::GetLane(plane.gy);
    h_ = hn::GetLane(plane.h);
    const bool swapped = !hn::AllFalse(d, plane.swapped);
    const double q1 = one.depth - base.depth, q2 = two.depth - base.depth;
    qm_ = swapped ? q2 : q1;
    qs_ = swapped ? q1 : q2;
  }

  using Row = FaceLine;
  [[nodiscard]] HWY_INLINE Row row(double y) const {
    const double dy = y - base_.y;
    return {base_.x, cx_, gx_, h_, cy_ * dy, gy_ * dy};
  }
  // The depths at points of a row.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE V along(D d, const Row& row, V x) const {
    return on_face(d, base_.depth, qm_, qs_, place_on_face(d, row, x));
  }

 private:
  ProjectedNode base_;
  double cx_, cy_, gx_, gy_, h_, qm_, qs_;
};

using Nodes = std::array<ProjectedNode, CellSurface::kMostCorners>;

HWY_INLINE Nodes projected_nodes(const Frame& frame, const CellSurface& surface) {
  Nodes nodes{};
  for (std::size_t k = 0; k < surface.corner_count; ++k) nodes[k] = frame.nodes[surface.nodes[k]];
  return nodes;
}

// The depths on a cell's triangles; each triangle is set up when it is first needed.
class SurfaceDepth {
 public:
  HWY_INLINE SurfaceDepth(const CellSurface& surface, const Nodes& nodes)
      : surface_(surface), nodes_(nodes) {}

  // The depths on a triangle along a row, clamped to those of the two edges that the row crosses. A
  // triangle seen edge-on takes the smaller of the two depths: of the two cells that it separates,
  // one gets the whole ray. The cells along the ray then follow one another whatever rounding does.
  struct Row {
    const TriangleDepth* triangle;  // null if it is seen edge-on
    double least, most;
    TriangleDepth::Row along;

    template <class D, class V = hn::Vec<D>>
    HWY_INLINE V at(D d, V x) const {
      if (triangle == nullptr) return hn::Set(d, least);
      return hn::Min(hn::Max(triangle->along(d, along, x), hn::Set(d, least)), hn::Set(d, most));
    }
  };
  HWY_INLINE Row row(std::size_t triangle, const RowCrossing& e, const RowCrossing& f, double y) {
    const double least = std::min(e.depth, f.depth), most = std::max(e.depth, f.depth);
    if (std::abs(e.x - f.x) < kEdgeOnWidth) return {nullptr, least, most, {}};
    return {&on(triangle), least, most, on(triangle).row(y)};
  }

  // The depth at one point of a row.
  HWY_INLINE double at(std::size_t triangle, const RowCrossing& e, const RowCrossing& f, double x,
                       double y) {
    const hn::CappedTag<double, 1> d;
    return hn::GetLane(row(triangle, e, f, y).at(d, hn::Set(d, x)));
  }

 private:
  HWY_INLINE const TriangleDepth& on(std::size_t triangle) {
    if (!ready_[triangle]) {
      const auto& c = surface_.triangles[triangle].corners;
      triangles_[triangle] = TriangleDepth(nodes_[c[0]], nodes_[c[1]], nodes_[c[2]]);
      ready_[triangle] = true;
    }
    return triangles_[triangle];
  }

  const CellSurface& surface_;
  const Nodes& nodes_;
  std::array<TriangleDepth, CellSurface::kMostTriangles> triangles_;
  std::array<bool, CellSurface::kMostTriangles> ready_{};
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
