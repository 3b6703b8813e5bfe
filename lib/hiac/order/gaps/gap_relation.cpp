#include "hiac/order/gaps/gap_relation.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <span>
#include <utility>

#include "hiac/base/cancellation.hpp"
#include "hiac/base/collect.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/order/faces/eye_side.hpp"
#include "hiac/order/faces/patch_side.hpp"
#include "hiac/order/gaps/bent_face.hpp"
#include "hiac/order/gaps/face_grid.hpp"
#include "hiac/order/gaps/face_obstruction.hpp"
#include "hiac/order/gaps/gap_window.hpp"

namespace hiac {
namespace {

constexpr std::size_t kFaceGrain = 1 << 11;
constexpr std::size_t kTileGrain = 64;

// An unmatched face that rays cross, as seen in a window.
struct GapFace {
  SeenFace seen;
  CellId cell;
  bool exit;    // whether rays leave the cell through it; else they enter
  double size;  // longest edge or diagonal from its first corner
  Outline outline;
  std::span<const Vector> hull;  // the hull of a face that is not planar; else empty

  [[nodiscard]] bool bent() const { return !hull.empty(); }
};

struct GapQuestion {
  const OrderBasis& basis;
  const View& view;
  double planarity;
  std::vector<BentFace> bent;  // for every unmatched face
};

// Appends a face, unless no ray crosses it in the window.
void add_face(const GapQuestion& q, const Window& window, const UnmatchedFace& face,
              std::vector<GapFace>& faces) {
  const auto corners = std::span(face.nodes).first(face.corner_count);
  GapFace gap{};
  gap.cell = face.cell;
  gap.seen.count = corners.size();
  for (std::size_t k = 0; k < corners.size(); ++k)
    gap.seen.corners[k] = q.basis.mesh->position(corners[k]).data();
  const Point3 a = gap.seen.corner(0);
  const int eye = eye_side(a, gap.seen.corner(1), gap.seen.corner(2), q.view);
  if (eye == 0 || face.side == 0) return;
  gap.seen.winding = eye;
  gap.exit = eye == face.side;
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const Point3 p = gap.seen.corner(k);
    gap.size = std::max(gap.size, std::hypot(p[0] - a[0], p[1] - a[1], p[2] - a[2]));
  }
  if (window.place(gap.seen, gap.outline)) faces.push_back(gap);
}

// Appends a face, or two, an exit and an entry, if rays cross the face both ways.
void add_bent_face(const Window& window, const UnmatchedFace& face, const BentFace& bent,
                   std::vector<GapFace>& faces) {
  if (bent.eye == 0) return;
  GapFace gap{};
  gap.cell = face.cell;
  gap.hull = bent.hull;
  for (const Vector& p : bent.hull) gap.size = std::max(gap.size, length(minus(p, bent.hull[0])));
  if (!window.place_hull(bent.hull, gap.outline)) return;
  for (const bool exit : {true, false}) {
    if (face.side != 0 && bent.eye != kBothSides && exit != (bent.eye == face.side)) continue;
    gap.exit = exit;
    faces.push_back(gap);
  }
}

std::vector<GapFace> faces_in(const GapQuestion& q, const Window& window) {
  const auto& unmatched = q.basis.unmatched;
  return collect<GapFace>(unmatched.size(), kFaceGrain, [&](std::size_t i, auto& faces) {
    if (q.bent[i].hull.empty())
      add_face(q, window, unmatched[i], faces);
    else
      add_bent_face(window, unmatched[i], q.bent[i], faces);
  });
}

// Returns points whose convex hull contains a face: its hull's or its corners.
std::vector<Vector> hull_of(const GapFace& face) {
  if (face.bent()) return {face.hull.begin(), face.hull.end()};
  std::vector<Vector> corners;
  for (std::size_t k = 0; k < face.seen.count; ++k) {
    const Point3 p = face.seen.corner(k);
    corners.push_back({p[0], p[1], p[2]});
  }
  return corners;
}

// What the window coordinates of two faces, with their error bounds, prove about their overlap.
enum class Overlap { none, certain, unknown };

double extent(const Outline& face) { return face.x.high - face.x.low + face.y.high - face.y.low; }

// Two convex polygons in a plane are disjoint exactly if an edge of one of them has the other on
// its outer side or on its line; a corner that both share surely lies on the line. `margin` bounds
// the rounding error of a corner's distance from an edge, times the edge's length.
Overlap overlap_across_edges(const GapFace& f, const GapFace& g, double margin) {
  const double inner = Window::kWinding * f.seen.winding;
  bool all_reached = true;
  for (std::size_t k = 0; k < f.seen.count; ++k) {
    const std::size_t next = k + 1 == f.seen.count ? 0 : k + 1;
    const double px = f.outline.at_x[k], py = f.outline.at_y[k];
    const double dx = inner * (f.outline.at_x[next] - px), dy = inner * (f.outline.at_y[next] - py);
    std::array<double, 4> turn;  // positive where a corner of g lies inside the edge
    for (std::size_t j = 0; j < 4; ++j)
      turn[j] = dx * (g.outline.at_y[j] - py) - dy * (g.outline.at_x[j] - px);
    const double most = std::max(std::max(turn[0], turn[1]), std::max(turn[2], turn[3]));
    if (most > margin) continue;
    all_reached = false;
    bool outside = true;
    for (std::size_t j = 0; j < g.seen.count && outside; ++j) {
      const double* const corner = g.seen.corners[j];
      outside = turn[j] < -margin || corner == f.seen.corners[k] || corner == f.seen.corners[next];
    }
    if (outside) return Overlap::none;
  }
  return all_reached ? Overlap::certain : Overlap::unknown;
}

// For faces whose bounds in the window meet.
Overlap overlap_in_window(const GapFace& f, const GapFace& g) {
  const double off = f.outline.error + g.outline.error;
  const double margin = 8 * off * (extent(f.outline) + extent(g.outline) + off);
  const Overlap across_f = overlap_across_edges(f, g, margin);
  if (across_f == Overlap::none) return Overlap::none;
  const Overlap across_g = overlap_across_edges(g, f, margin);
  if (across_g == Overlap::none) return Overlap::none;
  return across_f == across_g ? across_f : Overlap::unknown;
}

class PairSearch {
 public:
  PairSearch(const GapQuestion& q, const Window& window)
      : q_(q), window_(window), faces_(faces_in(q, window)) {}

