#include "hiac/order/order_basis.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "hiac/base/collect.hpp"
#include "hiac/base/error.hpp"
#include "hiac/geometry/face_form.hpp"
#include "hiac/order/behind_relation.hpp"
#include "hiac/order/faces/cell_side.hpp"
#include "hiac/order/faces/convexity.hpp"

namespace hiac {
namespace {

constexpr std::size_t kOrderBasisGrain = 1 << 13;

// `plane`: the face's plane_corners; `side`: the side of their plane on which the cell lies.
UnmatchedFace unmatched_face(const ZooMesh& mesh, CellId cell, std::size_t f,
                             const std::array<std::uint8_t, 4>& plane, int side) {
  UnmatchedFace face{cell,
                     static_cast<std::uint8_t>(f),
                     {},
                     topology_of(mesh.kinds[cell]).faces[f].corner_count,
                     static_cast<std::int8_t>(side),
                     0};
  for (std::size_t k = 0; k < 4; ++k) face.nodes[k] = mesh.cell_nodes(cell)[plane[k]];
  const auto at = [&](std::size_t k) { return mesh.position(face.nodes[k]); };
  // an edge without length has no side on which other faces could lie
  if (std::ranges::equal(at(3), at(0)) || std::ranges::equal(at(3), at(2))) {
    face.corner_count = 3;
    face.nodes[3] = face.nodes[2];
  }
  if (face.corner_count == 4) face.deviation = quadrilateral_deviation(at(0), at(1), at(2), at(3));
  return face;
}

// Returns the sides of one cell's shared faces on which it lies, and appends its unmatched faces.
CellSides sides_of(const ZooMesh& mesh, CellId cell, std::span<const CellId> neighbors,
                   std::vector<UnmatchedFace>& unmatched) {
  CellSides sides;
  const auto nodes = mesh.cell_nodes(cell);
  const auto faces = topology_of(mesh.kinds[cell]).faces;
  const CellKind kind = mesh.kinds[cell];
  const int curved_side = order_of(kind) == CellOrder::linear ? 0 : side_by_jacobian(mesh, cell);
  const bool tetrahedron = shape_of(kind) == CellShape::tetrahedron;
  // a tetrahedron's orientation tells on which side of all its faces it lies; so do the corners, or
  // the Jacobian, of any other cell that is nowhere turned inside out, however warped its faces are
  const int one_side = curved_side != 0 ? curved_side
                       : tetrahedron
                           ? -orientation(mesh.position(nodes[0]), mesh.position(nodes[1]),
                                          mesh.position(nodes[2]), mesh.position(nodes[3]))
                           : side_of_all_faces(mesh, cell);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const unsigned start = plane_start(mesh, cell, faces[f]);
    const auto plane = corners_from(faces[f], start);
    const int side = tetrahedron || one_side != 0 ? one_side : side_of_cell(mesh, cell, plane);
    if (neighbors[f] == kNoCell) {
      unmatched.push_back(unmatched_face(mesh, cell, f, plane, side));
      continue;
    }
    const auto bit = static_cast<std::uint8_t>(1U << f);
    if (side > 0) sides.positive |= bit;
    if (side < 0) sides.negative |= bit;
    sides.plane_start = static_cast<std::uint16_t>(sides.plane_start | (start << (2 * f)));
  }
  return sides;
}

// The nodes of the corners that span the plane of a face.
std::array<NodeId, 3> plane_nodes(const OrderBasis& basis, CellId cell, std::size_t face) {
  const ZooMesh& mesh = *basis.mesh;
  const auto nodes = mesh.cell_nodes(cell);
  const auto plane =
      corners_from(topology_of(mesh.kinds[cell]).faces[face], basis.sides[cell].start(face));
  return {nodes[plane[0]], nodes[plane[1]], nodes[plane[2]]};
}

// Returns +1 when both triples run around their triangle the same way, -1 when they run opposite
// ways, 0 when they are not the same three different nodes.
int same_winding(const std::array<NodeId, 3>& a, const std::array<NodeId, 3>& b) {
  const auto at = static_cast<std::size_t>(std::ranges::find(b, a[0]) - b.begin());
  if (at == 3 || a[0] == a[1] || a[1] == a[2] || a[0] == a[2]) return 0;
  if (b[(at + 1) % 3] == a[1] && b[(at + 2) % 3] == a[2]) return 1;
  if (b[(at + 1) % 3] == a[2] && b[(at + 2) % 3] == a[1]) return -1;
  return 0;
}

std::span<const CellId> neighbors_of(const OrderBasis& basis, CellId cell) {
  return basis.adjacency.neighbors.view().subspan(basis.faces.first(cell), basis.faces.count(cell));
}

// Returns how many faces two neighbours share; throws if they disagree about it.
std::ptrdiff_t shared_faces(const OrderBasis& basis, CellId cell, CellId other) {
  const auto here = neighbors_of(basis, cell);
  const auto there = other < basis.mesh->cell_count() && other != cell ? neighbors_of(basis, other)
                                                                       : std::span<const CellId>();
  const auto shared = std::ranges::count(here, other);
  const auto shared_back = std::ranges::count(there, cell);
  if (shared != shared_back)
    throw InputError("face adjacency",
                     fmt::format("cells {} and {} are not neighbours of one another ({} common "
                                 "faces expected, {} found)",
                                 cell, other, shared, shared_back));
  return shared;
}

// Returns -1 when two cells lie on different sides of a face that they share, +1 when they lie on
// the same side, 0 when that is unknown.
int sides_across(const OrderBasis& basis, CellId cell, std::size_t face) {
  const CellId other = neighbors_of(basis, cell)[face];
  const auto there = neighbors_of(basis, other);
  for (std::size_t back = 0; back < there.size(); ++back) {
    if (there[back] != cell) continue;
    const int winding =
        same_winding(plane_nodes(basis, cell, face), plane_nodes(basis, other, back));
    if (winding != 0) return winding * basis.sides[cell].side(face) * basis.sides[other].side(back);
  }
  return 0;
}

// A face is settled if it is the only face that its cells share and they lie on different sides of
// it: then one cell and the eye's side decide its arrows. Of both sides of such a face, the cell
// with the smaller number looks across it, and appends both if it is not settled.
void append_unsettled(const OrderBasis& basis, CellId cell, std::vector<UnsettledFace>& unsettled) {
  const auto neighbors = neighbors_of(basis, cell);
  for (std::uint32_t f = 0; f < neighbors.size(); ++f) {
    const CellId other = neighbors[f];
    if (other == kNoCell) continue;
    if (shared_faces(basis, cell, other) != 1) {
      unsettled.push_back({cell, f});
    } else if (cell < other && sides_across(basis, cell, f) >= 0) {
      const auto there = neighbors_of(basis, other);
      unsettled.push_back({cell, f});
      unsettled.push_back(
          {other, static_cast<std::uint32_t>(std::ranges::find(there, cell) - there.begin())});
    }
  }
}

// Adds the faces with both cells on the same side to the unmatched ones: rays enter both cells
// there, or leave both. Returns whether there are any.
bool add_folded_faces(OrderBasis& basis) {
  const std::size_t before = basis.unmatched.size();
  for (const auto& [cell, f] : basis.unsettled) {
    if (sides_across(basis, cell, f) <= 0) continue;
    const CellSides& sides = basis.sides[cell];
    const auto plane = corners_from(topology_of(basis.mesh->kinds[cell]).faces[f], sides.start(f));
    basis.unmatched.push_back(unmatched_face(*basis.mesh, cell, f, plane, sides.side(f)));
  }
  if (basis.unmatched.size() == before) return false;
  std::ranges::sort(basis.unmatched, {},
                    [](const UnmatchedFace& face) { return std::pair(face.cell, face.face); });
  return true;
}

// Returns whether an unmatched face has nodes off its plane: boundary_is_convex tests corners only.
bool has_curved_boundary(const OrderBasis& basis) {
  return std::ranges::any_of(basis.unmatched, [&](const UnmatchedFace& face) {
    return order_of(basis.mesh->kinds[face.cell]) != CellOrder::linear &&
           face_form(*basis.mesh, face.cell, face.face, 0).curved;
  });
}

}  // namespace

