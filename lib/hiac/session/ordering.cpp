#include "hiac/session/ordering.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/check/overlap.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/mesh_hash.hpp"
#include "hiac/order/published/centroid.hpp"
#include "hiac/order/published/mpvo.hpp"
#include "hiac/order/published/stein.hpp"
#include "hiac/order/published/visibility_cycle.hpp"
#include "hiac/scene/view_of.hpp"
#include "hiac/session/stages.hpp"

namespace hiac {

// A cancelled stage leaves nothing behind: each result is stored only when it is complete.
const OrderBasis& Ordering::basis(const LoopCrew* crew) {
  if (basis_) return *basis_;
  FaceAdjacency adjacency = run_stage(monitor_, "adjacency", [&] { return adjacency_of_mesh(); });
  OrderBasis made =
      run_stage(monitor_, "basis", [&] { return order_basis(mesh_, std::move(adjacency), crew); });
  if (overlap_planarity_) {
    made.overlaps = run_stage(monitor_, "overlap",
                              [&] { return overlapping_cells(made, *overlap_planarity_); });
    if (monitor_.note)
      monitor_.note(fmt::format("{} pairs of cells overlap, or may", made.overlaps.size()));
  }
  return basis_.emplace(std::move(made));
}

// A stored adjacency that leaves faces out costs hours, not correctness: each unmatched face is
// compared with others. A boundary has about n^(2/3) faces; where many more are unmatched,
// computing the adjacency is cheap in comparison.
FaceAdjacency Ordering::adjacency_of_mesh() const {
  if (!mesh_.adjacency) return build_face_adjacency(mesh_);
  const auto stored = mesh_.adjacency->neighbors.view();
  const auto unmatched = static_cast<double>(std::ranges::count(stored, kNoCell));
  constexpr double kManyTimes = 16;
  if (unmatched <= kManyTimes * std::pow(static_cast<double>(mesh_.cell_count()), 2.0 / 3.0))
    return *mesh_.adjacency;
  FaceAdjacency computed = build_face_adjacency(mesh_);
  if (monitor_.note && !std::ranges::equal(stored, computed.neighbors.view()))
    monitor_.note("the stored face adjacency is not that of the mesh: it was computed anew");
  return computed;
}

const std::string& Ordering::mesh_hash() {
  if (mesh_hash_.empty())
    mesh_hash_ = run_stage(monitor_, "hash", [&] { return geometry_hash(mesh_); });
  return mesh_hash_;
}

MeshOrder Ordering::exact(const Scene& scene, const LoopCrew* crew) {
  const OrderBasis& common = basis(crew);
  const double planarity = scene.render.planarity;
  OrderResult result = run_stage(
      monitor_, "order", [&] { return exact_order(common, view_of(scene.camera), planarity); });
  return {{mesh_hash(), view_hash(scene), std::move(result.order)},
          result.statistics,
          planarity,
          common.overlaps.size()};
}

MeshOrder Ordering::made_by(const OrderMethod& method, const Scene& scene, const LoopCrew* crew) {
  if (method.algorithm == OrderAlgorithm::exact) return exact(scene, crew);
  if (method.algorithm == OrderAlgorithm::mpvo) basis(crew);  // a stage of its own
  VisibilityOrder order = run_stage(monitor_, "order", [&] { return published(method, scene); });
  return {{mesh_hash(), view_hash(scene), std::move(order)}, {}, scene.render.planarity};
}

VisibilityOrder Ordering::published(const OrderMethod& method, const Scene& scene) {
  const View view = view_of(scene.camera);
  const double planarity = scene.render.planarity;
  try {
    switch (method.algorithm) {
      case OrderAlgorithm::stein:
        return stein_order(mesh_, view, planarity);
      case OrderAlgorithm::multitiled:
        return multitiled_order(mesh_, view, planarity, method.tiling);
      case OrderAlgorithm::mpvo:
        return mpvo_order(basis(), view, planarity);
      case OrderAlgorithm::centroid:
        return centroid_order(mesh_, view);
      case OrderAlgorithm::exact:
        break;
    }
  } catch (const VisibilityCycle& cycle) {
    throw JudgementError(cycle.what());
  }
  throw std::logic_error("an algorithm without a name");
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

}  // namespace hiac
