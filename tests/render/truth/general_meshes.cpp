#include "tests/render/truth/general_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>

#include "hiac/frame/renderable.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/scene/view_of.hpp"

namespace hiac::test {

Position sheared(const Position& p) {
  const auto& [x, y, z] = p;
  return {0.9 * x + 0.35 * y - 0.1 * z, -0.15 * x + 0.8 * y + 0.3 * z, 0.2 * x - 0.25 * y + z};
}

Position tapered(const Position& p) {
  const double w = 1 + 0.6 * p[2] - 0.25 * p[0] + 0.3 * p[1];
  const Position q = sheared(p);
  return {q[0] / w, q[1] / w, q[2] / w};
}

Position warped(const Position& p, double by) {
  Position q = p;
  for (const double x : p)
    if (x <= 0 || x >= 1) return p;
  for (std::size_t a = 0; a < 3; ++a) {
    const double wave = std::sin(127.1 * p[a] + 311.7 * p[(a + 1) % 3] + 74.7 * p[(a + 2) % 3]);
    const double random = 43758.5453 * wave;
    q[a] += by * (2 * (random - std::floor(random)) - 1);
  }
  return q;
}

Position bent(const Position& p) {
  double inner = 0.03;
  for (const double x : p) inner *= 4 * x * (1 - x);
  return {p[0] + inner * std::sin(7 * p[1] + 5 * p[2]),
          p[1] + inner * std::sin(6 * p[2] + 8 * p[0]),
          p[2] + inner * std::sin(9 * p[0] + 4 * p[1])};
}

Position rippled(const Position& p, double by) {
  return {p[0] + by * std::sin(5 * p[1] + 3 * p[2] + 1), p[1] + by * std::sin(4 * p[2] + 6 * p[0]),
          p[2] + by * std::sin(5 * p[0] + 4 * p[1] + 2)};
}

ZooMesh one_cell(CellKind kind, const std::vector<Position>& corners) {
  Cell cell{kind_of(shape_of(kind), CellOrder::linear), std::vector<NodeId>(corners.size())};
  std::iota(cell.nodes.begin(), cell.nodes.end(), NodeId{0});
  return of_order(make_mesh(corners, {cell}), order_of(kind));
}

ZooMesh two_wedges() {
  const std::vector<Position> positions{{0, 0, 0},    {1, 0, 0},   {0.5, 1, 0}, {0, 1, 0},
                                        {0, 0, 1},    {0.5, 0, 1}, {0, 1, 1},   {-1, 0, 0},
                                        {-0.5, 1, 0}, {-0.5, 0, 1}};
  return make_mesh(positions, {{CellKind::wedge7, {0, 1, 2, 3, 4, 5, 6}},
                               {CellKind::wedge7, {0, 7, 9, 4, 3, 8, 6}}});
}

ZooMesh wedge_grid(std::size_t n) {
  // halves of a cube's edges; of the other wedge it is the cube's point reflection
  constexpr std::array<std::array<int, 3>, 7> kCorners{
      {{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 2}, {0, 2, 2}}};
  // the wedge's own mirror image
  constexpr std::array<std::size_t, 7> kMirrored{0, 1, 5, 4, 3, 2, 6};
  std::map<std::array<int, 3>, NodeId> numbers;
  std::vector<Position> positions;
  std::vector<Cell> cells;
  const auto count = static_cast<int>(n);
  for (int z = 0; z < count; ++z)
    for (int y = 0; y < count; ++y)
      for (int x = 0; x < count; ++x)
        for (const bool other : {false, true}) {
          const std::array<bool, 3> flip{other, other != (y % 2 != 0), other != (z % 2 != 0)};
          const bool mirrored = (flip[0] != flip[1]) != flip[2];
          Cell cell{CellKind::wedge7, {}};
          for (std::size_t k = 0; k < 7; ++k) {
            const auto& corner = kCorners[mirrored ? kMirrored[k] : k];
            const std::array<int, 3> base{2 * x, 2 * y, 2 * z};
            std::array<int, 3> key;
            for (std::size_t c = 0; c < 3; ++c)
              key[c] = base[c] + (flip[c] ? 2 - corner[c] : corner[c]);
            const auto [at, is_new] =
                numbers.try_emplace(key, static_cast<NodeId>(positions.size()));
            if (is_new)
              positions.push_back({key[0] / (2.0 * double(n)), key[1] / (2.0 * double(n)),
                                   key[2] / (2.0 * double(n))});
            cell.nodes.push_back(at->second);
          }
          cells.push_back(cell);
        }
  return make_mesh(positions, cells);
}

ZooMesh mixed_columns(std::size_t n) {
  std::vector<Position> positions;
  const double h = 1.0 / static_cast<double>(n);
  for (std::size_t k = 0; k <= 3; ++k)
    for (std::size_t j = 0; j <= n; ++j)
      for (std::size_t i = 0; i <= n; ++i)
        positions.push_back({double(i) * h, double(j) * h, double(k) / 3});
  const auto node = [n](std::size_t i, std::size_t j, std::size_t k) {
    return static_cast<NodeId>((k * (n + 1) + j) * (n + 1) + i);
  };
  std::vector<Cell> cells;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::array<NodeId, 8> c{node(i, j, k),
                                      node(i + 1, j, k),
                                      node(i + 1, j + 1, k),
                                      node(i, j + 1, k),
                                      node(i, j, k + 1),
                                      node(i + 1, j, k + 1),
                                      node(i + 1, j + 1, k + 1),
                                      node(i, j + 1, k + 1)};
        if (k == 0) {
          cells.push_back({CellKind::prism6, {c[0], c[2], c[1], c[4], c[6], c[5]}});
          cells.push_back({CellKind::prism6, {c[0], c[3], c[2], c[4], c[7], c[6]}});
        } else if (k == 1) {
          const auto apex = static_cast<NodeId>(positions.size());
          positions.push_back({(double(i) + 0.5) * h, (double(j) + 0.5) * h, 0.5});
          cells.push_back({CellKind::tetrahedron4, {c[0], c[1], c[2], apex}});
          cells.push_back({CellKind::tetrahedron4, {c[0], c[2], c[3], apex}});
          for (const auto& base :
               {std::array{7, 6, 5, 4}, std::array{0, 4, 5, 1}, std::array{1, 5, 6, 2},
                std::array{2, 6, 7, 3}, std::array{3, 7, 4, 0}}) {
            Cell pyramid{CellKind::pyramid5, {}};
            for (const int b : base) pyramid.nodes.push_back(c[static_cast<std::size_t>(b)]);
            pyramid.nodes.push_back(apex);
            cells.push_back(pyramid);
          }
        } else {
          cells.push_back({CellKind::brick8, {c.begin(), c.end()}});
        }
      }
  return make_mesh(positions, cells);
}

