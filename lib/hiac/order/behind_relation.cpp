#include "hiac/order/behind_relation.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/geometry/predicates.hpp"
#include "hiac/order/cell_side.hpp"

namespace hiac {
namespace {

constexpr std::size_t kGrain = 1 << 14;

using Corners = std::array<Point3, 4>;

int side_of_view(Point3 a, Point3 b, Point3 c, const View& view) {
  if (view.perspective) return orientation(a, b, c, Point3(view.eye));
  // rays run along `direction`: the eye is infinitely far against it
  return -orientation_towards(a, b, c, Point3(view.direction));
}

std::uint8_t arrows_of_sides(int eye_side, int cell_side) {
  if (eye_side == 0 || cell_side == 0) return kNoArrow;
  return eye_side == cell_side ? kCellFirst : kNeighborFirst;
}

// The four-sign rule for a bilinear patch: the sign of (P - e).(P_u x P_v) is bilinear in u, v and
// so is bounded by its signs at the corners, each the orientation of one corner's triangle. With
// signs of both kinds rays cross both ways, unless the patch is planar for this purpose and seen
// edge-on to within the rounding of its coordinates.
bool crossed_both_ways(const Corners& p, const View& view, double planarity) {
  bool positive = false, negative = false;
  for (std::size_t k = 0; k < 4; ++k) {
    const int side = side_of_view(p[(k + 3) % 4], p[k], p[(k + 1) % 4], view);
    positive = positive || side > 0;
    negative = negative || side < 0;
  }
  return positive && negative && quadrilateral_deviation(p[0], p[1], p[2], p[3]) > planarity;
}

std::uint8_t face_arrows(const ZooMesh& mesh, CellId cell, const ShapeFace& face, const View& view,
                         double planarity) {
  const auto nodes = mesh.cell_nodes(cell);
  const auto at = plane_corners(mesh, cell, face);
  const auto corner = [&](std::size_t k) { return mesh.position(nodes[at[k]]); };
  const Corners p{corner(0), corner(1), corner(2), corner(3)};
  if (face.corner_count == 4 && crossed_both_ways(p, view, planarity)) return kBothWays;
  return arrows_of_sides(side_of_view(p[0], p[1], p[2], view), side_of_cell(mesh, cell, face));
}

// A tetrahedron needs one orientation for itself, and one a face for the eye.
void tetrahedron_arrows(const ZooMesh& mesh, CellId cell, std::span<const CellId> neighbors,
                        const View& view, std::span<std::uint8_t> arrows) {
  const auto nodes = mesh.cell_nodes(cell);
  const auto faces = topology_of(CellShape::tetrahedron).faces;
  const int volume = orientation(mesh.position(nodes[0]), mesh.position(nodes[1]),
                                 mesh.position(nodes[2]), mesh.position(nodes[3]));
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (neighbors[f] == kNoCell || volume == 0) continue;
    const auto& c = faces[f].corners;
    const int eye = side_of_view(mesh.position(nodes[c[0]]), mesh.position(nodes[c[1]]),
                                 mesh.position(nodes[c[2]]), view);
    arrows[f] = arrows_of_sides(eye, -volume);  // faces run counter-clockwise seen from outside
  }
}

unsigned mirrored(unsigned arrows) { return ((arrows & 1U) << 1) | (arrows >> 1); }

bool has_volume(const ZooMesh& mesh, CellId cell) {
  return std::ranges::any_of(topology_of(mesh.kinds[cell]).faces, [&](const ShapeFace& face) {
    return side_of_cell(mesh, cell, face) != 0;
  });
}

// Whether a face that two cells share is seen other than edge-on. One without area is not.
bool common_face_is_seen(const ZooMesh& mesh, CellId cell, CellId other,
                         std::span<const CellId> neighbors, const View& view) {
  const auto nodes = mesh.cell_nodes(cell);
  const auto faces = topology_of(mesh.kinds[cell]).faces;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (neighbors[f] != other) continue;
    const auto at = plane_corners(mesh, cell, faces[f]);
    if (side_of_view(mesh.position(nodes[at[0]]), mesh.position(nodes[at[1]]),
                     mesh.position(nodes[at[2]]), view) != 0)
      return true;
  }
  return false;
}

