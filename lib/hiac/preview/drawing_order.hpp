#pragma once

#include <vector>

#include "hiac/frame/projection.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/visibility_order.hpp"

namespace hiac::preview {

/// All cells of an order, back to front. Those of a group (a visibility cycle), which no order of
/// whole cells is right for, come by the depth of their centroids, those of one depth by number.
std::vector<CellId> back_to_front(const ZooMesh& mesh, const VisibilityOrder& order,
                                  const Projector& projector);

}  // namespace hiac::preview
