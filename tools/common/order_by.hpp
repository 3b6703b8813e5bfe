#pragma once

#include <string>

#include "hiac/order/algorithm.hpp"
#include "hiac/order/order_basis.hpp"
#include "hiac/order/published/multitiled.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::tools {

/// Whether an algorithm rests on an OrderBasis.
inline bool needs_basis(OrderAlgorithm algorithm) {
  return algorithm == OrderAlgorithm::exact || algorithm == OrderAlgorithm::mpvo;
}

/// The order of a mesh for a scene of one frame by an algorithm. `basis`: of the mesh, where the
/// algorithm needs it; null otherwise. Throws JudgementError, with `prefix` before it, where the
/// algorithm meets a visibility cycle that it has no answer to.
VisibilityOrder order_by(OrderAlgorithm algorithm, const TilingOptions& tiling, const ZooMesh& mesh,
                         const OrderBasis* basis, const Scene& scene,
                         const std::string& prefix = "");

}  // namespace hiac::tools
