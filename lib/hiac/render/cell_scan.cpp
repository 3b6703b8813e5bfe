#include "hiac/render/cell_scan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hiac/render/cell_scan.cpp"
#include <hwy/foreach_target.h>
// must come after foreach_target.h
#include <hwy/highway.h>

#include "hiac/render/surface_depth-inl.hpp"

// Compiled once for every instruction set, although little is in vectors here: where the
// tetrahedron kernel uses fused operations, these have to be fused as well.

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The first pixel in [low, high] whose centre lies at or after a coordinate, or before it by no
// more than `slack`.
HWY_INLINE int first_center(double coordinate, int low, int high, double slack = 0) {
  const double clamped = std::min(std::max(coordinate - (0.5 + slack), static_cast<double>(low)),
                                  static_cast<double>(high));
  return static_cast<int>(std::ceil(clamped));
}

// Nodes above a row of pixel centres or on it.
HWY_INLINE bool is_above(const ProjectedNode& node, double center) { return node.y <= center; }

HWY_INLINE RowCrossing cross_row(const ProjectedNode& a, const ProjectedNode& b, double center,
                                 const TileRect& tile) {
  const double slope = (b.x - a.x) / (b.y - a.y);
  const double offset = (center - a.y) * slope;
  const double x = a.x + offset;
  // a is on one side of the row and b on the other, so this is a mean of their depths
  const double s = (center - a.y) / (b.y - a.y);
  return {x, a.depth + s * (b.depth - a.depth),
          first_center(x, tile.x0, tile.x1, on_crossing(slope))};
}

// Triangles off the screen are seen edge-on (kEdgeOnWidth) when they are narrower than this,
// relative to their distance from the eye.
constexpr double kEdgeOn = 64 * std::numeric_limits<double>::epsilon();

// A triangle that a row crosses, between two of its edges.
struct CrossedTriangle {
  std::size_t triangle, e, f;
};

// What one row crosses.
struct RowSection {
  std::array<bool, CellSurface::kMostEdges> crossed;
  std::array<CrossedTriangle, CellSurface::kMostTriangles> triangles;
  std::size_t triangle_count;

  // `above`: corners on the row or above it. Triangles of curved faces are left out.
  HWY_INLINE RowSection(const CellSurface& surface, const CurvedFaces* curved, const bool* above)
      : triangle_count(0) {
    for (std::size_t e = 0; e < surface.edge_count; ++e)
      crossed[e] = above[surface.edges[e][0]] != above[surface.edges[e][1]];
    for (std::size_t k = 0; k < surface.triangle_count; ++k) {
      if (curved != nullptr && curved->holds(surface.triangles[k].face)) continue;
      // two edges of a triangle are crossed, or none
      const auto& [a, b, c] = surface.triangles[k].edges;
      if (!crossed[a] && !crossed[b]) continue;
      triangles[triangle_count++] = {k, crossed[a] ? a : b, crossed[a] && crossed[b] ? b : c};
    }
  }
};

// Where one ray crosses a cell's surface.
class RayCrossings {
 public:
  // Keeps them in order. `u`, `v`: of curved faces.
  HWY_INLINE void add(double t, std::uint8_t face, double u = 0, double v = 0) {
    std::size_t at = count_++;
    for (; at > 0 && places_[at - 1].t > t; --at) places_[at] = places_[at - 1];
    places_[at] = {t, u, v, face};
  }

  // The ray enters and leaves in turn: of a convex cell once each, but that rounding may roughen a
  // surface along which the ray runs.
  HWY_INLINE void append_to(std::vector<CellCrossing>& crossings, const CurvedFaces* curved, int x,
                            int y) const {
    for (std::size_t k = 0; k + 1 < count_; k += 2) {
      const Place &front = places_[k], &back = places_[k + 1];
      crossings.push_back({x, y, front.t, back.t, front.face, back.face, reference(curved, front),
                           reference(curved, back), doubt(curved, front, x),
                           doubt(curved, back, x)});
    }
  }