  // Appends the arrows, and returns the number of pairs that were tested.
  std::uint64_t run(std::vector<GapArrow>& arrows) const {
    FaceExtent extent;
    for (const GapFace& face : faces_) extent.include(face.outline);
    const FaceGrid grid(extent);
    const FaceBins exits = bins_of(grid, true), entries = bins_of(grid, false);
    std::atomic<std::uint64_t> pairs{0};
    const auto found = collect<GapArrow>(grid.tiles(), kTileGrain, [&](std::size_t t, auto& list) {
      pairs += decide_tile(grid, t, exits[t], entries[t], list);
    });
    arrows.insert(arrows.end(), found.begin(), found.end());
    return pairs;
  }

 private:
  // Exits are sorted by where their depth range begins, entries by where it ends, both moved by the
  // slack within which faces count as touching. Ascending.
  [[nodiscard]] FaceBins bins_of(const FaceGrid& grid, bool exit) const {
    std::vector<BinnedFace> faces;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      const GapFace& face = faces_[f];
      if (face.exit != exit) continue;
      const double slack = q_.planarity * face.size;
      const double depth = exit ? face.outline.depth.low - slack : face.outline.depth.high + slack;
      faces.push_back(grid.binned(face.outline, depth, !exit, f));
    }
    std::ranges::sort(faces, {}, &BinnedFace::depth);
    return grid.bin(faces);
  }

  // Decides the pairs of a tile. Returns their number.
  std::uint64_t decide_tile(const FaceGrid& grid, std::size_t tile,
                            std::span<const BinnedFace> exits, std::span<const BinnedFace> entries,
                            std::vector<GapArrow>& arrows) const {
    std::vector<std::uint64_t> prepared;
    for (const BinnedFace& entry : entries) prepared.push_back(MeetingTest::prepared(entry.bounds));
    std::uint64_t decided = 0;
    std::size_t first_behind = 0;
    for (const BinnedFace& exit : exits) {
      check_cancelled();
      while (first_behind < entries.size() && entries[first_behind].depth < exit.depth)
        ++first_behind;
      const MeetingTest test(exit.bounds);
      for (std::size_t e = first_behind; e < entries.size(); ++e) {
        if (!test.meets(prepared[e])) continue;
        const BinnedFace& entry = entries[e];
        // the first of the tiles that contain both decides the pair
        if (grid.tile_at(std::max(exit.bounds.x_low, entry.bounds.x_low),
                         std::max(exit.bounds.y_low, entry.bounds.y_low)) != tile)
          continue;
        decided += decide(faces_[exit.face], faces_[entry.face], arrows) ? 1 : 0;
      }
    }
    return decided;
  }

