#include "hiac/order/gap_relation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <span>

#include "hiac/base/parallel.hpp"
#include "hiac/order/eye_side.hpp"
#include "hiac/order/face_obstruction.hpp"

namespace hiac {
namespace {

using Vector = std::array<double, 3>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kMostTilesPerSide = 1024;

Vector minus(Point3 a, Point3 b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct Interval {
  double low = kInfinity, high = -kInfinity;

  void include(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  // widened by more than the rounding of what it was made of
  void widen(double scale) {
    const double slack = 1e-12 * (std::abs(low) + std::abs(high) + scale);
    low -= slack;
    high += slack;
  }
  [[nodiscard]] bool meets(const Interval& other) const {
    return low <= other.high && other.low <= high;
  }
};

// An unmatched face that rays cross, and its bounds in a window.
struct GapFace {
  SeenFace seen;
  CellId cell;
  double size;  // longest edge or diagonal from its first corner
  Interval x, y, depth;
};

// What rays leave through and what they enter through.
struct GapFaces {
  std::vector<GapFace> exits, entries;
};

void add_face(const ZooMesh& mesh, const UnmatchedFace& face, std::span<const NodeId> corners,
              const View& view, GapFaces& faces) {
  GapFace gap{};
  gap.cell = face.cell;
  gap.seen.count = corners.size();
  for (std::size_t k = 0; k < corners.size(); ++k)
    gap.seen.corners[k] = mesh.position(corners[k]).data();
  const Point3 a = gap.seen.corner(0);
  const int eye = eye_side(a, gap.seen.corner(1), gap.seen.corner(2), view);
  if (eye == 0 || face.side == 0) return;
  gap.seen.winding = eye;
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const Vector edge = minus(gap.seen.corner(k), a);
    gap.size = std::max(gap.size, std::hypot(edge[0], edge[1], edge[2]));
  }
  (eye == face.side ? faces.exits : faces.entries).push_back(gap);
}

GapFaces find_gap_faces(const OrderBasis& basis, const View& view, double planarity) {
  GapFaces faces;
  for (const UnmatchedFace& face : basis.unmatched) {
    const auto nodes = std::span(face.nodes);
    if (face.corner_count == 3 || face.deviation > planarity)
      add_face(*basis.mesh, face, nodes.first(3), view, faces);
    else
      add_face(*basis.mesh, face, nodes, view, faces);
    if (face.corner_count == 4 && face.deviation > planarity)
      add_face(*basis.mesh, face, std::array{nodes[0], nodes[2], nodes[3]}, view, faces);
  }
  return faces;
}

// A plane to project on. A face is bounded by its corners in it when all of them lie before the
// eye; else only what lies inside the window's pyramid |x|, |y| <= depth counts.
class Window {
 public:
  Window(const View& view, const Vector& axis, bool pyramid)
      : view_(view), axis_(axis), pyramid_(pyramid) {
    const std::size_t least = std::abs(axis[0]) <= std::abs(axis[1])
                                  ? (std::abs(axis[0]) <= std::abs(axis[2]) ? 0U : 2U)
                                  : (std::abs(axis[1]) <= std::abs(axis[2]) ? 1U : 2U);
    Vector other{};
    other[least] = 1;
    right_ = unit(cross(axis_, other));
    up_ = cross(unit(axis_), right_);
    axis_ = unit(axis_);
  }

  // False when nothing of the face is seen in the window.
  bool bound(GapFace& face) const {
    std::vector<Vector> points;
    for (std::size_t k = 0; k < face.seen.count; ++k) points.push_back(seen(face.seen.corner(k)));
    if (pyramid_) clip(points);
    face.x = face.y = face.depth = {};
    for (const Vector& p : points) {
      const double scale = view_.perspective ? p[2] : 1;
      face.x.include(p[0] / scale);
      face.y.include(p[1] / scale);
      face.depth.include(p[2]);
    }
    if (points.empty()) return false;
    face.x.widen(pyramid_ ? 1 : face.size);
    face.y.widen(pyramid_ ? 1 : face.size);
    face.depth.widen(face.size);
    return true;
  }

 private:
  static Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static Vector unit(const Vector& v) {
    const double length = std::hypot(v[0], v[1], v[2]);
    return {v[0] / length, v[1] / length, v[2] / length};
  }
  [[nodiscard]] Vector seen(Point3 p) const {
    const Vector v = view_.perspective ? minus(p, Point3(view_.eye)) : Vector{p[0], p[1], p[2]};
    return {dot(v, right_), dot(v, up_), dot(v, axis_)};
  }

  // Keeps the part of a polygon inside the window's pyramid, a little widened.
  static void clip(std::vector<Vector>& polygon) {
    constexpr double kOpening = 1 + 1e-9;
    for (std::size_t side = 0; side < 4; ++side) {
      const auto inside = [side](const Vector& p) {
        const double coordinate = side < 2 ? p[0] : p[1];
        return kOpening * p[2] - (side % 2 == 0 ? coordinate : -coordinate);
      };
      std::vector<Vector> kept;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vector &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
        const double p_in = inside(p), q_in = inside(q);
        if (p_in >= 0) kept.push_back(p);
        if ((p_in < 0) == (q_in < 0)) continue;
        const double u = p_in / (p_in - q_in);
        kept.push_back(
            {p[0] + u * (q[0] - p[0]), p[1] + u * (q[1] - p[1]), p[2] + u * (q[2] - p[2])});
      }
      polygon = std::move(kept);
    }
    std::erase_if(polygon, [](const Vector& p) { return !(p[2] > 0); });
  }

  const View& view_;
  Vector axis_, right_{}, up_{};
  bool pyramid_;
};

// The windows that together see the whole mesh: one when it lies on one side of the eye, else the
// six sides of a cube around the eye.
std::vector<Window> windows_of(const ZooMesh& mesh, const View& view) {
  if (!view.perspective) return {Window(view, view.direction, false)};
  std::array<Interval, 3> box;
  for (std::size_t i = 0; i < mesh.xyz.size(); ++i) box[i % 3].include(mesh.xyz[i]);
  Vector axis;
  for (std::size_t c = 0; c < 3; ++c)
    axis[c] = std::clamp(view.eye[c], box[c].low, box[c].high) - view.eye[c];
  if (dot(axis, axis) > 0) return {Window(view, axis, false)};
  std::vector<Window> sides;
  for (std::size_t c = 0; c < 3; ++c)
    for (const double sign : {-1.0, 1.0}) {
      Vector towards{};
      towards[c] = sign;
      sides.emplace_back(view, towards, true);
    }
  return sides;
}

// A regular grid over the window, and the faces whose bounds meet each of its tiles.
class FaceGrid {
 public:
  FaceGrid(Interval x, Interval y, std::size_t tiles_per_side)
      : x_(x), y_(y), side_(tiles_per_side) {}

