// Scan conversion of cells whose nodes are all projectable, compiled once for every instruction
// set. Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_SCREEN_SCAN_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_SCREEN_SCAN_INL
#    undef HIAC_RENDER_SCREEN_SCAN_INL
#  else
#    define HIAC_RENDER_SCREEN_SCAN_INL
#  endif

#  include <algorithm>
#  include <array>
#  include <bit>
#  include <cstdint>
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

// Scans a cell whose nodes are all projectable, row by row.
class ScreenScan {
 public:
  ScreenScan(const Frame& frame, const CellSurface& surface, CurvedFaces* curved,
             const TileRect& tile, CrossingRuns* runs, const PixelMask* only)
      : perspective_(frame.projector.perspective()),
        surface_(surface),
        curved_(curved),
        tile_(tile),
        runs_(runs),
        only_(only),
        nodes_(projected_nodes(frame, surface)),
        on_screen_(surface, nodes_),
        depth_(surface, nodes_) {}

  void scan(std::vector<CellCrossing>& crossings) {
    double top = nodes_[0].y, bottom = nodes_[0].y;
    for (std::size_t k = 1; k < surface_.corner_count; ++k) {
      top = std::min(top, nodes_[k].y);
      bottom = std::max(bottom, nodes_[k].y);
    }
    if (curved_ != nullptr) {
      const ScreenBounds bounds = curved_->bounds();
      top = bounds.in_front ? std::min(top, bounds.y0) : tile_.y0;
      bottom = bounds.in_front ? std::max(bottom, bounds.y1) : tile_.y1;
    }
    const int row_end = first_center(bottom, tile_.y0, tile_.y1);
    for (int y = first_center(top, tile_.y0, tile_.y1); y < row_end; ++y)
      if (only_ == nullptr || only_->row(y - tile_.y0) != 0) scan_row(y, crossings);
  }

 private:
  void scan_row(int y, std::vector<CellCrossing>& crossings) {
    const double center = pixel_center(y);
    std::array<RowCrossing, CellSurface::kMostEdges> edges;
    const std::uint32_t crossed = on_screen_.cross(center, tile_, edges);
    const RowSection section(surface_, curved_, crossed);
    int first = tile_.x1, last = tile_.x0;
    if (curved_ != nullptr) {
      std::array<bool, CellSurface::kMostCorners> above;
      for (std::size_t k = 0; k < surface_.corner_count; ++k)
        above[k] = is_above(nodes_[k], center);
      curved_->begin_row(center, tile_, above.data());
      first = curved_->columns()[0];
      last = curved_->columns()[1];
    }
    for (std::uint32_t rest = crossed; rest != 0; rest &= rest - 1) {
      const int column = edges[static_cast<std::size_t>(std::countr_zero(rest))].column;
      first = std::min(first, column);
      last = std::max(last, column);
    }
    if (first < last && runs_ != nullptr && add_run(section, edges, first, last, y)) return;
    if (curved_ == nullptr) return meet_row(section, edges, first, last, y, crossings);
    for (int x = first; x < last; ++x) {
      if (!is_wanted(x, y)) continue;
      RayCrossings ray;
      for (std::size_t i = 0; i < section.triangle_count; ++i) {
        const auto& [k, e, f] = section.triangles[i];
        if ((x >= edges[e].column) == (x >= edges[f].column)) continue;
        const double depth = depth_.at(k, edges[e], edges[f], pixel_center(x), center);
        ray.add(perspective_ ? -1 / depth : depth, surface_.triangles[k].face);
      }
      curved_->at_pixel(
          x, [&](std::size_t e) { return x >= edges[e].column; },
          [&](double t, std::uint8_t face, double u, double v) { ray.add(t, face, u, v); });
      ray.append_to(crossings, curved_, x, y);
    }
  }

  [[nodiscard]] bool is_wanted(int x, int y) const {
    return only_ == nullptr || only_->holds(x - tile_.x0, y - tile_.y0);
  }

