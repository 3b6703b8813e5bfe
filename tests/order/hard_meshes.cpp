#include "tests/order/hard_meshes.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>

#include "tests/support/instrumented.hpp"

namespace hiac::test {
namespace {

using Place = std::array<int, 3>;

// A part of a cube: its corners in units of half the cube.
struct Part {
  CellKind kind;
  std::vector<Place> corners;
};

// The corners of a cube in VTK's order.
constexpr std::array<Place, 8> kCube{
    {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}}};

Part part_of_cube(CellKind kind, std::initializer_list<std::size_t> corners) {
  Part part{kind, {}};
  for (const std::size_t corner : corners) part.corners.push_back(kCube[corner]);
  return part;
}

std::vector<Part> parts_of(CellShape shape) {
  std::vector<Part> parts;
  switch (shape) {
    case CellShape::brick:
      parts.push_back(part_of_cube(CellKind::brick8, {0, 1, 2, 3, 4, 5, 6, 7}));
      break;
    case CellShape::tetrahedron:
      for (const auto& c : {std::array<std::size_t, 4>{0, 1, 2, 6},
                            {0, 2, 3, 6},
                            {0, 3, 7, 6},
                            {0, 7, 4, 6},
                            {0, 4, 5, 6},
                            {0, 5, 1, 6}})
        parts.push_back(part_of_cube(CellKind::tetrahedron4, {c[0], c[1], c[2], c[3]}));
      break;
    case CellShape::prism:
      parts.push_back(part_of_cube(CellKind::prism6, {0, 2, 1, 4, 6, 5}));
      parts.push_back(part_of_cube(CellKind::prism6, {0, 3, 2, 4, 7, 6}));
      break;
    case CellShape::pyramid:
      for (const auto& c : {std::array<std::size_t, 4>{0, 1, 2, 3},
                            {7, 6, 5, 4},
                            {0, 4, 5, 1},
                            {1, 5, 6, 2},
                            {2, 6, 7, 3},
                            {3, 7, 4, 0}}) {
        parts.push_back(part_of_cube(CellKind::pyramid5, {c[0], c[1], c[2], c[3]}));
        parts.back().corners.push_back({1, 1, 1});
      }
      break;
    case CellShape::wedge: {
      // the plane 2 x = 4 - y - z cuts the cube into two wedges, one the other's reflection
      const std::vector<Place> half{{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {0, 2, 0},
                                    {0, 0, 2}, {1, 0, 2}, {0, 2, 2}};
      Part other{CellKind::wedge7, {}};
      for (const std::size_t k : {0U, 1U, 5U, 4U, 3U, 2U, 6U})  // turned inside out by reflection
        other.corners.push_back({2 - half[k][0], 2 - half[k][1], 2 - half[k][2]});
      parts = {{CellKind::wedge7, half}, std::move(other)};
      break;
    }
  }
  return parts;
}

// Cells between places on a lattice of integers; one node a place.
class LatticeMesh {
 public:
  void add_cube(const Place& origin, int side, CellShape shape) {
    for (const Part& part : parts_of(shape)) {
      Cell cell{part.kind, {}};
      for (const Place& corner : part.corners) {
        Place place;
        for (std::size_t c = 0; c < 3; ++c) {
          const bool mirrored = shape == CellShape::wedge && (origin[c] / side) % 2 != 0;
          place[c] = origin[c] + (mirrored ? 2 - corner[c] : corner[c]) * side / 2;
        }
        cell.nodes.push_back(node_at(place));
      }
      cells_.push_back(std::move(cell));
    }
  }

  [[nodiscard]] ZooMesh mesh() const { return make_mesh(positions_, cells_); }

 private:
  NodeId node_at(const Place& place) {
    const auto [at, is_new] = nodes_.try_emplace(place, static_cast<NodeId>(positions_.size()));
    if (is_new) positions_.push_back({double(place[0]), double(place[1]), double(place[2])});
    return at->second;
  }

  std::map<Place, NodeId> nodes_;
  std::vector<Position> positions_;
  std::vector<Cell> cells_;
};

double determinant(const std::array<Position, 3>& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) +
         m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// a + s (b - a)
Position towards(const Position& a, const Position& b, double s) {
  return {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])};
}
// To few bits, with which integer arithmetic is quick.
Position rounded(const Position& p) {
  const auto of = [](double x) { return std::round(x * 0x1p12) * 0x1p-12; };
  return {of(p[0]), of(p[1]), of(p[2])};
}
Position difference(const Position& a, const Position& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

}  // namespace

