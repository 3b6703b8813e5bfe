#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace hiac {

/// The algorithms that find a visibility order, by their names in hiac-sort.
enum class OrderAlgorithm : std::uint8_t {
  exact,       ///< visibility_order.hpp: right for every mesh; cycles become groups
  stein,       ///< stein.hpp: tests pairs of cells and needs no adjacency
  multitiled,  ///< multitiled.hpp: the same order, found tile by tile
  mpvo,        ///< mpvo.hpp: across shared faces; a heuristic for meshes that are not convex
  centroid     ///< centroid.hpp: by the depth of centroids; a heuristic
};

inline constexpr std::array<OrderAlgorithm, 5> kOrderAlgorithms{
    OrderAlgorithm::exact, OrderAlgorithm::stein, OrderAlgorithm::multitiled, OrderAlgorithm::mpvo,
    OrderAlgorithm::centroid};

/// Returns "exact", "stein", ...: the name that the algorithm puts into VisibilityOrder::algorithm.
std::string_view algorithm_name(OrderAlgorithm algorithm);

/// Returns the algorithm of that name. Throws UsageError(`option`: ...), which lists all names, for
/// an unknown one.
OrderAlgorithm parse_algorithm(std::string_view name, const std::string& option);

}  // namespace hiac
