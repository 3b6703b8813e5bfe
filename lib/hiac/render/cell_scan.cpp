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

// Compiled once for every instruction set, although little is in vectors here: where the
// tetrahedron kernel uses fused operations, these have to be fused as well.

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Fused where the instruction set has it, as the same operation on vectors is.
HWY_INLINE double mul_add(double a, double b, double c) {
  const hn::CappedTag<double, 1> d;
  return hn::GetLane(hn::MulAdd(hn::Set(d, a), hn::Set(d, b), hn::Set(d, c)));
}
HWY_INLINE double neg_mul_add(double a, double b, double c) {
  const hn::CappedTag<double, 1> d;
  return hn::GetLane(hn::NegMulAdd(hn::Set(d, a), hn::Set(d, b), hn::Set(d, c)));
}

// The first pixel in [low, high] whose centre lies at or after a coordinate.
HWY_INLINE int first_center(double coordinate, int low, int high) {
  const double clamped =
      std::min(std::max(coordinate - 0.5, static_cast<double>(low)), static_cast<double>(high));
  return static_cast<int>(std::ceil(clamped));
}

// Nodes above a row of pixel centres or on it.
HWY_INLINE bool is_above(const ProjectedNode& node, double center) { return node.y <= center; }

// The first pixel right of where a row of pixel centres crosses the edge a-b, or on it.
HWY_INLINE int crossing_column(const ProjectedNode& a, const ProjectedNode& b, double center,
                               const TileRect& tile) {
  const double slope = (b.x - a.x) / (b.y - a.y);
  const double offset = (center - a.y) * slope;
  return first_center(a.x + offset, tile.x0, tile.x1);
}

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
    least_ = std::min({base.depth, one.depth, two.depth});
    most_ = std::max({base.depth, one.depth, two.depth});
  }

  // Never beyond the triangle's corners: on triangles seen edge-on rounding knows no other bound.
  [[nodiscard]] HWY_INLINE double at(double x, double y) const {
    const double dx = x - base_.x, dy = y - base_.y;
    const double s = mul_add(dx, cx_, cy_ * dy);
    const double m = neg_mul_add(h_, s, mul_add(dx, gx_, gy_ * dy));
    const double depth = mul_add(s, qs_, mul_add(m, qm_, base_.depth));
    return std::min(std::max(depth, least_), most_);
  }

 private:
  ProjectedNode base_;
  double cx_, cy_, gx_, gy_, h_, qm_, qs_, least_, most_;
};

using Nodes = std::array<ProjectedNode, CellSurface::kMostCorners>;

HWY_INLINE Nodes projected_nodes(const Frame& frame, const CellSurface& surface) {
  Nodes nodes;
  for (std::size_t k = 0; k < surface.corner_count; ++k) nodes[k] = frame.nodes[surface.nodes[k]];
  return nodes;
}

// The depths on a cell's triangles, each made ready when it is first needed.
class SurfaceDepth {
 public:
  HWY_INLINE SurfaceDepth(const CellSurface& surface, const Nodes& nodes)
      : surface_(surface), nodes_(nodes) {}

  HWY_INLINE double at(std::size_t triangle, double x, double y) {
    if (!ready_[triangle]) {
      const auto& c = surface_.triangles[triangle].corners;
      triangles_[triangle] = TriangleDepth(nodes_[c[0]], nodes_[c[1]], nodes_[c[2]]);
      ready_[triangle] = true;
    }
    return triangles_[triangle].at(x, y);
  }

 private:
  const CellSurface& surface_;
  const Nodes& nodes_;
  std::array<TriangleDepth, CellSurface::kMostTriangles> triangles_;
  std::array<bool, CellSurface::kMostTriangles> ready_{};
};

// Columns first <= x < last of a row.
struct Run {
  int first, last;
};

// The pixels of one row that each triangle of a cell covers, and all of them together.
struct RowRuns {
  std::array<Run, CellSurface::kMostTriangles> triangles;
  Run whole;
};

