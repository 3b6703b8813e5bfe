#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"
#include "hiac/session/ordering.hpp"

namespace hiac {

/// The orders of one mesh for scenes of one frame, made or given, for any engine.
class SceneOrders {
 public:
  /// The mesh must outlive this object.
  SceneOrders(const ZooMesh& mesh, Monitor monitor)
      : mesh_(mesh), monitor_(std::move(monitor)), ordering_(mesh, monitor_) {}

  /// How orders are made from now on; the exact algorithm by default.
  void sort_by(const OrderMethod& method) { method_ = method; }

  /// Uses existing orders instead of making them.
  void use(GivenOrders orders) { given_ = std::move(orders); }

  /// As Session::look_for_overlaps.
  void look_for_overlaps(double planarity);

  /// Leaves cells, ascending, out of all further orders.
  void leave_out(std::vector<CellId> cells) { left_out_ = std::move(cells); }

  /// Throws InputError if orders are given and none of them fits the scene.
  void require(const Scene& scene);

  /// The order for a scene. Throws as `require` and Ordering::made_by do. `crew`: processes that
  /// ask for the same order and share the work; null: this one alone.
  MeshOrder of(const Scene& scene, const LoopCrew* crew = nullptr);

  /// The mesh's adjacency, if an order needed it.
  [[nodiscard]] const FaceAdjacency* adjacency() const { return ordering_.adjacency(); }
  /// The same, computed if no order has needed it yet.
  const FaceAdjacency& required_adjacency() { return ordering_.basis().adjacency; }

 private:
  MeshOrder of_all_cells(const Scene& scene, const LoopCrew* crew);

  const ZooMesh& mesh_;
  Monitor monitor_;
  Ordering ordering_;
  OrderMethod method_;
  std::optional<GivenOrders> given_;
  std::vector<CellId> left_out_;
};

}  // namespace hiac
