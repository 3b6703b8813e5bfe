#include "hiac/render/edges/chosen_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "hiac/frame/surfaces/boundary_faces.hpp"
#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

// The normal of the plane through a face's corners: between two edges, or two diagonals.
Vector face_normal(const ZooMesh& mesh, std::span<const NodeId> nodes, const ShapeFace& face) {
  const auto at = [&](std::size_t k) { return mesh.position(nodes[face.corners[k]]); };
  const Vector normal = face.corner_count == 3 ? cross(minus(at(1), at(0)), minus(at(2), at(0)))
                                               : cross(minus(at(2), at(0)), minus(at(3), at(1)));
  return largest(normal) > 0 ? unit(normal) : normal;
}

std::size_t edge_between(CellKind kind, std::uint8_t a, std::uint8_t b) {
  const auto edges = topology_of(kind).edges;
  return static_cast<std::size_t>(
      std::ranges::find_if(edges,
                           [&](const ShapeEdge& e) {
                             return e == ShapeEdge{a, b} || e == ShapeEdge{b, a};
                           }) -
      edges.begin());
}

void add_sides(const ZooMesh& mesh, CellId cell, const ShapeFace& face,
               std::vector<EdgeSide>& sides) {
  const CellKind kind = mesh.kinds[cell];
  const auto nodes = mesh.cell_nodes(cell);
  const Vector normal = face_normal(mesh, nodes, face);
  for (std::size_t k = 0; k < face.corner_count; ++k) {
    const std::uint8_t a = face.corners[k], b = face.corners[(k + 1) % face.corner_count];
    sides.push_back(
        {edge_nodes(kind, nodes, edge_between(kind, a, b)), normal, nodes[a] < nodes[b]});
  }
}

std::vector<EdgeNodes> boundary_edges(const ZooMesh& mesh, const Edges& wanted,
                                      std::span<const std::uint8_t> boundary) {
  const std::vector<EdgeSide> sides = boundary_sides(mesh, boundary);
  const double cosine = cosine_of(wanted);
  std::vector<EdgeNodes> edges;
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && ends_of(sides[end].edge) == ends_of(sides[begin].edge)) ++end;
    const auto around = std::span(sides).subspan(begin, end - begin);
    if (wanted.show == EdgeChoice::boundary || is_feature(around, cosine))
      edges.push_back(sides[begin].edge);
  }
  return edges;
}

}  // namespace

std::pair<NodeId, NodeId> ends_of(const EdgeNodes& edge) {
  return {edge.nodes[0], edge.nodes[edge.count - 1]};
}

std::vector<EdgeSide> boundary_sides(const ZooMesh& mesh, std::span<const std::uint8_t> boundary) {
  std::vector<EdgeSide> sides;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto faces = topology_of(mesh.kinds[cell]).faces;
    for (std::size_t f = 0; f < faces.size(); ++f)
      if ((boundary[cell] >> f & 1U) != 0) add_sides(mesh, cell, faces[f], sides);
  }
  std::ranges::stable_sort(sides, {}, [](const EdgeSide& side) { return ends_of(side.edge); });
  return sides;
}

bool is_feature(std::span<const EdgeSide> sides, double cosine) {
  if (sides.size() != 2) return true;
  const double turned = sides[0].ascending == sides[1].ascending ? -1 : 1;
  return turned * dot(sides[0].normal, sides[1].normal) < cosine;
}

double cosine_of(const Edges& wanted) { return std::cos(wanted.angle * std::numbers::pi / 180); }

std::vector<EdgeNodes> all_edges(const ZooMesh& mesh) {
  std::vector<EdgeNodes> edges;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    for (std::size_t e = 0; e < edge_count(mesh.kinds[cell]); ++e)
      edges.push_back(edge_nodes(mesh.kinds[cell], mesh.cell_nodes(cell), e));
  std::ranges::stable_sort(edges, {}, ends_of);
  const auto repeated = std::ranges::unique(edges, {}, ends_of);
  edges.erase(repeated.begin(), repeated.end());
  return edges;
}

MeshEdges mesh_edges(const ZooMesh& mesh, const Edges& wanted) {
  MeshEdges found{boundary_faces(mesh), {}};
  found.edges = chosen_edges(mesh, wanted, found.boundary);
  return found;
}

std::vector<EdgeNodes> chosen_edges(const ZooMesh& mesh, const Edges& wanted,
                                    std::span<const std::uint8_t> boundary) {
  return wanted.show == EdgeChoice::all ? all_edges(mesh) : boundary_edges(mesh, wanted, boundary);
}

}  // namespace hiac
