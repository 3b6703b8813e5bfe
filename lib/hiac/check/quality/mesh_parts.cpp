#include "hiac/check/quality/mesh_parts.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <vector>

#include "hiac/base/cancellation.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/base/parallel_sort.hpp"
#include "hiac/check/conformity.hpp"
#include "hiac/check/quality/disjoint_sets.hpp"
#include "hiac/check/quality/shell_volume.hpp"
#include "hiac/geometry/predicates.hpp"

namespace hiac {
namespace {

constexpr std::size_t kMeshPartsGrain = 1 << 13;

std::uint64_t count_components(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                               const FaceNumbering& numbering) {
  DisjointSets sets(mesh.cell_count());
  parallel_for(mesh.cell_count(), kMeshPartsGrain, [&](IndexRange range) {
    for (std::size_t cell = range.begin; cell < range.end; ++cell)
      for (std::uint32_t f = 0; f < numbering.count(cell); ++f) {
        const CellId other = adjacency.neighbors[numbering.first(cell) + f];
        if (other != kNoCell && other > cell) sets.join(static_cast<CellId>(cell), other);
      }
  });
  return number_sets(sets).count;
}

std::size_t distinct_corners(const FreeFace& face) {
  const auto nodes = std::span(face.nodes).first(face.corner_count);
  std::size_t count = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (std::ranges::find(nodes.first(k), nodes[k]) == nodes.first(k).end()) ++count;
  return count;
}

// One side of a boundary face: the edge from corner `corner` to the next.
struct Side {
  NodeId low, high;
  std::uint32_t face;
  std::uint8_t corner;
  bool upwards;  // it runs from the edge's lower node to its higher one

  bool operator<(const Side& other) const {
    return std::tie(low, high, face, corner) <
           std::tie(other.low, other.high, other.face, other.corner);
  }
};

std::vector<Side> sides_of(std::span<const FreeFace> faces) {
  std::vector<Side> sides;
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    for (std::uint8_t k = 0; k < faces[f].corner_count; ++k) {
      const NodeId a = faces[f].nodes[k], b = faces[f].nodes[(k + 1U) % faces[f].corner_count];
      if (a != b) sides.push_back({std::min(a, b), std::max(a, b), f, k, a < b});
    }
  parallel_sort(sides, std::less<>());
  return sides;
}

// The boundary faces around an edge, in the order in which a half plane that turns about the edge,
// counter-clockwise as seen against its direction from the lower node to the higher, meets them.
class Turning {
 public:
  Turning(const ZooMesh& mesh, std::span<const FreeFace> faces, std::span<const Side> sides)
      : mesh_(mesh),
        faces_(faces),
        low_(mesh.position(sides[0].low)),
        high_(mesh.position(sides[0].high)),
        start_(wing_of(sides[0])) {
    for (axis_ = 0; axis_ < 3; ++axis_)
      if ((start_side_ = in_plane_side(start_)) != 0) break;
  }

  // False if the first face has no angle at the edge.
  [[nodiscard]] bool is_defined() const { return start_side_ != 0; }

  [[nodiscard]] bool precedes(const Side& a, const Side& b) const {
    const Point3 p = wing_of(a), q = wing_of(b);
    const int part_of_p = part_of(p), part_of_q = part_of(q);
    if (part_of_p != part_of_q) return part_of_p < part_of_q;
    return orientation(low_, high_, p, q) > 0;
  }

  [[nodiscard]] bool same(const Side& a, const Side& b) const {
    return !precedes(a, b) && !precedes(b, a);
  }

 private:
  // The corner of the face next to the edge's lower node.
  [[nodiscard]] Point3 wing_of(const Side& side) const {
    const FreeFace& face = faces_[side.face];
    const std::size_t n = face.corner_count;
    return mesh_.position(face.nodes[(side.corner + (side.upwards ? n - 1 : 2)) % n]);
  }

  // On which side of the edge's line a point of the plane of edge and start lies.
  [[nodiscard]] int in_plane_side(Point3 q) const {
    std::array<double, 3> towards{};
    towards[axis_] = 1;
    return orientation_towards(low_, high_, q, towards);
  }

  // 0: at the start; 1: less than half a turn; 2: half a turn; 3: more.
  [[nodiscard]] int part_of(Point3 q) const {
    const int side = orientation(low_, high_, start_, q);
    if (side != 0) return side > 0 ? 1 : 3;
    return in_plane_side(q) == start_side_ ? 0 : 2;
  }

