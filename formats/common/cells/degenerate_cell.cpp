#include "formats/common/cells/degenerate_cell.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

namespace hiac::formats {
namespace {

constexpr std::string_view kKnife = "has two opposite corners of a face in one node (a 'knife')";
constexpr std::string_view kNoShape = "has repeated nodes that make no shape of the zoo";
constexpr std::string_view kMidNodes = "has repeated corners but mid-edge nodes that do not follow";

using Corners = std::array<std::uint8_t, 8>;
using Polygon = std::vector<unsigned>;

/// For every corner, the first corner with the same node.
Corners first_of(CellKind kind, std::span<const NodeId> nodes) {
  Corners first{};
  for (std::size_t i = 0; i < corner_count(kind); ++i) {
    std::size_t j = 0;
    while (nodes[j] != nodes[i]) ++j;
    first[i] = static_cast<std::uint8_t>(j);
  }
  return first;
}

/// A polygon that begins with its smallest corner.
Polygon turned(Polygon polygon) {
  std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
  return polygon;
}

/// A face after its nodes are merged: its distinct corners in cyclic order.
Polygon merged_face(const ShapeFace& face, const Corners& first) {
  Polygon polygon;
  for (std::size_t i = 0; i < face.corner_count; ++i) {
    const unsigned corner = first[face.corners[i]];
    if (polygon.empty() || polygon.back() != corner) polygon.push_back(corner);
  }
  while (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
  return polygon;
}

bool repeats(const Polygon& polygon) {
  Polygon sorted = polygon;
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

/// The shape's faces with its corners numbered by `numbering`, in a canonical order.
std::vector<Polygon> numbered_faces(const ShapeTopology& shape,
                                    const std::vector<std::uint8_t>& numbering) {
  std::vector<Polygon> faces;
  for (const ShapeFace& face : shape.faces) {
    Polygon polygon;
    for (std::size_t i = 0; i < face.corner_count; ++i)
      polygon.push_back(numbering[face.corners[i]]);
    faces.push_back(turned(std::move(polygon)));
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// The numbering of the shape's corners under which its faces are `faces`. Numberings are tried in
/// lexicographic order, so that a cell which already is in the shape's order keeps it.
std::optional<std::vector<std::uint8_t>> numbering_of(const ShapeTopology& shape,
                                                      std::vector<std::uint8_t> corners,
                                                      const std::vector<Polygon>& faces) {
  if (faces.size() != shape.faces.size()) return std::nullopt;
  do {
    if (numbered_faces(shape, corners) == faces) return corners;
  } while (std::next_permutation(corners.begin(), corners.end()));
  return std::nullopt;
}

TrueCell solve_corners(CellKind kind, const Corners& first) {
  std::vector<Polygon> faces;
  for (const ShapeFace& face : topology_of(kind).faces) {
    Polygon polygon = merged_face(face, first);
    if (repeats(polygon)) return {kKnife};
    if (polygon.size() > 2) faces.push_back(turned(std::move(polygon)));
  }
  std::sort(faces.begin(), faces.end());
  std::vector<std::uint8_t> corners(first.begin(),
                                    first.begin() + static_cast<long>(corner_count(kind)));
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  for (std::size_t s = 0; s < kShapeCount; ++s) {
    const auto shape = static_cast<CellShape>(s);
    if (topology_of(shape).corner_count != corners.size()) continue;
    const auto numbering = numbering_of(topology_of(shape), corners, faces);
    if (!numbering) return {kNoShape};
    TrueCell cell{{}, kind_of(shape, CellOrder::linear), {}, {}};
    std::copy(numbering->begin(), numbering->end(), cell.nodes.begin());
    return cell;
  }
  return {kNoShape};
}

/// Adds the mid-edge nodes of a quadratic cell to its true cell's corners.
TrueCell with_mid_nodes(CellKind kind, const TrueCell& corners, const Corners& first,
                        std::span<const NodeId> nodes) {
  const auto edges = topology_of(kind).edges;
  const std::size_t mid0 = corner_count(kind);
  TrueCell cell = corners;
  const auto replace = [&](std::size_t node, std::size_t by) {
    cell.replaced.emplace_back(static_cast<std::uint8_t>(node), static_cast<std::uint8_t>(by));
    cell.problem = kMidNodes;
  };
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (first[edges[e][0]] == first[edges[e][1]] && nodes[mid0 + e] != nodes[edges[e][0]])
      replace(mid0 + e, edges[e][0]);
  cell.kind = kind_of(shape_of(corners.kind), CellOrder::quadratic);
  std::size_t next = corner_count(corners.kind);
  for (const ShapeEdge& edge : topology_of(corners.kind).edges) {
    const std::array<std::uint8_t, 2> ends{corners.nodes[edge[0]], corners.nodes[edge[1]]};
    std::optional<std::size_t> mid;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const std::array<std::uint8_t, 2> found{first[edges[e][0]], first[edges[e][1]]};
      if (!std::is_permutation(found.begin(), found.end(), ends.begin())) continue;
      if (mid && nodes[*mid] != nodes[mid0 + e]) replace(mid0 + e, *mid);
      if (!mid) mid = mid0 + e;
    }
    if (!mid) return {kNoShape};
    cell.nodes[next++] = static_cast<std::uint8_t>(*mid);
  }
  return cell;
}

}  // namespace

bool TrueKinds::has_repeated_corner(CellKind kind, std::span<const NodeId> nodes) {
  const std::size_t corners = corner_count(kind);
  bool repeated = false;
  for (std::size_t i = 1; i < corners; ++i)
    for (std::size_t j = 0; j < i; ++j) repeated |= nodes[i] == nodes[j];
  return repeated;
}

TrueCell TrueKinds::find(CellKind kind, std::span<const NodeId> nodes) {
  if (order_of(kind) == CellOrder::cubic) return {kNoShape};
  const Corners first = first_of(kind, nodes);
  const CellKind linear = kind_of(shape_of(kind), CellOrder::linear);
  const auto [known, fresh] = known_.try_emplace(Pattern{linear, first});
  if (fresh) known->second = solve_corners(linear, first);
  const TrueCell& corners = known->second;
  if (!corners.problem.empty() || order_of(kind) == CellOrder::linear) return corners;
  return with_mid_nodes(kind, corners, first, nodes);
}

std::vector<std::vector<std::uint8_t>> merged_faces(CellKind kind, std::span<const NodeId> nodes) {
  const Corners first = first_of(kind, nodes);
  std::vector<std::vector<std::uint8_t>> faces;
  for (const ShapeFace& face : topology_of(kind).faces) {
    const Polygon polygon = merged_face(face, first);
    if (polygon.size() > 2 && !repeats(polygon)) faces.emplace_back(polygon.begin(), polygon.end());
  }
  return faces;
}

}  // namespace hiac::formats