 private:
  struct Place {
    double t, u, v;
    std::uint8_t face;
  };

  static HWY_INLINE std::array<double, 3> reference(const CurvedFaces* curved, const Place& place) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    if (curved == nullptr || !curved->holds(place.face)) return {kNone, kNone, kNone};
    return curved->reference(place.face, place.u, place.v);
  }

  static HWY_INLINE double doubt(const CurvedFaces* curved, const Place& place, int x) {
    if (curved == nullptr || !curved->with_doubts() || !curved->holds(place.face))
      return std::numeric_limits<double>::quiet_NaN();
    return curved->doubt(place.face, place.u, place.v, x, curved->displaced());
  }

  std::array<Place, CellSurface::kMostTriangles + CurvedFaces::kMostZeros> places_;
  std::size_t count_ = 0;
};

// A cell whose nodes are all on the screen, row by row.
class ScreenScan {
 public:
  ScreenScan(const Frame& frame, const CellSurface& surface, CurvedFaces* curved,
             const TileRect& tile, CrossingRuns* runs)
      : perspective_(frame.projector.perspective()),
        surface_(surface),
        curved_(curved),
        tile_(tile),
        runs_(runs),
        nodes_(projected_nodes(frame, surface)),
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
    for (int y = first_center(top, tile_.y0, tile_.y1); y < row_end; ++y) scan_row(y, crossings);
  }

 private:
  void scan_row(int y, std::vector<CellCrossing>& crossings) {
    const double center = y + 0.5;
    std::array<bool, CellSurface::kMostCorners> above;
    for (std::size_t k = 0; k < surface_.corner_count; ++k) above[k] = is_above(nodes_[k], center);
    const RowSection section(surface_, curved_, above.data());
    std::array<RowCrossing, CellSurface::kMostEdges> edges;
    int first = tile_.x1, last = tile_.x0;
    if (curved_ != nullptr) {
      curved_->begin_row(center, tile_, above.data());
      first = curved_->columns()[0];
      last = curved_->columns()[1];
    }
    for (std::size_t e = 0; e < surface_.edge_count; ++e) {
      if (!section.crossed[e]) continue;
      edges[e] =
          cross_row(nodes_[surface_.edges[e][0]], nodes_[surface_.edges[e][1]], center, tile_);
      first = std::min(first, edges[e].column);
      last = std::max(last, edges[e].column);
    }
    if (first < last && runs_ != nullptr && add_run(section, edges, first, last, y)) return;
    if (curved_ == nullptr) return meet_row(section, edges, first, last, y, crossings);
    for (int x = first; x < last; ++x) {
      RayCrossings ray;
      for (std::size_t i = 0; i < section.triangle_count; ++i) {
        const auto& [k, e, f] = section.triangles[i];
        if ((x >= edges[e].column) == (x >= edges[f].column)) continue;
        const double depth = depth_.at(k, edges[e], edges[f], x + 0.5, center);
        ray.add(perspective_ ? -1 / depth : depth, surface_.triangles[k].face);
      }
      curved_->at_pixel(
          x, [&](std::size_t e) { return x >= edges[e].column; },
          [&](double t, std::uint8_t face, double u, double v) { ray.add(t, face, u, v); });
      ray.append_to(crossings, curved_, x, y);
    }
  }

  // Whether the triangles that a row crosses cover every pixel of [first, last) twice.
  static bool is_covered_twice(const RowSection& section,
                               const std::array<RowCrossing, CellSurface::kMostEdges>& edges,
                               int first, int last) {
    static_assert(kTileWidth <= 64);  // a bit a pixel, of how often it is covered
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

  // The pixels [first, last) as one run, without curved faces. False where a ray does not enter and
  // leave once.
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
    const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());
    for (std::size_t j = 0; j < pixels; j += hn::Lanes(d)) {
      hn::StoreU(infinity, d, front + j);
      hn::StoreU(hn::Neg(infinity), d, back + j);
    }
    for (std::size_t i = 0; i < section.triangle_count; ++i) {
      const auto& [k, e, f] = section.triangles[i];
      const auto [from, to] = std::minmax(edges[e].column, edges[f].column);
      const auto offset = static_cast<std::size_t>(from - first);
      depth_.along_row(k, edges[e], edges[f], from + 0.5, y + 0.5,
                       static_cast<std::size_t>(to - from),
                       [&](std::size_t j, auto depth, auto within) HWY_ATTR {
                         double *near = front + offset + j, *far = back + offset + j;
                         const auto here = hn::LoadU(d, near), there = hn::LoadU(d, far);
                         hn::StoreU(hn::IfThenElse(within, hn::Min(here, depth), here), d, near);
                         hn::StoreU(hn::IfThenElse(within, hn::Max(there, depth), there), d, far);
                       });
    }
    if (perspective_) {
      const auto minus_one = hn::Set(d, -1.0);
      for (std::size_t j = 0; j < pixels; j += hn::Lanes(d)) {
        hn::StoreU(hn::Div(minus_one, hn::LoadU(d, front + j)), d, front + j);
        hn::StoreU(hn::Div(minus_one, hn::LoadU(d, back + j)), d, back + j);
      }
    }
    runs_->runs.push_back({first, y, runs_->count, pixels});
    runs_->count += pixels;
    return true;
  }

  // Without curved faces: triangle by triangle, then the pixels [first, last).
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
      depth_.along_row(k, edges[e], edges[f], from + 0.5, y + 0.5, pixels,
                       [&](std::size_t j, auto depth, auto)
                           HWY_ATTR { hn::StoreU(depth, d, depths.data() + j); });
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
      const auto at = static_cast<std::size_t>(x - first);
      if (count[at] == 2) {  // as it mostly is
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
  CrossingRuns* runs_;  // for rows that are one
  Nodes nodes_;
  SurfaceDepth depth_;
};