  const ZooMesh& mesh_;
  std::span<const FreeFace> faces_;
  Point3 low_, high_, start_;
  std::size_t axis_ = 0;
  int start_side_ = 0;
};

// The boundary as surfaces: which faces and which of their corners belong together.
class Boundary {
 public:
  Boundary(const ZooMesh& mesh, std::span<const FreeFace> faces, MeshParts& parts)
      : mesh_(mesh), faces_(faces), parts_(parts), corners_(4 * faces.size()) {
    join_repeated_nodes();
    auto sides = sides_of(faces);
    CancellationCheck cancelled;
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
      cancelled();
      end = begin + 1;
      while (end < sides.size() && sides[end].low == sides[begin].low &&
             sides[end].high == sides[begin].high)
        ++end;
      join_around(std::span(sides).subspan(begin, end - begin));
    }
    number();
  }

  [[nodiscard]] std::span<const std::uint32_t> shell_of_faces() const { return shell_of_; }

 private:
  // A side without length is no edge: its ends are one corner.
  void join_repeated_nodes() {
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      const FreeFace& face = faces_[f];
      for (std::uint32_t k = 0; k < face.corner_count; ++k) {
        const std::uint32_t next = (k + 1) % face.corner_count;
        if (face.nodes[k] == face.nodes[next]) corners_.join(4 * f + k, 4 * f + next);
      }
    }
  }

  // All sides at one edge.
  void join_around(std::span<Side> sides) {
    if (sides.size() == 2 && sides[0].upwards != sides[1].upwards) return join(sides[0], sides[1]);
    if (sides.size() > 2) ++parts_.branching_edges;
    if (!sort_around(sides)) {
      ++parts_.tangled_edges;
      for (const Side& side : sides) join(sides[0], side);
      return;
    }
    // the emptiness on a face's outer side begins behind a face that runs upwards
    const std::size_t first = sides[0].upwards ? 0 : 1;
    for (std::size_t i = first; i < sides.size(); i += 2)
      join(sides[i], sides[(i + 1) % sides.size()]);
  }

  // Sorts the sides around the edge; false if they do not alternate.
  bool sort_around(std::span<Side> sides) const {
    const Turning turning(mesh_, faces_, sides);
    if (sides.size() % 2 != 0 || !turning.is_defined()) return false;
    std::ranges::sort(sides, [&](const Side& a, const Side& b) { return turning.precedes(a, b); });
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const Side& next = sides[(i + 1) % sides.size()];
      if (sides[i].upwards == next.upwards || turning.same(sides[i], next)) return false;
    }
    return true;
  }

  // Joins the corners of two faces at both ends of an edge.
  void join(const Side& a, const Side& b) {
    corners_.join(corner_at(a, a.low), corner_at(b, b.low));
    corners_.join(corner_at(a, a.high), corner_at(b, b.high));
    ++joins_;
  }

  [[nodiscard]] std::uint32_t corner_at(const Side& side, NodeId node) const {
    const FreeFace& face = faces_[side.face];
    const bool first = face.nodes[side.corner] == node;
    return 4 * side.face + (first ? side.corner : (side.corner + 1U) % face.corner_count);
  }

  void number() {
    const std::uint64_t vertices = count_vertices();
    DisjointSets shells(faces_.size());
    // faces whose corners are joined, and so the corners of one face
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
      for (std::uint32_t k = 0; k < faces_[f].corner_count; ++k)
        shells.join(f, corners_.root(4 * f + k) / 4);
    SetNumbers numbers = number_sets(shells);
    parts_.shells = numbers.count;
    shell_of_ = std::move(numbers.of);
    if (parts_.tangled_edges > 0) return;
    // each join is an edge of the surface
    const auto euler = static_cast<std::int64_t>(vertices + faces_.size()) - joins_;
    parts_.tunnels = static_cast<std::int64_t>(parts_.shells) - euler / 2;
  }

  std::uint64_t count_vertices() {
    std::uint64_t count = 0;
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
      for (std::uint32_t k = 0; k < faces_[f].corner_count; ++k)
        if (corners_.root(4 * f + k) == 4 * f + k) ++count;
    return count;
  }

  const ZooMesh& mesh_;
  std::span<const FreeFace> faces_;
  MeshParts& parts_;
  DisjointSets corners_;  // number 4 f + k: corner k of face f
  std::int64_t joins_ = 0;
  std::vector<std::uint32_t> shell_of_;
};

}  // namespace

MeshParts mesh_parts(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                     const CellShapes& shapes) {
  MeshParts parts;
  const FaceNumbering numbering(mesh);
  parts.components = count_components(mesh, adjacency, numbering);
  std::vector<FreeFace> faces = free_faces(mesh, adjacency, numbering, shapes);
  // collapsed to an edge: the faces beside it meet there
  std::erase_if(faces, [](const FreeFace& face) { return distinct_corners(face) < 3; });
  parts.boundary_faces = faces.size();
  const Boundary boundary(mesh, faces, parts);
  const std::vector<int> signs =
      shell_volume_signs(mesh, faces, boundary.shell_of_faces(), parts.shells);
  parts.cavities = static_cast<std::uint64_t>(std::ranges::count(signs, -1));
  return parts;
}

}  // namespace hiac