  [[nodiscard]] std::size_t tiles() const { return side_ * side_; }
  [[nodiscard]] std::size_t tile_of(double x, double y) const {
    return place(y, y_) * side_ + place(x, x_);
  }

  // Faces by tile: those of tile t are members[start[t]] ... members[start[t + 1] - 1].
  struct Bins {
    std::vector<std::uint32_t> start, members;
  };
  [[nodiscard]] Bins bin(std::span<const GapFace> faces) const {
    Bins bins;
    bins.start.assign(tiles() + 1, 0);
    for_each_place(faces, [&](std::size_t tile, std::uint32_t) { ++bins.start[tile + 1]; });
    for (std::size_t t = 0; t < tiles(); ++t) bins.start[t + 1] += bins.start[t];
    bins.members.resize(bins.start.back());
    std::vector<std::uint32_t> next(bins.start.begin(), bins.start.end() - 1);
    for_each_place(faces,
                   [&](std::size_t tile, std::uint32_t f) { bins.members[next[tile]++] = f; });
    return bins;
  }

 private:
  [[nodiscard]] std::size_t place(double v, const Interval& range) const {
    const double u = (v - range.low) / (range.high - range.low) * static_cast<double>(side_);
    return static_cast<std::size_t>(std::clamp(u, 0.0, static_cast<double>(side_ - 1)));
  }
  template <typename Visit>
  void for_each_place(std::span<const GapFace> faces, const Visit& visit) const {
    for (std::uint32_t f = 0; f < faces.size(); ++f)
      for (std::size_t r = place(faces[f].y.low, y_); r <= place(faces[f].y.high, y_); ++r)
        for (std::size_t c = place(faces[f].x.low, x_); c <= place(faces[f].x.high, x_); ++c)
          visit(r * side_ + c, f);
  }

