#include "hiac/order/faces/convexity.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <vector>

#include "hiac/geometry/predicates.hpp"
#include "hiac/order/faces/cell_side.hpp"

namespace hiac {
namespace {

struct BoundaryFace {
  std::array<NodeId, 4> nodes;  // in order around it; a triangle repeats its last node
  NodeId inner;                 // a corner of the cell that is off the face's plane
  int inside;                   // its orientation relative to nodes 0, 1, 2; 0 if there is none
};

struct BoundaryEdge {
  NodeId low, high;
  std::uint32_t face;

  bool operator<(const BoundaryEdge& other) const {
    return std::tie(low, high, face) < std::tie(other.low, other.high, other.face);
  }
  [[nodiscard]] bool same_edge(const BoundaryEdge& other) const {
    return low == other.low && high == other.high;
  }
};

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

std::vector<BoundaryFace> boundary_faces(const ZooMesh& mesh, const FaceAdjacency& adjacency) {
  std::vector<BoundaryFace> boundary;
  std::size_t slot = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto nodes = mesh.cell_nodes(cell);
    for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces) {
      if (adjacency.neighbors[slot++] != kNoCell) continue;
      const auto corners = plane_corners(mesh, cell, face);
      BoundaryFace b{};
      for (std::size_t k = 0; k < 4; ++k) b.nodes[k] = nodes[corners[k]];
      for (std::size_t k = 0; k < corner_count(mesh.kinds[cell]) && b.inside == 0; ++k) {
        if (std::ranges::find(corners, k) != corners.end()) continue;
        b.inner = nodes[k];
        b.inside = orientation(mesh.position(b.nodes[0]), mesh.position(b.nodes[1]),
                               mesh.position(b.nodes[2]), mesh.position(b.inner));
      }
      boundary.push_back(b);
    }
  }
  return boundary;
}

// Returns the side of a face's plane on which a node lies.
int side_of_plane(const ZooMesh& mesh, const BoundaryFace& plane, NodeId node) {
  return orientation(mesh.position(plane.nodes[0]), mesh.position(plane.nodes[1]),
                     mesh.position(plane.nodes[2]), mesh.position(node));
}

// Returns whether every corner of `face` lies in the plane of `plane` or on its inner side.
bool within(const ZooMesh& mesh, const BoundaryFace& plane, const BoundaryFace& face) {
  return std::ranges::all_of(face.nodes, [&](NodeId node) {
    const int side = side_of_plane(mesh, plane, node);
    return side == 0 || side == plane.inside;
  });
}

// Returns the side of the plane of a, b and c on which a face with the edge a-b lies: that of its
// first corner off the plane, or 0 if there is none.
int side_of_face(const ZooMesh& mesh, NodeId a, NodeId b, NodeId c, const BoundaryFace& face) {
  for (const NodeId node : face.nodes) {
    const int side =
        orientation(mesh.position(a), mesh.position(b), mesh.position(c), mesh.position(node));
    if (side != 0) return side;
  }
  return 0;
}

// Returns whether the angle inside the body, at the edge a-b that two of its faces share, is at
// most half a turn. Two faces in one plane may also be folded onto one another, with an angle of
// zero (a body of no thickness) or of a full turn (the front of a crack of no width).
bool convex_along(const ZooMesh& mesh, NodeId a, NodeId b, const BoundaryFace& f,
                  const BoundaryFace& g) {
  if (!within(mesh, f, g) || !within(mesh, g, f)) return false;
  const auto in_plane = [&](NodeId node) { return side_of_plane(mesh, f, node) == 0; };
  if (!std::ranges::all_of(g.nodes, in_plane)) return true;
  return side_of_face(mesh, a, b, f.inner, f) * side_of_face(mesh, a, b, f.inner, g) < 0;
}

// Returns whether an edge of the convex polygon `f` has all of `g`, a polygon in the same plane, on
// its outer side or its line.
bool apart_at_an_edge(const ZooMesh& mesh, const BoundaryFace& f, const BoundaryFace& g) {
  for (std::size_t k = 0; k < 4; ++k) {
    const NodeId a = f.nodes[k], b = f.nodes[(k + 1) % 4];
    if (a == b) continue;
    const int inwards = side_of_face(mesh, a, b, f.inner, f);
    if (std::ranges::none_of(g.nodes, [&](NodeId node) {
          return orientation(mesh.position(a), mesh.position(b), mesh.position(f.inner),
                             mesh.position(node)) == inwards;
        }))
      return true;
  }
  return false;
}

// Returns whether a surface that is convex along its edges winds around its body once (K. Mehlhorn
// et al., "Checking geometric programs or verification of geometric structures", 1999): from a
// point just below the middle of face 0, every face is seen from inside, and the direction of that
// middle meets no other face. The projection from that point covers the sphere as often everywhere.
bool winds_once(const ZooMesh& mesh, const std::vector<BoundaryFace>& faces) {
  const BoundaryFace& first = faces[0];
  return std::ranges::all_of(faces, [&](const BoundaryFace& face) {
    if (&face == &first) return true;
    if (!within(mesh, face, first) || !within(mesh, first, face)) return false;
    const bool in_plane = std::ranges::all_of(
        face.nodes, [&](NodeId node) { return side_of_plane(mesh, first, node) == 0; });
    if (in_plane && side_of_plane(mesh, first, face.inner) != first.inside) return false;
    return !in_plane || apart_at_an_edge(mesh, first, face) || apart_at_an_edge(mesh, face, first);
  });
}

}  // namespace

bool boundary_is_convex(const ZooMesh& mesh, const FaceAdjacency& adjacency) {
  const auto faces = boundary_faces(mesh, adjacency);
  std::vector<BoundaryEdge> edges;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    if (faces[f].inside == 0) return false;  // a cell without volume: nothing is certain
    if (!within(mesh, faces[f], faces[f])) return false;
    for (std::size_t k = 0; k < 4; ++k) {
      const NodeId a = faces[f].nodes[k], b = faces[f].nodes[(k + 1) % 4];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), f});
    }
  }
  std::sort(edges.begin(), edges.end());
  DisjointSets surfaces(faces.size());
  for (std::size_t e = 0; e < edges.size(); e += 2) {
    const bool pair = e + 1 < edges.size() && edges[e].same_edge(edges[e + 1]);
    const bool more = e + 2 < edges.size() && edges[e].same_edge(edges[e + 2]);
    if (!pair || more) return false;
    const BoundaryFace& f = faces[edges[e].face];
    const BoundaryFace& g = faces[edges[e + 1].face];
    if (!convex_along(mesh, edges[e].low, edges[e].high, f, g)) return false;
    surfaces.join(edges[e].face, edges[e + 1].face);
  }
  for (std::uint32_t f = 1; f < faces.size(); ++f)
    if (surfaces.find(f) != surfaces.find(0)) return false;
  return faces.empty() || winds_once(mesh, faces);
}

}  // namespace hiac
