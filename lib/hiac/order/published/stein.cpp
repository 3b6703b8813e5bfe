#include "hiac/order/published/stein.hpp"

#include "hiac/order/algorithm.hpp"
#include "hiac/order/published/pair_sort.hpp"

namespace hiac {

VisibilityOrder stein_order(const ZooMesh& mesh, const View& view, double planarity) {
  return {sort_pairs(mesh, view, planarity, {1, 1, false}),
          {},
          std::string(algorithm_name(OrderAlgorithm::stein))};
}

}  // namespace hiac
