#include "hiac/order/visibility_order.hpp"

#include <algorithm>
#include <utility>

#include "hiac/base/cancellation.hpp"
#include "hiac/base/seconds.hpp"
#include "hiac/order/behind_relation.hpp"
#include "hiac/order/components.hpp"
#include "hiac/order/gaps/gap_relation.hpp"

namespace hiac {

OrderResult exact_order(const OrderBasis& basis, const View& view, double planarity) {
  OrderResult result;
  OrderStatistics& statistics = result.statistics;
  statistics.shared_faces = basis.shared_faces;
  statistics.unmatched_faces = basis.unmatched.size();
  statistics.convex = basis.convex;
  const double start = seconds_now();
  const BehindRelation relation = shared_face_relation(basis, view, planarity);
  statistics.both_ways = relation.both_ways;
  statistics.edge_on = relation.edge_on;
  check_cancelled();
  const double related = seconds_now();
  const GapRelation gaps = gap_relation(basis, view, planarity);
  statistics.gap_pairs = gaps.candidate_pairs;
  statistics.gap_arrows = gaps.behind.size();
  check_cancelled();
  const double joined = seconds_now();
  result.order = order_of_components(relation, basis.faces, basis.adjacency.neighbors, gaps);
  statistics.relation_seconds = related - start;
  statistics.gap_seconds = joined - related;
  statistics.component_seconds = seconds_now() - joined;
  for (const CellGroup& group : result.order.groups) {
    statistics.cells_in_groups += group.count;
    statistics.largest_group = std::max<std::uint64_t>(statistics.largest_group, group.count);
  }
  return result;
}

OrderResult exact_order(const ZooMesh& mesh, const FaceAdjacency& adjacency, const View& view,
                        double planarity) {
  return exact_order(order_basis(mesh, adjacency), view, planarity);
}

}  // namespace hiac