// What a cell says of all the faces that it shares with another one, and how many those are.
struct Said {
  unsigned arrows = kNoArrow, faces = 0;
};

Said said_of(CellId cell, CellId other, const FaceAdjacency& adjacency,
             const std::vector<std::uint64_t>& offset, const std::vector<std::uint8_t>& said) {
  Said all;
  for (std::uint64_t face = offset[cell]; face < offset[cell + 1]; ++face) {
    if (adjacency.neighbors[face] != other) continue;
    all.arrows |= said[face];
    ++all.faces;
  }
  return all;
}

// Joins what the two sides of every shared face say.
std::uint64_t join_sides(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                         const std::vector<std::uint64_t>& offset,
                         const std::vector<std::uint8_t>& said, const View& view,
                         std::vector<std::uint8_t>& joined) {
  std::atomic<std::uint64_t> both_ways{0};
  parallel_for(mesh.cell_count(), kGrain, [&](IndexRange range) {
    std::uint64_t both = 0;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto cell = static_cast<CellId>(i);
      for (std::uint64_t face = offset[cell]; face < offset[cell + 1]; ++face) {
        const CellId other = adjacency.neighbors[face];
        if (other == kNoCell) continue;
        const Said here = said_of(cell, other, adjacency, offset, said);
        const Said there = said_of(other, cell, adjacency, offset, said);
        if (here.faces != there.faces || other == cell)
          throw InputError("face adjacency",
                           fmt::format("cells {} and {} are not neighbours of one another ({} "
                                       "common faces expected, {} found)",
                                       cell, other, here.faces, there.faces));
        unsigned arrows = here.arrows | mirrored(there.arrows);
        if (arrows == kNoArrow && !has_volume(mesh, cell) && !has_volume(mesh, other) &&
            common_face_is_seen(mesh, cell, other, adjacency.neighbors.view().subspan(offset[cell]),
                                view))
          arrows = kBothWays;
        joined[face] = static_cast<std::uint8_t>(arrows);
        if (arrows == kBothWays && other > cell) ++both;
      }
    }
    both_ways += both;
  });
  return both_ways;
}

}  // namespace

double quadrilateral_deviation(Point3 a, Point3 b, Point3 c, Point3 d) {
  const auto minus = [](Point3 p, Point3 q) {
    return std::array<double, 3>{p[0] - q[0], p[1] - q[1], p[2] - q[2]};
  };
  const auto length = [](const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); };
  const auto ab = minus(b, a), ac = minus(c, a), bd = minus(d, b);
  const std::array<double, 3> n{ac[1] * bd[2] - ac[2] * bd[1], ac[2] * bd[0] - ac[0] * bd[2],
                                ac[0] * bd[1] - ac[1] * bd[0]};
  const double area = length(n), size = std::max(length(ac), length(bd));
  if (!(area > 0)) return 0;
  // the diagonals' distance from one another: their common normal against an edge between them
  const double gap = std::abs(n[0] * ab[0] + n[1] * ab[1] + n[2] * ab[2]) / area;
  return gap / size;
}

BehindRelation shared_face_relation(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                                    const View& view, double planarity) {
  BehindRelation relation;
  relation.face_offset = face_offsets(mesh);
  const auto& offset = relation.face_offset;
  std::vector<std::uint8_t> said(offset.back(), kNoArrow);
  parallel_for(mesh.cell_count(), kGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto cell = static_cast<CellId>(i);
      const auto faces = topology_of(mesh.kinds[cell]).faces;
      const auto neighbors = adjacency.neighbors.view().subspan(offset[i], faces.size());
      const auto arrows = std::span(said).subspan(offset[i], faces.size());
      if (shape_of(mesh.kinds[cell]) == CellShape::tetrahedron) {
        tetrahedron_arrows(mesh, cell, neighbors, view, arrows);
        continue;
      }
      for (std::size_t f = 0; f < faces.size(); ++f)
        if (neighbors[f] != kNoCell) arrows[f] = face_arrows(mesh, cell, faces[f], view, planarity);
    }
  });
  relation.arrows.assign(said.size(), kNoArrow);
  relation.both_ways = join_sides(mesh, adjacency, offset, said, view, relation.arrows);
  return relation;
}

}  // namespace hiac