OrderBasis order_basis(const ZooMesh& mesh, FaceAdjacency adjacency, const LoopCrew* crew) {
  OrderBasis basis{&mesh, std::move(adjacency), FaceNumbering(mesh), {}, {}, {}};
  const std::size_t cells = mesh.cell_count();
  if (basis.adjacency.neighbors.size() != basis.faces.first(cells))
    throw InputError("face adjacency",
                     fmt::format("wrong size ({} faces expected, {} found)",
                                 basis.faces.first(cells), basis.adjacency.neighbors.size()));
  const IndexRange own = own_part(crew, cells);
  const std::size_t count = own.end - own.begin;
  std::vector<CellSides> sides(count);
  basis.unmatched = of_all_parts(
      crew, collect<UnmatchedFace>(count, kOrderBasisGrain, [&](std::size_t i, auto& unmatched) {
        const auto cell = static_cast<CellId>(own.begin + i);
        sides[i] = sides_of(mesh, cell, neighbors_of(basis, cell), unmatched);
      }));
  basis.sides = of_all_parts(crew, std::move(sides));
  basis.shared_faces = (basis.adjacency.neighbors.size() - basis.unmatched.size()) / 2;
  basis.unsettled = of_all_parts(
      crew, collect<UnsettledFace>(count, kOrderBasisGrain, [&](std::size_t i, auto& unsettled) {
        append_unsettled(basis, static_cast<CellId>(own.begin + i), unsettled);
      }));
  std::ranges::sort(basis.unsettled, {},
                    [](const UnsettledFace& face) { return std::pair(face.cell, face.face); });
  for (const auto& [cell, face] : basis.unsettled)
    basis.sides[cell].unsettled |= static_cast<std::uint8_t>(1U << face);
  const bool folded = add_folded_faces(basis);
  basis.convex =
      !folded && !has_curved_boundary(basis) && boundary_is_convex(mesh, basis.adjacency);
  return basis;
}

}  // namespace hiac
