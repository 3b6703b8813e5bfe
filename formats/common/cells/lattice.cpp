#include "formats/common/cells/lattice.hpp"

#include <cmath>

#include "hiac/mesh/shape_functions.hpp"

namespace hiac::formats {
namespace {

using Point = std::array<double, 3>;
using Nodes = std::span<const std::optional<std::size_t>>;

/// The lattice points i, j, k divide the sides of the reference cell into `order` parts.
template <typename Contains>
std::vector<Point> grid_points(std::size_t order, const Contains& contains) {
  const auto p = static_cast<double>(order);
  std::vector<Point> points;
  for (std::size_t k = 0; k <= order; ++k)
    for (std::size_t j = 0; j <= order; ++j)
      for (std::size_t i = 0; i <= order; ++i)
        if (contains(i, j, k))
          points.push_back(
              {static_cast<double>(i) / p, static_cast<double>(j) / p, static_cast<double>(k) / p});
  return points;
}

Point mean_of(std::span<const Point> corners, std::span<const std::uint8_t> places) {
  Point mean{};
  for (const std::uint8_t place : places)
    for (std::size_t c = 0; c < 3; ++c)
      mean[c] += corners[place][c] / static_cast<double>(places.size());
  return mean;
}

/// Order 2: adds the centres of the faces and of the cell that the grid does not contain.
void add_centres(CellShape shape, std::vector<Point>& points);

std::optional<std::size_t> place_of(const Lattice& lattice, const Point& point) {
  constexpr double kSame = 1e-9;
  for (std::size_t i = 0; i < lattice.points.size(); ++i) {
    const Point& other = lattice.points[i];
    if (std::abs(other[0] - point[0]) + std::abs(other[1] - point[1]) +
            std::abs(other[2] - point[2]) <
        kSame)
      return i;
  }
  return std::nullopt;
}

void add_centres(CellShape shape, std::vector<Point>& points) {
  const auto corners = reference_nodes(kind_of(shape, CellOrder::linear));
  Lattice so_far{shape, 2, std::move(points)};
  const auto add = [&](const Point& centre) {
    if (!place_of(so_far, centre)) so_far.points.push_back(centre);
  };
  for (const ShapeFace& face : topology_of(shape).faces)
    add(mean_of(corners, std::span(face.corners).first(face.corner_count)));
  constexpr std::array<std::uint8_t, 8> kAll{0, 1, 2, 3, 4, 5, 6, 7};
  add(mean_of(corners, std::span(kAll).first(corners.size())));
  // half-way from a pyramid's base to its apex, where the elements of Fuentes et al. have theirs
  if (shape == CellShape::pyramid) add({0.25, 0.25, 0.5});
  points = std::move(so_far.points);
}

/// The node of the cell at a point of the reference cell.
std::optional<std::size_t> node_at(const Lattice& lattice, Nodes nodes, const Point& point) {
  const auto place = place_of(lattice, point);
  return place ? nodes[*place] : std::nullopt;
}

Point between(const Point& a, const Point& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

/// The Lagrange polynomial of the nodes on the edge a b, at `third` thirds of the edge.
std::optional<Weights> on_edge(const Lattice& lattice, Nodes nodes, const Point& a, const Point& b,
                               std::size_t third) {
  const auto p = static_cast<double>(lattice.order);
  const double at = p * static_cast<double>(third);  // in parts of 1 / (3 p), exactly
  Weights weights;
  for (std::size_t i = 0; i <= lattice.order; ++i) {
    const auto node = node_at(lattice, nodes, between(a, b, static_cast<double>(i) / p));
    if (!node) return std::nullopt;
    double weight = 1;
    for (std::size_t j = 0; j <= lattice.order; ++j)
      if (j != i)
        weight *= (at - 3 * static_cast<double>(j)) /
                  (3 * (static_cast<double>(i) - static_cast<double>(j)));
    if (weight != 0) weights.emplace_back(*node, weight);
  }
  return weights;
}

/// Silvester's polynomial of the barycentric coordinate 1/3: a product of (p/3 - m) / (a - m).
double silvester(std::size_t order, std::size_t a) {
  double value = 1;
  for (std::size_t m = 0; m < a; ++m)
    value *= (static_cast<double>(order) - 3 * static_cast<double>(m)) /
             (3 * (static_cast<double>(a) - static_cast<double>(m)));
  return value;
}

/// The Lagrange polynomial of a triangle's nodes, at its centre.
std::optional<Weights> in_triangle(const Lattice& lattice, Nodes nodes,
                                   const std::array<Point, 3>& corners) {
  const std::size_t p = lattice.order;
  Weights weights;
  for (std::size_t i = 0; i <= p; ++i)
    for (std::size_t j = 0; i + j <= p; ++j) {
      const std::array<std::size_t, 3> index{i, j, p - i - j};
      Point point{};
      double weight = 1;
      for (std::size_t v = 0; v < 3; ++v) {
        weight *= silvester(p, index[v]);
        for (std::size_t c = 0; c < 3; ++c)
          point[c] += corners[v][c] * static_cast<double>(index[v]) / static_cast<double>(p);
      }
      const auto node = node_at(lattice, nodes, point);
      if (!node) return std::nullopt;
      if (weight != 0) weights.emplace_back(*node, weight);
    }
  return weights;
}

/// The value at the centre of a triangle that the cubic shape functions of its edges give
/// (shape_functions.hpp).
Weights from_edges(const std::vector<Weights>& rows, const ShapeFace& face) {
  const auto edges = topology_of(CellShape::tetrahedron).edges;
  const auto in_face = [&](std::uint8_t corner) {
    return face.corners[0] == corner || face.corners[1] == corner || face.corners[2] == corner;
  };
  Weights weights;
  const auto add = [&](const Weights& row, double factor) {
    for (const auto& [node, weight] : row) weights.emplace_back(node, factor * weight);
  };
  for (std::size_t corner = 0; corner < 3; ++corner) add(rows[face.corners[corner]], -1.0 / 6);
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (in_face(edges[e][0]) && in_face(edges[e][1]))
      for (const std::size_t third : {0, 1}) add(rows[4 + 2 * e + third], 0.25);
  return weights;
}

/// The weights of node n of a cubic kind; n is not a corner.
std::optional<Weights> weights_of_node(const Lattice& lattice, Nodes nodes, CellKind kind,
                                       std::size_t n, const std::vector<Weights>& before) {
  const auto points = reference_nodes(kind);
  const auto& topology = topology_of(kind);
  const std::size_t at = n - topology.corner_count;
  if (at < 2 * topology.edges.size()) {
    const ShapeEdge edge = topology.edges[at / 2];
    return on_edge(lattice, nodes, points[edge[0]], points[edge[1]], at % 2 + 1);
  }
  const ShapeFace& face = topology.faces[at - 2 * topology.edges.size()];
  const std::array<Point, 3> corners{points[face.corners[0]], points[face.corners[1]],
                                     points[face.corners[2]]};
  if (auto weights = in_triangle(lattice, nodes, corners)) return weights;
  return from_edges(before, face);
}

}  // namespace

Lattice lattice_of(CellShape shape, std::size_t order) {
  const auto contains = [&](std::size_t i, std::size_t j, std::size_t k) {
    switch (shape) {
      case CellShape::tetrahedron:
        return i + j + k <= order;
      case CellShape::pyramid:
        return i + k <= order && j + k <= order;
      case CellShape::prism:
        return i + j <= order;
      default:
        return true;
    }
  };
  Lattice lattice{shape, order, grid_points(order, contains)};
  if (order == 2) add_centres(shape, lattice.points);
  return lattice;
}

CellKind nearest_kind(const Lattice& lattice) {
  return kind_of(lattice.shape, lattice.order == 2 ? CellOrder::quadratic : CellOrder::cubic);
}

std::optional<std::vector<Weights>> weights_of_nearest(
    const Lattice& lattice, std::span<const std::optional<std::size_t>> nodes) {
  const CellKind kind = nearest_kind(lattice);
  const auto points = reference_nodes(kind);
  std::vector<Weights> rows;
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (const auto node = node_at(lattice, nodes, points[n])) {
      rows.push_back({{*node, 1.0}});
      continue;
    }
    if (n < corner_count(kind) || order_of(kind) != CellOrder::cubic) return std::nullopt;
    auto weights = weights_of_node(lattice, nodes, kind, n, rows);
    if (!weights) return std::nullopt;
    rows.push_back(std::move(*weights));
  }
  return rows;
}

}  // namespace hiac::formats
