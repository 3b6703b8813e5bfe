#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hiac/check/cells.hpp"
#include "hiac/check/defect.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/order_basis.hpp"

namespace hiac {

/// How sure it is that the interiors of two cells have a point in common.
enum class Overlap : std::uint8_t { none, possible, certain };

struct CellOverlap {
  Overlap overlap = Overlap::none;
  /// Certain: overlap_depth relative to the smaller cell's size (its longest edge or diagonal).
  double depth = 0;
};

/// Whether the interiors of two cells overlap.
///
/// Exact for convex cells with planar faces: none or certain (are_separated). Other linear cells:
/// none where the hulls of their corners are separated, or where each of two cells that share a
/// face (or have faces with corners at the same places) is separated from all faces of the other
/// but that one; certain where common_point finds a
/// point of both; else possible. Quadrilaterals whose deviation from a plane is at most `planarity`
/// count as planar; their cells then overlap certainly or not at all, and grazing_overlap is for
/// what their rounding makes of it.
///
/// Curved cells lie within the hull of their corners widened by curved_reach: none where these are
/// apart, or, of two cells with a node in common, where their corners alone say so (that cells with
/// positive Jacobians do not overlap where they meet is not proven here); certain where a point of
/// both is further than that from all faces.
///
/// A cell without volume, or whose Jacobian changes its sign, has no interior that could be asked
/// about: its verdict is none, or possible.
CellOverlap cells_overlap(const ZooMesh& mesh, const CellShapes& shapes, CellId a, CellId b,
                          double planarity);

/// How far, at most and in each coordinate, points of a curved cell are from where they would be
/// without the displacement of its nodes between the corners: the largest such displacement times a
/// bound of the sum of these nodes' shape functions, without sign. 0 for linear cells.
std::array<double, 3> curved_reach(const ZooMesh& mesh, CellId cell);

struct OverlapReport {
  std::vector<Finding> findings;  ///< overlap, grazing_overlap, possible_overlap
  std::uint64_t pairs = 0;        ///< pairs of cells that were asked about
  /// It was enough to ask about cells at the boundary.
  bool by_boundary = false;
};

/// All pairs of cells whose interiors overlap. Overlaps that are no deeper than `planarity` times
/// the smaller cell's size are grazing_overlap: what rounded coordinates make of cells that touch.
///
/// Where all cells turn alike and no face is folded, only cells with a face without neighbour are
/// asked about, with the cells that this face may reach. If none of those overlap, no cells do:
///
///   Let N(y) be the number of cells that hold the point y, and S the union of the faces without
///   neighbour. Every cell's map preserves orientation, so N is the degree of the map of the whole
///   mesh; the two sides of a shared face cancel in its boundary, so N is constant on every
///   component of the complement of S (M. W. Hirsch, "Differential Topology", 1976, chapter 5.1; of
///   polyhedral chains: the winding number about their boundary). Say that N is 2 or more
///   somewhere. That region is bounded, so at some point of S that is on no edge N is k >= 2 on one
///   side and less on the other; some cell A with a face there lies on the first side, and so does
///   another cell B, which holds that point or has a face there too. A and B overlap next to it.
///
/// Otherwise, and to name all pairs where there are some, every two cells are asked whose boxes
/// meet.
OverlapReport find_overlaps(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                            const CellShapes& shapes, bool folded, double planarity);

/// The pairs of cells that find_overlaps names, but for those that only graze each other: for
/// OrderBasis::overlaps. With them no two cells that do not overlap are in the wrong order.
std::vector<std::array<CellId, 2>> overlapping_cells(const OrderBasis& basis, double planarity);

}  // namespace hiac
