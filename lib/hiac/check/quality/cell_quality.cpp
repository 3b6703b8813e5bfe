#include "hiac/check/quality/cell_quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "hiac/geometry/cell_volume.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/corner_fan.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

constexpr std::array<FigureDescription, kFigureCount> kFigures{
    {{"volume", "volume", ""},
     {"least_dihedral", "least dihedral angle", "degrees"},
     {"largest_dihedral", "largest dihedral angle", "degrees"},
     {"edge_ratio", "edge ratio", ""},
     {"aspect_ratio", "aspect ratio", ""},
     {"radius_ratio", "radius ratio", ""},
     {"condition", "condition", ""},
     {"scaled_jacobian", "scaled Jacobian", ""},
     {"jacobian_ratio", "Jacobian ratio", ""}}};

double determinant(const Vector& u, const Vector& v, const Vector& w) {
  return dot(u, cross(v, w));
}

// The positions of a cell's corners, relative to the first.
struct CornerVectors {
  CellShape shape;
  std::array<Vector, 8> at{};
};

CornerVectors corners_of(const ZooMesh& mesh, CellId cell) {
  CornerVectors corners{shape_of(mesh.kinds[cell]), {}};
  const auto nodes = mesh.cell_nodes(cell);
  for (std::size_t k = 0; k < topology_of(corners.shape).corner_count; ++k)
    corners.at[k] = minus(mesh.position(nodes[k]), mesh.position(nodes[0]));
  return corners;
}

// The edges that leave a corner with three of them, with a positive determinant in a right-handed
// convex cell.
struct Frame {
  std::array<Vector, 3> edges;

  [[nodiscard]] double det() const { return determinant(edges[0], edges[1], edges[2]); }
  [[nodiscard]] double scaled() const {
    return det() / (length(edges[0]) * length(edges[1]) * length(edges[2]));
  }
};

Frame frame_at(const CornerVectors& cell, std::size_t corner) {
  // the determinant of the edges in the fan's order is negative
  const auto& [a, b, c, none] = corner_fan(cell.shape, corner).neighbors;
  return {{minus(cell.at[a], cell.at[corner]), minus(cell.at[c], cell.at[corner]),
           minus(cell.at[b], cell.at[corner])}};
}

template <typename Visit>
void for_each_frame(const CornerVectors& cell, const Visit& visit) {
  for (std::size_t corner = 0; corner < topology_of(cell.shape).corner_count; ++corner)
    if (corner_fan(cell.shape, corner).count == 3) visit(corner, frame_at(cell, corner));
}

// The three vectors between the middles of a brick's opposite faces.
Frame principal_axes(const CornerVectors& brick) {
  Frame frame{};
  constexpr std::array<std::array<std::uint8_t, 4>, 3> kFar{
      {{1, 2, 5, 6}, {2, 3, 6, 7}, {4, 5, 6, 7}}};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t k = 0; k < 8; ++k) {
      const double side = std::ranges::find(kFar[axis], k) != kFar[axis].end() ? 0.25 : -0.25;
      for (std::size_t c = 0; c < 3; ++c) frame.edges[axis][c] += side * brick.at[k][c];
    }
  return frame;
}

// Ideal cells -------------------------------------------------------------------------------------

CornerVectors ideal_corners(CellShape shape) {
  CornerVectors ideal{shape, {}};
  const double third = std::numbers::sqrt3 / 2;
  switch (shape) {
    case CellShape::tetrahedron:
      ideal.at = {{{0, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}}};
      break;
    case CellShape::pyramid:
      ideal.at = {
          {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1 / std::numbers::sqrt2}}};
      break;
    case CellShape::prism:
      ideal.at = {{{0, 0, 0}, {0.5, third, 0}, {1, 0, 0}, {0, 0, 1}, {0.5, third, 1}, {1, 0, 1}}};
      break;
    case CellShape::wedge:
    case CellShape::brick: {
      const auto nodes = reference_nodes(kind_of(shape, CellOrder::linear));
      std::ranges::copy(nodes, ideal.at.begin());
      break;
    }
  }
  return ideal;
}

