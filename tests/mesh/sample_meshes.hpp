#pragma once

#include <cstddef>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::samples {

/// One cell as a test writes it down.
struct Cell {
  CellKind kind;
  std::vector<NodeId> nodes;
};

/// A mesh of the cells, its coordinates zero unless given.
inline ZooMesh make_mesh(const std::vector<Cell>& cells, std::size_t node_count,
                         std::vector<double> xyz = {}) {
  std::vector<CellKind> kinds;
  std::vector<std::uint64_t> elems{0};
  std::vector<NodeId> nodes;
  for (const Cell& cell : cells) {
    kinds.push_back(cell.kind);
    nodes.insert(nodes.end(), cell.nodes.begin(), cell.nodes.end());
    elems.push_back(nodes.size());
  }
  xyz.resize(3 * node_count);
  ZooMesh mesh;
  mesh.kinds = std::move(kinds);
  mesh.elems = std::move(elems);
  mesh.nodes = std::move(nodes);
  mesh.xyz = std::move(xyz);
  return mesh;
}

/// Unit bricks, n in every direction; node (i, j, k) is number i + (n+1) (j + (n+1) k).
inline ZooMesh brick_grid(std::size_t n) {
  std::vector<Cell> cells;
  std::vector<double> xyz;
  const auto node = [n](std::size_t i, std::size_t j, std::size_t k) {
    return static_cast<NodeId>(i + (n + 1) * (j + (n + 1) * k));
  };
  for (std::size_t k = 0; k <= n; ++k)
    for (std::size_t j = 0; j <= n; ++j)
      for (std::size_t i = 0; i <= n; ++i)
        for (const std::size_t x : {i, j, k}) xyz.push_back(static_cast<double>(x));
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i)
        cells.push_back({CellKind::brick8,
                         {node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k),
                          node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1),
                          node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)}});
  return make_mesh(cells, (n + 1) * (n + 1) * (n + 1), std::move(xyz));
}

/// The brick grid with every brick cut into the six tetrahedra around its diagonal 0-6: conforming.
inline ZooMesh tetrahedron_grid(std::size_t n) {
  const ZooMesh bricks = brick_grid(n);
  static constexpr std::size_t kCut[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                             {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  std::vector<Cell> cells;
  for (CellId brick = 0; brick < bricks.cell_count(); ++brick) {
    const auto nodes = bricks.cell_nodes(brick);
    for (const auto& cut : kCut)
      cells.push_back(
          {CellKind::tetrahedron4, {nodes[cut[0]], nodes[cut[1]], nodes[cut[2]], nodes[cut[3]]}});
  }
  return make_mesh(cells, bricks.node_count(), {bricks.xyz.begin(), bricks.xyz.end()});
}

/// One cell of every kind, all apart from each other, with a field of every location.
inline ZooMesh one_of_each_kind() {
  std::vector<Cell> cells;
  NodeId next = 0;
  for (std::size_t k = 0; k < kKindCount; ++k) {
    Cell cell{static_cast<CellKind>(k), {}};
    for (std::size_t i = 0; i < node_count(cell.kind); ++i) cell.nodes.push_back(next++);
    cells.push_back(cell);
  }
  std::vector<double> xyz;
  for (std::size_t i = 0; i < 3 * std::size_t{next}; ++i)
    xyz.push_back(0.25 * static_cast<double>(i % 7));
  ZooMesh mesh = make_mesh(cells, next, std::move(xyz));
  const auto values = [](std::size_t count) {
    std::vector<double> v(count);
    for (std::size_t i = 0; i < count; ++i) v[i] = static_cast<double>(i) - 3.5;
    return v;
  };
  mesh.fields.push_back({"temperature", "K", FieldLocation::node, 1, values(next)});
  mesh.fields.push_back({"velocity", "m/s", FieldLocation::node, 3, values(std::size_t{3} * next)});
  mesh.fields.push_back({"stress", "", FieldLocation::cell, 6, values(6 * kKindCount)});
  mesh.fields.push_back({"damage", "", FieldLocation::corner, 1, values(mesh.nodes.size())});
  mesh.metadata = {{"source", "a test"}, {"time", "0.5"}};
  return mesh;
}

}  // namespace hiac::samples
