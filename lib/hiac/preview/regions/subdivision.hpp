#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hiac/preview/regions/screen_predicates.hpp"

namespace hiac::preview {

/// An edge of a polyhedron: two of its vertices.
using PolyhedronEdge = std::array<std::uint16_t, 2>;

/// The subdivision of the plane by the projected edges of a polyhedron, whose bounded regions are
/// homogeneous: no projected edge crosses one (Williams, Max, Stein 1998, section 7).
///
/// Edges are added one at a time to a half-edge structure (the paper: winged edges). A new edge is
/// followed from its starting vertex through the regions that it crosses, along the edges that it
/// overlaps, and through the vertices that it meets. Every decision is an exact predicate on the
/// coordinates as given; vertices at one point become one, edges of no length vanish, overlapping
/// edges become one with several sources.
///
/// The object is reused: build() forgets what was there and keeps the memory.
class Subdivision {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// A point where edges meet: a given point, or else the crossing of two given edges.
  struct Vertex {
    std::uint32_t point;                 ///< the first given point here; kNone at a crossing
    std::array<std::uint32_t, 2> edges;  ///< the crossing's
    std::uint32_t out;                   ///< a half-edge that leaves it; kNone: a lone point
  };
  /// A region: `count` entries of corners() from `first` on, in one turn around it, counter-
  /// clockwise with y up. Corners may lie on straight sides.
  struct Region {
    std::uint32_t first, count;
  };

  /// `edges`: pairs of indices into `points`, of a connected graph (std::invalid_argument where it
  /// is not). Both have to outlive the use of this object.
  void build(std::span<const ScreenPoint> points, std::span<const PolyhedronEdge> edges);

  [[nodiscard]] std::span<const Vertex> vertices() const { return vertices_; }
  [[nodiscard]] std::span<const Region> regions() const { return regions_; }
  /// Indices of vertices.
  [[nodiscard]] std::span<const std::uint32_t> corners() const { return corners_; }
  /// The outline: the unbounded region's corners, clockwise with y up.
  [[nodiscard]] std::span<const std::uint32_t> outline() const { return outline_; }
  /// The vertex at a given point; points at one place have one vertex.
  [[nodiscard]] std::uint32_t vertex_of(std::uint32_t point) const { return vertex_of_[point]; }
  /// Where a vertex is: exactly at a given point, else the crossing, rounded.
  [[nodiscard]] ScreenPoint position(const Vertex& vertex) const;
  /// Calls visit(edge) for every given edge that begins, ends or passes at a vertex and has a
  /// length; for some of them more than once.
  template <class Visit>
  void for_edges_at(const Vertex& vertex, const Visit& visit) const {
    if (vertex.out == kNone) return;
    std::uint32_t h = vertex.out;
    do {
      for (std::uint32_t s = pairs_[h / 2].sources; s != kNone; s = sources_[s].next)
        visit(sources_[s].edge);
      h = twin(half_edges_[h].prev);
    } while (h != vertex.out);
  }

 private:
  // Half-edges 2 k and 2 k + 1 are twins; the region of a half-edge is to its left.
  struct HalfEdge {
    std::uint32_t origin, next, prev;
  };
  // Both lie on the line of `edge`, the even one in its direction or, `reversed`, against it.
  struct Pair {
    std::uint32_t edge, sources;
    bool reversed;
  };
  struct Source {
    std::uint32_t edge, next;
  };
  // The next thing that a new edge meets in a region: a vertex, or the inside of a half-edge.
  struct Hit {
    std::uint32_t vertex = kNone, half_edge = kNone;
  };

  static std::uint32_t twin(std::uint32_t h) { return h ^ 1U; }
  [[nodiscard]] std::uint32_t target(std::uint32_t h) const { return half_edges_[twin(h)].origin; }
  [[nodiscard]] const ScreenPoint& start(std::uint32_t edge) const {
    return points_[edges_[edge][0]];
  }
  [[nodiscard]] const ScreenPoint& end(std::uint32_t edge) const {
    return points_[edges_[edge][1]];
  }

  [[nodiscard]] int side_of(std::uint32_t edge, const Vertex& vertex) const;
  [[nodiscard]] int compare(std::uint32_t edge, const Vertex& u, const Vertex& v) const;
  [[nodiscard]] int turn_of(std::uint32_t h, std::uint32_t edge, int sense) const;
  [[nodiscard]] bool same_way(std::uint32_t h, std::uint32_t edge, int sense) const;
  [[nodiscard]] int turn_between(std::uint32_t g, std::uint32_t h) const;
  [[nodiscard]] bool in_wedge(std::uint32_t o, std::uint32_t edge, int sense) const;
  [[nodiscard]] std::uint32_t wedge_of(std::uint32_t vertex, std::uint32_t edge, int sense) const;
  [[nodiscard]] std::uint32_t overlapping(std::uint32_t vertex, std::uint32_t edge,
                                          int sense) const;
  [[nodiscard]] Hit nearest_hit(std::uint32_t from, std::uint32_t wedge, std::uint32_t edge,
                                int sense) const;

  void insert(std::uint32_t edge, int sense);
  std::uint32_t advance_in_region(std::uint32_t from, std::uint32_t edge, int sense,
                                  std::uint32_t last);
  std::uint32_t advance_along(std::uint32_t h, std::uint32_t edge, int sense, std::uint32_t last);
  std::uint32_t add_point(std::uint32_t point);
  void name_vertex(std::uint32_t vertex, std::uint32_t point);
  void add_edge(std::uint32_t from, std::uint32_t to, std::uint32_t edge, int sense);
  void split(std::uint32_t h, std::uint32_t vertex);
  void add_source(std::uint32_t pair, std::uint32_t edge);
  void merge_points();
  [[nodiscard]] std::uint32_t unbounded() const;
  void collect_regions();

  std::span<const ScreenPoint> points_;
  std::span<const PolyhedronEdge> edges_;
  std::vector<std::uint32_t> place_of_, vertex_of_, pending_, corners_, outline_;
  std::vector<Vertex> vertices_;
  std::vector<HalfEdge> half_edges_;
  std::vector<Pair> pairs_;
  std::vector<Source> sources_;
  std::vector<Region> regions_;
  std::vector<std::uint8_t> seen_;
};

}  // namespace hiac::preview