  // Returns true if the pair needed more than the test of bounds.
  bool decide(const GapFace& exit, const GapFace& entry, std::vector<GapArrow>& arrows) const {
    if (exit.cell == entry.cell) return false;
    if (exit.bent() || entry.bent()) {
      const double slack = q_.planarity * std::max(exit.size, entry.size);
      if (may_be_met_first(hull_of(exit), hull_of(entry), q_.view, slack))
        arrows.push_back({exit.cell, entry.cell});
      return true;
    }
    const Overlap overlap = window_.pyramid() ? Overlap::unknown : overlap_in_window(exit, entry);
    if (overlap == Overlap::none) return true;
    if (overlap == Overlap::unknown && !projections_overlap(exit.seen, entry.seen, q_.view))
      return true;
    const double slack = q_.planarity * std::max(exit.size, entry.size);
    // an exit that lies wholly in front of an entry is met first. In a pyramid the depths bound
    // only the parts of the faces inside it; the order may be reversed where they overlap
    const bool farther = !window_.pyramid() && exit.outline.depth.high < entry.outline.depth.low;
    if (farther || reached_first(exit.seen, entry.seen, q_.view, slack))
      arrows.push_back({exit.cell, entry.cell});
    return true;
  }

  const GapQuestion& q_;
  const Window& window_;
  std::vector<GapFace> faces_;
};

// Returns the number of pairs of faces that were tested.
std::uint64_t add_gap_arrows(const OrderBasis& basis, const View& view, double planarity,
                             std::vector<GapArrow>& arrows) {
  GapQuestion question{basis, view, planarity, {}};
  question.bent.resize(basis.unmatched.size());
  parallel_for(question.bent.size(), kFaceGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      question.bent[i] = bent_face(*basis.mesh, basis.unmatched[i], view, planarity);
  });
  std::vector<Vector> points;
  for (const BentFace& face : question.bent)
    points.insert(points.end(), face.hull.begin(), face.hull.end());
  std::uint64_t pairs = 0;
  for (const Window& window : windows_of(*basis.mesh, points, view))
    pairs += PairSearch(question, window).run(arrows);
  return pairs;
}

}  // namespace

GapRelation sorted_by_cell(std::size_t cells, std::span<const GapArrow> arrows) {
  GapRelation relation;
  if (arrows.empty()) return relation;
  auto& [start, behind, pairs] = relation;
  start.assign(cells + 1, 0);
  for (const GapArrow& arrow : arrows) ++start[arrow.front + 1];
  for (std::size_t cell = 0; cell < cells; ++cell) start[cell + 1] += start[cell];
  behind.resize(arrows.size());
  // while arrows are placed, start[c] is where the next arrow of cell c goes; then where they end
  for (const GapArrow& arrow : arrows) behind[start[arrow.front]++] = arrow.behind;
  std::uint64_t begin = 0, kept = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const std::uint64_t end = std::exchange(start[cell], kept);
    const auto first = behind.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = behind.begin() + static_cast<std::ptrdiff_t>(end);
    begin = end;
    if (first == last) continue;
    std::sort(first, last);
    const auto to = behind.begin() + static_cast<std::ptrdiff_t>(kept);
    kept =
        static_cast<std::uint64_t>(std::move(first, std::unique(first, last), to) - behind.begin());
  }
  start.back() = kept;
  behind.resize(kept);
  return relation;
}

GapRelation gap_relation(const OrderBasis& basis, const View& view, double planarity) {
  std::vector<GapArrow> arrows;
  for (const auto& [a, b] : basis.overlaps) {
    arrows.push_back({a, b});
    arrows.push_back({b, a});
  }
  // no ray leaves a convex mesh and enters it again
  const std::uint64_t pairs = basis.convex ? 0 : add_gap_arrows(basis, view, planarity, arrows);
  GapRelation relation = sorted_by_cell(basis.mesh->cell_count(), arrows);
  relation.candidate_pairs = pairs;
  return relation;
}

}  // namespace hiac
