#pragma once

#include <nlohmann/json.hpp>

#include "hiac/session/ordering.hpp"

namespace hiac::tools {

/// The facts of an order that any algorithm made.
nlohmann::ordered_json order_facts(const VisibilityOrder& order);

/// With what was met while the order was made, where it was.
nlohmann::ordered_json order_facts(const MeshOrder& order);

/// The same as a line for people; empty where nothing was met.
std::string order_line(const MeshOrder& order);

/// What the option --overlap says of itself.
inline constexpr const char* kOverlapHelp =
    "Look for cells that overlap, as hiac-check --overlap does, so that all others are in the "
    "right order";

}  // namespace hiac::tools
