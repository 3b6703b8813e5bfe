#include "hiac/order/published/multitiled.hpp"

#include "hiac/order/algorithm.hpp"
#include "hiac/order/published/pair_sort.hpp"

namespace hiac {

VisibilityOrder multitiled_order(const ZooMesh& mesh, const View& view, double planarity,
                                 const TilingOptions& tiling) {
  return {sort_pairs(mesh, view, planarity, tiling),
          {},
          std::string(algorithm_name(OrderAlgorithm::multitiled))};
}

}  // namespace hiac
