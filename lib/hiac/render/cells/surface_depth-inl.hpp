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

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Fused where the instruction set has it, as the same operation on vectors is.
HWY_INLINE double neg_mul_add(double a, double b, double c) {
  const hn::CappedTag<double, 1> d;
  return hn::GetLane(hn::NegMulAdd(hn::Set(d, a), hn::Set(d, b), hn::Set(d, c)));
}

// Where a row of pixel centres crosses an edge.
struct RowCrossing {
  double x, depth;
  int column;  // the first pixel right of it, or on it
};

// Pixels between the edges of a triangle: narrower than this it is seen edge-on, and where it lies
// is known to rounding of projected coordinates alone (an ulp is 3e-11 for the farthest nodes).
inline constexpr double kEdgeOnWidth = 0x1p-35;

// Depth on a triangle over the screen: FacePlanes of scan_conversion-inl.hpp, one at a time.
class TriangleDepth {
 public:
  TriangleDepth() = default;
  HWY_INLINE TriangleDepth(const ProjectedNode& base, const ProjectedNode& one,
                           const ProjectedNode& two)
      : base_(base) {
    const double x1 = one.x - base.x, y1 = one.y - base.y;
    const double x2 = two.x - base.x, y2 = two.y - base.y;
    const bool swapped =
        std::max(std::abs(x1), std::abs(y1)) < std::max(std::abs(x2), std::abs(y2));
    const double mx = swapped ? x2 : x1, my = swapped ? y2 : y1;
    const double sx = swapped ? x1 : x2, sy = swapped ? y1 : y2;
    const bool y_pivot = std::abs(mx) < std::abs(my);
    const double mp = y_pivot ? my : mx, mq = y_pivot ? mx : my;
    const double sp = y_pivot ? sy : sx, sq = y_pivot ? sx : sy;
    const double inverse_mp = 1 / mp;
    const double l = mq * inverse_mp;
    const double inverse_u = 1 / neg_mul_add(l, sp, sq);
    const double cp = -(l * inverse_u);
    cx_ = y_pivot ? inverse_u : cp;
    cy_ = y_pivot ? cp : inverse_u;
    gx_ = y_pivot ? 0.0 : inverse_mp;
    gy_ = y_pivot ? inverse_mp : 0.0;
    h_ = sp * inverse_mp;
    const double q1 = one.depth - base.depth, q2 = two.depth - base.depth;
    qm_ = swapped ? q2 : q1;
    qs_ = swapped ? q1 : q2;
  }

  // What a row has in common.
  struct Row {
    double cy_dy, gy_dy;
  };
  [[nodiscard]] HWY_INLINE Row row(double y) const {
    const double dy = y - base_.y;
    return {cy_ * dy, gy_ * dy};
  }
  // At points of it.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE V along(D d, const Row& row, V x) const {
    const V dx = hn::Sub(x, hn::Set(d, base_.x));
    const V s = hn::MulAdd(dx, hn::Set(d, cx_), hn::Set(d, row.cy_dy));
    const V m =
        hn::NegMulAdd(hn::Set(d, h_), s, hn::MulAdd(dx, hn::Set(d, gx_), hn::Set(d, row.gy_dy)));
    return hn::MulAdd(s, hn::Set(d, qs_), hn::MulAdd(m, hn::Set(d, qm_), hn::Set(d, base_.depth)));
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

// The depths on a cell's triangles, each made ready when it is first needed.
class SurfaceDepth {
 public:
  HWY_INLINE SurfaceDepth(const CellSurface& surface, const Nodes& nodes)
      : surface_(surface), nodes_(nodes) {}

  // A row, between the two edges that it crosses; never beyond the depths there. A triangle seen
  // edge-on is as deep as the nearer of the two: of the cells that it parts, one gets all of the
  // ray. The ray's cells then follow one another whatever rounding does.
  struct Row {
    const TriangleDepth* triangle;  // none where it is seen edge-on
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

  // The same at one point.
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
