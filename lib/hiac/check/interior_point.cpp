#include "hiac/check/interior_point.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "hiac/check/box_tree.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

constexpr double kNowhere = -std::numeric_limits<double>::infinity();

// The reference cell of a shape.
struct ReferenceCell {
  std::vector<std::array<double, 4>>
      planes;  // inward unit normal, and minus its product on the face
  std::vector<Vector> samples;
  Vector middle{};
};

Vector mean_of(std::span<const std::array<double, 3>> nodes, std::span<const std::uint8_t> which) {
  Vector mean{};
  for (const std::uint8_t n : which)
    for (std::size_t c = 0; c < 3; ++c) mean[c] += nodes[n][c] / static_cast<double>(which.size());
  return mean;
}

ReferenceCell make_reference(CellShape shape) {
  ReferenceCell cell;
  const ShapeTopology& topology = topology_of(shape);
  const auto nodes = reference_nodes(kind_of(shape, CellOrder::linear));
  for (const auto& node : nodes)
    for (std::size_t c = 0; c < 3; ++c)
      cell.middle[c] += node[c] / static_cast<double>(nodes.size());
  std::vector<Vector> outside(nodes.begin(), nodes.end());
  for (const ShapeEdge& edge : topology.edges) outside.push_back(mean_of(nodes, edge));
  for (const ShapeFace& face : topology.faces) {
    const Vector &a = nodes[face.corners[0]], &b = nodes[face.corners[1]],
                 &c = nodes[face.corners[2]];
    const Vector inwards = unit(cross(minus(c, a), minus(b, a)));
    cell.planes.push_back({inwards[0], inwards[1], inwards[2], -dot(inwards, a)});
    outside.push_back(mean_of(nodes, std::span(face.corners).first(face.corner_count)));
  }
  cell.samples.push_back(cell.middle);
  for (const double part : {0.5, 0.9, 0.99})
    for (const Vector& p : outside) {
      Vector x;
      for (std::size_t c = 0; c < 3; ++c) x[c] = cell.middle[c] + part * (p[c] - cell.middle[c]);
      cell.samples.push_back(x);
    }
  return cell;
}

const ReferenceCell& reference_cell(CellShape shape) {
  static const std::array<ReferenceCell, kShapeCount> kTable = [] {
    std::array<ReferenceCell, kShapeCount> table;
    for (std::size_t s = 0; s < kShapeCount; ++s)
      table[s] = make_reference(static_cast<CellShape>(s));
    return table;
  }();
  return kTable[static_cast<std::size_t>(shape)];
}

// A cell with its map and its box.
class MappedCell {
 public:
  MappedCell(const ZooMesh& mesh, CellId cell)
      : kind_(mesh.kinds[cell]),
        count_(node_count(kind_)),
        reference_(reference_cell(shape_of(kind_))) {
    const auto nodes = mesh.cell_nodes(cell);
    for (std::size_t k = 0; k < count_; ++k) {
      const auto p = mesh.position(nodes[k]);
      nodes_[k] = {p[0], p[1], p[2]};
      box_.include(p);
    }
    size_ = length(minus(box_.high, box_.low));
  }

  [[nodiscard]] const ReferenceCell& reference() const { return reference_; }

  [[nodiscard]] Vector position(const Vector& xi) const {
    std::array<double, kMaxNodesPerCell> values{};
    shape_functions<double>(kind_, xi, values);
    Vector x{};
    for (std::size_t n = 0; n < count_; ++n)
      for (std::size_t c = 0; c < 3; ++c) x[c] += values[n] * nodes_[n][c];
    return x;
  }