ZooMesh of_order(const ZooMesh& mesh, CellOrder order) {
  std::vector<Position> positions = positions_of(mesh);
  std::map<std::vector<NodeId>, NodeId> added;
  // the node at a weighted mean of others: by them, each as often as it weighs
  const auto mean_of = [&](std::vector<NodeId> nodes) {
    std::ranges::sort(nodes);
    const auto [at, is_new] = added.try_emplace(nodes, static_cast<NodeId>(positions.size()));
    if (is_new) {
      Position p{};
      for (const NodeId node : nodes)
        for (std::size_t a = 0; a < 3; ++a)
          p[a] += positions[node][a] / static_cast<double>(nodes.size());
      positions.push_back(p);
    }
    return at->second;
  };
  std::vector<Cell> cells = cells_of(mesh);
  for (Cell& cell : cells) {
    const auto& topology = topology_of(cell.kind);
    cell.kind = kind_of(shape_of(cell.kind), order);
    const std::vector<NodeId> corners = cell.nodes;
    for (const auto& [a, b] : topology.edges) {
      if (order == CellOrder::quadratic) cell.nodes.push_back(mean_of({corners[a], corners[b]}));
      if (order != CellOrder::cubic) continue;
      cell.nodes.push_back(mean_of({corners[a], corners[a], corners[b]}));
      cell.nodes.push_back(mean_of({corners[a], corners[b], corners[b]}));
    }
    if (cell.kind != CellKind::tetrahedron20) continue;
    for (const ShapeFace& face : topology.faces)
      cell.nodes.push_back(
          mean_of({corners[face.corners[0]], corners[face.corners[1]], corners[face.corners[2]]}));
  }
  return make_mesh(positions, cells);
}