using Matrix = std::array<Vector, 3>;  // columns

struct IdealCorner {
  double scaled = 0;  // det / product of lengths
  Matrix inverse{};   // of the matrix with the frame's edges as columns
};

Matrix inverse_of(const Frame& frame) {
  const auto& [a, b, c] = frame.edges;
  const double det = frame.det();
  const std::array<Vector, 3> rows{cross(b, c), cross(c, a), cross(a, b)};
  Matrix inverse{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) inverse[j][i] = rows[i][j] / det;
  return inverse;
}

const IdealCorner& ideal_corner(CellShape shape, std::size_t corner) {
  static const auto kTable = [] {
    std::array<std::array<IdealCorner, 8>, kShapeCount> table{};
    for (std::size_t s = 0; s < kShapeCount; ++s)
      for_each_frame(ideal_corners(static_cast<CellShape>(s)),
                     [&](std::size_t at, const Frame& frame) {
                       table[s][at] = {frame.scaled(), inverse_of(frame)};
                     });
    return table;
  }();
  return kTable[static_cast<std::size_t>(shape)][corner];
}

// Figures -----------------------------------------------------------------------------------------

double dihedral(const CornerVectors& cell, int hand, bool largest) {
  double found = largest ? 0 : 360;
  const bool convex = cell.shape == CellShape::tetrahedron;
  for (std::size_t corner = 0; corner < topology_of(cell.shape).corner_count; ++corner) {
    const CornerFan& fan = corner_fan(cell.shape, corner);
    const auto edge = [&](std::size_t k) {
      return minus(cell.at[fan.neighbors[k % fan.count]], cell.at[corner]);
    };
    for (std::size_t k = 0; k < fan.count; ++k) {
      const Vector e = edge(k), before = edge(k + fan.count - 1), after = edge(k + 1);
      const Vector u = cross(e, before), v = cross(e, after);
      if (!(length(u) > 0) || !(length(v) > 0)) return kUndefined;
      const double cosine = dot(u, v);
      double sine = length(e) * determinant(e, before, after) * hand;
      // an angle of 0 or 180 degrees up to rounding
      if (convex || std::abs(sine) < 1e-13 * length(u) * length(v)) sine = std::abs(sine);
      double angle = std::atan2(sine, cosine) * (180 / std::numbers::pi);
      if (angle < 0) angle += 360;
      found = largest ? std::max(found, angle) : std::min(found, angle);
    }
  }
  return found;
}

double edge_ratio(const CornerVectors& cell) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const auto& [a, b] : topology_of(cell.shape).edges) {
    const double here = length(minus(cell.at[a], cell.at[b]));
    least = std::min(least, here);
    most = std::max(most, here);
  }
  return least > 0 ? most / least : kUndefined;
}

double area_of_tetrahedron(const CornerVectors& cell) {
  double area = 0;
  for (const ShapeFace& face : topology_of(CellShape::tetrahedron).faces) {
    const auto& [a, b, c, none] = face.corners;
    area += length(cross(minus(cell.at[b], cell.at[a]), minus(cell.at[c], cell.at[a]))) / 2;
  }
  return area;
}

double aspect_ratio(const CornerVectors& cell) {
  const double volume = std::abs(determinant(cell.at[1], cell.at[2], cell.at[3])) / 6;
  if (!(volume > 0)) return kUndefined;
  double longest = 0;
  for (const auto& [a, b] : topology_of(cell.shape).edges)
    longest = std::max(longest, length(minus(cell.at[a], cell.at[b])));
  const double inscribed = 3 * volume / area_of_tetrahedron(cell);
  return longest / (2 * std::sqrt(6.0) * inscribed);
}

double radius_ratio(const CornerVectors& cell) {
  const Vector &a = cell.at[1], &b = cell.at[2], &c = cell.at[3];
  const double det = std::abs(determinant(a, b, c));
  if (!(det > 0)) return kUndefined;
  const Vector bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  Vector centre{};
  for (std::size_t i = 0; i < 3; ++i)
    centre[i] = dot(a, a) * bc[i] + dot(b, b) * ca[i] + dot(c, c) * ab[i];
  const double circumscribed = length(centre) / (2 * det);
  const double inscribed = det / 2 / area_of_tetrahedron(cell);
  return circumscribed / (3 * inscribed);
}

