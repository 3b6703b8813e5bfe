// Where rows of pixel centres cross the projected edges of a cell, compiled once for every
// instruction set. Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_EDGE_CROSSINGS_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_EDGE_CROSSINGS_INL
#    undef HIAC_RENDER_EDGE_CROSSINGS_INL
#  else
#    define HIAC_RENDER_EDGE_CROSSINGS_INL
#  endif

#  include <algorithm>
#  include <array>
#  include <bit>
#  include <cmath>
#  include <cstdint>

#  include <hwy/highway.h>

#  include "hiac/element/cell_surface.hpp"
#  include "hiac/frame/row_crossing-inl.hpp"
#  include "hiac/frame/tiles/tile.hpp"
#  include "hiac/render/cells/surface_depth-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Whether a node lies above a row of pixel centres or on it.
HWY_INLINE bool is_above(const ProjectedNode& node, double center) { return node.y <= center; }

HWY_INLINE RowCrossing cross_row(const ProjectedNode& a, const ProjectedNode& b, double center,
                                 const TileRect& tile) {
  const double slope = edge_slope(a, b);
  const double x = hiac::crossing_x(center, a.x, a.y, slope);
  // a and b lie on different sides of the row, so 0 <= s <= 1
  const double s = (center - a.y) / (b.y - a.y);
  return {x, a.depth + s * (b.depth - a.depth),
          first_center(x, tile.x0, tile.x1, on_crossing(slope))};
}

// The edges of a surface on the screen, and where a row crosses them: cross_row for many edges at a
// time.
class EdgesOnScreen {
 public:
  HWY_INLINE EdgesOnScreen(const CellSurface& surface, const Nodes& nodes) : surface_(surface) {
    for (std::size_t e = 0; e < surface.edge_count; ++e) {
      const ProjectedNode &a = nodes[surface.edges[e][0]], &b = nodes[surface.edges[e][1]];
      x_[e] = a.x;
      y_[e] = a.y;
      other_y_[e] = b.y;
      height_[e] = b.y - a.y;
      slope_[e] = edge_slope(a, b);
      to_first_[e] = to_first_pixel(slope_[e]);
      depth_[e] = a.depth;
      deeper_[e] = b.depth - a.depth;
    }
  }

  // Returns the edges that the row crosses, one bit each, and writes their crossings to `at`; the
  // other entries of `at` are undefined.
  HWY_INLINE std::uint32_t cross(double center, const TileRect& tile,
                                 std::array<RowCrossing, CellSurface::kMostEdges>& at) const {
    const hn::CappedTag<double, 8> d;
    const auto row = hn::Set(d, center), left = hn::Set(d, tile.x0), right = hn::Set(d, tile.x1);
    HWY_ALIGN double x[kPlaces], depth[kPlaces], column[kPlaces];
    std::uint32_t crossed = 0;
    for (std::size_t e = 0; e < surface_.edge_count; e += hn::Lanes(d)) {
      const auto y = hn::Load(d, y_ + e), down = hn::Sub(row, y);
      std::uint8_t bits[8];
      hn::StoreMaskBits(d, hn::Xor(hn::Le(y, row), hn::Le(hn::Load(d, other_y_ + e), row)), bits);
      crossed |= std::uint32_t{bits[0]} << e;
      const auto here = crossing_x(row, hn::Load(d, x_ + e), y, hn::Load(d, slope_ + e));
      const auto s = hn::Div(down, hn::Load(d, height_ + e));
      hn::Store(here, d, x + e);
      hn::Store(hn::Add(hn::Load(d, depth_ + e), hn::Mul(s, hn::Load(d, deeper_ + e))), d,
                depth + e);
      const auto first = hn::Sub(here, hn::Load(d, to_first_ + e));
      hn::Store(hn::Ceil(hn::Min(hn::Max(first, left), right)), d, column + e);
    }
    crossed &= (std::uint32_t{1} << surface_.edge_count) - 1;
    for (std::uint32_t rest = crossed; rest != 0; rest &= rest - 1) {
      const auto e = static_cast<std::size_t>(std::countr_zero(rest));
      at[e] = {x[e], depth[e], static_cast<int>(column[e])};
    }
    return crossed;
  }

 private:
  static constexpr std::size_t kPlaces = (CellSurface::kMostEdges + 7) / 8 * 8;

  const CellSurface& surface_;
  // coordinates of an edge's first corner; `other_y_`: those of its second corner
  HWY_ALIGN double x_[kPlaces]{}, y_[kPlaces]{}, depth_[kPlaces]{}, other_y_[kPlaces]{};
  // differences from the first corner to the second, and slopes
  HWY_ALIGN double height_[kPlaces]{}, slope_[kPlaces]{}, deeper_[kPlaces]{};
  HWY_ALIGN double to_first_[kPlaces]{};  // to_first_pixel
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
