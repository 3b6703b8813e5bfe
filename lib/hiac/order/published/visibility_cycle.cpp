#include "hiac/order/published/visibility_cycle.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace hiac {
namespace {

std::string message(const std::vector<CellId>& cells) {
  constexpr std::size_t kMostNamed = 16;
  std::string names;
  for (std::size_t i = 0; i < std::min(cells.size(), kMostNamed); ++i)
    names += fmt::format("{}{}", i == 0 ? "" : ", ", cells[i]);
  if (cells.size() > kMostNamed) names += fmt::format(" and {} more", cells.size() - kMostNamed);
  return fmt::format(
      "visibility order: there is none (cells free of cycles expected, a cycle of {} found, each "
      "in part in front of the next: {})",
      cells.size(), names);
}

}  // namespace

VisibilityCycle::VisibilityCycle(std::vector<CellId> cells)
    : JudgementError(message(cells)), cells_(std::move(cells)) {}

}  // namespace hiac