HWY_INLINE RowRuns scan_row(const CellSurface& surface, const Nodes& nodes, const TileRect& tile,
                            double center) {
  const Run none{tile.x1, tile.x0};
  std::array<Run, CellSurface::kMostEdges> edges;
  for (std::size_t e = 0; e < surface.edge_count; ++e) {
    const ProjectedNode &a = nodes[surface.edges[e][0]], &b = nodes[surface.edges[e][1]];
    edges[e] = none;
    if (is_above(a, center) == is_above(b, center)) continue;
    const int column = crossing_column(a, b, center, tile);
    edges[e] = {column, column};
  }
  RowRuns runs{{}, none};
  const auto join = [](const Run& a, const Run& b) {
    return Run{std::min(a.first, b.first), std::max(a.last, b.last)};
  };
  for (std::size_t k = 0; k < surface.triangle_count; ++k) {
    const auto& e = surface.triangles[k].edges;
    runs.triangles[k] = join(join(edges[e[0]], edges[e[1]]), edges[e[2]]);
    runs.whole = join(runs.whole, runs.triangles[k]);
  }
  return runs;
}

void scan_projected(const Frame& frame, const CellSurface& surface, const TileRect& tile,
                    std::vector<CellCrossing>& crossings) {
  const Nodes nodes = projected_nodes(frame, surface);
  const bool perspective = frame.projector.perspective();
  double top = nodes[0].y, bottom = nodes[0].y;
  for (std::size_t k = 1; k < surface.corner_count; ++k) {
    top = std::min(top, nodes[k].y);
    bottom = std::max(bottom, nodes[k].y);
  }
  SurfaceDepth depth(surface, nodes);
  const int row_end = first_center(bottom, tile.y0, tile.y1);
  for (int y = first_center(top, tile.y0, tile.y1); y < row_end; ++y) {
    const double center = y + 0.5;
    const RowRuns runs = scan_row(surface, nodes, tile, center);
    for (int x = runs.whole.first; x < runs.whole.last; ++x) {
      double front = std::numeric_limits<double>::infinity(), back = -front;
      for (std::size_t k = 0; k < surface.triangle_count; ++k) {
        if (x < runs.triangles[k].first || x >= runs.triangles[k].last) continue;
        const double here = depth.at(k, x + 0.5, center);
        front = std::min(front, here);
        back = std::max(back, here);
      }
      if (front > back) continue;
      if (perspective) {
        front = -1 / front;
        back = -1 / back;
      }
      crossings.push_back({x, y, front, back});
    }
  }
}

using Vector = std::array<double, 3>;

// Where the plane of the eye and a row of pixel centres crosses an edge: right and forward
// coordinates from the eye, in that plane.
struct PlanePoint {
  double right, forward;
};

// A cell beside the eye, row by row.
class LineScan {
 public:
  LineScan(const Frame& frame, const CellSurface& surface, const TileRect& tile)
      : frame_(frame),
        surface_(surface),
        tile_(tile),
        nodes_(projected_nodes(frame, surface)),
        depth_(surface, nodes_) {
    for (std::size_t k = 0; k < surface.corner_count; ++k) {
      camera_[k] = frame.projector.camera_coordinates(frame.mesh.position(surface.nodes[k]));
      projectable_[k] = !std::isnan(nodes_[k].depth);
    }
  }

