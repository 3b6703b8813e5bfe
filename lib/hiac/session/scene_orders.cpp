#include "hiac/session/scene_orders.hpp"

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/frame/renderable.hpp"

namespace hiac {

void SceneOrders::look_for_overlaps(double planarity) {
  if (given_)
    throw UsageError(given_->subject +
                     " has an order that is there already, made without looking for overlaps");
  ordering_.look_for_overlaps(planarity);
}

void SceneOrders::require(const Scene& scene) {
  if (given_) fitting_order(*given_, ordering_.mesh_hash(), mesh_, scene);
}

MeshOrder SceneOrders::of_all_cells(const Scene& scene, const LoopCrew* crew) {
  if (!given_) return ordering_.made_by(method_, scene, crew);
  MeshOrder order{fitting_order(*given_, ordering_.mesh_hash(), mesh_, scene), {}};
  const std::string& algorithm = order.record.order.algorithm;
  if (monitor_.note && algorithm != algorithm_name(OrderAlgorithm::exact))
    monitor_.note(fmt::format("{}: the order is by {}, not by the exact algorithm", given_->subject,
                              algorithm));
  return order;
}

MeshOrder SceneOrders::of(const Scene& scene, const LoopCrew* crew) {
  MeshOrder order = of_all_cells(scene, crew);
  if (!left_out_.empty()) order.record.order = without_cells(order.record.order, left_out_);
  return order;
}

}  // namespace hiac
