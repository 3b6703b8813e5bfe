#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hiac/geometry/bezier_patch.hpp"
#include "hiac/geometry/predicates.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Returns a quadrilateral's deviation from a plane: the distance between the lines of its two
/// diagonals, divided by the longer diagonal. 0 for a degenerate face.
double quadrilateral_deviation(Point3 a, Point3 b, Point3 c, Point3 d);

/// The nodes of an edge, starting at the end with the lower node number: the same order in all its
/// cells.
struct EdgeNodes {
  std::size_t count;
  std::array<NodeId, 4> nodes;
};
EdgeNodes edge_nodes(CellKind kind, std::span<const NodeId> nodes, std::size_t edge);

/// Returns whether an inner node of an edge deviates from its place on the straight edge by more
/// than `straightness` times the edge's length.
bool is_curved(const ZooMesh& mesh, const EdgeNodes& edge, double straightness);

/// The form of a cell's face: planar with straight edges, or a parametric surface. It depends only
/// on the face's own nodes, in an order that both cells use, so that both get the same form.
struct FaceForm {
  bool curved;       ///< it has curved edges or deviates from a plane by more than `straightness`
  PatchShape shape;  ///< of degree 1 if all edges are straight (to `straightness`)
  std::array<std::uint8_t, 4> corners;  ///< from the lowest node towards its lower neighbour
  std::array<std::size_t, 4> edges;  ///< the kind's edges, from each of these corners to the next
  std::array<bool, 4> curved_edges;  ///< which of these edges are curved (is_curved)
};
FaceForm face_form(const ZooMesh& mesh, CellId cell, std::size_t face, double straightness);

/// Returns the nodes of a face in the order of its patch (bezier_patch.hpp); only the first
/// form.shape.node_count() entries are set.
std::array<NodeId, kMostPatchNodes> patch_nodes(const ZooMesh& mesh, CellId cell, std::size_t face,
                                                const FaceForm& form);

/// Returns the control points of a face's patch, whose convex hull contains the face; those beyond
/// the first form.shape.control_count() are 0.
PatchNet<std::array<double, 3>> control_points(const ZooMesh& mesh, CellId cell, std::size_t face,
                                               const FaceForm& form);

/// Returns whether any face of a cell is curved.
bool has_curved_faces(const ZooMesh& mesh, CellId cell, double straightness);

}  // namespace hiac