  void scan(std::vector<CellCrossing>& crossings) {
    if (outside_tile()) return;
    for (int y = tile_.y0; y < tile_.y1; ++y) {
      if (!cut(y)) continue;
      for (int x = tile_.x0; x < tile_.x1; ++x) {
        CellCrossing crossing{x, y, std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity()};
        cross(crossing);
        if (crossing.front <= crossing.back) crossings.push_back(crossing);
      }
    }
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

  // Cuts the cell with the plane of one row. False when no pixel of the row sees the section.
  bool cut(int y) {
    center_ = y + 0.5;
    const double slope = frame_.projector.slopes(0, center_)[1];
    bool in_front = false;
    for (std::size_t k = 0; k < surface_.corner_count; ++k) {
      height_[k] = camera_[k][1] - slope * camera_[k][2];
      above_[k] = projectable_[k] ? is_above(nodes_[k], center_) : height_[k] >= 0;
    }
    for (std::size_t e = 0; e < surface_.edge_count; ++e) {
      const auto [a, b] = surface_.edges[e];
      crossed_[e] = above_[a] != above_[b];
      if (!crossed_[e]) continue;
      points_[e] = point_between(a, b);
      in_front = in_front || points_[e].forward > 0;
      on_screen_[e] = projectable_[a] && projectable_[b];
      if (on_screen_[e]) column_[e] = crossing_column(nodes_[a], nodes_[b], center_, tile_);
    }
    return in_front;
  }

  [[nodiscard]] PlanePoint point_between(std::size_t a, std::size_t b) const {
    const double difference = height_[a] - height_[b];
    // nodes told apart by their screen coordinates alone may have heights of one sign
    const double s = difference == 0 ? 0.5 : std::clamp(height_[a] / difference, 0.0, 1.0);
    return {camera_[a][0] + s * (camera_[b][0] - camera_[a][0]),
            camera_[a][2] + s * (camera_[b][2] - camera_[a][2])};
  }

  void cross(CellCrossing& crossing) {
    const double slope = frame_.projector.slopes(crossing.x + 0.5, center_)[0];
    for (std::size_t e = 0; e < surface_.edge_count; ++e) {
      if (!crossed_[e]) continue;
      offset_[e] = points_[e].right - slope * points_[e].forward;
      left_of_pixel_[e] = on_screen_[e] ? crossing.x >= column_[e] : offset_[e] <= 0;
    }
    for (std::size_t k = 0; k < surface_.triangle_count; ++k) {
      const auto& edges = surface_.triangles[k].edges;
      // two edges of a triangle are crossed, or none
      std::array<std::size_t, 2> e{};
      std::size_t count = 0;
      for (const std::uint8_t edge : edges)
        if (crossed_[edge]) e[count++] = edge;
      if (count == 0 || left_of_pixel_[e[0]] == left_of_pixel_[e[1]]) continue;
      const double here = parameter(k, e[0], e[1], crossing.x);
      crossing.front = std::min(crossing.front, here);
      crossing.back = std::max(crossing.back, here);
    }
  }

  // The ray parameter at which a triangle is crossed, between its edges e and f.
  [[nodiscard]] double parameter(std::size_t triangle, std::size_t e, std::size_t f, int x) {
    const auto& c = surface_.triangles[triangle].corners;
    if (projectable_[c[0]] && projectable_[c[1]] && projectable_[c[2]])
      return -1 / depth_.at(triangle, x + 0.5, center_);
    const double difference = offset_[e] - offset_[f];
    const double s = difference == 0 ? 0.5 : std::clamp(offset_[e] / difference, 0.0, 1.0);
    return points_[e].forward + s * (points_[f].forward - points_[e].forward);
  }

  const Frame& frame_;
  const CellSurface& surface_;
  const TileRect& tile_;
  Nodes nodes_;
  SurfaceDepth depth_;
  std::array<Vector, CellSurface::kMostCorners> camera_;
  std::array<bool, CellSurface::kMostCorners> projectable_;
  // of the row at hand
  double center_ = 0;
  std::array<double, CellSurface::kMostCorners> height_;
  std::array<bool, CellSurface::kMostCorners> above_;
  std::array<bool, CellSurface::kMostEdges> crossed_, on_screen_;
  std::array<PlanePoint, CellSurface::kMostEdges> points_;
  std::array<int, CellSurface::kMostEdges> column_;
  // of the pixel at hand
  std::array<double, CellSurface::kMostEdges> offset_;
  std::array<bool, CellSurface::kMostEdges> left_of_pixel_;
};

void scan_beside_eye(const Frame& frame, const CellSurface& surface, const TileRect& tile,
                     std::vector<CellCrossing>& crossings) {
  LineScan(frame, surface, tile).scan(crossings);
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hiac {

HWY_EXPORT(scan_projected);
HWY_EXPORT(scan_beside_eye);

void scan_projected_cell(const Frame& frame, const CellSurface& surface, const TileRect& tile,
                         std::vector<CellCrossing>& crossings) {
  HWY_DYNAMIC_DISPATCH(scan_projected)(frame, surface, tile, crossings);
}

void scan_cell_beside_eye(const Frame& frame, const CellSurface& surface, const TileRect& tile,
                          std::vector<CellCrossing>& crossings) {
  HWY_DYNAMIC_DISPATCH(scan_beside_eye)(frame, surface, tile, crossings);
}

}  // namespace hiac
#endif