  Interval x_, y_;
  std::size_t side_;
};

std::vector<GapFace> seen_in(const Window& window, std::vector<GapFace> faces) {
  std::erase_if(faces, [&](GapFace& face) { return !window.bound(face); });
  return faces;
}

class PairSearch {
 public:
  PairSearch(const View& view, double planarity, const Window& window, const GapFaces& faces)
      : view_(view),
        planarity_(planarity),
        exits_(seen_in(window, faces.exits)),
        entries_(seen_in(window, faces.entries)) {}

  void run(GapRelation& relation) {
    if (exits_.empty() || entries_.empty()) return;
    Interval x, y;
    for (const auto* list : {&exits_, &entries_})
      for (const GapFace& face : *list) {
        x.include(face.x.low), x.include(face.x.high);
        y.include(face.y.low), y.include(face.y.high);
      }
    const auto per_side = static_cast<std::size_t>(
        std::sqrt(static_cast<double>(exits_.size() + entries_.size()) / 2));
    const FaceGrid grid(x, y, std::clamp<std::size_t>(per_side, 1, kMostTilesPerSide));
    const auto exits = grid.bin(exits_), entries = grid.bin(entries_);
    std::mutex joining;
    parallel_for(grid.tiles(), 64, [&](IndexRange tiles) {
      std::vector<GapArrow> arrows;
      std::uint64_t pairs = 0;
      for (std::size_t tile = tiles.begin; tile < tiles.end; ++tile)
        for (std::uint32_t i = exits.start[tile]; i < exits.start[tile + 1]; ++i)
          for (std::uint32_t j = entries.start[tile]; j < entries.start[tile + 1]; ++j)
            pairs +=
                decide(grid, tile, exits_[exits.members[i]], entries_[entries.members[j]], arrows)
                    ? 1
                    : 0;
      const std::scoped_lock lock(joining);
      relation.candidate_pairs += pairs;
      relation.arrows.insert(relation.arrows.end(), arrows.begin(), arrows.end());
    });
  }

 private:
  // True when the pair had to be asked the exact questions.
  bool decide(const FaceGrid& grid, std::size_t tile, const GapFace& exit, const GapFace& entry,
              std::vector<GapArrow>& arrows) const {
    if (exit.cell == entry.cell || !exit.x.meets(entry.x) || !exit.y.meets(entry.y)) return false;
    // nothing of the entry lies behind the exit, not even by the slack for faces that touch
    const double slack = planarity_ * std::max(exit.size, entry.size);
    if (entry.depth.high + slack < exit.depth.low) return false;
    // of the tiles that both are in, the first one decides
    if (grid.tile_of(std::max(exit.x.low, entry.x.low), std::max(exit.y.low, entry.y.low)) != tile)
      return false;
    if (projections_overlap(exit.seen, entry.seen, view_) &&
        reached_first(exit.seen, entry.seen, view_, slack))
      arrows.push_back({exit.cell, entry.cell});
    return true;
  }

  const View& view_;
  double planarity_;
  std::vector<GapFace> exits_, entries_;
};

}  // namespace

GapRelation gap_relation(const OrderBasis& basis, const View& view, double planarity) {
  GapRelation relation;
  const GapFaces faces = find_gap_faces(basis, view, planarity);
  for (const Window& window : windows_of(*basis.mesh, view))
    PairSearch(view, planarity, window, faces).run(relation);
  std::sort(relation.arrows.begin(), relation.arrows.end());
  relation.arrows.erase(std::unique(relation.arrows.begin(), relation.arrows.end()),
                        relation.arrows.end());
  return relation;
}

}  // namespace hiac
