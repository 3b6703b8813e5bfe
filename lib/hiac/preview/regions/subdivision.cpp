#include "hiac/preview/regions/subdivision.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hiac::preview {

// ---- predicates ----

int Subdivision::side_of(std::uint32_t edge, const Vertex& vertex) const {
  if (vertex.point != kNone) {
    const ScreenPoint& p = points_[vertex.point];
    if (p == start(edge) || p == end(edge)) return 0;
    return side(start(edge), end(edge), p);
  }
  const auto [c, d] = vertex.edges;
  if (c == edge || d == edge) return 0;
  return side_of_crossing(start(edge), end(edge), start(c), end(c), start(d), end(d));
}

// The sign of the distance from v to u in the direction of an edge on whose line both lie.
int Subdivision::compare(std::uint32_t edge, const Vertex& u, const Vertex& v) const {
  if (&u == &v) return 0;
  const ScreenPoint &a = start(edge), &b = end(edge);
  if (v.point == kNone) {
    // on the line, the area that a point makes with the other edge is linear, and 0 at v
    std::uint32_t other = v.edges[0];
    int slope = other == edge ? 0 : turn(start(other), end(other), a, b);
    if (slope == 0) {
      other = v.edges[1];
      slope = turn(start(other), end(other), a, b);
    }
    return side_of(other, u) * slope;
  }
  if (u.point == kNone) return -compare(edge, v, u);
  const ScreenPoint &p = points_[u.point], &q = points_[v.point];
  const int dx = (b.x > a.x) - (b.x < a.x), dy = (b.y > a.y) - (b.y < a.y);
  return dx != 0 ? dx * ((p.x > q.x) - (p.x < q.x)) : dy * ((p.y > q.y) - (p.y < q.y));
}

// How one turns from a half-edge into an edge (sense 1) or its reverse (-1).
int Subdivision::turn_of(std::uint32_t h, std::uint32_t edge, int sense) const {
  const Pair& pair = pairs_[h / 2];
  if (pair.edge == edge) return 0;
  const int way = (pair.reversed ? -1 : 1) * ((h & 1U) != 0 ? -1 : 1) * sense;
  return way * turn(start(pair.edge), end(pair.edge), start(edge), end(edge));
}

int Subdivision::turn_between(std::uint32_t g, std::uint32_t h) const {
  const Pair& pair = pairs_[h / 2];
  return turn_of(g, pair.edge, (pair.reversed ? -1 : 1) * ((h & 1U) != 0 ? -1 : 1));
}

// Of parallel directions: whether they are the same.
bool Subdivision::same_way(std::uint32_t h, std::uint32_t edge, int sense) const {
  const Pair& pair = pairs_[h / 2];
  const int way = (pair.reversed ? -1 : 1) * ((h & 1U) != 0 ? -1 : 1) * sense;
  const ScreenPoint &a = start(pair.edge), &b = end(pair.edge);
  const ScreenPoint &c = start(edge), &d = end(edge);
  const int along = b.x != a.x ? sign_of(b.x - a.x) * sign_of(d.x - c.x)
                               : sign_of(b.y - a.y) * sign_of(d.y - c.y);
  return way * along > 0;
}

// Whether a direction lies strictly between the half-edge o and the next one counter-clockwise
// around their origin; it is the direction of none of the half-edges there.
bool Subdivision::in_wedge(std::uint32_t o, std::uint32_t edge, int sense) const {
  const std::uint32_t next = twin(half_edges_[o].prev);
  if (next == o) return true;
  const int from = turn_of(o, edge, sense), to = -turn_of(next, edge, sense);
  const int opening = turn_between(o, next);
  if (opening > 0) return from > 0 && to > 0;
  return opening < 0 ? from > 0 || to > 0 : from > 0;
}

// The half-edge whose region, at its origin, a direction points into.
std::uint32_t Subdivision::wedge_of(std::uint32_t vertex, std::uint32_t edge, int sense) const {
  const std::uint32_t first = vertices_[vertex].out;
  for (std::uint32_t o = first; o != kNone;) {
    if (in_wedge(o, edge, sense)) return o;
    o = twin(half_edges_[o].prev);
    if (o == first) break;
  }
  return kNone;
}

// The half-edge that leaves a vertex in just that direction, if any.
std::uint32_t Subdivision::overlapping(std::uint32_t vertex, std::uint32_t edge, int sense) const {
  const std::uint32_t first = vertices_[vertex].out;
  for (std::uint32_t o = first; o != kNone;) {
    if (turn_of(o, edge, sense) == 0 && same_way(o, edge, sense)) return o;
    o = twin(half_edges_[o].prev);
    if (o == first) break;
  }
  return kNone;
}

// ---- the half-edge structure ----

std::uint32_t Subdivision::add_point(std::uint32_t point) {
  vertices_.push_back({point, {kNone, kNone}, kNone});
  return vertex_of_[point] = static_cast<std::uint32_t>(vertices_.size() - 1);
}

// A crossing turns out to be at a given point.
void Subdivision::name_vertex(std::uint32_t vertex, std::uint32_t point) {
  vertices_[vertex].point = point;
  vertex_of_[point] = vertex;
}

