#include "hiac/order/visibility_order.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "hiac/order/behind_relation.hpp"
#include "hiac/order/components.hpp"
#include "hiac/order/convexity.hpp"

namespace hiac {
namespace {

VisibilityOrder one_group(std::size_t cells) {
  std::vector<CellId> all(cells);
  std::iota(all.begin(), all.end(), CellId{0});
  std::vector<CellGroup> groups;
  if (cells > 1) groups.push_back({0, static_cast<std::uint32_t>(cells)});
  return {std::move(all), std::move(groups), "exact"};
}

}  // namespace

OrderResult exact_order(const ZooMesh& mesh, const FaceAdjacency& adjacency, const View& view,
                        double planarity) {
  OrderResult result;
  OrderStatistics& statistics = result.statistics;
  for (const CellId neighbor : adjacency.neighbors)
    ++(neighbor == kNoCell ? statistics.unmatched_faces : statistics.shared_faces);
  statistics.shared_faces /= 2;
  statistics.convex = boundary_is_convex(mesh, adjacency);
  if (statistics.convex) {
    const BehindRelation relation = shared_face_relation(mesh, adjacency, view, planarity);
    statistics.both_ways = relation.both_ways;
    result.order = order_of_components(relation, adjacency.neighbors);
  } else {
    result.order = one_group(mesh.cell_count());
  }
  for (const CellGroup& group : result.order.groups) {
    statistics.cells_in_groups += group.count;
    statistics.largest_group = std::max<std::uint64_t>(statistics.largest_group, group.count);
  }
  return result;
}

}  // namespace hiac
