#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac::formats {

/// Evenly spaced points of a reference cell (shape_functions.hpp): all possible positions of nodes
/// in a cell of that order. For order 2 they include the centres of all faces and of the cell, and
/// of a pyramid also the middle between base and apex.
struct Lattice {
  CellShape shape;
  std::size_t order;
  std::vector<std::array<double, 3>> points;
};

/// The lattice of a shape other than the wedge, of an order from 2 on.
Lattice lattice_of(CellShape shape, std::size_t order);

/// A value at a point as a weighted sum of values at other points: places and weights.
using Weights = std::vector<std::pair<std::size_t, double>>;

/// The nearest kind for cells of that order: the quadratic one for order 2, else the cubic one.
CellKind nearest_kind(const Lattice& lattice);

/// For every node of the nearest kind, the value of the cell's interpolant there, as weights of the
/// values at the cell's nodes; `nodes[p]` is the node at the lattice point p, if there is one. On
/// an edge the interpolant is the Lagrange polynomial of the edge's nodes, on a triangle that of
/// the triangle's nodes (if some of them are missing, the cubic without a centre node). Nothing
/// when a corner or a node of an edge is missing.
std::optional<std::vector<Weights>> weights_of_nearest(
    const Lattice& lattice, std::span<const std::optional<std::size_t>> nodes);

}  // namespace hiac::formats
