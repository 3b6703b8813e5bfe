#include "hiac/order/published/cell_obstruction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/base/parallel.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/order/behind_relation.hpp"
#include "hiac/order/faces/cell_side.hpp"
#include "hiac/order/faces/eye_side.hpp"
#include "hiac/order/gaps/face_obstruction.hpp"

namespace hiac {
namespace {

constexpr std::size_t kCellObstructionGrain = 1 << 13;

// How the eye sees a face. A face whose plane contains the eye is both front and back: no ray goes
// from one of its sides to the other.
constexpr unsigned kFront = 1;        // the eye lies on the outer side, or in the plane
constexpr unsigned kBack = 2;         // the eye lies on the inner side, or in the plane
constexpr unsigned kNearlyFront = 4;  // the same, to within rounding
constexpr unsigned kNearlyBack = 8;
constexpr unsigned kInward = 16;  // the corners run clockwise seen from outside
constexpr unsigned kSided = 32;   // the cell has an inner side there: it has a volume
constexpr unsigned kNearlyEdgeOn = kNearlyFront | kNearlyBack;

// The vector from a plane's point to the eye; against the rays in a parallel view.
Vector towards_eye(const View& view, const FacePlane& plane) {
  if (view.perspective) return minus(Point3(view.eye), Point3(plane.point));
  return {-view.direction[0], -view.direction[1], -view.direction[2]};
}

unsigned facing_of_side(int side) {
  if (side == 0) return kFront | kBack | kNearlyEdgeOn;
  return side > 0 ? kFront | kNearlyFront : kBack | kNearlyBack;
}

std::uint8_t facing_of_triangle(const CellCorners& cell, const ShapeFace& face, int side_of_rest,
                                const View& view, const MeshScale& scale) {
  if (side_of_rest == 0) return 0;
  const auto& c = face.corners;
  const int eye = -side_of_rest * eye_side(cell.at(c[0]), cell.at(c[1]), cell.at(c[2]), view);
  const FacePlane plane = plane_of_face(cell, face, scale);
  const Vector towards = towards_eye(view, plane);
  const double distance = taxicab(towards);
  const double touch = view.perspective ? plane.touch(distance) : plane.touching_slope * distance;
  unsigned facing = facing_of_side(eye);
  if (std::abs(plane.value(towards)) <= touch) facing |= kNearlyEdgeOn;
  return static_cast<std::uint8_t>(facing | kSided | (side_of_rest > 0 ? kInward : 0U));
}

// If the eye is as near to Newell's plane as the quadrilateral's corners are, the plane does not
// tell on which side of the quadrilateral it lies; a quadrilateral that counts as planar is then
// edge-on.
std::uint8_t facing_of_quadrilateral(const CellCorners& cell, const ShapeFace& face,
                                     const View& view, const MeshScale& scale, double planarity) {
  const FacePlane plane = plane_of_face(cell, face, scale);
  double inside = 0;
  for (std::size_t k = 0; k < cell.nodes.size(); ++k)
    inside += plane.value(minus(cell.at(k), Point3(plane.point)));
  if (inside == 0 || !(plane.size > 0)) return 0;
  const Vector towards = towards_eye(view, plane);
  const double distance = taxicab(towards);
  const double value = (inside > 0 ? -1 : 1) * plane.value(towards);
  const double slope = plane.touching_slope + plane.deviation / plane.size;
  const double unsure = (view.perspective ? plane.touching : 0) + slope * distance;
  const auto& c = face.corners;
  unsigned facing = kSided | (inside > 0 ? kInward : 0U);
  if (std::abs(value) > unsure)
    facing |= facing_of_side(value > 0 ? 1 : -1);
  else if (quadrilateral_deviation(cell.at(c[0]), cell.at(c[1]), cell.at(c[2]), cell.at(c[3])) <=
           planarity)
    facing |= facing_of_side(0);
  return static_cast<std::uint8_t>(facing);
}

void find_facing(const ZooMesh& mesh, CellId cell, const View& view, const MeshScale& scale,
                 double planarity, std::span<std::uint8_t> facing) {
  const CellCorners corners(mesh, cell);
  const auto faces = topology_of(mesh.kinds[cell]).faces;
  for (std::size_t f = 0; f < faces.size(); ++f)
    facing[f] =
        faces[f].corner_count == 3
            ? facing_of_triangle(corners, faces[f], side_of_cell(mesh, cell, faces[f]), view, scale)
            : facing_of_quadrilateral(corners, faces[f], view, scale, planarity);
}

// The faces of a cell through which rays leave it, or those through which rays enter it.
class SeenFaces {
 public:
  SeenFaces(const ZooMesh& mesh, CellId cell, const View& view, double planarity, bool exits,
            std::span<const std::uint8_t> facing) {
    const auto nodes = mesh.cell_nodes(cell);
    const auto faces = topology_of(mesh.kinds[cell]).faces;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (faces[f].corner_count == 3 && (facing[f] & kNearlyEdgeOn) == kNearlyEdgeOn) continue;
      const int side = side_of_cell(mesh, cell, faces[f]);
      const auto c = plane_corners(mesh, cell, faces[f]);
      const auto at = [&](std::size_t k) { return mesh.position(nodes[c[k]]).data(); };
      const bool whole = faces[f].corner_count == 3 ||
                         quadrilateral_deviation(Point3(at(0), 3), Point3(at(1), 3),
                                                 Point3(at(2), 3), Point3(at(3), 3)) <= planarity;
      const std::size_t count = whole ? faces[f].corner_count : 3;
      add({at(0), at(1), at(2), at(3)}, count, side, view, exits);
      if (!whole) add({at(0), at(2), at(3), at(3)}, count, side, view, exits);
    }
  }

