#include "hiac/check/mesh_convexity.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "hiac/geometry/face_form.hpp"
#include "hiac/geometry/predicates.hpp"
#include "hiac/order/faces/cell_side.hpp"
#include "hiac/order/faces/convexity.hpp"

namespace hiac {
namespace {

struct BoundaryFace {
  CellId cell;
  std::array<NodeId, 4> nodes;  // around it; a triangle repeats its last one
  int inside;                   // the side of the plane of the first three on which its cell lies
};

struct BoundaryEdge {
  NodeId low, high;
  std::uint32_t face;
};

std::vector<BoundaryFace> boundary_of(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                                      bool& curved) {
  std::vector<BoundaryFace> boundary;
  std::size_t slot = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto nodes = mesh.cell_nodes(cell);
    const bool linear = order_of(mesh.kinds[cell]) == CellOrder::linear;
    std::size_t number = 0;
    for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces) {
      const std::size_t own = number++;
      if (adjacency.neighbors[slot++] != kNoCell) continue;
      const auto corners = plane_corners(mesh, cell, face);
      BoundaryFace found{cell, {}, side_of_cell(mesh, cell, corners)};
      for (std::size_t k = 0; k < 4; ++k) found.nodes[k] = nodes[corners[k]];
      boundary.push_back(found);
      if (!linear) curved = curved || face_form(mesh, cell, own, 0).curved;
    }
  }
  return boundary;
}

// On which side of a face's plane a node lies: +1 its cell's, -1 the outer one, 0 in the plane.
int side_of(const ZooMesh& mesh, const BoundaryFace& face, NodeId node) {
  return face.inside * orientation(mesh.position(face.nodes[0]), mesh.position(face.nodes[1]),
                                   mesh.position(face.nodes[2]), mesh.position(node));
}

bool is_planar(const ZooMesh& mesh, const BoundaryFace& face) {
  return side_of(mesh, face, face.nodes[3]) == 0;
}

bool is_sound(const ZooMesh& mesh, const BoundaryFace& face) {
  return face.inside != 0 && is_planar(mesh, face);
}

bool reaches_outside(const ZooMesh& mesh, const BoundaryFace& plane, const BoundaryFace& face) {
  return std::ranges::any_of(face.nodes,
                             [&](NodeId node) { return side_of(mesh, plane, node) < 0; });
}

std::vector<BoundaryEdge> edges_of(const std::vector<BoundaryFace>& faces) {
  std::vector<BoundaryEdge> edges;
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < 4; ++k) {
      const NodeId a = faces[f].nodes[k], b = faces[f].nodes[(k + 1) % 4];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), f});
    }
  std::ranges::sort(edges, {}, [](const BoundaryEdge& edge) {
    return std::tuple(edge.low, edge.high, edge.face);
  });
  return edges;
}

// Surfaces that are connected across edges.
class Surfaces {
 public:
  explicit Surfaces(std::size_t faces) : parent_(faces), count_(faces) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    parent_[a] = b;
    --count_;
  }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  std::vector<std::uint32_t> parent_;
  std::size_t count_;
};

}  // namespace

MeshConvexity judge_convexity(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                              bool interfaces) {
  MeshConvexity found;
  bool curved = false, uneven = false;
  const auto faces = boundary_of(mesh, adjacency, curved);
  const auto edges = edges_of(faces);
  Surfaces surfaces(faces.size());
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].low == edges[begin].low &&
           edges[end].high == edges[begin].high)
      surfaces.join(edges[begin].face, edges[end++].face);
    uneven = uneven || end - begin != 2;
    if (end - begin != 2) continue;
    const BoundaryFace &f = faces[edges[begin].face], &g = faces[edges[begin + 1].face];
    if ((is_planar(mesh, f) && reaches_outside(mesh, f, g)) ||
        (is_planar(mesh, g) && reaches_outside(mesh, g, f)))
      found.edges.push_back({edges[begin].low, edges[begin].high, f.cell, g.cell});
  }
  found.surfaces = surfaces.count();
  if (curved) {
    found.edges.clear();
    found.reason = "the boundary has curved faces";
  } else if (interfaces) {
    found.reason = "faces lie on one another that are not shared";
  } else if (faces.empty()) {
    found.reason = "there is no boundary";
  } else if (boundary_is_convex(mesh, adjacency)) {
    found.verdict = Convexity::convex;
  } else if (!found.edges.empty() || found.surfaces > 1) {
    found.verdict = Convexity::not_convex;
  } else {
    found.reason = uneven ? "edges have more or fewer than two boundary faces"
                   : std::ranges::all_of(faces, [&](const auto& f) { return is_sound(mesh, f); })
                       ? "the boundary overlaps itself, or winds around more than once"
                       : "boundary faces are not planar, or cells have no volume";
  }
  return found;
}

}  // namespace hiac
