#include "hiac/order/behind_relation.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

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
// so is bounded by its signs at the corners, each the orientation of one corner's triangle.
std::uint8_t quadrilateral_arrows(const ZooMesh& mesh, CellId cell, const ShapeFace& face,
                                  const Corners& p, const View& view, double planarity) {
  int positive = 0, negative = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const int s = side_of_view(p[(k + 3) % 4], p[k], p[(k + 1) % 4], view);
    positive += s > 0 ? 1 : 0;
    negative += s < 0 ? 1 : 0;
  }
  const int cell_side = side_of_cell(mesh, cell, face);
  if (positive > 0 && negative > 0) {
    if (quadrilateral_deviation(p[0], p[1], p[2], p[3]) > planarity) return kBothWays;
    // planar for this purpose, seen edge-on to within rounding of its coordinates
    return arrows_of_sides(side_of_view(p[0], p[1], p[2], view), cell_side);
  }
  return arrows_of_sides(positive - negative, cell_side);
}

std::uint8_t face_arrows(const ZooMesh& mesh, CellId cell, const ShapeFace& face, const View& view,
                         double planarity) {
  const auto nodes = mesh.cell_nodes(cell);
  const auto corner = [&](std::size_t k) { return mesh.position(nodes[face.corners[k]]); };
  const Corners p{corner(0), corner(1), corner(2), corner(face.corner_count == 4 ? 3 : 0)};
  if (face.corner_count == 4) return quadrilateral_arrows(mesh, cell, face, p, view, planarity);
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

std::uint8_t mirrored(std::uint8_t arrows) {
  return static_cast<std::uint8_t>(((arrows & 1U) << 1) | (arrows >> 1));
}

bool has_volume(const ZooMesh& mesh, CellId cell) {
  return std::ranges::any_of(topology_of(mesh.kinds[cell]).faces, [&](const ShapeFace& face) {
    return side_of_cell(mesh, cell, face) != 0;
  });
}

// Joins what the two sides of every shared face say.
std::uint64_t join_sides(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                         const std::vector<std::uint64_t>& offset,
                         const std::vector<std::uint8_t>& said, std::vector<std::uint8_t>& joined) {
  std::atomic<std::uint64_t> both_ways{0};
  parallel_for(mesh.cell_count(), kGrain, [&](IndexRange range) {
    std::uint64_t both = 0;
    for (std::size_t cell = range.begin; cell < range.end; ++cell) {
      for (std::uint64_t face = offset[cell]; face < offset[cell + 1]; ++face) {
        const CellId other = adjacency.neighbors[face];
        if (other == kNoCell) continue;
        unsigned arrows = said[face];
        for (std::uint64_t back = offset[other]; back < offset[other + 1]; ++back)
          if (adjacency.neighbors[back] == cell) arrows |= mirrored(said[back]);
        if (arrows == kNoArrow && !has_volume(mesh, static_cast<CellId>(cell)) &&
            !has_volume(mesh, other))
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
  relation.both_ways = join_sides(mesh, adjacency, offset, said, relation.arrows);
  return relation;
}

}  // namespace hiac