  // Whether the triangles that a row crosses cover every pixel of [first, last) twice.
  static bool is_covered_twice(const RowSection& section,
                               const std::array<RowCrossing, CellSurface::kMostEdges>& edges,
                               int first, int last) {
    static_assert(kTileWidth <= 64);  // one bit per pixel
    const auto before = [&](int x) {
      return x - first == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << (x - first)) - 1;
    };
    std::uint64_t ones = 0, twos = 0, fours = 0;
    for (std::size_t i = 0; i < section.triangle_count; ++i) {
      const std::uint64_t covered = before(edges[section.triangles[i].e].column) ^
                                    before(edges[section.triangles[i].f].column);
      const std::uint64_t carried = ones & covered;
      ones ^= covered;
      fours |= twos & carried;
      twos ^= carried;
    }
    return ones == 0 && fours == 0 && twos == before(last);
  }

  // Adds the pixels [first, last) as one run, without curved faces. Returns false if a ray does not
  // enter and leave exactly once.
  bool add_run(const RowSection& section,
               const std::array<RowCrossing, CellSurface::kMostEdges>& edges, int first, int last,
               int y) {
    if (!is_covered_twice(section, edges, first, last)) return false;
    const hn::CappedTag<double, 8> d;
    const auto pixels = static_cast<std::size_t>(last - first);
    const std::size_t places = runs_->count + pixels + hn::Lanes(d);
    if (runs_->front.size() < places) {
      runs_->front.resize(2 * places);
      runs_->back.resize(2 * places);
    }
    double* front = runs_->front.data() + runs_->count;
    double* back = runs_->back.data() + runs_->count;
    struct Part {
      SurfaceDepth::Row depth;
      double from, to;  // columns
    };
    std::array<Part, CellSurface::kMostTriangles> parts;
    std::size_t count = 0;
    for (std::size_t i = 0; i < section.triangle_count; ++i) {
      const auto& [k, e, f] = section.triangles[i];
      const auto [from, to] = std::minmax(edges[e].column, edges[f].column);
      if (from == to) continue;
      parts[count++] = {depth_.row(k, edges[e], edges[f], pixel_center(y)),
                        static_cast<double>(from), static_cast<double>(to)};
    }
    const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());
    const auto minus_one = hn::Set(d, -1.0), half = hn::Set(d, 0.5);
    for (std::size_t j = 0; j < pixels; j += hn::Lanes(d)) {
      const auto column = hn::Iota(d, first + static_cast<double>(j)), x = hn::Add(column, half);
      auto near = infinity, far = hn::Neg(infinity);
      for (std::size_t i = 0; i < count; ++i) {
        const auto within = hn::And(hn::Ge(column, hn::Set(d, parts[i].from)),
                                    hn::Lt(column, hn::Set(d, parts[i].to)));
        const auto depth = parts[i].depth.at(d, x);
        near = hn::IfThenElse(within, hn::Min(near, depth), near);
        far = hn::IfThenElse(within, hn::Max(far, depth), far);
      }
      hn::StoreU(perspective_ ? hn::Div(minus_one, near) : near, d, front + j);
      hn::StoreU(perspective_ ? hn::Div(minus_one, far) : far, d, back + j);
    }
    runs_->runs.push_back({first, y, runs_->count, pixels});
    runs_->count += pixels;
    return true;
  }

  // Appends the crossings of the pixels [first, last), without curved faces, triangle by triangle.
  void meet_row(const RowSection& section,
                const std::array<RowCrossing, CellSurface::kMostEdges>& edges, int first, int last,
                int y, std::vector<CellCrossing>& crossings) {
    if (first >= last) return;
    std::array<std::uint8_t, kTileStride> count;
    std::fill_n(count.begin(), last - first, std::uint8_t{0});
    std::array<double, kTileStride> depths;
    std::array<std::array<double, kTileStride>, CellSurface::kMostTriangles> places;
    std::array<std::array<std::uint8_t, kTileStride>, CellSurface::kMostTriangles> faces;
    for (std::size_t i = 0; i < section.triangle_count; ++i) {
      const auto& [k, e, f] = section.triangles[i];
      const auto [from, to] = std::minmax(edges[e].column, edges[f].column);
      if (from == to) continue;
      const auto pixels = static_cast<std::size_t>(to - from);
      const hn::CappedTag<double, 8> d;
      const SurfaceDepth::Row depth = depth_.row(k, edges[e], edges[f], pixel_center(y));
      for (std::size_t j = 0; j < pixels; j += hn::Lanes(d))
        hn::StoreU(depth.at(d, hn::Iota(d, pixel_center(from) + static_cast<double>(j))), d,
                   depths.data() + j);
      const auto offset = static_cast<std::size_t>(from - first);
      if (perspective_)
        for (std::size_t j = 0; j < pixels; ++j) depths[j] = -1 / depths[j];
      for (std::size_t j = 0; j < pixels; ++j) {
        const std::size_t slot = count[offset + j]++;
        places[slot][offset + j] = depths[j];
        faces[slot][offset + j] = surface_.triangles[k].face;
      }
    }
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    constexpr CellCrossing kPlain{
        0, 0, 0, 0, 0, 0, {kNone, kNone, kNone}, {kNone, kNone, kNone}, kNone, kNone};
    for (int x = first; x < last; ++x) {
      if (!is_wanted(x, y)) continue;
      const auto at = static_cast<std::size_t>(x - first);
      if (count[at] == 2) {  // the usual case
        const std::size_t front = places[1][at] < places[0][at] ? 1 : 0, back = 1 - front;
        CellCrossing& crossing = crossings.emplace_back(kPlain);
        crossing.x = x;
        crossing.y = y;
        crossing.front = places[front][at];
        crossing.back = places[back][at];
        crossing.front_face = faces[front][at];
        crossing.back_face = faces[back][at];
        continue;
      }
      RayCrossings ray;
      for (std::size_t k = 0; k < count[at]; ++k) ray.add(places[k][at], faces[k][at]);
      ray.append_to(crossings, nullptr, x, y);
    }
  }

  bool perspective_;
  const CellSurface& surface_;
  CurvedFaces* curved_;
  const TileRect& tile_;
  CrossingRuns* runs_;     // for rows that form one run; may be null
  const PixelMask* only_;  // the pixels whose crossings are wanted; null for all
  Nodes nodes_;
  EdgesOnScreen on_screen_;
  SurfaceDepth depth_;
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
