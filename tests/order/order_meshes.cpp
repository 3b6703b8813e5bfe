#include "tests/order/order_meshes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>

#include "tests/support/instrumented.hpp"

namespace hiac::test {
namespace {

Position mean(const std::vector<Position>& positions, const Cell& cell) {
  Position sum{};
  for (const NodeId node : cell.nodes)
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += positions[node][c] / static_cast<double>(cell.nodes.size());
  return sum;
}

// A numbering of a linear cell's nodes that turns its inside out.
std::vector<std::size_t> inversion(CellKind kind) {
  switch (shape_of(kind)) {
    case CellShape::tetrahedron:
      return {1, 0, 2, 3};
    case CellShape::pyramid:
      return {0, 3, 2, 1, 4};
    case CellShape::prism:
      return {3, 4, 5, 0, 1, 2};
    case CellShape::brick:
      return {4, 5, 6, 7, 0, 1, 2, 3};
    case CellShape::wedge:
      break;
  }
  return {};
}

}  // namespace

NamedView from_eye(std::string name, const Position& eye) {
  return {std::move(name), {true, eye, {}}};
}

NamedView along(std::string name, const Position& direction) {
  return {std::move(name), {false, {}, direction}};
}

std::vector<NamedView> all_views() {
  std::vector<NamedView> views{from_eye("outside", {-1.3, -2.1, 1.7}),
                               from_eye("far", {900, -2100, 1700}),
                               from_eye("inside", {0.41, 0.57, 0.63}),
                               from_eye("in the middle", {0.5, 0.5, 0.5}),
                               from_eye("on a corner", {0, 0, 0}),
                               from_eye("on an edge", {0.5, 0, 1}),
                               from_eye("on a side", {0.25, 0.5, 0}),
                               from_eye("in the planes of sides", {-2, 0, 1}),
                               from_eye("in middle planes", {0.5, 3, 0.5}),
                               along("x", {1, 0, 0}),
                               along("-y", {0, -1, 0}),
                               along("z", {0, 0, 1}),
                               along("a diagonal", {1, 1, 0}),
                               along("the other diagonal", {1, -1, 1})};
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 4; ++i) {
    const Position p{normal(random), normal(random), normal(random)};
    views.push_back(along("random direction " + std::to_string(i), p));
    views.push_back(from_eye("random eye " + std::to_string(i), {2 * p[0], 2 * p[1], 2 * p[2]}));
  }
  return views;
}

std::vector<NamedView> many_views() { return tried(all_views()); }

View view_named(std::string_view name) {
  const std::vector<NamedView> views = all_views();
  const auto found = std::find_if(views.begin(), views.end(),
                                  [&](const NamedView& named) { return named.name == name; });
  if (found == views.end()) throw std::out_of_range(std::string(name));
  return found->view;
}