ZooMesh blocks(int n, const BlockAt& at) {
  LatticeMesh mesh;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const auto block = at(i, j, k);
        if (!block) continue;
        if (!block->halved) {
          mesh.add_cube({4 * i, 4 * j, 4 * k}, 4, block->shape);
          continue;
        }
        for (const Place& corner : kCube)
          mesh.add_cube({4 * i + corner[0], 4 * j + corner[1], 4 * k + corner[2]}, 2, block->shape);
      }
  return mesh.mesh();
}

ZooMesh distorted(const ZooMesh& blocks, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::array<std::array<double, 17>, 3> planes{};  // where the planes between cubes go
  for (auto& along : planes)
    for (std::size_t i = 1; i < along.size(); ++i)
      along[i] = along[i - 1] + static_cast<double>(1 + random() % 31) / 8;
  std::array<Position, 3> matrix;
  do {
    for (Position& row : matrix)
      for (double& entry : row) entry = static_cast<double>(random() % 5) - 2;
  } while (determinant(matrix) == 0);
  return moved(blocks, [&](const Position& p) {
    Position stretched, mapped{};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto cube = static_cast<std::size_t>(p[c] / 4);
      const double part = p[c] / 4 - static_cast<double>(cube);
      stretched[c] = planes[c][cube] + part * (planes[c][cube + 1] - planes[c][cube]);
    }
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) mapped[r] += matrix[r][c] * stretched[c];
    return mapped;
  });
}

std::vector<NamedView> special_views(const ZooMesh& mesh, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto positions = positions_of(mesh);
  const auto cells = cells_of(mesh);
  struct Face {
    Position a, b, c;
  };
  const auto some_cell = [&]() -> const Cell& { return cells[random() % cells.size()]; };
  const auto some_face = [&]() -> Face {
    while (true) {
      const Cell& cell = some_cell();
      const auto faces = topology_of(cell.kind).faces;
      const auto& face = faces[random() % faces.size()];
      const std::size_t k = random() % face.corner_count;
      const auto corner = [&](std::size_t i) {
        return positions[cell.nodes[face.corners[(k + i) % face.corner_count]]];
      };
      const Face found{corner(0), corner(1), corner(2)};
      if (found.a != found.b && found.b != found.c && found.c != found.a) return found;
    }
  };
  const Position middle = positions[positions.size() / 2];
  const auto random_direction = [&] {
    return rounded({normal(random), normal(random), normal(random)});
  };
  const auto anywhere = [&](double distance) {
    const Position v = random_direction();
    return rounded(
        {middle[0] + distance * v[0], middle[1] + distance * v[1], middle[2] + distance * v[2]});
  };
  const auto center = [&](const Cell& cell) {
    Position sum{};
    for (const NodeId node : cell.nodes)
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += positions[node][c] / static_cast<double>(cell.nodes.size());
    return rounded(sum);
  };
  const Face f = some_face(), g = some_face(), h = some_face(), d = some_face(), e = some_face();
  const double sign = random() % 2 == 0 ? 1 : -1;
  return tried(std::vector<NamedView>{
      from_eye("somewhere", anywhere(4)), from_eye("far away", anywhere(1e4)),
      from_eye("in a cell", center(some_cell())), from_eye("on a vertex", f.a),
      from_eye("on an edge", towards(f.a, f.b, 0.5)),
      from_eye("on a face", towards(f.a, towards(f.b, f.c, 0.5), 0.5)),
      from_eye("in a face's plane", towards(g.a, towards(g.b, g.c, -2), 4)),
      from_eye("in line with an edge", towards(h.a, h.b, 3)), along("x", {sign, 0, 0}),
      along("y", {0, -sign, 0}), along("z", {0, 0, sign}), along("an edge", difference(d.a, d.b)),
      along("a face's diagonal", difference(e.a, e.c)),
      along("a face's plane", difference(towards(e.a, e.c, 3), e.b)),
      along("any way", random_direction())});
}