  [[nodiscard]] std::span<const SeenFace> faces() const { return {faces_.data(), count_}; }

 private:
  void add(const std::array<const double*, 4>& corners, std::size_t count, int side,
           const View& view, bool exits) {
    SeenFace face{corners, count, 0};
    face.winding = eye_side(face.corner(0), face.corner(1), face.corner(2), view);
    if (face.winding == 0 || side == 0 || (face.winding == side) != exits) return;
    faces_[count_++] = face;
  }

  std::array<SeenFace, 12> faces_;
  std::size_t count_ = 0;
};

// Returns whether a cell has no volume.
bool is_flat(const CellObstruction::Cell& cell) {
  return std::ranges::all_of(cell.facing, [](unsigned facing) { return (facing & kSided) == 0; });
}

}  // namespace

CellObstruction::CellObstruction(const ZooMesh& mesh, const View& view, double planarity)
    : mesh_(mesh),
      view_(view),
      planarity_(planarity),
      scale_(mesh),
      face_offset_(face_offsets(mesh)) {
  facing_.resize(face_offset_.back());
  parallel_for(mesh.cell_count(), kCellObstructionGrain, [&](IndexRange range) {
    for (std::size_t cell = range.begin; cell < range.end; ++cell)
      find_facing(mesh, static_cast<CellId>(cell), view_, scale_, planarity_,
                  std::span(facing_).subspan(face_offset_[cell],
                                             face_offset_[cell + 1] - face_offset_[cell]));
  });
}

const FacePlane& CellObstruction::Cell::plane(std::size_t face, const MeshScale& scale) {
  if ((known_ >> face & 1U) == 0) {
    known_ |= 1U << face;
    planes_[face] = plane_of_face(corners, faces[face], scale);
    if ((facing[face] & kInward) != 0) flip(planes_[face]);
  }
  return planes_[face];
}

// Returns whether all corners lie in a face's plane or on its outer side.
CellObstruction::Separation CellObstruction::beyond(Cell& of, std::size_t face,
                                                    const CellCorners& corners) const {
  const FacePlane& plane = of.plane(face, scale_);
  std::array<double, 8> values;
  const auto& [x, y, z] = corners.coordinates;
  for (std::size_t k = 0; k < corners.filled_up(); ++k)
    values[k] = plane.normal[0] * (x[k] - plane.point[0]) +
                plane.normal[1] * (y[k] - plane.point[1]) +
                plane.normal[2] * (z[k] - plane.point[2]);
  const double lowest = *std::min_element(values.begin(), values.begin() + corners.filled_up());
  if (lowest > plane.certain) return Separation::surely;
  if (lowest < -plane.apart) return Separation::none;
  return nearly_beyond(of, face, corners, values);
}

// Decides the same if a corner lies in the plane or close to it.
CellObstruction::Separation CellObstruction::nearly_beyond(
    Cell& of, std::size_t face, const CellCorners& corners,
    const std::array<double, 8>& values) const {
  const FacePlane& plane = of.plane(face, scale_);
  const auto& c = of.faces[face].corners;
  const auto& nodes = of.corners.nodes;
  const bool triangle = of.faces[face].corner_count == 3;
  Separation separation = Separation::surely;
  for (std::size_t k = 0; k < corners.nodes.size(); ++k) {
    if (values[k] > plane.certain) continue;
    const NodeId node = corners.nodes[k];
    if (triangle && (node == nodes[c[0]] || node == nodes[c[1]] || node == nodes[c[2]])) continue;
    const double distance = taxicab(minus(corners.at(k), Point3(plane.point)));
    if (values[k] < -plane.touch(distance)) return Separation::none;
    if (!triangle) continue;
    const int side =
        orientation(of.corners.at(c[0]), of.corners.at(c[1]), of.corners.at(c[2]), corners.at(k));
    if (side != 0 && (side > 0) == ((of.facing[face] & kInward) != 0))
      separation = Separation::nearly;
  }
  return separation;
}

