#include "hiac/render/walk/ray_scene.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/base/large_pages.hpp"
#include "hiac/base/parallel.hpp"

namespace hiac {

bool has_medium_and_edges_alone(const Scene& scene) {
  return scene.isosurfaces.empty() && !scene.skin && !scene.camera.clip &&
         scene.render.splat_below == 0;
}

RayScene::RayScene(const WalkableMesh& of_mesh, const Scene& scene, const Projector& projector,
                   const MeshEdges* edges_of_mesh)
    : mesh(of_mesh),
      frame(of_mesh.mesh(), scene, projector, Details::none, Kernels::none),
      is_walkable_(has_medium_and_edges_alone(scene) && frame.optics.same_field &&
                   frame.optics.rule == PieceRule::exact &&
                   frame.extinction.location == FieldLocation::node &&
                   std::ranges::none_of(frame.nodes, [](const ProjectedNode& node) {
                     return std::isnan(node.depth);
                   })) {
  if (!is_walkable_) return;
  if (edges_of_mesh != nullptr)
    edges = ScreenEdges(frame, scene, edges_of_mesh->boundary, edges_of_mesh->edges);
  nodes = large_vector<RayNode>(mesh.node_count());
  parallel_for(nodes.size(), std::size_t{1} << 14, [&](IndexRange range) {
    for (std::size_t n = range.begin; n < range.end; ++n) {
      const NodeId node = mesh.node_of_mesh(static_cast<NodeId>(n));
      const ProjectedNode& at = frame.nodes[node];
      nodes[n] = {at.x, at.y, at.depth, frame.extinction.values[node]};
    }
  });
}

}  // namespace hiac
