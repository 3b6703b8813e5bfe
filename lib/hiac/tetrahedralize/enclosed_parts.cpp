#include "hiac/tetrahedralize/enclosed_parts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string_view>

#include "hiac/geometry/predicates.hpp"
#include "hiac/mesh/face_adjacency.hpp"

namespace hiac {
namespace {

using Position = std::array<double, 3>;

std::span<const double> regions_of(const ZooMesh& mesh) {
  const auto field = std::ranges::find_if(mesh.fields, [](const Field& f) {
    return f.name == kRegionField && f.location == FieldLocation::cell;
  });
  return field->values.view();
}

Position minus(std::span<const double, 3> a, std::span<const double, 3> b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Position cross(const Position& a, const Position& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Position& a, const Position& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// A cell's volume, and the radius of the sphere inside it: 3 volumes over its surface.
struct CellSize {
  double volume, inner_radius;
};

CellSize size_of(const ZooMesh& mesh, CellId cell) {
  const auto nodes = mesh.cell_nodes(cell);
  const auto edge = [&](std::size_t k, std::size_t from) {
    return minus(mesh.position(nodes[k]), mesh.position(nodes[from]));
  };
  const Position a = edge(1, 0), b = edge(2, 0), c = edge(3, 0);
  const double volume = std::abs(dot(a, cross(b, c))) / 6;
  double area = 0;
  for (const Position& normal :
       {cross(a, b), cross(b, c), cross(c, a), cross(edge(2, 1), edge(3, 1))})
    area += std::sqrt(dot(normal, normal)) / 2;
  return {volume, area > 0 ? 3 * volume / area : 0};
}

Position middle_of(const ZooMesh& mesh, CellId cell) {
  Position middle{};
  for (const NodeId node : mesh.cell_nodes(cell))
    for (std::size_t c = 0; c < 3; ++c) middle[c] += mesh.position(node)[c] / 4;
  return middle;
}

// Whether the point is in the cell or on its surface; a bit for every face that it is on.
std::optional<unsigned> faces_at(const ZooMesh& mesh, CellId cell, const Position& point) {
  const auto nodes = mesh.cell_nodes(cell);
  for (std::size_t c = 0; c < 3; ++c) {
    bool above = true, below = true;
    for (const NodeId node : nodes) {
      above &= mesh.position(node)[c] > point[c];
      below &= mesh.position(node)[c] < point[c];
    }
    if (above || below) return std::nullopt;
  }
  const auto at = [&](std::size_t k) { return mesh.position(nodes[k]); };
  const int turn = orientation(at(0), at(1), at(2), at(3));
  unsigned faces = 0;
  const auto table = topology_of(CellShape::tetrahedron).faces;
  for (std::size_t f = 0; f < table.size(); ++f) {
    const auto& corners = table[f].corners;
    // faces turn counter-clockwise as seen from outside, the cell's own corners as seen from inside
    const int side = turn * orientation(at(corners[0]), at(corners[1]), at(corners[2]), point);
    if (side > 0) return std::nullopt;
    if (side == 0) faces |= 1U << f;
  }
  return faces;
}

// The rank of every node that is at a point of the surface, among these points by x, y, z.
std::vector<std::optional<NodeId>> ranks_of_nodes(const ZooMesh& mesh,
                                                  std::span<const Position> surface_points) {
  std::vector<Position> points(surface_points.begin(), surface_points.end());
  std::ranges::sort(points);
  std::vector<std::optional<NodeId>> ranks(mesh.node_count());
  for (NodeId node = 0; node < ranks.size(); ++node) {
    const auto at = mesh.position(node);
    const auto found = std::ranges::lower_bound(points, Position{at[0], at[1], at[2]});
    if (found != points.end() && std::ranges::equal(*found, at))
      ranks[node] = static_cast<NodeId>(found - points.begin());
  }
  return ranks;
}

}  // namespace

void number_parts(const ZooMesh& mesh, std::span<const Position> surface_points,
                  std::vector<double>& parts) {
  const std::vector<std::optional<NodeId>> ranks = ranks_of_nodes(mesh, surface_points);
  std::map<double, std::vector<NodeId>> points;     // of every part, their ranks
  std::vector<double> last(mesh.node_count(), -1);  // the part that met the node last: few meet one
  double previous = -1;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    if (parts[cell] != previous) points[previous = parts[cell]];  // even without a surface point
    for (const NodeId node : mesh.cell_nodes(cell)) {
      if (!ranks[node] || last[node] == parts[cell]) continue;
      last[node] = parts[cell];
      points[parts[cell]].push_back(*ranks[node]);
    }
  }
  std::vector<std::pair<std::vector<NodeId>, double>> order;
  for (auto& [part, touched] : points) {
    std::ranges::sort(touched);
    touched.erase(std::ranges::unique(touched).begin(), touched.end());
    order.emplace_back(std::move(touched), part);
  }
  std::ranges::sort(order);
  std::map<double, double> numbers;
  for (const auto& [touched, part] : order)
    numbers.emplace(part, static_cast<double>(numbers.size() + 1));
  for (double& part : parts) part = numbers.at(part);
}

std::vector<EnclosedPart> enclosed_parts(const ZooMesh& mesh) {
  const std::span<const double> regions = regions_of(mesh);
  const double most = regions.empty() ? 0 : *std::ranges::max_element(regions);
  std::vector<EnclosedPart> parts(static_cast<std::size_t>(most));
  std::vector<double> largest(parts.size(), -1);
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto part = static_cast<std::size_t>(regions[cell]) - 1;
    const auto [volume, inner_radius] = size_of(mesh, cell);
    parts[part].volume += volume;
    if (inner_radius <= largest[part]) continue;
    largest[part] = inner_radius;
    parts[part].point = middle_of(mesh, cell);
  }
  return parts;
}

std::vector<std::uint32_t> parts_at(const ZooMesh& mesh, const Position& point) {
  const std::span<const double> regions = regions_of(mesh);
  std::vector<std::uint32_t> found;
  std::vector<std::pair<CellId, unsigned>> on_faces;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto faces = faces_at(mesh, cell, point);
    if (!faces) continue;
    found.push_back(static_cast<std::uint32_t>(regions[cell]));
    if (*faces != 0) on_faces.emplace_back(cell, *faces);
  }
  if (!on_faces.empty()) {
    const FaceAdjacency adjacency = build_face_adjacency(mesh);
    for (const auto& [cell, faces] : on_faces)
      for (std::size_t f = 0; f < 4; ++f)
        if ((faces >> f & 1U) != 0 && adjacency.neighbors[4 * std::size_t{cell} + f] == kNoCell)
          found.push_back(0);
  }
  std::ranges::sort(found);
  found.erase(std::ranges::unique(found).begin(), found.end());
  return found;
}

}  // namespace hiac
