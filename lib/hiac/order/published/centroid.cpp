#include "hiac/order/published/centroid.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "hiac/base/parallel.hpp"
#include "hiac/base/parallel_sort.hpp"
#include "hiac/order/algorithm.hpp"
#include "hiac/order/published/depth.hpp"

namespace hiac {
namespace {

constexpr std::size_t kCentroidGrain = 1 << 14;

}  // namespace

VisibilityOrder centroid_order(const ZooMesh& mesh, const View& view) {
  const Depth depth(view);
  std::vector<std::pair<double, CellId>> by_depth(mesh.cell_count());
  parallel_for(by_depth.size(), kCentroidGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto cell = static_cast<CellId>(i);
      by_depth[i] = {centroid_depth(mesh, cell, depth), cell};
    }
  });
  parallel_sort(by_depth, std::less<>());
  std::vector<CellId> cells(by_depth.size());
  std::ranges::transform(by_depth, cells.begin(), [](const auto& entry) { return entry.second; });
  return {std::move(cells), {}, std::string(algorithm_name(OrderAlgorithm::centroid))};
}

}  // namespace hiac
