#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace hiac {

/// The ways to find a visibility order, by the names that hiac-sort knows them by.
enum class OrderAlgorithm : std::uint8_t {
  exact,       ///< visibility_order.hpp: right for every mesh, cycles become groups
  stein,       ///< stein.hpp: pairs of cells, no adjacency needed
  multitiled,  ///< multitiled.hpp: the same order, found tile by tile
  mpvo,        ///< mpvo.hpp: across shared faces, a heuristic for meshes that are not convex
  centroid     ///< centroid.hpp: by depth of the centroids, a heuristic
};

inline constexpr std::array<OrderAlgorithm, 5> kOrderAlgorithms{
    OrderAlgorithm::exact, OrderAlgorithm::stein, OrderAlgorithm::multitiled, OrderAlgorithm::mpvo,
    OrderAlgorithm::centroid};

/// "exact", "stein", ...: also VisibilityOrder::algorithm of what the algorithm returns.
std::string_view algorithm_name(OrderAlgorithm algorithm);

/// The algorithm of that name. Throws UsageError(`option`: ...) that lists all names when there is
/// none.
OrderAlgorithm parse_algorithm(std::string_view name, const std::string& option);

}  // namespace hiac