ZooMesh collapsed_fan(int sectors, int rings, int layers, Collapse collapse) {
  std::vector<Position> positions;
  // rays from the axis, with integer coordinates, over three quarters of a turn
  std::vector<std::array<double, 2>> rays;
  for (int i = 0; i <= sectors; ++i) {
    const double angle = 1.5 * std::numbers::pi * i / sectors;
    rays.push_back({std::round(64 * std::cos(angle)), std::round(64 * std::sin(angle))});
  }
  for (int k = 0; k <= layers; ++k)
    for (int j = 0; j <= rings; ++j)
      for (const auto& ray : rays) positions.push_back({j * ray[0], j * ray[1], 40.0 * k});
  const auto node = [&](int i, int j, int k) {
    if (j == 0 && collapse == Collapse::merged) i = 0;
    return static_cast<NodeId>((k * (rings + 1) + j) * (sectors + 1) + i);
  };
  std::vector<Cell> cells;
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < rings; ++j)
      for (int i = 0; i < sectors; ++i) {
        if (j == 0 && collapse == Collapse::merged)
          cells.push_back({CellKind::prism6,
                           {node(i, 0, k), node(i + 1, 1, k), node(i, 1, k), node(i, 0, k + 1),
                            node(i + 1, 1, k + 1), node(i, 1, k + 1)}});
        else
          cells.push_back({CellKind::brick8,
                           {node(i, j, k), node(i, j + 1, k), node(i + 1, j + 1, k),
                            node(i + 1, j, k), node(i, j, k + 1), node(i, j + 1, k + 1),
                            node(i + 1, j + 1, k + 1), node(i + 1, j, k + 1)}});
      }
  return make_mesh(positions, cells);
}

ZooMesh ring_of_sticks(int n, double height) {
  constexpr double kThick = 0.06;
  std::vector<Position> positions;
  std::vector<Cell> cells;
  const auto polygon = [n](int k) {
    const double angle = 2 * std::numbers::pi * k / n;
    return Position{std::cos(angle), std::sin(angle), 0};
  };
  for (int k = 0; k < n; ++k) {
    // past both corners of the polygon, low at the one and high at the other
    Position low = towards(polygon(k), polygon(k + 1), -0.3),
             high = towards(polygon(k), polygon(k + 1), 1.3);
    low[2] = -height / 2;
    high[2] = height / 2;
    const Position along = difference(high, low);
    const double length = std::hypot(along[0], along[1]);
    const Position across{-along[1] / length * kThick, along[0] / length * kThick, 0};
    const auto first = static_cast<NodeId>(positions.size());
    positions.push_back(towards(low, {low[0] + across[0], low[1] + across[1], low[2]}, 1));
    positions.push_back(towards(low, {low[0] + across[0], low[1] + across[1], low[2]}, -1));
    positions.push_back({high[0], high[1], high[2] - kThick * height});
    positions.push_back({high[0], high[1], high[2] + kThick * height});
    cells.push_back({CellKind::tetrahedron4, {first, first + 1, first + 2, first + 3}});
  }
  return make_mesh(positions, cells);
}

ZooMesh jittered_bricks(std::size_t n, double amplitude, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> push(-amplitude / static_cast<double>(n),
                                              amplitude / static_cast<double>(n));
  return moved(structured(n, Cut::bricks), [&](const Position& p) {
    Position q = p;
    for (double& x : q)
      if (x > 0 && x < 1) x += push(random);
    return q;
  });
}

}  // namespace hiac::test