// The third and fourth tests of Obstructs: Q lies in front of a front face of P, or P behind a back
// face of Q. The former is tested first, as the planes of P are known.
CellObstruction::Separation CellObstruction::lies_behind(Cell& p, Cell& q) const {
  Separation best = Separation::none;
  const auto ask = [&](Cell& of, const Cell& other, unsigned exact, unsigned nearly) {
    for (std::size_t f = 0; f < of.faces.size() && best != Separation::surely; ++f) {
      if ((of.facing[f] & nearly) == 0) continue;
      Separation separation = beyond(of, f, other.corners);
      if ((of.facing[f] & exact) == 0) separation = std::min(separation, Separation::nearly);
      best = std::max(best, separation);
    }
  };
  ask(p, q, kFront, kNearlyFront);
  ask(q, p, kBack, kNearlyBack);
  return best;
}

// Returns whether a plane through the eye and an edge of P has all of P on one side and all of Q on
// the other, so that no ray meets both.
bool CellObstruction::separated_by_edge(const Cell& p, const Cell& q) const {
  for (const ShapeEdge& edge : topology_of(mesh_.kinds[p.id]).edges) {
    const Point3 a = p.corners.at(edge[0]), b = p.corners.at(edge[1]);
    const auto side_of = [&](const CellCorners& corners, std::size_t k) {
      return eye_side(a, b, corners.at(k), view_);
    };
    int p_side = 0;
    bool separated = true;
    for (std::size_t k = 0; k < p.corners.nodes.size() && separated; ++k) {
      if (k == edge[0] || k == edge[1]) continue;
      const int side = side_of(p.corners, k);
      separated = p_side * side >= 0;
      if (side != 0) p_side = side;
    }
    for (std::size_t k = 0; k < q.corners.nodes.size() && separated; ++k)
      separated = p_side * side_of(q.corners, k) <= 0;
    if (separated && p_side != 0) return true;
  }
  return false;
}

// Returns whether P obscures a part of Q, if no plane of a face shows that it does not.
bool CellObstruction::projects_before(const Cell& p, const Cell& q) const {
  for (const ShapeEdge& e : topology_of(mesh_.kinds[p.id]).edges)
    for (const ShapeEdge& f : topology_of(mesh_.kinds[q.id]).edges) {
      const auto nearer = nearer_edge(p.corners.at(e[0]), p.corners.at(e[1]), q.corners.at(f[0]),
                                      q.corners.at(f[1]), view_);
      if (nearer && *nearer != 0) return *nearer < 0;
    }
  const SeenFaces exits(mesh_, p.id, view_, planarity_, true, p.facing);
  const SeenFaces entries(mesh_, q.id, view_, planarity_, false, q.facing);
  for (const SeenFace& f : exits.faces())
    for (const SeenFace& g : entries.faces())
      if (projections_overlap(f, g, view_)) return reached_first(f, g, view_, 0);
  return false;
}

bool CellObstruction::projections_meet(const Cell& p, const Cell& q) const {
  const SeenFaces exits(mesh_, p.id, view_, planarity_, true, p.facing);
  const SeenFaces entries(mesh_, q.id, view_, planarity_, false, q.facing);
  return std::ranges::any_of(exits.faces(), [&](const SeenFace& f) {
    return std::ranges::any_of(entries.faces(),
                               [&](const SeenFace& g) { return projections_overlap(f, g, view_); });
  });
}

bool CellObstruction::obstructs(Cell& p, Cell& q) const {
  if (is_flat(p) || is_flat(q)) return false;
  const Separation behind = lies_behind(p, q);
  if (behind == Separation::surely) return false;
  if (separated_by_edge(p, q) || separated_by_edge(q, p)) return false;
  // Section 6.1: if projections overlap, one face's plane with Q behind P decides.
  const Separation before = lies_behind(q, p);
  if (before == Separation::surely) return projections_meet(p, q);
  if (behind == Separation::nearly) return false;
  if (before == Separation::nearly) return projections_meet(p, q);
  return projects_before(p, q);
}

}  // namespace hiac
