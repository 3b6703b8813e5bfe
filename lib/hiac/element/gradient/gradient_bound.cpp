#include "hiac/element/gradient/gradient_bound.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/base/rounding.hpp"
#include "hiac/base/special_values.hpp"
#include "hiac/element/gradient/curved_gradient_bound.hpp"
#include "hiac/geometry/interval.hpp"
#include "hiac/geometry/inverse_map.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

// The difference of a cell's corners `to` and `from`.
struct Edge {
  std::uint8_t from, to;
};

// A column's edges at the eight corners of the cube, by corner number; bit d of the number is
// coordinate d. A column does not change along its own coordinate.
using EdgesOfColumn = std::array<Edge, 8>;
using EdgesOfColumns = std::array<EdgesOfColumn, 3>;

// A wedge's first column is b p E0 + b y E1 + a z E2 with a + b = 1, p = 1 - y (inverse_map.cpp),
// weights that sum to between 1/2 and 1; the three determinants are examined one by one.
constexpr std::array<Edge, 3> kWedgeEdges{{{0, 1}, {3, 2}, {4, 5}}};
constexpr double kLeastWedgeWeight = 0.5;

constexpr EdgesOfColumn constant(Edge edge) {
  return {edge, edge, edge, edge, edge, edge, edge, edge};
}

constexpr EdgesOfColumns edges_of(CellShape shape) {
  switch (shape) {
    case CellShape::tetrahedron:
      return {constant({0, 1}), constant({0, 2}), constant({0, 3})};
    case CellShape::pyramid:  // along the base's sides, and from the base to the apex
      return {{{{{0, 1}, {0, 1}, {3, 2}, {3, 2}, {0, 1}, {0, 1}, {3, 2}, {3, 2}}},
               {{{0, 3}, {1, 2}, {0, 3}, {1, 2}, {0, 3}, {1, 2}, {0, 3}, {1, 2}}},
               {{{0, 4}, {1, 4}, {3, 4}, {2, 4}, {0, 4}, {1, 4}, {3, 4}, {2, 4}}}}};
    case CellShape::prism:  // along two triangles' sides, and from one to the other
      return {{{{{0, 1}, {0, 1}, {0, 1}, {0, 1}, {3, 4}, {3, 4}, {3, 4}, {3, 4}}},
               {{{0, 2}, {0, 2}, {0, 2}, {0, 2}, {3, 5}, {3, 5}, {3, 5}, {3, 5}}},
               {{{0, 3}, {1, 4}, {2, 5}, {2, 5}, {0, 3}, {1, 4}, {2, 5}, {2, 5}}}}};
    case CellShape::wedge:
      return {{constant(kWedgeEdges[0]),
               {{{0, 3}, {1, 2}, {0, 3}, {1, 2}, {4, 6}, {5, 6}, {4, 6}, {5, 6}}},
               {{{0, 4}, {1, 5}, {3, 6}, {2, 6}, {0, 4}, {1, 5}, {3, 6}, {2, 6}}}}};
    case CellShape::brick:
      break;
  }
  return {{{{{0, 1}, {0, 1}, {3, 2}, {3, 2}, {4, 5}, {4, 5}, {7, 6}, {7, 6}}},
           {{{0, 3}, {1, 2}, {0, 3}, {1, 2}, {4, 7}, {5, 6}, {4, 7}, {5, 6}}},
           {{{0, 4}, {1, 5}, {3, 7}, {2, 6}, {0, 4}, {1, 5}, {3, 7}, {2, 6}}}}};
}

using Column = std::array<Vector, 8>;

// Visits all combinations of corners (0 or 1 each) at which the two columns that change along each
// coordinate are evaluated, with the Bernstein coefficient of degree (2, 2, 2) to which their
// product belongs.
template <typename Visit>
void for_products(const Visit& visit) {
  for (unsigned bits = 0; bits < 64; ++bits) {
    // along coordinate d, the column after d is at bit 2 d, the one after that at bit 2 d + 1
    std::array<std::size_t, 3> corner{};
    std::size_t coefficient = 0, power = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      const std::size_t first = (bits >> (2 * d)) & 1U, second = (bits >> (2 * d + 1)) & 1U;
      corner[(d + 1) % 3] |= first << d;
      corner[(d + 2) % 3] |= second << d;
      coefficient += power * (first + second);
      power *= 3;
    }
    visit(corner, coefficient);
  }
}

