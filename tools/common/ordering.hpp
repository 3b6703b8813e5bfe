#pragma once

#include "hiac/order/order_file.hpp"
#include "hiac/scene/scene.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// The view of a camera, as orders depend on it.
View view_of(const Camera& camera);

/// The exact visibility order of a mesh for a scene's camera, with the hashes that it belongs to.
/// Uses the adjacency that the mesh brings, or computes it. Puts what was met among the facts.
OrderRecord order_mesh(Tool& tool, const ZooMesh& mesh, const Scene& scene);

/// Throws InputError(subject, ...) unless the order belongs to this mesh and this scene's view.
void require_fitting_order(const OrderRecord& record, const ZooMesh& mesh, const Scene& scene,
                           const std::string& subject);

}  // namespace hiac::tools