  // The distance of a reference point from the reference cell's faces, negative outside of it.
  [[nodiscard]] double depth_of_reference(const Vector& xi) const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [x, y, z, offset] : reference_.planes)
      least = std::min(least, x * xi[0] + y * xi[1] + z * xi[2] + offset);
    return least;
  }

  // The same of a point of the world; kNowhere where Newton's iteration from the middle does not
  // lead to it, or where it is far away.
  [[nodiscard]] double depth_of(const Vector& x) const {
    constexpr double kResidual = 1e-9, kFar = 2;
    constexpr int kSteps = 12;
    for (std::size_t c = 0; c < 3; ++c)
      if (x[c] < box_.low[c] - 0.1 * size_ || x[c] > box_.high[c] + 0.1 * size_) return kNowhere;
    Vector xi = reference_.middle;
    for (int step = 0; step < kSteps; ++step) {
      const Vector off = minus(x, position(xi));
      if (length(off) <= kResidual * size_) return depth_of_reference(xi);
      const Vector by = towards(xi, off);
      for (std::size_t c = 0; c < 3; ++c) xi[c] += by[c];
      if (!(length(minus(xi, reference_.middle)) < kFar)) return kNowhere;
    }
    return kNowhere;
  }

 private:
  // The change of reference coordinates that moves the point by `off`, to first order.
  [[nodiscard]] Vector towards(const Vector& xi, const Vector& off) const {
    std::array<Vector, kMaxNodesPerCell> gradients{};
    shape_gradients<double>(kind_, xi, gradients);
    std::array<Vector, 3> columns{};
    for (std::size_t n = 0; n < count_; ++n)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t c = 0; c < 3; ++c) columns[j][c] += gradients[n][j] * nodes_[n][c];
    const auto& [u, v, w] = columns;
    const double det = dot(u, cross(v, w));
    return {dot(off, cross(v, w)) / det, dot(off, cross(w, u)) / det, dot(off, cross(u, v)) / det};
  }

  CellKind kind_;
  std::size_t count_;
  std::array<Vector, kMaxNodesPerCell> nodes_{};
  const ReferenceCell& reference_;
  Box box_ = Box::empty();
  double size_;
};

// A point of one cell, by its reference coordinates there, and its depth in both.
struct Candidate {
  Vector xi;
  double depth = kNowhere;
};

double depth_in_both(const MappedCell& a, const MappedCell& b, const Vector& xi) {
  const double own = a.depth_of_reference(xi);
  return own > 0 ? std::min(own, b.depth_of(a.position(xi))) : kNowhere;
}

// The deepest of the sample points of a; the first that is deep enough.
Candidate best_sample(const MappedCell& a, const MappedCell& b, double enough) {
  Candidate best;
  for (const Vector& xi : a.reference().samples) {
    const double depth = depth_in_both(a, b, xi);
    if (depth > best.depth) best = {xi, depth};
    if (depth > enough) break;
  }
  return best;
}

// Steps along the axes as long as they lead deeper, then shorter ones.
void climb(const MappedCell& a, const MappedCell& b, double enough, Candidate& best) {
  for (double step = 0.125; step > 1e-4 && best.depth <= enough;) {
    Candidate next = best;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const double by : {step, -step}) {
        Vector xi = best.xi;
        xi[axis] += by;
        const double depth = depth_in_both(a, b, xi);
        if (depth > next.depth) next = {xi, depth};
      }
    // a gain that is small for the step is none: it might go on for ever
    const bool gains = next.depth > best.depth + 0.1 * step;
    if (next.depth > best.depth) best = next;
    if (!gains) step /= 2;
  }
}

}  // namespace

std::optional<InteriorPoint> common_interior_point(const ZooMesh& mesh, CellId a, CellId b) {
  // what is deeper than `kEnough` need not be looked at further
  constexpr double kLeast = 1e-5, kEnough = 1e-3, kHopeless = -0.3;
  const MappedCell of_a(mesh, a), of_b(mesh, b);
  std::optional<InteriorPoint> found;
  for (const bool swapped : {false, true}) {
    const MappedCell &from = swapped ? of_b : of_a, &to = swapped ? of_a : of_b;
    Candidate best = best_sample(from, to, kEnough);
    if (best.depth > kHopeless) climb(from, to, kEnough, best);
    if (best.depth > kLeast && (!found || best.depth > found->depth))
      found = InteriorPoint{from.position(best.xi), best.depth};
    if (found && found->depth > kEnough) break;
  }
  return found;
}

}  // namespace hiac
