#include "formats/common/mesh/last_definitions.hpp"

#include <algorithm>
#include <unordered_map>

namespace hiac::formats {
namespace {

/// For every entry, whether it is the last one with its number.
std::vector<bool> last_ones(const std::vector<std::int64_t>& numbers) {
  std::unordered_map<std::int64_t, std::size_t> last;
  last.reserve(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) last[numbers[i]] = i;
  std::vector<bool> kept(numbers.size());
  for (const auto& [number, place] : last) kept[place] = true;
  return kept;
}

}  // namespace

void keep_last_points(std::vector<std::int64_t>& numbers, std::vector<double>& xyz) {
  const std::vector<bool> kept = last_ones(numbers);
  std::size_t to = 0;
  for (std::size_t point = 0; point < kept.size(); ++point) {
    if (!kept[point]) continue;
    numbers[to] = numbers[point];
    std::copy_n(&xyz[3 * point], 3, &xyz[3 * to]);
    ++to;
  }
  numbers.resize(to);
  xyz.resize(3 * to);
}

void keep_last_cells(std::vector<std::int64_t>& numbers, std::vector<std::uint16_t>& cell_types,
                     std::vector<std::int64_t>& cell_nodes, const std::vector<ForeignType>& types) {
  const std::vector<bool> kept = last_ones(numbers);
  std::size_t to = 0;
  std::size_t from_node = 0;
  std::size_t to_node = 0;
  for (std::size_t cell = 0; cell < kept.size(); ++cell) {
    const std::size_t nodes = types[cell_types[cell]].nodes;
    if (kept[cell]) {
      numbers[to] = numbers[cell];
      cell_types[to] = cell_types[cell];
      std::copy_n(cell_nodes.data() + from_node, nodes, cell_nodes.data() + to_node);
      to_node += nodes;
      ++to;
    }
    from_node += nodes;
  }
  numbers.resize(to);
  cell_types.resize(to);
  cell_nodes.resize(to_node);
}

}  // namespace hiac::formats