void scan_projected(const Frame& frame, const CellSurface& surface, CurvedFaces* curved,
                    const TileRect& tile, CrossingRuns* runs,
                    std::vector<CellCrossing>& crossings) {
  ScreenScan(frame, surface, curved, tile, runs).scan(crossings);
}

// The distance of a point from a plane through the eye, or 0 when it is rounding in comparison with
// the distance from the eye: what Projector does for coordinates close to pixel centres.
HWY_INLINE double straightened(double distance, double from_eye) {
  constexpr double kRounding = 32 * std::numeric_limits<double>::epsilon();
  return std::abs(distance) <= kRounding * from_eye ? 0 : distance;
}

using Vector = std::array<double, 3>;

// A cell beside the eye, row by row.
class LineScan {
 public:
  LineScan(const Frame& frame, const CellSurface& surface, CurvedFaces* curved,
           const TileRect& tile)
      : frame_(frame),
        surface_(surface),
        curved_(curved),
        tile_(tile),
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
    for (int y = tile_.y0; y < tile_.y1; ++y) scan_row(y, crossings);
  }

 private:
  // All corners outside one of the planes through the eye and the tile's borders: what the tile's
  // pixels see lies inside all of them.
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
    const double center = y + 0.5, slope = frame_.projector.slopes(0, center)[1];
    std::array<bool, CellSurface::kMostCorners> above;
    for (std::size_t k = 0; k < surface_.corner_count; ++k) {
      const auto& [right, up, forward] = camera_[k];
      height_[k] = straightened(up - slope * forward, std::abs(right) + std::abs(forward));
      above[k] = projectable_[k] ? is_above(nodes_[k], center) : height_[k] >= 0;
    }
    const RowSection section(surface_, curved_, above.data());
    if (!cut_edges(section, center) && curved_ == nullptr) return;
    if (curved_ != nullptr) curved_->begin_row(center, tile_, above.data());
    for (int x = tile_.x0; x < tile_.x1; ++x) {
      set_sides(section, x);
      RayCrossings ray;
      for (std::size_t i = 0; i < section.triangle_count; ++i) {
        const CrossedTriangle& t = section.triangles[i];
        if (edges_[t.e].left_of_pixel != edges_[t.f].left_of_pixel)
          ray.add(parameter(t, x + 0.5, center), surface_.triangles[t.triangle].face);
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
    RowCrossing on_screen;  // where it is projectable
    // of the pixel at hand
    double offset;  // how far right of the line, at the point's depth
    bool left_of_pixel;
  };

  // False when all that the row crosses lies behind the eye.
  bool cut_edges(const RowSection& section, double center) {
    bool in_front = false;
    for (std::size_t e = 0; e < surface_.edge_count; ++e) {
      if (!section.crossed[e]) continue;
      const auto [a, b] = surface_.edges[e];
      const double difference = height_[a] - height_[b];
      // nodes told apart by their screen coordinates alone may have heights of one sign
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

  void set_sides(const RowSection& section, int x) {
    const double slope = frame_.projector.slopes(x + 0.5, 0)[0];
    for (std::size_t e = 0; e < surface_.edge_count; ++e) {
      if (!section.crossed[e]) continue;
      CrossedEdge& edge = edges_[e];
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
  Nodes nodes_;
  SurfaceDepth depth_;
  std::array<Vector, CellSurface::kMostCorners> camera_;
  std::array<bool, CellSurface::kMostCorners> projectable_;
  // of the row at hand
  std::array<double, CellSurface::kMostCorners> height_;
  std::array<CrossedEdge, CellSurface::kMostEdges> edges_;
};

void scan_beside_eye(const Frame& frame, const CellSurface& surface, CurvedFaces* curved,
                     const TileRect& tile, std::vector<CellCrossing>& crossings) {
  LineScan(frame, surface, curved, tile).scan(crossings);
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hiac {

HWY_EXPORT(scan_projected);
HWY_EXPORT(scan_beside_eye);

void scan_projected_cell(const Frame& frame, const CellSurface& surface, CurvedFaces* curved,
                         const TileRect& tile, std::vector<CellCrossing>& crossings) {
  HWY_DYNAMIC_DISPATCH(scan_projected)(frame, surface, curved, tile, nullptr, crossings);
}

void scan_projected_runs(const Frame& frame, const CellSurface& surface, const TileRect& tile,
                         CrossingRuns& runs, std::vector<CellCrossing>& others) {
  HWY_DYNAMIC_DISPATCH(scan_projected)(frame, surface, nullptr, tile, &runs, others);
}

void scan_cell_beside_eye(const Frame& frame, const CellSurface& surface, CurvedFaces* curved,
                          const TileRect& tile, std::vector<CellCrossing>& crossings) {
  HWY_DYNAMIC_DISPATCH(scan_beside_eye)(frame, surface, curved, tile, crossings);
}

bool is_projectable(const Frame& frame, const CellSurface& surface) {
  return std::none_of(surface.nodes.begin(),
                      surface.nodes.begin() + static_cast<std::ptrdiff_t>(surface.corner_count),
                      [&](NodeId node) { return std::isnan(frame.nodes[node].depth); });
}

void scan_cell(const Frame& frame, CellId cell, const TileRect& tile,
               std::vector<CellCrossing>& crossings) {
  const CellSurface surface = cell_surface(frame.mesh.kinds[cell], frame.mesh.cell_nodes(cell));
  const auto scan = is_projectable(frame, surface) ? scan_projected_cell : scan_cell_beside_eye;
  if (!frame.is_curved(cell)) return scan(frame, surface, nullptr, tile, crossings);
  CurvedFaces curved(frame, cell, surface);
  scan(frame, surface, &curved, tile, crossings);
}

}  // namespace hiac
#endif
