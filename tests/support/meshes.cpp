#include "tests/support/meshes.hpp"

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>

#include "hiac/tetrahedralize/meshing/delaunay.hpp"

namespace hiac::test {
namespace {

std::vector<Position> random_points(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto point = [&] { return Position{unit(random), unit(random), unit(random)}; };
  const double n = static_cast<double>(count);
  const auto per_face = static_cast<std::size_t>(std::lround(std::cbrt(n * n)));
  const auto per_edge = static_cast<std::size_t>(std::lround(std::cbrt(n)));
  std::vector<Position> points;
  for (unsigned corner = 0; corner < 8; ++corner)
    points.push_back({double(corner & 1U), double((corner >> 1) & 1U), double(corner >> 2)});
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double side : {0.0, 1.0}) {
      for (std::size_t i = 0; i < per_face; ++i) {
        points.push_back(point());
        points.back()[axis] = side;
      }
      for (const double other : {0.0, 1.0})
        for (std::size_t i = 0; i < per_edge; ++i) {
          points.push_back(point());
          points.back()[axis] = side;
          points.back()[(axis + 1) % 3] = other;
        }
    }
  for (std::size_t i = 0; i < count; ++i) points.push_back(point());
  return points;
}

// The bricks of a lattice, with corners in VTK's order.
std::vector<std::array<NodeId, 8>> lattice_bricks(std::size_t n) {
  const auto node = [n](std::size_t i, std::size_t j, std::size_t k) {
    return static_cast<NodeId>((k * (n + 1) + j) * (n + 1) + i);
  };
  std::vector<std::array<NodeId, 8>> bricks;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i)
        bricks.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k),
                          node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1),
                          node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)});
  return bricks;
}

void cut_into(std::vector<Cell>& cells, const std::array<NodeId, 8>& brick, CellKind kind,
              std::initializer_list<std::vector<std::size_t>> parts) {
  for (const auto& part : parts) {
    Cell cell{kind, {}};
    for (const std::size_t corner : part) cell.nodes.push_back(brick[corner]);
    cells.push_back(std::move(cell));
  }
}

}  // namespace

ZooMesh make_mesh(const std::vector<Position>& positions, const std::vector<Cell>& cells) {
  std::vector<std::uint64_t> elems{0};
  std::vector<NodeId> nodes;
  std::vector<CellKind> kinds;
  for (const Cell& cell : cells) {
    nodes.insert(nodes.end(), cell.nodes.begin(), cell.nodes.end());
    elems.push_back(nodes.size());
    kinds.push_back(cell.kind);
  }
  std::vector<double> xyz;
  for (const Position& p : positions) xyz.insert(xyz.end(), p.begin(), p.end());
  ZooMesh mesh;
  mesh.elems = std::move(elems);
  mesh.nodes = std::move(nodes);
  mesh.xyz = std::move(xyz);
  mesh.kinds = std::move(kinds);
  return mesh;
}

void add_counted_fields(ZooMesh& mesh) {
  const auto add = [&](const char* name, FieldLocation location, std::uint32_t components,
                       std::size_t tuples) {
    std::vector<double> values(tuples * components);
    std::iota(values.begin(), values.end(), 0.0);
    mesh.fields.push_back({name, "m", location, components, std::move(values)});
  };
  add("n", FieldLocation::node, 2, mesh.node_count());
  add("c", FieldLocation::cell, 3, mesh.cell_count());
  add("k", FieldLocation::corner, 1, mesh.nodes.size());
}

void add_node_field(ZooMesh& mesh, const std::string& name, const ScalarFunction& function) {
  std::vector<double> values;
  for (NodeId node = 0; node < mesh.node_count(); ++node) {
    const auto p = mesh.position(node);
    values.push_back(function({p[0], p[1], p[2]}));
  }
  mesh.fields.push_back({name, "", FieldLocation::node, 1, std::move(values)});
}

ZooMesh random_delaunay(std::size_t points, std::uint64_t seed) {
  const auto positions = random_points(points, seed);
  std::vector<Cell> cells;
  for (const auto& tetrahedron : delaunay_tetrahedra(positions))
    cells.push_back({CellKind::tetrahedron4, {tetrahedron.begin(), tetrahedron.end()}});
  return make_mesh(positions, cells);
}

