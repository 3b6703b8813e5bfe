#include "tools/common/ordering.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/check/overlap.hpp"
#include "hiac/mesh/face_adjacency.hpp"

namespace hiac::tools {

nlohmann::ordered_json order_facts(const VisibilityOrder& order) {
  std::uint64_t in_groups = 0, largest = 1;
  for (const CellGroup& group : order.groups) {
    in_groups += group.count;
    largest = std::max<std::uint64_t>(largest, group.count);
  }
  return {{"algorithm", order.algorithm},
          {"cells", order.cells.size()},
          {"groups_of_several_cells", order.groups.size()},
          {"largest_group", largest},
          {"cells_in_groups", in_groups}};
}

const OrderBasis& Orderer::basis() {
  if (basis_) return *basis_;
  FaceAdjacency adjacency = tool_.timed("adjacency", [&] {
    return mesh_.adjacency ? *mesh_.adjacency : build_face_adjacency(mesh_);
  });
  basis_ = tool_.timed("basis", [&] { return order_basis(mesh_, std::move(adjacency)); });
  if (overlap_planarity_) {
    basis_->overlaps =
        tool_.timed("overlap", [&] { return overlapping_cells(*basis_, *overlap_planarity_); });
    tool_.note(fmt::format("{} pairs of cells overlap, or may", basis_->overlaps.size()));
  }
  return *basis_;
}

const std::string& Orderer::mesh_hash() {
  if (mesh_hash_.empty()) mesh_hash_ = tool_.timed("hash", [&] { return content_hash(mesh_); });
  return mesh_hash_;
}

MeshOrder Orderer::exact(const Scene& scene) {
  const OrderBasis& common = basis();
  const double planarity = scene.render.planarity;
  OrderResult result =
      tool_.timed("order", [&] { return exact_order(common, view_of(scene.camera), planarity); });
  const OrderStatistics& s = result.statistics;
  MeshOrder made{{mesh_hash(), view_hash(scene), std::move(result.order)}, s, {}};
  made.facts = order_facts(made.record.order);
  made.facts.update({{"shared_faces", s.shared_faces},
                     {"unmatched_faces", s.unmatched_faces},
                     {"arrows_one_way", s.shared_faces - s.edge_on - s.both_ways},
                     {"edge_on", s.edge_on},
                     {"arrows_both_ways", s.both_ways},
                     {"convex", s.convex},
                     {"overlapping_pairs", common.overlaps.size()},
                     {"gap_pairs", s.gap_pairs},
                     {"gap_arrows", s.gap_arrows},
                     {"planarity", planarity},
                     {"seconds",
                      {{"relation", s.relation_seconds},
                       {"gaps", s.gap_seconds},
                       {"components", s.component_seconds}}}});
  tool_.detail(
      fmt::format("order: {} shared and {} unmatched faces; {} of {} cells in {} groups, "
                  "the largest of {}; planarity {:g}",
                  s.shared_faces, s.unmatched_faces, s.cells_in_groups, mesh_.cell_count(),
                  made.record.order.groups.size(), s.largest_group, planarity));
  return made;
}

OrderRecord fitting_order(const GivenOrders& orders, const std::string& mesh_hash,
                          const ZooMesh& mesh, const Scene& scene) {
  const std::string view = view_hash(scene);
  std::string other_mesh, other_view;
  for (const ExtraChunk& chunk : orders.chunks) {
    const OrderHead head = decode_order_head(chunk, orders.subject);
    if (head.mesh_hash != mesh_hash) {
      other_mesh = head.mesh_hash;
    } else if (head.view_hash != view) {
      other_view = head.view_hash;
    } else if (head.cell_count != mesh.cell_count()) {
      throw InputError(orders.subject,
                       fmt::format("the order is of another mesh ({} cells expected, {} found)",
                                   mesh.cell_count(), head.cell_count));
    } else {
      return decode_order(chunk, orders.subject);
    }
  }
  if (other_view.empty())
    throw InputError(orders.subject,
                     fmt::format("the order belongs to another mesh (hash {} expected, {} found)",
                                 mesh_hash, other_mesh));
  if (orders.chunks.size() == 1)
    throw InputError(orders.subject,
                     fmt::format("the order belongs to another view (hash {} expected, {} found)",
                                 view, other_view));
  throw InputError(orders.subject,
                   fmt::format("the orders all belong to other views (hash {} expected, found "
                               "{} others, the last of them {})",
                               view, orders.chunks.size(), other_view));
}

}  // namespace hiac::tools
