#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hiac/geometry/bezier_patch.hpp"
#include "hiac/geometry/predicates.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Deviation of a quadrilateral from a plane: the distance between its two diagonals' lines,
/// divided by the longer diagonal. 0 for a degenerate face.
double quadrilateral_deviation(Point3 a, Point3 b, Point3 c, Point3 d);

/// The nodes of an edge in the order in which its cells share it: from its lower corner on.
struct EdgeNodes {
  std::size_t count;
  std::array<NodeId, 4> nodes;
};
EdgeNodes edge_nodes(CellKind kind, std::span<const NodeId> nodes, std::size_t edge);

/// Whether an edge's inner nodes are off their places on a straight one by more than `straightness`
/// of its length.
bool is_curved(const ZooMesh& mesh, const EdgeNodes& edge, double straightness);

/// What a face of a cell is: planar, between straight edges; or a parametric surface. Judged by its
/// own nodes in an order that its cells share, so that both say the same.
struct FaceForm {
  bool curved;       ///< not planar, by more than `straightness` of its size, or with curved edges
  PatchShape shape;  ///< of degree 1 where all edges are straight (to `straightness`)
  std::array<std::uint8_t, 4> corners;  ///< from the lowest node on, towards its lower neighbour
  std::array<std::size_t, 4> edges;     ///< of the kind, from each of these corners to the next
  std::array<bool, 4> curved_edges;     ///< of these, the ones that are (is_curved)
};
FaceForm face_form(const ZooMesh& mesh, CellId cell, std::size_t face, double straightness);

/// The nodes of a face as its patch has them (bezier_patch.hpp); their number is
/// form.shape.node_count().
std::array<NodeId, kMostPatchNodes> patch_nodes(const ZooMesh& mesh, CellId cell, std::size_t face,
                                                const FaceForm& form);

/// Whether any face of a cell is curved.
bool has_curved_faces(const ZooMesh& mesh, CellId cell, double straightness);

}  // namespace hiac