double longest(const Column& column) {
  double most = 0;
  for (const Vector& v : column) most = std::max(most, length(v));
  return most;
}

// Extends the interval to include the determinant everywhere on the cube.
void include_determinant(const std::array<Column, 3>& columns, Interval& interval) {
  std::array<double, 27> sum{}, count{};
  for_products([&](const std::array<std::size_t, 3>& corner, std::size_t coefficient) {
    sum[coefficient] +=
        dot(columns[0][corner[0]], cross(columns[1][corner[1]], columns[2][corner[2]]));
    count[coefficient] += 1;
  });
  const double rounding =
      32 * kUnit * longest(columns[0]) * longest(columns[1]) * longest(columns[2]);
  for (std::size_t k = 0; k < sum.size(); ++k) {
    if (count[k] == 0) continue;
    interval.include(sum[k] / count[k] - rounding);
    interval.include(sum[k] / count[k] + rounding);
  }
}

}  // namespace

GradientBound::GradientBound(CellKind kind, std::span<const Vector> nodes, double straightness)
    : kind_(kind) {
  if (order_of(kind) == CellOrder::linear) {
    set_rows(nodes);
    return;
  }
  std::copy_n(nodes.begin(), node_count(kind), nodes_.begin());
  if (edge_deviation(kind, nodes) > straightness) return;
  const std::size_t corners = corner_count(kind);
  const auto reference = reference_nodes(kind);
  std::array<double, kMaxNodesPerCell> shape;
  for (std::size_t k = corners; k < node_count(kind); ++k) {
    shape_functions<double>(kind_of(shape_of(kind), CellOrder::linear), reference[k], shape);
    nodes_[k] = {};
    for (std::size_t n = 0; n < corners; ++n)
      for (std::size_t c = 0; c < 3; ++c) nodes_[k][c] += shape[n] * nodes[n][c];
  }
}

void GradientBound::set_rows(std::span<const Vector> nodes) {
  const CellShape shape = shape_of(kind_);
  const EdgesOfColumns edges = edges_of(shape);
  const auto vector = [&](const Edge& e) { return minus(nodes[e.to], nodes[e.from]); };
  std::array<Column, 3> columns;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t k = 0; k < 8; ++k) columns[a][k] = vector(edges[a][k]);
  Interval interval;
  include_determinant(columns, interval);
  std::array<Column, 3> widest = columns;
  if (shape == CellShape::wedge) {
    for (std::size_t k = 1; k < 3; ++k) {
      columns[0].fill(vector(kWedgeEdges[k]));
      widest[0][k] = columns[0][0];
      include_determinant(columns, interval);
    }
  }
  double determinant = std::max({interval.low, -interval.high, 0.0});
  if (shape == CellShape::wedge) determinant *= kLeastWedgeWeight;
  for (std::size_t a = 0; a < 3; ++a) {
    const Column &b = widest[(a + 1) % 3], &c = widest[(a + 2) % 3];
    double most = 0;
    for (const Vector& p : b)
      for (const Vector& q : c) most = std::max(most, length(cross(p, q)));
    const double rounding = 8 * kUnit * longest(b) * longest(c);
    rows_[a] = determinant > 0 ? (1 + 8 * kUnit) * (most + rounding) / determinant : kInfinity;
  }
}

double GradientBound::operator()(const CellField& field) const {
  if (order_of(kind_) != CellOrder::linear)
    return curved_gradient_bound(kind_, nodes_, field.values);
  const CellShape shape = shape_of(kind_);
  const EdgesOfColumns edges = edges_of(shape);
  double sum = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    double most = 0;
    const auto take = [&](const Edge& e) {
      most = std::max(most, std::abs(field.values[e.to] - field.values[e.from]));
    };
    for (const Edge& e : edges[a]) take(e);
    if (shape == CellShape::wedge && a == 0)
      for (const Edge& e : kWedgeEdges) take(e);
    if (most > 0) sum += most * rows_[a];
  }
  return (1 + 8 * kUnit) * sum;
}

}  // namespace hiac
