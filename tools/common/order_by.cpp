#include "tools/common/order_by.hpp"

#include <stdexcept>

#include "hiac/base/error.hpp"
#include "hiac/order/published/centroid.hpp"
#include "hiac/order/published/mpvo.hpp"
#include "hiac/order/published/stein.hpp"
#include "hiac/order/published/visibility_cycle.hpp"
#include "hiac/scene/view_of.hpp"

namespace hiac::tools {

VisibilityOrder order_by(OrderAlgorithm algorithm, const TilingOptions& tiling, const ZooMesh& mesh,
                         const OrderBasis* basis, const Scene& scene, const std::string& prefix) {
  const View view = view_of(scene.camera);
  const double planarity = scene.render.planarity;
  if (needs_basis(algorithm) && basis == nullptr)
    throw std::logic_error("this order is made from a basis");
  try {
    switch (algorithm) {
      case OrderAlgorithm::stein:
        return stein_order(mesh, view, planarity);
      case OrderAlgorithm::multitiled:
        return multitiled_order(mesh, view, planarity, tiling);
      case OrderAlgorithm::mpvo:
        return mpvo_order(*basis, view, planarity);
      case OrderAlgorithm::centroid:
        return centroid_order(mesh, view);
      case OrderAlgorithm::exact:
        return exact_order(*basis, view, planarity).order;
    }
  } catch (const VisibilityCycle& cycle) {
    throw JudgementError(prefix + cycle.what());
  }
  throw std::logic_error("an algorithm without a name");
}

}  // namespace hiac::tools
