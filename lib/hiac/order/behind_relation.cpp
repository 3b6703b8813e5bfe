#include "hiac/order/behind_relation.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#include "hiac/base/large_pages.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/order/faces/cell_side.hpp"
#include "hiac/order/faces/eye_side.hpp"
#include "hiac/order/faces/patch_side.hpp"

namespace hiac {
namespace {

constexpr std::size_t kBehindRelationGrain = 1 << 13;

unsigned arrows_of_sides(int eye, int cell) {
  if (eye == 0 || cell == 0) return kNoArrow;
  return eye == cell ? kCellFirst : kNeighborFirst;
}

struct Question {
  const OrderBasis& basis;
  const View& view;
  double planarity;
};

int eye_side_of_face(const Question& q, CellId cell, std::size_t face) {
  const ZooMesh& mesh = *q.basis.mesh;
  const ShapeFace& shape = topology_of(mesh.kinds[cell]).faces[face];
  const auto nodes = mesh.cell_nodes(cell);
  const auto at = corners_from(shape, q.basis.sides[cell].start(face));
  const auto corner = [&](std::size_t k) { return mesh.position(nodes[at[k]]); };
  if (order_of(mesh.kinds[cell]) != CellOrder::linear) {
    const FaceForm form = face_form(mesh, cell, face, q.planarity);
    if (form.shape.degree > 1) return eye_side_of_curved_face(mesh, cell, face, form, q.view);
  }
  if (shape.corner_count == 3) return eye_side(corner(0), corner(1), corner(2), q.view);
  return eye_side_of_patch({corner(0), corner(1), corner(2), corner(3)}, q.view, q.planarity);
}

// The arrows across a cell's settled faces.
CellArrows settled_arrows(const Question& q, CellId cell) {
  const ZooMesh& mesh = *q.basis.mesh;
  const CellSides& sides = q.basis.sides[cell];
  const unsigned asked = (sides.positive | sides.negative) & ~unsigned{sides.unsettled};
  unsigned positive = 0, negative = 0;
  const CellKind kind = mesh.kinds[cell];
  const bool flat = kind == CellKind::tetrahedron4 || (shape_of(kind) == CellShape::tetrahedron &&
                                                       !has_curved_faces(mesh, cell, q.planarity));
  if (flat) {
    const auto nodes = mesh.cell_nodes(cell);
    const auto at = [&](std::size_t k) { return mesh.position(nodes[k]).data(); };
    const EyeSides eye = eye_sides_of_tetrahedron({at(0), at(1), at(2), at(3)}, q.view);
    positive = eye.positive & asked;
    negative = eye.negative & asked;
  } else {
    for (unsigned left = asked; left != 0; left &= left - 1) {
      const int face = std::countr_zero(left);
      const int eye = eye_side_of_face(q, cell, static_cast<std::size_t>(face));
      positive |= (eye > 0 ? 1U : 0U) << face;
      negative |= (eye < 0 || eye == kBothSides ? 1U : 0U) << face;
    }
  }
  return {static_cast<std::uint8_t>((positive & sides.positive) | (negative & sides.negative)),
          static_cast<std::uint8_t>((positive & sides.negative) | (negative & sides.positive))};
}

// Cells with consecutive numbers need not have nearby nodes: without prefetching, most of the time
// is spent waiting for node positions.
constexpr std::size_t kFetchAhead = 12;

void fetch_corners(const ZooMesh& mesh, CellId cell) {
  const auto nodes = mesh.cell_nodes(cell).first(corner_count(mesh.kinds[cell]));
  for (const NodeId node : nodes) __builtin_prefetch(mesh.position(node).data());
}

unsigned mirrored(unsigned arrows) { return ((arrows & 1U) << 1) | (arrows >> 1); }

// One cell's answer for all the faces that it shares with another cell, and whether rays cross any
// of them: a face without area is always seen edge-on.
struct Said {
  unsigned arrows = kNoArrow;
  bool crossed = false;
};

Said said_of(const Question& q, CellId cell, CellId other) {
  const CellSides& sides = q.basis.sides[cell];
  const std::uint64_t first = q.basis.faces.first(cell);
  Said said;
  for (std::size_t f = 0; f < q.basis.faces.count(cell); ++f) {
    if (q.basis.adjacency.neighbors[first + f] != other) continue;
    const int eye = eye_side_of_face(q, cell, f);
    said.arrows |= eye == kBothSides ? unsigned{kBothWays} : arrows_of_sides(eye, sides.side(f));
    said.crossed = said.crossed || eye != 0;
  }
  return said;
}

bool has_volume(const ZooMesh& mesh, CellId cell) {
  return std::ranges::any_of(topology_of(mesh.kinds[cell]).faces, [&](const ShapeFace& face) {
    return side_of_cell(mesh, cell, face) != 0;
  });
}

// Joins the answers of both cells of an unsettled face.
unsigned joined_arrows(const Question& q, const UnsettledFace& at) {
  const CellId other = q.basis.adjacency.neighbors[q.basis.faces.first(at.cell) + at.face];
  const Said here = said_of(q, at.cell, other);
  const unsigned arrows = here.arrows | mirrored(said_of(q, other, at.cell).arrows);
  const bool nobody_knows = here.crossed && arrows == kNoArrow &&
                            !has_volume(*q.basis.mesh, at.cell) &&
                            !has_volume(*q.basis.mesh, other);
  return nobody_knows ? unsigned{kBothWays} : arrows;
}

// The list is sorted by cell.
void join_unsettled(const Question& q, std::vector<CellArrows>& of_cell) {
  const auto& unsettled = q.basis.unsettled;
  std::vector<std::uint8_t> arrows(unsettled.size());
  parallel_for(unsettled.size(), 256, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      arrows[i] = static_cast<std::uint8_t>(joined_arrows(q, unsettled[i]));
  });
  for (std::size_t i = 0; i < unsettled.size(); ++i)
    of_cell[unsettled[i].cell].set(unsettled[i].face, arrows[i]);
}

}  // namespace

BehindRelation shared_face_relation(const OrderBasis& basis, const View& view, double planarity) {
  const Question q{basis, view, planarity};
  const ZooMesh& mesh = *basis.mesh;
  BehindRelation relation;
  relation.of_cell = large_vector<CellArrows>(basis.sides.size());
  parallel_for(relation.of_cell.size(), kBehindRelationGrain, [&](IndexRange range) {
    for (std::size_t cell = range.begin; cell < range.end; ++cell) {
      if (cell + kFetchAhead < range.end)
        fetch_corners(mesh, static_cast<CellId>(cell + kFetchAhead));
      relation.of_cell[cell] = settled_arrows(q, static_cast<CellId>(cell));
    }
  });
  join_unsettled(q, relation.of_cell);
  std::atomic<std::uint64_t> arrows{0}, both_ways{0};
  parallel_for(relation.of_cell.size(), kBehindRelationGrain, [&](IndexRange range) {
    std::uint64_t some = 0, both = 0;
    for (std::size_t cell = range.begin; cell < range.end; ++cell) {
      const auto [first, behind] = relation.of_cell[cell];
      some += count_faces(unsigned{first} | behind);
      both += count_faces(unsigned{first} & behind);
    }
    arrows += some;
    both_ways += both;
  });
  relation.both_ways = both_ways / 2;
  relation.edge_on = basis.shared_faces - arrows / 2;
  return relation;
}

}  // namespace hiac
