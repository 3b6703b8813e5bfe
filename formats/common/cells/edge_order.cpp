#include "formats/common/cells/edge_order.hpp"

#include <algorithm>
#include <list>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace hiac::formats {

std::vector<std::uint8_t> permutation_by_edges(CellKind kind, std::span<const std::uint8_t> corners,
                                               std::span<const ShapeEdge> edges,
                                               std::span<const std::uint8_t> faces) {
  const auto place = [](std::size_t at) { return static_cast<std::uint8_t>(at); };
  const std::size_t count = corner_count(kind);
  const std::size_t per_edge = static_cast<std::size_t>(order_of(kind)) - 1;
  std::vector<std::uint8_t> result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(corners.empty() ? place(i) : corners[i]);
  for (const ShapeEdge& edge : topology_of(kind).edges) {
    if (per_edge == 0) break;
    const ShapeEdge along{result[edge[0]], result[edge[1]]};
    const ShapeEdge against{along[1], along[0]};
    const auto found = std::find_if(edges.begin(), edges.end(), [&](const ShapeEdge& other) {
      return other == along || other == against;
    });
    if (found == edges.end()) throw std::logic_error("a format's edge is missing");
    const std::size_t first = count + per_edge * static_cast<std::size_t>(found - edges.begin());
    for (std::size_t k = 0; k < per_edge; ++k)
      result.push_back(place(first + (*found == along ? k : per_edge - 1 - k)));
  }
  const std::size_t behind = count + per_edge * edges.size();
  for (const std::uint8_t face : faces) result.push_back(place(behind + face));
  return result;
}

std::span<const std::uint8_t> kept_permutation(std::vector<std::uint8_t> permutation) {
  static std::mutex guard;
  static std::list<std::vector<std::uint8_t>> all;
  const std::scoped_lock lock(guard);
  const auto kept = std::find(all.begin(), all.end(), permutation);
  return kept != all.end() ? *kept : all.emplace_back(std::move(permutation));
}

}  // namespace hiac::formats
