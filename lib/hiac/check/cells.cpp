#include "hiac/check/cells.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "hiac/base/collect.hpp"
#include "hiac/geometry/jacobian_sign.hpp"
#include "hiac/geometry/predicates.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/corner_fan.hpp"
#include "hiac/mesh/face_nodes.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/order/behind_relation.hpp"

namespace hiac {
namespace {

constexpr std::size_t kCellsGrain = 1 << 13;

// One cell's node positions, by node number within the cell.
class Nodes {
 public:
  Nodes(const ZooMesh& mesh, CellId cell) : mesh_(mesh), nodes_(mesh.cell_nodes(cell)) {}
  [[nodiscard]] Point3 at(std::size_t k) const { return mesh_.position(nodes_[k]); }

 private:
  const ZooMesh& mesh_;
  std::span<const NodeId> nodes_;
};

Turn turn_of_tetrahedron(const Nodes& n) {
  const int sign = orientation(n.at(0), n.at(1), n.at(2), n.at(3));
  return sign == 0 ? Turn::flat : sign > 0 ? Turn::right : Turn::left;
}

bool lie_in_one_plane(const Nodes& n, std::size_t count) {
  for (std::size_t i = 1; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      for (std::size_t k = j + 1; k < count; ++k)
        if (orientation(n.at(0), n.at(i), n.at(j), n.at(k)) != 0) return false;
  return true;
}

// Returns a linear cell's orientation from the signs at the corners where three edges meet. Up to a
// positive factor these are the signs of the map's Jacobian there (in a pyramid or a wedge, of its
// limit along the edges).
Turn turn_at_corners(const Nodes& n, CellShape shape) {
  bool positive = false, negative = false;
  for (std::size_t corner = 0; corner < topology_of(shape).corner_count; ++corner) {
    const CornerFan& fan = corner_fan(shape, corner);
    if (fan.count != 3) continue;  // a pyramid's apex, a wedge's node 6
    const auto& [a, b, c, none] = fan.neighbors;
    const int sign = orientation(n.at(corner), n.at(a), n.at(c), n.at(b));
    positive = positive || sign > 0;
    negative = negative || sign < 0;
  }
  if (positive != negative) return positive ? Turn::right : Turn::left;
  if (!positive && lie_in_one_plane(n, topology_of(shape).corner_count)) return Turn::flat;
  return Turn::mixed;
}

Turn turn_inside(const ZooMesh& mesh, CellId cell) {
  // determinants below this are rounding errors
  constexpr double kRounding = 1e-13;
  std::array<std::array<double, 3>, kMaxNodesPerCell> at{};
  const auto nodes = mesh.cell_nodes(cell);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    std::ranges::copy(mesh.position(nodes[k]), at[k].begin());
  switch (jacobian_sign(mesh.kinds[cell], std::span(at).first(nodes.size()), kRounding)) {
    case JacobianSign::positive:
      return Turn::right;
    case JacobianSign::negative:
      return Turn::left;
    case JacobianSign::mixed:
      return Turn::mixed;
    case JacobianSign::flat:
      return Turn::flat;
    case JacobianSign::undecided:
      break;
  }
  return Turn::undecided;
}

Turn turn_of(const ZooMesh& mesh, CellId cell) {
  const CellKind kind = mesh.kinds[cell];
  const Nodes n(mesh, cell);
  if (kind == CellKind::tetrahedron4) return turn_of_tetrahedron(n);
  if (order_of(kind) != CellOrder::linear) return turn_inside(mesh, cell);
  const Turn at_corners = turn_at_corners(n, shape_of(kind));
  if (at_corners == Turn::flat || at_corners == Turn::mixed) return at_corners;
  const Turn inside = turn_inside(mesh, cell);
  // the volume is too small to decide anything that the corners do not
  return inside == Turn::mixed || inside == at_corners ? inside : Turn::undecided;
}

// Faces and convexity -----------------------------------------------------------------------------

// Returns the distance of q from the plane of a, b, c; 0 exactly if q lies in it.
double distance_from_plane(Point3 a, Point3 b, Point3 c, Point3 q) {
  if (orientation(a, b, c, q) == 0) return 0;
  const Vector normal = cross(minus(b, a), minus(c, a));
  const double area = length(normal);
  const double distance = area > 0 ? std::abs(dot(normal, minus(q, a))) / area : 0;
  return std::max(distance, std::numeric_limits<double>::denorm_min());
}

double size_of(const Nodes& n, const ShapeFace& face) {
  double size = 0;
  for (std::size_t k = 1; k < face.corner_count; ++k)
    for (std::size_t j = 0; j < k; ++j)
      size = std::max(size, length(minus(n.at(face.corners[k]), n.at(face.corners[j]))));
  return size;
}

double relative(double distance, double size) {
  if (distance == 0) return 0;
  return std::max(distance / size, std::numeric_limits<double>::denorm_min());
}

double deviation_of_face(const Nodes& n, CellKind kind, std::size_t number) {
  const ShapeFace& face = topology_of(kind).faces[number];
  const auto corner = [&](std::size_t k) { return n.at(face.corners[k]); };
  double deviation = 0;
  if (face.corner_count == 4 && orientation(corner(0), corner(1), corner(2), corner(3)) != 0)
    deviation = std::max(quadrilateral_deviation(corner(0), corner(1), corner(2), corner(3)),
                         std::numeric_limits<double>::denorm_min());
  if (order_of(kind) == CellOrder::linear) return deviation;
  const BetweenNodes between = nodes_between(kind, number);
  const double size = size_of(n, face);
  for (std::size_t i = 0; i < between.count; ++i)
    deviation = std::max(deviation, relative(distance_from_plane(corner(0), corner(1), corner(2),
                                                                 n.at(between.nodes[i])),
                                             size));
  return deviation;
}

// Returns whether a corner off the face lies outside a plane through three of the face's corners;
// `side` is the sign of the cell's orientation.
bool outside_of_face(const Nodes& n, const ShapeTopology& shape, const ShapeFace& face, int side,
                     double planarity) {
  const double tolerated = planarity > 0 ? planarity * size_of(n, face) : 0;
  const std::size_t triples = face.corner_count == 3 ? 1 : 4;
  for (std::size_t t = 0; t < triples; ++t) {
    const auto corner = [&](std::size_t k) {
      return n.at(face.corners[(t + k) % face.corner_count]);
    };
    for (std::size_t k = 0; k < shape.corner_count; ++k) {
      const auto on_face = std::span(face.corners).first(face.corner_count);
      if (std::ranges::find(on_face, k) != on_face.end()) continue;
      if (orientation(corner(0), corner(1), corner(2), n.at(k)) * side <= 0) continue;
      if (distance_from_plane(corner(0), corner(1), corner(2), n.at(k)) > tolerated) return true;
    }
  }
  return false;
}

// Findings of a pass over the cells ---------------------------------------------------------------

// Returns the orientation of most cells; right if there are as many of either.
Turn hand_of(const std::vector<Turn>& turns) {
  std::atomic<std::int64_t> right_over_left{0};
  parallel_for(turns.size(), kCellsGrain, [&](IndexRange range) {
    std::int64_t sum = 0;
    for (std::size_t i = range.begin; i < range.end; ++i)
      sum += (turns[i] == Turn::right ? 1 : 0) - (turns[i] == Turn::left ? 1 : 0);
    right_over_left += sum;
  });
  return right_over_left < 0 ? Turn::left : Turn::right;
}

template <typename Which>
std::vector<Offender> cells_that(const std::vector<Turn>& turns, const Which& which) {
  return collect<Offender>(turns.size(), kCellsGrain, [&](std::size_t cell, auto& found) {
    if (which(turns[cell])) found.push_back({cell});
  });
}

// Adds the findings about orientations: cells that differ from the mesh, or all left cells of a
// left mesh.
void judge_turns(CellShapes& shapes) {
  const auto& turns = shapes.turns;
  const auto all = [&](Defect defect, Turn turn) {
    add_finding(shapes.findings, defect, cells_that(turns, [&](Turn t) { return t == turn; }));
  };
  all(Defect::zero_volume, Turn::flat);
  all(Defect::inverted, shapes.hand == Turn::right ? Turn::left : Turn::right);
  all(Defect::jacobian, Turn::mixed);
  all(Defect::jacobian_undecided, Turn::undecided);
  shapes.uniform = shapes.findings.empty();
  if (shapes.hand == Turn::left) all(Defect::left_handed, Turn::left);
}

}  // namespace

double face_deviation(const ZooMesh& mesh, CellId cell) {
  const Nodes n(mesh, cell);
  double deviation = 0;
  for (std::size_t f = 0; f < face_count(mesh.kinds[cell]); ++f)
    deviation = std::max(deviation, deviation_of_face(n, mesh.kinds[cell], f));
  return deviation;
}

bool is_convex(const ZooMesh& mesh, CellId cell, Turn turn, double planarity) {
  const ShapeTopology& shape = topology_of(mesh.kinds[cell]);
  const Nodes n(mesh, cell);
  // the faces of a right cell run counter-clockwise as seen from outside, so that their positive
  // side is outside
  const int side = turn == Turn::right ? 1 : -1;
  return std::ranges::none_of(shape.faces, [&](const ShapeFace& face) {
    return outside_of_face(n, shape, face, side, planarity);
  });
}

CellShapes judge_cells(const ZooMesh& mesh, double planarity) {
  CellShapes shapes;
  shapes.turns.resize(mesh.cell_count());
  parallel_for(mesh.cell_count(), kCellsGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      shapes.turns[i] = turn_of(mesh, static_cast<CellId>(i));
  });
  shapes.hand = hand_of(shapes.turns);
  judge_turns(shapes);
  const auto over_other_cells = [&](const auto& visit) {
    return collect<Offender>(mesh.cell_count(), kCellsGrain, [&](std::size_t i, auto& found) {
      if (mesh.kinds[i] != CellKind::tetrahedron4) visit(static_cast<CellId>(i), found);
    });
  };
  add_finding(shapes.findings, Defect::nonplanar_face,
              over_other_cells([&](CellId cell, auto& found) {
                const double deviation = face_deviation(mesh, cell);
                if (deviation > planarity) found.push_back({cell, kNobody, deviation});
              }));
  add_finding(shapes.findings, Defect::nonconvex_cell,
              over_other_cells([&](CellId cell, auto& found) {
                const Turn turn = shapes.turns[cell];
                if (order_of(mesh.kinds[cell]) == CellOrder::linear && turn != Turn::flat &&
                    !is_convex(mesh, cell, turn, planarity))
                  found.push_back({cell});
              }));
  return shapes;
}

}  // namespace hiac
