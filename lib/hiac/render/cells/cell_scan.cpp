#include "hiac/render/cells/cell_scan.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hiac/render/cells/cell_scan.cpp"
#include <hwy/foreach_target.h>
// must come after foreach_target.h
#include <hwy/highway.h>

#include "hiac/render/cells/surface_depth-inl.hpp"

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

// The edges of a surface on the screen, and where the row at hand crosses them: cross_row for many
// edges at a time.
class EdgesOnScreen {
 public:
  HWY_INLINE EdgesOnScreen(const CellSurface& surface, const Nodes& nodes) : surface_(surface) {
    for (std::size_t e = 0; e < surface.edge_count; ++e) {
      const ProjectedNode &a = nodes[surface.edges[e][0]], &b = nodes[surface.edges[e][1]];
      x_[e] = a.x;
      y_[e] = a.y;
      other_y_[e] = b.y;
      height_[e] = b.y - a.y;
      slope_[e] = (b.x - a.x) / height_[e];
      on_it_[e] = 0.5 + on_crossing(slope_[e]);
      depth_[e] = a.depth;
      deeper_[e] = b.depth - a.depth;
    }
  }

  // Returns those that the row crosses, a bit each; only these are in `at`.
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
      const auto here = hn::Add(hn::Load(d, x_ + e), hn::Mul(down, hn::Load(d, slope_ + e)));
      const auto s = hn::Div(down, hn::Load(d, height_ + e));
      hn::Store(here, d, x + e);
      hn::Store(hn::Add(hn::Load(d, depth_ + e), hn::Mul(s, hn::Load(d, deeper_ + e))), d,
                depth + e);
      const auto first = hn::Sub(here, hn::Load(d, on_it_ + e));
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
  // of an edge's first corner; `other_y_`: of its second one
  HWY_ALIGN double x_[kPlaces]{}, y_[kPlaces]{}, depth_[kPlaces]{}, other_y_[kPlaces]{};
  // from the one to the other
  HWY_ALIGN double height_[kPlaces]{}, slope_[kPlaces]{}, deeper_[kPlaces]{};
  HWY_ALIGN double on_it_[kPlaces]{};  // how far left of a pixel's right edge counts as on it
};

// Triangles off the screen are seen edge-on (kEdgeOnWidth) when they are narrower than this,
// relative to their distance from the eye.
constexpr double kEdgeOn = 64 * std::numeric_limits<double>::epsilon();

// A triangle that a row crosses, between two of its edges.
struct CrossedTriangle {
  std::size_t triangle, e, f;
};

// What one row crosses.
struct RowSection {
  std::array<CrossedTriangle, CellSurface::kMostTriangles> triangles;
  std::size_t triangle_count;

  // `crossed`: edges that the row crosses, a bit each. Triangles of curved faces are left out.
  HWY_INLINE RowSection(const CellSurface& surface, const CurvedFaces* curved,
                        std::uint32_t crossed)
      : triangle_count(0) {
    const auto is_crossed = [&](std::uint8_t e) { return (crossed >> e & 1U) != 0; };
    for (std::size_t k = 0; k < surface.triangle_count; ++k) {
      if (curved != nullptr && curved->holds(surface.triangles[k].face)) continue;
      // two edges of a triangle are crossed, or none
      const auto& [a, b, c] = surface.triangles[k].edges;
      if (!is_crossed(a) && !is_crossed(b)) continue;
      triangles[triangle_count++] = {k, is_crossed(a) ? a : b,
                                     is_crossed(a) && is_crossed(b) ? b : c};
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
    for (int y = first_center(top, tile_.y0, tile_.y1); y < row_end; ++y) scan_row(y, crossings);
  }

 private:
  void scan_row(int y, std::vector<CellCrossing>& crossings) {
    const double center = y + 0.5;
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
      parts[count++] = {depth_.row(k, edges[e], edges[f], y + 0.5), static_cast<double>(from),
                        static_cast<double>(to)};
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
      const SurfaceDepth::Row depth = depth_.row(k, edges[e], edges[f], y + 0.5);
      for (std::size_t j = 0; j < pixels; j += hn::Lanes(d))
        hn::StoreU(depth.at(d, hn::Iota(d, from + 0.5 + static_cast<double>(j))), d,
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
  EdgesOnScreen on_screen_;
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
  bool cut_edges(std::uint32_t crossed, double center) {
    bool in_front = false;
    for (std::uint32_t rest = crossed; rest != 0; rest &= rest - 1) {
      const auto e = static_cast<std::size_t>(std::countr_zero(rest));
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

  void set_sides(std::uint32_t crossed, int x) {
    const double slope = frame_.projector.slopes(x + 0.5, 0)[0];
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