double condition_of(const Frame& frame, const Matrix& from_ideal, int hand) {
  Frame t{};  // columns of the frame's matrix times the ideal frame's inverse
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c) t.edges[j][c] += frame.edges[k][c] * from_ideal[j][k];
  const double det = t.det() * hand;
  if (!(det > 0)) return kUndefined;
  const auto& [u, v, w] = t.edges;
  const auto norm = [](const Vector& a, const Vector& b, const Vector& c) {
    return std::hypot(length(a), length(b), length(c));
  };
  return norm(u, v, w) * norm(cross(u, v), cross(v, w), cross(w, u)) / (3 * det);
}

double condition(const CornerVectors& cell, int hand) {
  double largest = 0;
  for_each_frame(cell, [&](std::size_t corner, const Frame& frame) {
    const double here = condition_of(frame, ideal_corner(cell.shape, corner).inverse, hand);
    if (!(here <= largest)) largest = std::isnan(largest) ? largest : here;
  });
  return largest;
}

double scaled_jacobian(const CornerVectors& cell, int hand) {
  double least = std::numeric_limits<double>::infinity();
  const auto include = [&](double value) {
    if (!(value >= least)) least = std::isnan(least) ? least : value;
  };
  for_each_frame(cell, [&](std::size_t corner, const Frame& frame) {
    include(hand * frame.scaled() / ideal_corner(cell.shape, corner).scaled);
  });
  if (cell.shape == CellShape::brick) include(hand * principal_axes(cell).scaled());
  return least;
}

double jacobian_ratio(const ZooMesh& mesh, CellId cell, int hand) {
  const CellKind kind = mesh.kinds[cell];
  const auto nodes = mesh.cell_nodes(cell);
  std::array<Vector, kMaxNodesPerCell> gradients{};
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Vector& xi : reference_nodes(kind)) {
    shape_gradients<double>(kind, xi, gradients);
    Matrix jacobian{};
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const Vector at = minus(mesh.position(nodes[n]), mesh.position(nodes[0]));
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t c = 0; c < 3; ++c) jacobian[j][c] += gradients[n][j] * at[c];
    }
    const double det = hand * determinant(jacobian[0], jacobian[1], jacobian[2]);
    least = std::min(least, det);
    most = std::max(most, std::abs(det));
  }
  return most > 0 ? least / most : kUndefined;
}

}  // namespace

const FigureDescription& description_of(QualityFigure figure) {
  return kFigures[static_cast<std::size_t>(figure)];
}

bool has_figure(CellKind kind, QualityFigure figure) {
  if (figure == QualityFigure::aspect_ratio || figure == QualityFigure::radius_ratio)
    return shape_of(kind) == CellShape::tetrahedron;
  return figure != QualityFigure::jacobian_ratio || kind != CellKind::tetrahedron4;
}

double quality_of(const ZooMesh& mesh, CellId cell, QualityFigure figure, int hand) {
  using enum QualityFigure;
  const auto corners = [&] { return corners_of(mesh, cell); };
  switch (figure) {
    case volume:
      return hand * signed_volume(mesh, cell);
    case least_dihedral:
    case largest_dihedral:
      return dihedral(corners(), hand, figure == largest_dihedral);
    case edge_ratio:
      return hiac::edge_ratio(corners());
    case aspect_ratio:
      return hiac::aspect_ratio(corners());
    case radius_ratio:
      return hiac::radius_ratio(corners());
    case condition:
      return hiac::condition(corners(), hand);
    case scaled_jacobian:
      return hiac::scaled_jacobian(corners(), hand);
    case jacobian_ratio:
      return hiac::jacobian_ratio(mesh, cell, hand);
  }
  return kUndefined;
}

}  // namespace hiac
