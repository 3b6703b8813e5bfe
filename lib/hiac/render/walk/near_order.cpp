#include "hiac/render/walk/near_order.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>

#include "hiac/base/parallel.hpp"
#include "hiac/base/parallel_sort.hpp"
#include "hiac/geometry/box.hpp"
#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

constexpr std::size_t kNearGrain = std::size_t{1} << 14;
constexpr double kParts = 1024;

// Leaves two zeros between any two bits of a number of ten bits.
std::uint32_t spread(std::uint32_t bits) {
  bits = (bits | bits << 16U) & 0x030000FFU;
  bits = (bits | bits << 8U) & 0x0300F00FU;
  bits = (bits | bits << 4U) & 0x030C30C3U;
  return (bits | bits << 2U) & 0x09249249U;
}

// The smallest cube with sides along the axes that holds all nodes.
struct Cube {
  Vector low;
  double size = 0;

  explicit Cube(const Box& box) : low(box.low) {
    for (std::size_t c = 0; c < 3; ++c) size = std::max(size, box.high[c] - low[c]);
  }

  // The part along an axis in which a coordinate lies. In a cube without extent, or with one that
  // is not finite, this is the first.
  [[nodiscard]] std::uint32_t part(double coordinate, std::size_t axis) const {
    const double share = (coordinate - low[axis]) / size;
    return share > 0 ? static_cast<std::uint32_t>(std::min(kParts * share, kParts - 1)) : 0;
  }
};

std::vector<NodeId> nodes_by_code(const ZooMesh& mesh) {
  const Cube cube(box_of_nodes(mesh));
  std::vector<std::uint64_t> keys(mesh.node_count());  // code and node
  parallel_for(keys.size(), kNearGrain, [&](IndexRange range) {
    for (std::size_t n = range.begin; n < range.end; ++n) {
      const auto at = mesh.position(static_cast<NodeId>(n));
      const std::uint64_t code =
          morton_code(cube.part(at[0], 0), cube.part(at[1], 1), cube.part(at[2], 2));
      keys[n] = code << 32U | n;
    }
  });
  parallel_sort(keys, std::less<>());
  std::vector<NodeId> nodes(keys.size());
  for (std::size_t n = 0; n < keys.size(); ++n) nodes[n] = static_cast<NodeId>(keys[n]);
  return nodes;
}

// A counting sort.
std::vector<CellId> cells_by_first_node(const ZooMesh& mesh, const std::vector<NodeId>& nodes) {
  const std::vector<std::uint32_t> number = numbers_in(nodes);
  std::vector<std::uint32_t> first(mesh.cell_count());
  parallel_for(first.size(), kNearGrain, [&](IndexRange range) {
    for (std::size_t cell = range.begin; cell < range.end; ++cell) {
      std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
      for (const NodeId node : mesh.cell_nodes(static_cast<CellId>(cell)))
        least = std::min(least, number[node]);
      first[cell] = least;
    }
  });
  std::vector<std::uint32_t> next(nodes.size() + 1);
  for (const std::uint32_t node : first) ++next[node + 1];
  for (std::size_t node = 1; node < next.size(); ++node) next[node] += next[node - 1];
  std::vector<CellId> cells(first.size());
  for (std::size_t cell = 0; cell < first.size(); ++cell)
    cells[next[first[cell]]++] = static_cast<CellId>(cell);
  return cells;
}

}  // namespace

std::uint32_t morton_code(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return spread(x) | spread(y) << 1U | spread(z) << 2U;
}

NearOrder near_order(const ZooMesh& mesh) {
  NearOrder order;
  order.nodes = nodes_by_code(mesh);
  order.cells = cells_by_first_node(mesh, order.nodes);
  return order;
}

std::vector<std::uint32_t> numbers_in(const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> number(order.size());
  parallel_for(order.size(), kNearGrain, [&](IndexRange range) {
    for (std::size_t n = range.begin; n < range.end; ++n)
      number[order[n]] = static_cast<std::uint32_t>(n);
  });
  return number;
}

}  // namespace hiac
