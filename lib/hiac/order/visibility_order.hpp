#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hiac/geometry/view.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/order_basis.hpp"

namespace hiac {

/// A visibility cycle, or cells whose order is unknown: a run of VisibilityOrder::cells that the
/// renderer must order pixel by pixel.
struct CellGroup {
  std::uint32_t first;  ///< index into VisibilityOrder::cells
  std::uint32_t count;  ///< at least 2

  bool operator==(const CellGroup&) const = default;
};

/// A sequence of groups that contains every cell of a mesh once, front to back; groups of one cell
/// are implicit. No ray meets a cell of an earlier group behind a cell of a later one.
struct VisibilityOrder {
  SharedArray<CellId> cells;
  SharedArray<CellGroup> groups;  ///< the groups of several cells, by ascending `first`, disjoint
  std::string algorithm;          ///< the algorithm's name in hiac-sort
};

/// Counts of what ordering a view found.
struct OrderStatistics {
  std::uint64_t shared_faces = 0;
  std::uint64_t unmatched_faces = 0;
  std::uint64_t both_ways = 0;   ///< shared faces with arrows both ways
  std::uint64_t edge_on = 0;     ///< shared faces that no ray crosses
  std::uint64_t gap_pairs = 0;   ///< pairs of unmatched faces that were tested
  std::uint64_t gap_arrows = 0;  ///< arrows between cells that share no face
  std::uint64_t cells_in_groups = 0;
  std::uint64_t largest_group = 1;
  bool convex = false;  ///< no ray can leave the mesh and enter it again
  double relation_seconds = 0, gap_seconds = 0, component_seconds = 0;
};

struct OrderResult {
  VisibilityOrder order;
  OrderStatistics statistics;
};

/// Returns the exact visibility order of a mesh for a view: a topological order, front to back, of
/// the strongly connected components of the relation across shared faces and, where a ray could
/// leave the mesh and enter it again, across gaps. `planarity` is the deviation, relative to the
/// size of a face, below which a quadrilateral counts as planar. The result does not depend on the
/// number of threads.
OrderResult exact_order(const OrderBasis& basis, const View& view, double planarity);

/// Computes the basis as well: for a single view.
OrderResult exact_order(const ZooMesh& mesh, const FaceAdjacency& adjacency, const View& view,
                        double planarity);

}  // namespace hiac
