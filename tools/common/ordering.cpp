#include "tools/common/ordering.hpp"

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/face_adjacency.hpp"

namespace hiac::tools {

View view_of(const Camera& camera) {
  return {camera.projection == Projection::perspective, camera.eye, view_direction(camera)};
}

OrderRecord order_mesh(Tool& tool, const ZooMesh& mesh, const Scene& scene) {
  const FaceAdjacency adjacency = tool.timed(
      "adjacency", [&] { return mesh.adjacency ? *mesh.adjacency : build_face_adjacency(mesh); });
  OrderResult result = tool.timed("order", [&] {
    return exact_order(mesh, adjacency, view_of(scene.camera), scene.render.planarity);
  });
  const OrderStatistics& s = result.statistics;
  tool.facts()["order"] = {{"algorithm", result.order.algorithm},
                           {"shared_faces", s.shared_faces},
                           {"unmatched_faces", s.unmatched_faces},
                           {"arrows_both_ways", s.both_ways},
                           {"convex", s.convex},
                           {"gap_pairs", s.gap_pairs},
                           {"gap_arrows", s.gap_arrows},
                           {"groups_of_several_cells", result.order.groups.size()},
                           {"largest_group", s.largest_group},
                           {"cells_in_groups", s.cells_in_groups},
                           {"planarity", scene.render.planarity}};
  tool.detail(
      fmt::format("order: {} shared and {} unmatched faces; {} of {} cells in {} groups, "
                  "the largest of {}; planarity {:g}",
                  s.shared_faces, s.unmatched_faces, s.cells_in_groups, mesh.cell_count(),
                  result.order.groups.size(), s.largest_group, scene.render.planarity));
  const std::string hash = tool.timed("hash", [&] { return content_hash(mesh); });
  return {hash, view_hash(scene), std::move(result.order)};
}

void require_fitting_order(const OrderRecord& record, const ZooMesh& mesh, const Scene& scene,
                           const std::string& subject) {
  const std::string mesh_hash = content_hash(mesh), view = view_hash(scene);
  if (record.mesh_hash != mesh_hash)
    throw InputError(subject, fmt::format("the order belongs to another mesh (hash {} expected, {} "
                                          "found)",
                                          mesh_hash, record.mesh_hash));
  if (record.view_hash != view)
    throw InputError(subject, fmt::format("the order belongs to another view (hash {} expected, {} "
                                          "found)",
                                          view, record.view_hash));
  if (record.order.cells.size() != mesh.cell_count())
    throw InputError(subject, fmt::format("the order is of another mesh ({} cells expected, {} "
                                          "found)",
                                          mesh.cell_count(), record.order.cells.size()));
}

}  // namespace hiac::tools
