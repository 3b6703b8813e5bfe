#include "hiac/order/visibility_order.hpp"

#include <algorithm>
#include <utility>

#include "hiac/order/behind_relation.hpp"
#include "hiac/order/components.hpp"
#include "hiac/order/convexity.hpp"
#include "hiac/order/gap_relation.hpp"

namespace hiac {

OrderResult exact_order(const ZooMesh& mesh, const FaceAdjacency& adjacency, const View& view,
                        double planarity) {
  OrderResult result;
  OrderStatistics& statistics = result.statistics;
  for (const CellId neighbor : adjacency.neighbors)
    ++(neighbor == kNoCell ? statistics.unmatched_faces : statistics.shared_faces);
  statistics.shared_faces /= 2;
  const BehindRelation relation = shared_face_relation(mesh, adjacency, view, planarity);
  statistics.both_ways = relation.both_ways;
  GapRelation gaps;
  statistics.convex = boundary_is_convex(mesh, adjacency);
  if (!statistics.convex) gaps = gap_relation(mesh, adjacency, view, planarity);
  statistics.gap_pairs = gaps.candidate_pairs;
  statistics.gap_arrows = gaps.arrows.size();
  result.order = order_of_components(relation, adjacency.neighbors, gaps.arrows);
  for (const CellGroup& group : result.order.groups) {
    statistics.cells_in_groups += group.count;
    statistics.largest_group = std::max<std::uint64_t>(statistics.largest_group, group.count);
  }
  return result;
}

}  // namespace hiac
