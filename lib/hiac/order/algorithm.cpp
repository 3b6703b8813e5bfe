#include "hiac/order/algorithm.hpp"

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac {

std::string_view algorithm_name(OrderAlgorithm algorithm) {
  static constexpr std::array<std::string_view, kOrderAlgorithms.size()> kNames{
      "exact", "stein", "multitiled", "mpvo", "centroid"};
  return kNames[static_cast<std::size_t>(algorithm)];
}

OrderAlgorithm parse_algorithm(std::string_view name, const std::string& option) {
  std::string names;
  for (const OrderAlgorithm algorithm : kOrderAlgorithms) {
    if (algorithm_name(algorithm) == name) return algorithm;
    names += names.empty() ? "" : ", ";
    names += algorithm_name(algorithm);
  }
  throw UsageError(
      fmt::format("{}: unknown algorithm ({} expected, `{}` found)", option, names, name));
}

}  // namespace hiac
