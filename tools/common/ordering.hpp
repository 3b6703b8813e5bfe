#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "hiac/order/order_basis.hpp"
#include "hiac/order/order_file.hpp"
#include "hiac/scene/scene.hpp"
#include "hiac/scene/view_of.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// A visibility order with the hashes that it belongs to, and what was met on the way.
struct MeshOrder {  // NOLINT(bugprone-exception-escape): the JSON library's move says so
  OrderRecord record;
  OrderStatistics statistics;
  nlohmann::ordered_json facts;
};

/// The facts of an order that any algorithm made.
nlohmann::ordered_json order_facts(const VisibilityOrder& order);

/// Orders one mesh for any number of views; what does not depend on the view is made once, when it
/// is first needed.
class Orderer {
 public:
  /// Both have to outlive the orderer.
  Orderer(Tool& tool, const ZooMesh& mesh) : tool_(tool), mesh_(mesh) {}

  /// Cells that overlap will be looked for, and each two of them put into one group (the option
  /// --overlap). Before the first order.
  void look_for_overlaps(double planarity) { overlap_planarity_ = planarity; }

  /// The exact visibility order for a scene's camera (a scene of one frame).
  MeshOrder exact(const Scene& scene);

  /// What all views have in common. Uses the adjacency that the mesh brings, or computes it.
  const OrderBasis& basis();
  const std::string& mesh_hash();

 private:
  Tool& tool_;
  const ZooMesh& mesh_;
  std::optional<double> overlap_planarity_;
  std::optional<OrderBasis> basis_;
  std::string mesh_hash_;
};

/// What the option --overlap says of itself.
inline constexpr const char* kOverlapHelp =
    "Look for cells that overlap, as hiac-check --overlap does, so that all others are in the "
    "right order";

/// Orders that came in an order file, or behind a mesh.
struct GivenOrders {
  std::string subject;             ///< the file, for errors
  std::vector<ExtraChunk> chunks;  ///< of type kOrderChunk
};

/// The first of the orders that belongs to a mesh and to a scene's view. Throws InputError(subject,
/// ...) saying what does not fit when there is none.
OrderRecord fitting_order(const GivenOrders& orders, const std::string& mesh_hash,
                          const ZooMesh& mesh, const Scene& scene);

}  // namespace hiac::tools