Position turned(const Position& p) {
  const double s = std::sin(0.7), c = std::cos(0.7), u = std::sin(0.4), v = std::cos(0.4);
  const Position q{c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
  return {q[0], v * q[1] - u * q[2], u * q[1] + v * q[2]};
}

ZooMesh torn(const ZooMesh& mesh, double front) {
  std::vector<Position> positions = positions_of(mesh);
  std::vector<Cell> cells = cells_of(mesh);
  std::vector<NodeId> twin(positions.size());
  for (NodeId node = 0; node < twin.size(); ++node) {
    twin[node] = node;
    const Position p = positions[node];
    if (p[0] != 0.5 || p[2] <= front) continue;
    twin[node] = static_cast<NodeId>(positions.size());
    positions.push_back(p);
  }
  for (Cell& cell : cells)
    if (mean(positions, cell)[0] > 0.5)
      for (NodeId& node : cell.nodes) node = twin[node];
  return make_mesh(positions, cells);
}

ZooMesh inverted(const ZooMesh& mesh, const std::function<bool(CellId)>& which) {
  std::vector<Cell> cells = cells_of(mesh);
  for (CellId cell = 0; cell < cells.size(); ++cell) {
    if (!which(cell)) continue;
    std::vector<NodeId> nodes;
    for (const std::size_t k : inversion(cells[cell].kind)) nodes.push_back(cells[cell].nodes[k]);
    cells[cell].nodes = std::move(nodes);
  }
  return make_mesh(positions_of(mesh), cells);
}

ZooMesh pinwheel() {
  constexpr double kThird = 2 * std::numbers::pi / 3, kLean = 0.35;
  std::vector<Position> positions;  // a0 a1 a2 A0 A1 A2 at z = 0, then the same at z = 1
  for (const double z : {0.0, 1.0})
    for (const double radius : {1.0, 5.0})
      for (int k = 0; k < 3; ++k) {
        const double angle = k * kThird + (radius > 1 ? kLean : 0);
        positions.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
      }
  std::vector<Cell> cells{{CellKind::prism6, {0, 2, 1, 6, 8, 7}}};
  for (NodeId k = 0; k < 3; ++k) {
    const NodeId next = (k + 1) % 3;
    cells.push_back(
        {CellKind::brick8, {k, 3 + k, 3 + next, next, 6 + k, 9 + k, 9 + next, 6 + next}});
  }
  return make_mesh(positions, cells);
}

ZooMesh corners_in_line(NodeId in_line) {
  const std::array<std::array<double, 2>, 8> places{
      {{0.5, 0.5}, {0.5, 0}, {0, 0}, {0, 0.5}, {1, 0.5}, {1, 0}, {0.5, 0.1}, {0.5, 1}}};
  const auto number = [in_line](NodeId node, NodeId layer) {
    return 8 * layer + (node + in_line) % 8;
  };
  std::vector<Position> positions(24);
  for (NodeId layer = 0; layer < 3; ++layer)
    for (NodeId node = 0; node < 8; ++node)
      positions[number(node, layer)] = {places[node][0], places[node][1], 0.5 * layer};
  std::vector<Cell> cells;
  for (NodeId layer = 0; layer < 2; ++layer)
    for (const auto& base : {std::array<NodeId, 4>{2, 1, 0, 3}, {1, 5, 4, 0}, {3, 0, 4, 7}}) {
      Cell brick{CellKind::brick8, {}};
      for (const NodeId above : {layer, layer + 1})
        for (const NodeId node : base) brick.nodes.push_back(number(node, above));
      cells.push_back(std::move(brick));
    }
  return make_mesh(positions, cells);
}

ZooMesh flat_between() {
  std::vector<Position> positions;  // three squares, each 0 1 2 3 around, one above the other
  for (const double z : {0.0, 0.5, 1.0})
    for (const auto& [x, y] :
         std::initializer_list<std::pair<double, double>>{{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      positions.push_back({x, y, z});
  std::vector<Cell> cells{{CellKind::tetrahedron4, {4, 5, 6, 7}}};
  const std::array<std::array<NodeId, 8>, 2> bricks{
      {{0, 1, 2, 3, 4, 5, 6, 7}, {5, 6, 7, 4, 9, 10, 11, 8}}};
  const std::array<std::array<std::size_t, 4>, 6> parts{
      {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}};
  for (const auto& brick : bricks)
    for (const auto& part : parts) {
      Cell cell{CellKind::tetrahedron4, {}};
      for (const std::size_t corner : part) cell.nodes.push_back(brick[corner]);
      cells.push_back(std::move(cell));
    }
  return make_mesh(positions, cells);
}

ZooMesh wound(int sectors, int turns) {
  std::vector<Position> places{{0, 0, 0}, {0, 0, 1}};
  std::vector<Cell> cells;
  for (int i = 0; i < sectors; ++i) {
    // a second time at the same places to the last bit
    const double part = static_cast<double>((i * turns) % sectors) / sectors;
    const double angle = 2 * std::numbers::pi * part;
    for (const double z : {0.0, 1.0}) places.push_back({std::cos(angle), std::sin(angle), z});
    const auto low = static_cast<NodeId>(2 + 2 * i);
    const auto next = static_cast<NodeId>(2 + 2 * ((i + 1) % sectors));
    cells.push_back({CellKind::prism6, {0, next, low, 1, next + 1, low + 1}});
  }
  return make_mesh(places, cells);
}

}  // namespace hiac::test