std::vector<CellKind> all_kinds() {
  std::vector<CellKind> kinds;
  for (std::size_t k = 0; k < kKindCount; ++k) kinds.push_back(static_cast<CellKind>(k));
  return kinds;
}

ZooMesh straight_mesh(CellKind kind, std::size_t per_edge) {
  const ZooMesh linear = [&] {
    switch (shape_of(kind)) {
      case CellShape::tetrahedron:
        return structured(per_edge, Cut::tetrahedra);
      case CellShape::pyramid:
        return structured(per_edge, Cut::pyramids);
      case CellShape::prism:
        return structured(per_edge, Cut::prisms);
      case CellShape::wedge:
        return two_wedges();
      case CellShape::brick:
        break;
    }
    return structured(per_edge, Cut::bricks);
  }();
  return hiac::order_of(kind) == CellOrder::linear ? linear
                                                   : of_order(linear, hiac::order_of(kind));
}

ZooMesh curved_mesh(CellKind kind) {
  const ZooMesh straight = straight_mesh(kind);
  for (double by = 0.06;; by *= 0.8) {
    ZooMesh mesh = moved(straight, [by](const Position& p) { return rippled(p, by); });
    if (invalid_cells(mesh, 1e-10).empty()) return mesh;
  }
}

ZooMesh arch(CellKind kind, double degrees, std::size_t per_edge) {
  return moved(straight_mesh(kind, per_edge), [&](const Position& p) -> Position {
    const double angle = (p[0] - 0.5) * degrees * std::numbers::pi / 180, radius = 0.5 + p[2];
    return {radius * std::sin(angle), p[1], radius * std::cos(angle)};
  });
}

void add_random_field(ZooMesh& mesh, const std::string& name, FieldLocation location,
                      std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const std::size_t count = location == FieldLocation::node   ? mesh.node_count()
                            : location == FieldLocation::cell ? mesh.cell_count()
                                                              : mesh.nodes.size();
  std::vector<double> values(count);
  for (double& value : values) value = unit(random);
  mesh.fields.push_back({name, "", location, 1, std::move(values)});
}

Scene cube_scene(Projection projection, std::uint32_t width, std::uint32_t height) {
  Scene scene;
  scene.image = {width, height};
  scene.camera.projection = projection;
  scene.camera.eye = {3.1, 2.3, 2.7};
  scene.camera.look_at = {0.45, 0.4, 0.4};
  scene.camera.up = {0.1, 0, 1};
  scene.camera.fov = 27;
  scene.camera.height = 1.75;
  scene.volume.color =
      ColorTransfer{"f", {{0.0, {0.1, 0.2, 0.9}}, {0.45, {0.2, 0.9, 0.3}}, {1, {0.9, 0.1, 0.1}}}};
  scene.volume.extinction = ExtinctionTransfer{"f", {{0.0, {0.2}}, {0.6, {4}}, {1, {1}}}};
  scene.render.tolerance = 1e-13;
  return scene;
}

void make_uniform(Scene& scene) {
  scene.volume.color->points = {{0, {0.9, 0.5, 0.2}}};
  scene.volume.extinction->points = {{0, {1.5}}};
}

VisibilityOrder sorted(const ZooMesh& mesh, const Scene& scene) {
  return exact_order(mesh, build_face_adjacency(mesh), view_of(scene.camera),
                     scene.render.planarity)
      .order;
}

RenderResult draw(const ZooMesh& mesh, const Scene& scene) {
  return render(mesh, sorted(mesh, scene), scene, false);
}

}  // namespace hiac::test
