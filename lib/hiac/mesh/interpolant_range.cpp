#include "hiac/mesh/interpolant_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

using Real = long double;

std::array<Real, 3> uncollapsed(CellShape shape, const std::array<Real, 3>& cube) {
  const auto& [u, v, w] = cube;
  switch (shape) {
    case CellShape::tetrahedron:
      return {u * (1 - v) * (1 - w), v * (1 - w), w};
    case CellShape::pyramid:
      return {u * (1 - w), v * (1 - w), w};
    case CellShape::prism:
      return {u * (1 - v), v, w};
    case CellShape::wedge:
      return {u * (2 - v - w), v, w};
    case CellShape::brick:
      break;
  }
  return cube;
}

// Matrices that give the Bernstein coefficients of degree p from the values at 0, 1/p, ..., 1.
constexpr std::array<std::array<std::array<Real, 4>, 4>, 4> kFromValues{
    {{},
     {{{1}, {0, 1}}},
     {{{1}, {-0.5L, 2, -0.5L}, {0, 0, 1}}},
     {{{1}, {-5.0L / 6, 3, -1.5L, 1.0L / 3}, {1.0L / 3, -1.5L, 3, -5.0L / 6}, {0, 0, 0, 1}}}}};

// The Bernstein coefficients of all shape functions of a kind.
struct KindTable {
  // A node's weight in every coefficient; the first node's weights are omitted.
  using Shares = std::array<double, InterpolantCoefficients::kMost>;

  std::size_t nodes = 0, count = 0;
  std::vector<Shares> of_node;
  double largest_sum = 0;  // of the absolute weights in a coefficient

  explicit KindTable(CellKind kind) : nodes(node_count(kind)), of_node(nodes) {
    const auto p = static_cast<std::size_t>(order_of(kind));
    const std::size_t n = p + 1;
    count = n * n * n;
    std::array<std::array<Real, kMaxNodesPerCell>, InterpolantCoefficients::kMost> values{};
    for (std::size_t i = 0; i < count; ++i) {
      const auto at = [&](std::size_t k) { return static_cast<Real>(k) / static_cast<Real>(p); };
      shape_functions<Real>(
          kind, uncollapsed(shape_of(kind), {at(i % n), at(i / n % n), at(i / n / n)}), values[i]);
    }
    for (const std::size_t stride : {std::size_t{1}, n, n * n}) transform(p, stride, values);
    for (std::size_t i = 0; i < count; ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < nodes; ++k) {
        const auto share = static_cast<double>(values[i][k]);
        sum += std::abs(share);
        if (k > 0 && std::abs(share) > kZero) of_node[k][i] = share;
      }
      largest_sum = std::max(largest_sum, sum);
    }
  }

 private:
  static constexpr double kZero = 1e-16;  // smaller weights are rounding errors

  template <typename Values>
  void transform(std::size_t p, std::size_t stride, Values& values) const {
    for (std::size_t i = 0; i < count; ++i) {
      if (i / stride % (p + 1) != 0) continue;
      for (std::size_t k = 0; k < nodes; ++k) {
        std::array<Real, 4> before{};
        for (std::size_t j = 0; j <= p; ++j) before[j] = values[i + j * stride][k];
        for (std::size_t j = 0; j <= p; ++j) {
          Real sum = 0;
          for (std::size_t m = 0; m <= p; ++m) sum += kFromValues[p][j][m] * before[m];
          values[i + j * stride][k] = sum;
        }
      }
    }
  }
};

const KindTable& table_of(CellKind kind) {
  static const auto kTables = [] {
    std::vector<KindTable> tables;
    for (std::size_t k = 0; k < kKindCount; ++k) tables.emplace_back(static_cast<CellKind>(k));
    return tables;
  }();
  return kTables[static_cast<std::size_t>(kind)];
}

}  // namespace

InterpolantCoefficients interpolant_coefficients(CellKind kind, std::span<const double> values) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  const KindTable& table = table_of(kind);
  // differences keep the digits of a small variation of large numbers
  std::array<double, kMaxNodesPerCell> difference;
  double largest = 0;
  for (std::size_t k = 0; k < table.nodes; ++k) {
    difference[k] = values[k] - values[0];
    largest = std::max(largest, std::abs(difference[k]));
  }
  InterpolantCoefficients result;
  result.count = table.count;
  add_shares(
      table.nodes, table.count, [&](std::size_t k) { return table.of_node[k].data(); }, difference,
      result.c);
  for (std::size_t i = 0; i < table.count; ++i) result.c[i] += values[0];
  if (largest > 0)
    result.rounding =
        kEpsilon * ((static_cast<double>(table.nodes) + 4) * table.largest_sum * largest +
                    2 * (std::abs(values[0]) + largest));
  return result;
}

ValueRange interpolant_range(CellKind kind, std::span<const double> values) {
  const auto nodal = std::ranges::minmax(values.first(node_count(kind)));
  if (order_of(kind) == CellOrder::linear || nodal.min == nodal.max) return {nodal.min, nodal.max};
  const InterpolantCoefficients b = interpolant_coefficients(kind, values);
  const auto [least, most] = std::ranges::minmax(std::span(b.c).first(b.count));
  return {least - b.rounding, most + b.rounding};
}

}  // namespace hiac
