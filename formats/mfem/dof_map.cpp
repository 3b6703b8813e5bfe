#include "formats/mfem/dof_map.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <span>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/cell_kind.hpp"

namespace hiac::formats::mfem {
namespace {

using Edge = std::array<std::uint8_t, 2>;
using Face = std::array<std::uint8_t, 3>;

// The edges and faces of MFEM's geometries, in its order
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
constexpr std::array<Face, 4> kTetrahedronFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
/// The place of the zoo's face f among MFEM's.
constexpr std::array<std::size_t, 4> kZooFaces{2, 0, 1, 3};

std::span<const Edge> edges_of(Geometry geometry) {
  switch (geometry) {
    case Geometry::tetrahedron:
      return kTetrahedron;
    case Geometry::cube:
      return kCube;
    case Geometry::prism:
      return kPrism;
    case Geometry::pyramid:
      return kPyramid;
    default:
      return {};
  }
}

}  // namespace

Space space_named(const std::string& collection, const std::string& subject) {
  if (collection == "Linear") return {1, false};
  if (collection == "Quadratic") return {2, false};
  if (collection == "Cubic") return {3, false};
  const std::size_t order_at = collection.rfind("_P");
  if (collection.starts_with("H1_3D_P") && order_at != std::string::npos) {
    const int order = std::atoi(collection.c_str() + order_at + 2);
    if (order >= 1 && order <= 3) return {order, order == 3};
  }
  throw InputError(subject, fmt::format("the space '{}' cannot be held (H1_3D_P1 to H1_3D_P3, "
                                        "Linear, Quadratic or Cubic expected)",
                                        collection));
}

bool is_piecewise_constant(const std::string& collection) {
  return collection.starts_with("L2_") && collection.ends_with("_P0");
}

DofMap::DofMap(const MeshFile& mesh, const Space& space)
    : mesh_(mesh), space_(space), size_(mesh.vertex_count), first_edge_(mesh.vertex_count) {
  std::map<std::array<std::int64_t, 2>, std::size_t> edges;
  std::map<std::array<std::int64_t, 3>, std::size_t> faces;
  for (const Element& element : mesh.elements) {
    const bool tetrahedron = element.geometry == Geometry::tetrahedron;
    for (const Edge& edge : edges_of(element.geometry)) {
      std::array<std::int64_t, 2> key{element.vertices[edge[0]], element.vertices[edge[1]]};
      std::sort(key.begin(), key.end());
      const std::size_t number = edges.try_emplace(key, edges.size()).first->second;
      if (tetrahedron) edges_.push_back(number);
    }
    if (!tetrahedron) edges_.resize(edges_.size() + kTetrahedron.size());
    for (const Face& face : kTetrahedronFaces) {
      std::array<std::int64_t, 3> key{element.vertices[face[0]], element.vertices[face[1]],
                                      element.vertices[face[2]]};
      std::sort(key.begin(), key.end());
      faces_.push_back(tetrahedron ? faces.try_emplace(key, faces.size()).first->second : 0);
    }
  }
  const auto inside = static_cast<std::size_t>(space.order - 1);
  first_face_ = first_edge_ + inside * edges.size();
  size_ = first_face_ + (space.order == 3 ? faces.size() : 0);
}

std::vector<std::size_t> DofMap::of(std::size_t element) const {
  const Element& cell = mesh_.elements[element];
  std::vector<std::size_t> dofs;
  for (std::size_t v = 0; v < 4; ++v) dofs.push_back(static_cast<std::size_t>(cell.vertices[v]));
  if (space_.order == 1) return dofs;
  const auto inside = static_cast<std::size_t>(space_.order - 1);
  for (const ShapeEdge& edge : topology_of(CellShape::tetrahedron).edges) {
    std::size_t local = 0;
    while (kTetrahedron[local] != Edge{std::min(edge[0], edge[1]), std::max(edge[0], edge[1])})
      ++local;
    const std::size_t first = first_edge_ + inside * edges_[6 * element + local];
    // an edge goes from its vertex of the lower number to the other
    const bool along = cell.vertices[edge[0]] < cell.vertices[edge[1]];
    for (std::size_t k = 0; k < inside; ++k) dofs.push_back(first + (along ? k : inside - 1 - k));
  }
  if (space_.order == 3)
    for (const std::size_t face : kZooFaces)
      dofs.push_back(first_face_ + faces_[4 * element + face]);
  return dofs;
}

}  // namespace hiac::formats::mfem
