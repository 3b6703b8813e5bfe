#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/verify_order.hpp"
#include "tools/common/picture/order_facts.hpp"

namespace hiac::tools {

/// What is told of one order that was made.
struct ReportedOrder {
  std::uint32_t frame;
  std::string algorithm;
  OrderStatistics statistics;
  std::uint64_t groups;  ///< of several cells
  double seconds;
};

/// A table of what a run met: cells by kind, faces and arrows by source, groups, seconds by stage
/// (`seconds`: an object of numbers), memory at its peak. Of several orders each has a line.
std::string statistics_table(const ZooMesh& mesh, const std::vector<ReportedOrder>& orders,
                             const nlohmann::ordered_json& seconds, std::uint64_t peak_bytes);

/// What was proven of an order, in a few words; of one that is not right, what is wrong with it.
std::string check_text(const OrderCheck& check, const VisibilityOrder& order);

nlohmann::ordered_json check_facts(const OrderCheck& check);

}  // namespace hiac::tools