void Subdivision::add_source(std::uint32_t pair, std::uint32_t edge) {
  sources_.push_back({edge, pairs_[pair].sources});
  pairs_[pair].sources = static_cast<std::uint32_t>(sources_.size() - 1);
}

// A new pair from one vertex to another through the region between them, or to a lone point.
void Subdivision::add_edge(std::uint32_t from, std::uint32_t to, std::uint32_t edge, int sense) {
  const std::uint32_t at_from = wedge_of(from, edge, sense);
  const std::uint32_t at_to = wedge_of(to, edge, -sense);
  const auto h = static_cast<std::uint32_t>(half_edges_.size()), t = h + 1;
  half_edges_.push_back({from, t, t});
  half_edges_.push_back({to, h, h});
  pairs_.push_back({edge, kNone, sense < 0});
  add_source(h / 2, edge);
  const auto link = [&](std::uint32_t first, std::uint32_t second) {
    half_edges_[first].next = second;
    half_edges_[second].prev = first;
  };
  if (at_from != kNone) {
    link(half_edges_[at_from].prev, h);
    link(t, at_from);
  } else {
    vertices_[from].out = h;
  }
  if (at_to != kNone) {
    link(half_edges_[at_to].prev, t);
    link(h, at_to);
  } else {
    vertices_[to].out = t;
  }
}

// Puts a vertex into the inside of a half-edge, which ends there; the rest is a new pair.
void Subdivision::split(std::uint32_t h, std::uint32_t vertex) {
  const std::uint32_t t = twin(h), end_of_h = half_edges_[t].origin;
  const auto rest = static_cast<std::uint32_t>(half_edges_.size()), back = rest + 1;
  const std::uint32_t next = half_edges_[h].next, prev = half_edges_[t].prev;
  half_edges_.push_back({vertex, next == t ? back : next, h});
  half_edges_.push_back({end_of_h, t, prev == h ? rest : prev});
  pairs_.push_back({pairs_[h / 2].edge, kNone, pairs_[h / 2].reversed != ((h & 1U) != 0)});
  for (std::uint32_t s = pairs_[h / 2].sources; s != kNone; s = sources_[s].next)
    add_source(rest / 2, sources_[s].edge);
  if (next != t) half_edges_[next].prev = rest;
  if (prev != h) half_edges_[prev].next = back;
  half_edges_[h].next = rest;
  half_edges_[t].prev = back;
  half_edges_[t].origin = vertex;
  if (vertices_[end_of_h].out == t) vertices_[end_of_h].out = back;
  vertices_[vertex].out = rest;
}

// ---- insertion ----

Subdivision::Hit Subdivision::nearest_hit(std::uint32_t from, std::uint32_t wedge,
                                          std::uint32_t edge, int sense) const {
  Hit nearest;
  Vertex best{};
  const auto consider = [&](const Vertex& at, Hit hit) {
    if (sense * compare(edge, at, vertices_[from]) <= 0) return;
    if (nearest.vertex == kNone && nearest.half_edge == kNone) {
      best = at;
      nearest = hit;
      return;
    }
    if (sense * compare(edge, at, best) >= 0) return;
    best = at;
    nearest = hit;
  };
  std::uint32_t h = wedge;
  int before = 0;  // the side of h's origin; `from` lies on the edge's line
  do {
    const std::uint32_t to = target(h);
    const int after = to == from ? 0 : side_of(edge, vertices_[to]);
    if (after == 0)
      consider(vertices_[to], {to, kNone});
    else if (before * after < 0)
      consider({kNone, {edge, pairs_[h / 2].edge}, kNone}, {kNone, h});
    before = after;
    h = half_edges_[h].next;
  } while (h != wedge);
  return nearest;
}

// From a vertex through the region ahead, to what is met first.
std::uint32_t Subdivision::advance_in_region(std::uint32_t from, std::uint32_t edge, int sense,
                                             std::uint32_t last) {
  const std::uint32_t wedge = wedge_of(from, edge, sense);
  const Hit hit = wedge == kNone ? Hit{} : nearest_hit(from, wedge, edge, sense);
  const Vertex end_point{last, {kNone, kNone}, kNone};
  std::uint32_t to = hit.vertex;
  if (hit.half_edge != kNone) {
    const Vertex crossing{kNone, {edge, pairs_[hit.half_edge / 2].edge}, kNone};
    const int beyond = vertex_of_[last] == kNone ? sense * compare(edge, crossing, end_point) : -1;
    if (beyond <= 0) {
      if (beyond == 0) {
        to = add_point(last);
      } else {
        vertices_.push_back(crossing);
        to = static_cast<std::uint32_t>(vertices_.size() - 1);
      }
      split(hit.half_edge, to);
    }
  } else if (to != kNone && vertex_of_[last] == kNone) {
    const int beyond = sense * compare(edge, vertices_[to], end_point);
    if (beyond == 0) name_vertex(to, last);
    if (beyond > 0) to = kNone;
  }
  if (to == kNone) to = add_point(last);
  add_edge(from, to, edge, sense);
  return to;
}