ZooMesh structured(std::size_t n, Cut cut) {
  const double h = 1.0 / static_cast<double>(n);
  std::vector<Position> positions;
  for (std::size_t k = 0; k <= n; ++k)
    for (std::size_t j = 0; j <= n; ++j)
      for (std::size_t i = 0; i <= n; ++i)
        positions.push_back({double(i) * h, double(j) * h, double(k) * h});
  std::vector<Cell> cells;
  for (const auto& brick : lattice_bricks(n)) {
    switch (cut) {
      case Cut::bricks:
        cut_into(cells, brick, CellKind::brick8, {{0, 1, 2, 3, 4, 5, 6, 7}});
        break;
      case Cut::tetrahedra:
        cut_into(
            cells, brick, CellKind::tetrahedron4,
            {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}});
        break;
      case Cut::prisms:
        cut_into(cells, brick, CellKind::prism6, {{0, 2, 1, 4, 6, 5}, {0, 3, 2, 4, 7, 6}});
        break;
      case Cut::pyramids: {
        Position center{};
        for (const NodeId corner : brick)
          for (std::size_t c = 0; c < 3; ++c) center[c] += positions[corner][c] / 8;
        const auto apex = static_cast<NodeId>(positions.size());
        positions.push_back(center);
        const std::size_t first = cells.size();
        cut_into(
            cells, brick, CellKind::pyramid5,
            {{0, 1, 2, 3}, {7, 6, 5, 4}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}});
        for (std::size_t c = first; c < cells.size(); ++c) cells[c].nodes.push_back(apex);
        break;
      }
    }
  }
  return make_mesh(positions, cells);
}

std::vector<Position> positions_of(const ZooMesh& mesh) {
  std::vector<Position> positions;
  for (NodeId node = 0; node < mesh.node_count(); ++node) {
    const auto p = mesh.position(node);
    positions.push_back({p[0], p[1], p[2]});
  }
  return positions;
}

std::vector<Cell> cells_of(const ZooMesh& mesh) {
  std::vector<Cell> cells;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto nodes = mesh.cell_nodes(cell);
    cells.push_back({mesh.kinds[cell], {nodes.begin(), nodes.end()}});
  }
  return cells;
}

ZooMesh keep_cells(const ZooMesh& mesh,
                   const std::function<bool(const Position& centroid, CellId cell)>& keep) {
  const auto positions = positions_of(mesh);
  const auto cells = cells_of(mesh);
  std::vector<Cell> kept;
  for (CellId cell = 0; cell < cells.size(); ++cell) {
    Position centroid{};
    for (const NodeId node : cells[cell].nodes)
      for (std::size_t c = 0; c < 3; ++c)
        centroid[c] += positions[node][c] / static_cast<double>(cells[cell].nodes.size());
    if (keep(centroid, cell)) kept.push_back(cells[cell]);
  }
  return make_mesh(positions, kept);
}

ZooMesh side_by_side(const ZooMesh& a, const ZooMesh& b) {
  auto positions = positions_of(a);
  auto cells = cells_of(a);
  const auto offset = static_cast<NodeId>(positions.size());
  for (const Position& p : positions_of(b)) positions.push_back(p);
  for (Cell& cell : cells_of(b)) {
    for (NodeId& node : cell.nodes) node += offset;
    cells.push_back(std::move(cell));
  }
  return make_mesh(positions, cells);
}

ZooMesh moved(const ZooMesh& mesh, const std::function<Position(const Position&)>& map) {
  std::vector<double> xyz;
  for (const Position& p : positions_of(mesh)) {
    const Position q = map(p);
    xyz.insert(xyz.end(), q.begin(), q.end());
  }
  ZooMesh result = mesh;
  result.xyz = std::move(xyz);
  return result;
}

double smooth_field(const Position& p) {
  using std::numbers::pi;
  double r2 = 0;
  for (const double x : p) r2 += (x - 0.5) * (x - 0.5);
  return 0.5 + 0.5 * std::sin(2 * pi * p[0]) * std::sin(2 * pi * p[1]) * std::cos(pi * p[2]) *
                   std::exp(-r2);
}

}  // namespace hiac::test
