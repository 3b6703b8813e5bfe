#include "formats/mfem/dof_map.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <span>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/cell_kind.hpp"

namespace hiac::formats::mfem {
namespace {

constexpr int kHighestOrder = 8;

using Edge = std::array<std::uint8_t, 2>;
/// Corners of a face; a triangle repeats its last one.
using Corners = std::array<std::uint8_t, 4>;
using Place = std::array<int, 3>;

// The edges and faces of MFEM's geometries, in MFEM's order
constexpr std::array<Edge, 6> kTetrahedron{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
constexpr std::array<Edge, 12> kCube{{{0, 1},
                                      {1, 2},
                                      {3, 2},
                                      {0, 3},
                                      {4, 5},
                                      {5, 6},
                                      {7, 6},
                                      {4, 7},
                                      {0, 4},
                                      {1, 5},
                                      {2, 6},
                                      {3, 7}}};
constexpr std::array<Edge, 9> kPrism{
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
constexpr std::array<Edge, 8> kPyramid{
    {{0, 1}, {1, 2}, {3, 2}, {0, 3}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}};
constexpr std::array<Corners, 4> kTetrahedronFaces{
    {{1, 2, 3, 3}, {0, 3, 2, 2}, {0, 1, 3, 3}, {0, 2, 1, 1}}};
constexpr std::array<Corners, 6> kCubeFaces{
    {{3, 2, 1, 0}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}}};
constexpr std::array<Corners, 5> kPrismFaces{
    {{0, 2, 1, 1}, {3, 4, 5, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
constexpr std::array<Corners, 5> kPyramidFaces{
    {{3, 2, 1, 0}, {0, 1, 4, 4}, {1, 2, 4, 4}, {2, 3, 4, 4}, {3, 0, 4, 4}}};
/// For the zoo's face f, the number of the face in MFEM.
constexpr std::array<std::size_t, 4> kZooFaces{2, 0, 1, 3};

// The positions of the corners, in units of the order
constexpr std::array<Place, 4> kTetrahedronCorners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr std::array<Place, 8> kCubeCorners{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
constexpr std::array<Place, 6> kPrismCorners{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
constexpr std::array<Place, 5> kPyramidCorners{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}};

struct Shape {
  std::span<const Place> corners;
  std::span<const Edge> edges;
  std::span<const Corners> faces;
};

Shape shape_of_geometry(Geometry geometry) {
  switch (geometry) {
    case Geometry::tetrahedron:
      return {kTetrahedronCorners, kTetrahedron, kTetrahedronFaces};
    case Geometry::cube:
      return {kCubeCorners, kCube, kCubeFaces};
    case Geometry::prism:
      return {kPrismCorners, kPrism, kPrismFaces};
    case Geometry::pyramid:
      return {kPyramidCorners, kPyramid, kPyramidFaces};
    default:
      return {};
  }
}

bool is_triangle(const Corners& face) { return face[2] == face[3]; }

/// order corner + s (a - corner) + t (b - corner).
Place at(const Place& corner, const Place& a, int s, const Place& b, int t, int order) {
  Place place{};
  for (std::size_t c = 0; c < 3; ++c)
    place[c] = order * corner[c] + s * (a[c] - corner[c]) + t * (b[c] - corner[c]);
  return place;
}

using Part = LatticePoint::Part;

void add_edge(const Shape& shape, std::size_t edge, bool forward, int order,
              std::vector<LatticePoint>& points) {
  const auto [a, b] = shape.edges[edge];
  const Place& from = shape.corners[forward ? a : b];
  const Place& to = shape.corners[forward ? b : a];
  for (int t = 1; t < order; ++t)
    points.push_back({at(from, to, t, from, 0, order), Part::edge, edge});
}

void add_face(const Shape& shape, std::size_t number, int order,
              std::vector<LatticePoint>& points) {
  const Corners& face = shape.faces[number];
  const Place& corner = shape.corners[face[0]];
  const bool triangle = is_triangle(face);
  const Place& a = shape.corners[face[1]];
  const Place& b = shape.corners[triangle ? face[2] : face[3]];
  for (int t = 1; t < order; ++t)
    for (int s = 1; s < (triangle ? order - t : order); ++s)
      points.push_back({at(corner, a, s, b, t, order), Part::face, number});
}

/// Adds the interior points in MFEM's order: i fastest.
void add_inside(Geometry geometry, const Space& space, std::vector<LatticePoint>& points) {
  const int order = space.order;
  const bool narrowing = geometry == Geometry::pyramid && space.narrowing;
  std::size_t number = 0;
  for (int k = 1; k < order; ++k)
    for (int j = 1; j < order; ++j)
      for (int i = 1; i < order; ++i) {
        if (geometry == Geometry::tetrahedron && i + j + k >= order) continue;
        if (geometry == Geometry::prism && i + j >= order) continue;
        if (geometry == Geometry::pyramid && !narrowing && std::max(i, j) + k >= order) continue;
        points.push_back({{i, j, k}, Part::inside, number++, narrowing});
      }
}

}  // namespace

std::vector<LatticePoint> lattice_points(Geometry geometry, const Space& space) {
  const int order = space.order;
  const Shape shape = shape_of_geometry(geometry);
  std::vector<LatticePoint> points;
  for (std::size_t v = 0; v < shape.corners.size(); ++v)
    points.push_back({at(shape.corners[v], {}, 0, {}, 0, order), Part::corner, v});
  if (geometry == Geometry::tetrahedron) {
    for (const ShapeEdge& edge : topology_of(CellShape::tetrahedron).edges) {
      std::size_t local = 0;
      while (kTetrahedron[local] != Edge{std::min(edge[0], edge[1]), std::max(edge[0], edge[1])})
        ++local;
      add_edge(shape, local, edge[0] < edge[1], order, points);
    }
    for (const std::size_t face : kZooFaces) add_face(shape, face, order, points);
  } else {
    for (std::size_t e = 0; e < shape.edges.size(); ++e) add_edge(shape, e, true, order, points);
    for (std::size_t f = 0; f < shape.faces.size(); ++f) add_face(shape, f, order, points);
  }
  add_inside(geometry, space, points);
  return points;
}

std::array<double, 3> position_of(const LatticePoint& point, int order) {
  std::array<double, 3> position{};
  for (std::size_t c = 0; c < 3; ++c) position[c] = static_cast<double>(point.place[c]) / order;
  if (point.narrowing)
    for (const std::size_t c : {0, 1}) position[c] *= 1 - position[2];
  return position;
}

bool can_be_of(Geometry geometry, const Space& space) {
  const int order = space.order;
  switch (geometry) {
    case Geometry::cube:
      return order <= kHighestOrder;
    case Geometry::tetrahedron:
    case Geometry::prism:
      return order <= 3;
    case Geometry::pyramid:
      return order <= (space.bernstein ? 1 : 2);
    default:
      return order == 1;
  }
}

std::optional<Space> space_named(const std::string& collection) {
  if (collection == "Linear") return Space{1, false};
  if (collection == "Quadratic") return Space{2, false};
  if (collection == "Cubic") return Space{3, false};
  // MFEM writes no letter for Gauss-Lobatto points, its default; U stands for evenly spaced ones
  constexpr auto kFamilies =
      std::to_array<std::string_view>({"H1_3D_P", "H1@G_3D_P", "H1@U_3D_P", "H1Pos_3D_P"});
  for (std::size_t family = 0; family < kFamilies.size(); ++family) {
    if (!collection.starts_with(kFamilies[family])) continue;
    const int order = std::atoi(collection.c_str() + kFamilies[family].size());
    if (order < 1 || order > kHighestOrder) return std::nullopt;
    return Space{order, order >= 3 && family < 2, false, family == 3};
  }
  return std::nullopt;
}

bool is_piecewise_constant(const std::string& collection) {
  return collection.starts_with("L2_") && collection.ends_with("_P0");
}

DofMap::DofMap(const MeshFile& mesh, const Space& space)
    : mesh_(mesh), order_(space.order), first_edge_(mesh.vertex_count) {
  const auto along = static_cast<std::size_t>(order_ - 1);
  std::map<std::array<std::int64_t, 2>, std::size_t> edges;
  std::map<std::array<std::int64_t, 4>, std::size_t> faces;
  for (const Element& element : mesh.elements) {
    const Shape shape = shape_of_geometry(element.geometry);
    edges_.emplace_back();
    for (std::size_t e = 0; e < shape.edges.size(); ++e) {
      std::array<std::int64_t, 2> key{element.vertices[shape.edges[e][0]],
                                      element.vertices[shape.edges[e][1]]};
      std::sort(key.begin(), key.end());
      edges_.back()[e] = edges.try_emplace(key, edges.size()).first->second;
    }
    faces_.emplace_back();
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
      const Corners& face = shape.faces[f];
      Face found{};
      for (std::size_t v = 0; v < face.size(); ++v) found.vertices[v] = element.vertices[face[v]];
      // as many as a triangle or a quadrilateral of the order has in its interior
      found.first = is_triangle(face) ? along * (along > 0 ? along - 1 : 0) / 2 : along * along;
      std::array<std::int64_t, 4> key = found.vertices;
      if (is_triangle(face)) key[3] = -1;
      std::sort(key.begin(), key.end());
      const auto [place, added] = faces.try_emplace(key, all_faces_.size());
      if (added) all_faces_.push_back(found);
      faces_.back()[f] = place->second;
    }
  }
  size_ = first_edge_ + along * edges.size();
  for (Face& face : all_faces_) {
    const std::size_t dofs = face.first;
    face.first = size_;
    size_ += dofs;
  }
  for (const Element& element : mesh.elements) {
    std::vector<LatticePoint>& points = points_[static_cast<std::size_t>(element.geometry)];
    if (points.empty()) points = lattice_points(element.geometry, space);
    inside_.push_back(size_);
    size_ += static_cast<std::size_t>(
        std::count_if(points.begin(), points.end(),
                      [](const LatticePoint& point) { return point.part == Part::inside; }));
  }
}

std::size_t DofMap::on_edge(const Element& element, std::size_t edge, const LatticePoint& point,
                            const std::array<std::size_t, 12>& edges) const {
  const Shape shape = shape_of_geometry(element.geometry);
  // an edge is directed from its vertex with the lower number to the other
  auto [a, b] = shape.edges[edge];
  if (element.vertices[a] > element.vertices[b]) std::swap(a, b);
  int t = 1;
  while (t < order_ &&
         at(shape.corners[a], shape.corners[b], t, shape.corners[a], 0, order_) != point.place)
    ++t;
  return first_edge_ + static_cast<std::size_t>(order_ - 1) * edges[edge] +
         static_cast<std::size_t>(t - 1);
}

/// The points in the interior of a face are numbered from its first vertex towards its second, row
/// by row towards its last.
std::size_t DofMap::on_face(std::size_t element, const LatticePoint& point) const {
  const Element& cell = mesh_.elements[element];
  const Face& face = all_faces_[faces_[element][point.number]];
  const Shape shape = shape_of_geometry(cell.geometry);
  const auto corner = [&](std::size_t v) -> const Place& {
    const auto count = static_cast<std::ptrdiff_t>(shape.corners.size());
    const auto found =
        std::find(cell.vertices.begin(), cell.vertices.begin() + count, face.vertices[v]);
    return shape
        .corners[static_cast<std::size_t>(found - cell.vertices.begin()) % shape.corners.size()];
  };
  const bool triangle = face.vertices[2] == face.vertices[3];
  std::size_t number = 0;
  for (int t = 1; t < order_; ++t)
    for (int s = 1; s < (triangle ? order_ - t : order_); ++s, ++number)
      if (at(corner(0), corner(1), s, corner(triangle ? 2 : 3), t, order_) == point.place)
        return face.first + number;
  throw InputError(mesh_.path, fmt::format("element {} has one vertex twice", element));
}

std::vector<std::size_t> DofMap::of(std::size_t element) const {
  const Element& cell = mesh_.elements[element];
  std::vector<std::size_t> dofs;
  for (const LatticePoint& point : points_[static_cast<std::size_t>(cell.geometry)]) {
    switch (point.part) {
      case Part::corner:
        dofs.push_back(static_cast<std::size_t>(cell.vertices[point.number]));
        break;
      case Part::edge:
        dofs.push_back(on_edge(cell, point.number, point, edges_[element]));
        break;
      case Part::face:
        dofs.push_back(on_face(element, point));
        break;
      case Part::inside:
        dofs.push_back(inside_[element] + point.number);
        break;
    }
  }
  return dofs;
}

}  // namespace hiac::formats::mfem