// From a vertex along a half-edge in the same direction.
std::uint32_t Subdivision::advance_along(std::uint32_t h, std::uint32_t edge, int sense,
                                         std::uint32_t last) {
  if (vertex_of_[last] == kNone) {
    const Vertex end_point{last, {kNone, kNone}, kNone};
    const int beyond = sense * compare(edge, vertices_[target(h)], end_point);
    if (beyond == 0) name_vertex(target(h), last);
    if (beyond > 0) split(h, add_point(last));
  }
  add_source(h / 2, edge);
  return target(h);
}

// Adds an edge one of whose ends is a vertex: the first with sense 1, the second with -1.
void Subdivision::insert(std::uint32_t edge, int sense) {
  const std::uint32_t first = place_of_[edges_[edge][sense > 0 ? 0 : 1]];
  const std::uint32_t last = place_of_[edges_[edge][sense > 0 ? 1 : 0]];
  std::uint32_t at = vertex_of_[first];
  while (at != vertex_of_[last]) {
    const std::uint32_t h = overlapping(at, edge, sense);
    at =
        h != kNone ? advance_along(h, edge, sense, last) : advance_in_region(at, edge, sense, last);
  }
}

// place_of_: for each point the first one at its place.
void Subdivision::merge_points() {
  place_of_.resize(points_.size());
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    std::uint32_t q = 0;
    while (!(points_[q] == points_[p])) ++q;
    place_of_[p] = q;
  }
}

void Subdivision::build(std::span<const ScreenPoint> points,
                        std::span<const PolyhedronEdge> edges) {
  points_ = points;
  edges_ = edges;
  vertices_.clear();
  half_edges_.clear();
  pairs_.clear();
  sources_.clear();
  regions_.clear();
  corners_.clear();
  outline_.clear();
  vertex_of_.assign(points.size(), kNone);
  merge_points();
  pending_.clear();
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    if (place_of_[edges[e][0]] != place_of_[edges[e][1]]) pending_.push_back(e);
  if (points.empty()) return;
  add_point(pending_.empty() ? 0 : place_of_[edges[pending_.front()][0]]);
  // of the edges that are left, those that begin or end at a vertex
  while (!pending_.empty()) {
    std::size_t kept = 0;
    for (const std::uint32_t e : pending_) {
      if (vertex_of_[place_of_[edges[e][0]]] != kNone)
        insert(e, 1);
      else if (vertex_of_[place_of_[edges[e][1]]] != kNone)
        insert(e, -1);
      else
        pending_[kept++] = e;
    }
    if (kept == pending_.size())
      throw std::invalid_argument("the edges of a polyhedron must be connected");
    pending_.resize(kept);
  }
  for (std::uint32_t p = 0; p < points.size(); ++p) vertex_of_[p] = vertex_of_[place_of_[p]];
  collect_regions();
}

// ---- regions ----

// A half-edge of the unbounded region. At the leftmost vertex (of these the lowest), where all
// half-edges point to the right or up, it is the last one counter-clockwise.
std::uint32_t Subdivision::unbounded() const {
  const Vertex* least = nullptr;
  for (const Vertex& v : vertices_) {
    if (v.point == kNone || v.out == kNone) continue;
    if (least == nullptr) {
      least = &v;
      continue;
    }
    const ScreenPoint &p = points_[v.point], &q = points_[least->point];
    if (p.x < q.x || (p.x == q.x && p.y < q.y)) least = &v;
  }
  if (least == nullptr) return kNone;
  std::uint32_t last = least->out;
  for (std::uint32_t o = twin(half_edges_[last].prev); o != least->out;
       o = twin(half_edges_[o].prev))
    if (turn_between(last, o) > 0) last = o;
  return last;
}

void Subdivision::collect_regions() {
  const std::uint32_t outside = unbounded();
  if (outside == kNone) return;
  seen_.assign(half_edges_.size(), 0);
  std::uint32_t h = outside;
  do {
    seen_[h] = 1;
    outline_.push_back(half_edges_[h].origin);
    h = half_edges_[h].next;
  } while (h != outside);
  for (std::uint32_t first = 0; first < half_edges_.size(); ++first) {
    if (seen_[first] != 0) continue;
    Region region{static_cast<std::uint32_t>(corners_.size()), 0};
    h = first;
    do {
      seen_[h] = 1;
      corners_.push_back(half_edges_[h].origin);
      ++region.count;
      h = half_edges_[h].next;
    } while (h != first);
    regions_.push_back(region);
  }
}

ScreenPoint Subdivision::position(const Vertex& vertex) const {
  if (vertex.point != kNone) return points_[vertex.point];
  const auto [i, k] = vertex.edges;
  const ScreenPoint &c = start(i), &d = end(i), &e = start(k), &f = end(k);
  const double n = std::abs(twice_area(e, f, c)), m = std::abs(twice_area(e, f, d));
  const double share = n / (n + m);
  return {c.x + share * (d.x - c.x), c.y + share * (d.y - c.y)};
}

}  // namespace hiac::preview
