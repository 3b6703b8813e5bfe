#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hiac/check/cells.hpp"
#include "hiac/check/defect.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/order_basis.hpp"

namespace hiac {

/// Whether the interiors of two cells have a point in common.
enum class Overlap : std::uint8_t { none, possible, certain };

struct CellOverlap {
  Overlap overlap = Overlap::none;
  /// If certain: overlap_depth relative to the smaller cell's size (its longest edge or diagonal);
  /// of cells that common_interior_point decides, twice the depth of that point.
  double depth = 0;
};

/// Returns whether the interiors of two cells overlap.
///
/// Exact for convex cells with planar faces: none or certain (are_separated). For other linear
/// cells: none if the hulls of their corners are separated, or if each of two cells that share a
/// face (or have faces with corners at the same places) is separated from all other faces of the
/// other cell; certain if common_point or common_interior_point finds a point of both; else
/// possible. Quadrilaterals whose
/// deviation from a plane is at most `planarity` count as planar; their cells then overlap
/// certainly or not at all, and grazing_overlap covers the effect of their rounding.
///
/// Curved cells lie within the hull of their corners widened by curved_reach. The answer is none if
/// these are disjoint or, for two cells with a common node, if the hulls of the corners alone are
/// (it is not proven here that cells with positive Jacobians do not overlap where they meet);
/// certain if a point of both is farther than curved_reach from all faces, or if
/// common_interior_point finds one; else possible.
///
/// A cell without volume, or whose Jacobian changes its sign, has no well-defined interior: the
/// answer is none or possible.
CellOverlap cells_overlap(const ZooMesh& mesh, const CellShapes& shapes, CellId a, CellId b,
                          double planarity);

/// Bounds, in each coordinate, how far the displacement of the nodes between corners moves the
/// points of a curved cell: the largest displacement times a bound of the sum of the absolute
/// values of these nodes' shape functions. 0 for linear cells.
std::array<double, 3> curved_reach(const ZooMesh& mesh, CellId cell);

struct OverlapReport {
  std::vector<Finding> findings;  ///< overlap, grazing_overlap, possible_overlap
  std::uint64_t pairs = 0;        ///< pairs of cells that were tested
  /// True if it was enough to test cells at the boundary.
  bool by_boundary = false;
};

/// Finds all pairs of cells whose interiors overlap. Overlaps no deeper than `planarity` times the
/// smaller cell's size are grazing_overlap: the effect of rounded coordinates on cells that touch.
///
/// If all cells have the same orientation and no face is folded, only cells with a face without
/// neighbour are tested, with the cells that this face may reach. If none of those overlap, no
/// cells do:
///
/// Let N(y) be the number of cells that contain the point y, and S the union of the faces without
/// neighbour. Every cell's map preserves orientation, so N is the degree of the map of the whole
/// mesh; the two sides of a shared face cancel in its boundary, so N is constant on every component
/// of the complement of S (M. W. Hirsch, "Differential Topology", 1976, chapter 5.1; for polyhedral
/// chains: the winding number about their boundary). Suppose that N is 2 or more somewhere. That
/// region is bounded, so at some point of S that is on no edge N is k >= 2 on one side and less on
/// the other; some cell A with a face there lies on the first side, and so does another cell B,
/// which contains that point or has a face there too. A and B overlap next to it.
///
/// Otherwise, and to list all pairs if there are any, every two cells whose boxes meet are tested.
OverlapReport find_overlaps(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                            const CellShapes& shapes, bool folded, double planarity);

/// Returns the pairs of cells that find_overlaps lists, except those that only graze each other,
/// for OrderBasis::overlaps. With them, no two cells that do not overlap are in the wrong order.
std::vector<std::array<CellId, 2>> overlapping_cells(const OrderBasis& basis, double planarity);

}  // namespace hiac
