#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hiac/order/algorithm.hpp"
#include "hiac/order/order_basis.hpp"
#include "hiac/order/order_file.hpp"
#include "hiac/order/published/multitiled.hpp"
#include "hiac/scene/scene.hpp"
#include "hiac/session/session.hpp"

namespace hiac {

/// A visibility order with the hashes that identify its mesh and view, and findings made on the
/// way.
struct MeshOrder {
  OrderRecord record;
  /// For orders made by the exact algorithm; none for others.
  std::optional<OrderStatistics> statistics;
  double planarity = 0;
  std::uint64_t overlapping_pairs = 0;
};

/// How an order is made.
struct OrderMethod {
  OrderAlgorithm algorithm = OrderAlgorithm::exact;
  TilingOptions tiling;  ///< of OrderAlgorithm::multitiled
};

/// Orders one mesh for any number of views; whatever does not depend on the view is computed once,
/// when it is first needed.
class Ordering {
 public:
  /// The mesh must outlive this object.
  Ordering(const ZooMesh& mesh, Monitor monitor) : mesh_(mesh), monitor_(std::move(monitor)) {}

  /// From now on overlapping cells are searched for, and every two that overlap go into one group.
  /// To be called before the first order.
  void look_for_overlaps(double planarity) { overlap_planarity_ = planarity; }

  /// The exact visibility order for a scene's camera (a scene of one frame). `crew`: processes that
  /// ask for the same order and share the work; null: this one alone.
  MeshOrder exact(const Scene& scene, const LoopCrew* crew = nullptr);

  /// The order for a scene's camera (a scene of one frame) by any algorithm. Throws JudgementError
  /// when the algorithm meets a visibility cycle that it has no answer to.
  MeshOrder made_by(const OrderMethod& method, const Scene& scene, const LoopCrew* crew = nullptr);

  /// The part of the order that all views share. Uses the adjacency stored with the mesh, or
  /// computes it.
  const OrderBasis& basis(const LoopCrew* crew = nullptr);
  /// The adjacency of the basis; null before that is computed.
  [[nodiscard]] const FaceAdjacency* adjacency() const {
    return basis_ ? &basis_->adjacency : nullptr;
  }
  /// The hash of the mesh's geometry (geometry_hash), which orders of this mesh refer to.
  const std::string& mesh_hash();

 private:
  [[nodiscard]] FaceAdjacency adjacency_of_mesh() const;
  [[nodiscard]] VisibilityOrder published(const OrderMethod& method, const Scene& scene);

  const ZooMesh& mesh_;
  Monitor monitor_;
  std::optional<double> overlap_planarity_;
  std::optional<OrderBasis> basis_;
  std::string mesh_hash_;
};

/// Orders read from an order file, or stored with a mesh.
struct GivenOrders {
  std::string subject;             ///< the file, for errors
  std::vector<ExtraChunk> chunks;  ///< of type kOrderChunk
};

/// The first of the orders that fits the mesh and the scene's view. Throws InputError(subject, ...)
/// naming the mismatch when none fits.
OrderRecord fitting_order(const GivenOrders& orders, const std::string& mesh_hash,
                          const ZooMesh& mesh, const Scene& scene);

}  // namespace hiac
