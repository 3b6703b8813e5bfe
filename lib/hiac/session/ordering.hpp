#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hiac/order/order_basis.hpp"
#include "hiac/order/order_file.hpp"
#include "hiac/scene/scene.hpp"
#include "hiac/session/session.hpp"

namespace hiac {

/// A visibility order with the hashes that it belongs to, and what was met on the way.
struct MeshOrder {
  OrderRecord record;
  /// Of an order that was made by the exact algorithm; none of others.
  std::optional<OrderStatistics> statistics;
  double planarity = 0;
  std::uint64_t overlapping_pairs = 0;
};

/// Orders one mesh for any number of views; what does not depend on the view is made once, when it
/// is first needed.
class Ordering {
 public:
  /// The mesh has to outlive it.
  Ordering(const ZooMesh& mesh, Monitor monitor) : mesh_(mesh), monitor_(std::move(monitor)) {}

  /// Cells that overlap will be looked for, and each two of them put into one group. Before the
  /// first order.
  void look_for_overlaps(double planarity) { overlap_planarity_ = planarity; }

  /// The exact visibility order for a scene's camera (a scene of one frame).
  MeshOrder exact(const Scene& scene);

  /// What all views have in common. Uses the adjacency that the mesh brings, or computes it.
  const OrderBasis& basis();
  /// What the mesh's orders are known by: the hash of its geometry (geometry_hash).
  const std::string& mesh_hash();

 private:
  [[nodiscard]] FaceAdjacency adjacency_of_mesh() const;

  const ZooMesh& mesh_;
  Monitor monitor_;
  std::optional<double> overlap_planarity_;
  std::optional<OrderBasis> basis_;
  std::string mesh_hash_;
};

/// Orders that came in an order file, or behind a mesh.
struct GivenOrders {
  std::string subject;             ///< the file, for errors
  std::vector<ExtraChunk> chunks;  ///< of type kOrderChunk
};

/// The first of the orders that belongs to a mesh and to a scene's view. Throws InputError(subject,
/// ...) saying what does not fit when there is none.
OrderRecord fitting_order(const GivenOrders& orders, const std::string& mesh_hash,
                          const ZooMesh& mesh, const Scene& scene);

}  // namespace hiac
