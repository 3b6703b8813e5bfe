#include "hiac/geometry/jacobian_sign.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hiac/geometry/bernstein_domain.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

using Factor = BernsteinDomain::Factor;
using Point = std::array<double, 3>;

// The result is undecided after this many parts of a cell.
constexpr std::size_t kMostParts = 4096;

// The polynomial's domain: simplices and their products are used as they are; pyramids and wedges
// are collapsed from a brick, which is their domain.
BernsteinDomain make_domain(CellKind kind) {
  const auto n = static_cast<std::size_t>(order_of(kind));
  switch (shape_of(kind)) {
    case CellShape::tetrahedron:
      return BernsteinDomain(std::array{Factor{3, 3 * n - 3}});
    case CellShape::prism:
      // the derivatives in the triangle are of degree n - 1 there and n along the prism; the
      // derivative along the prism is of degree n in the triangle and n - 1 along the prism
      return BernsteinDomain(std::array{Factor{2, 3 * n - 2}, Factor{1, 3 * n - 1}});
    case CellShape::pyramid:
    case CellShape::wedge:
    case CellShape::brick:
      break;
  }
  return BernsteinDomain(
      std::array{Factor{1, 3 * n - 1}, Factor{1, 3 * n - 1}, Factor{1, 3 * n - 1}});
}

// The reference point that belongs to a point of the domain, and the determinant of the map from
// the domain to the reference cell.
struct ReferencePoint {
  Point xi;
  double factor;
};

ReferencePoint reference_point(CellShape shape, const Point& p) {
  const auto& [u, v, w] = p;
  if (shape == CellShape::pyramid) {
    const double rest = 1 - w;
    return {{u * rest, v * rest, w}, rest * rest};
  }
  if (shape == CellShape::wedge) {
    const double rest = 2 - v - w;
    return {{u * rest, v, w}, rest};
  }
  return {p, 1};
}

// A part of the domain: the image of the whole domain under an affine map.
struct Part {
  Point origin;
  std::array<Point, 3> axes;

  [[nodiscard]] Point at(const Point& p) const {
    Point q = origin;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t a = 0; a < 3; ++a) q[c] += p[a] * axes[a][c];
    return q;
  }
  // Composes the maps: the image of `child`, a part of the whole domain, in this part.
  [[nodiscard]] Part of(const Part& child) const {
    Part part{at(child.origin), {}};
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        for (std::size_t c = 0; c < 3; ++c) part.axes[a][c] += child.axes[a][b] * axes[b][c];
    return part;
  }
};

constexpr Part kWhole{{0, 0, 0}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};

// The four triangles into which the midpoints of its edges divide a triangle.
struct PlanePart {
  std::array<double, 2> origin, u, v;
};
constexpr std::array<PlanePart, 4> kTriangleParts{{{{0, 0}, {0.5, 0}, {0, 0.5}},
                                                   {{0.5, 0}, {0.5, 0}, {0, 0.5}},
                                                   {{0, 0.5}, {0.5, 0}, {0, 0.5}},
                                                   {{0.5, 0.5}, {-0.5, 0}, {0, -0.5}}}};

std::vector<Part> tetrahedron_parts() {
  // one tetrahedron at each corner, and four around a diagonal of the octahedron that remains (J.
  // Bey, 1995)
  const std::array<Point, 10> p{{{0, 0, 0},
                                 {1, 0, 0},
                                 {0, 1, 0},
                                 {0, 0, 1},
                                 {0.5, 0, 0},
                                 {0, 0.5, 0},
                                 {0, 0, 0.5},
                                 {0.5, 0.5, 0},
                                 {0.5, 0, 0.5},
                                 {0, 0.5, 0.5}}};
  constexpr std::array<std::array<std::size_t, 4>, 8> kParts{{{0, 4, 5, 6},
                                                              {4, 1, 7, 8},
                                                              {5, 7, 2, 9},
                                                              {6, 8, 9, 3},
                                                              {4, 5, 6, 8},
                                                              {4, 5, 7, 8},
                                                              {5, 6, 8, 9},
                                                              {5, 7, 8, 9}}};
  std::vector<Part> parts;
  for (const auto& c : kParts)
    parts.push_back(
        {p[c[0]], {minus(p[c[1]], p[c[0]]), minus(p[c[2]], p[c[0]]), minus(p[c[3]], p[c[0]])}});
  return parts;
}

std::vector<Part> make_parts(CellShape shape) {
  if (shape == CellShape::tetrahedron) return tetrahedron_parts();
  std::vector<Part> parts;
  for (const double w : {0.0, 0.5}) {
    if (shape == CellShape::prism) {
      for (const PlanePart& t : kTriangleParts)
        parts.push_back({{t.origin[0], t.origin[1], w},
                         {{{t.u[0], t.u[1], 0}, {t.v[0], t.v[1], 0}, {0, 0, 0.5}}}});
      continue;
    }
    for (const double v : {0.0, 0.5})
      for (const double u : {0.0, 0.5})
        parts.push_back({{u, v, w}, {{{0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}}}});
  }
  return parts;
}

using Gradients = std::array<Point, kMaxNodesPerCell>;

// What all cells of a kind share.
struct KindTables {
  BernsteinDomain domain;
  std::vector<Part> parts;
  std::vector<Gradients> gradients;  // at the points of the whole domain
  std::vector<double> factors;       // at the same points

  explicit KindTables(CellKind kind)
      : domain(make_domain(kind)), parts(make_parts(shape_of(kind))) {
    for (const Point& p : domain.points()) {
      const auto [xi, factor] = reference_point(shape_of(kind), p);
      shape_gradients<double>(kind, xi, gradients.emplace_back());
      factors.push_back(factor);
    }
  }
};

const KindTables& tables_of(CellKind kind) {
  static const std::vector<KindTables> kTables = [] {
    std::vector<KindTables> tables;
    for (std::size_t k = 0; k < kKindCount; ++k) tables.emplace_back(static_cast<CellKind>(k));
    return tables;
  }();
  return kTables[static_cast<std::size_t>(kind)];
}

class Judge {
 public:
  Judge(CellKind kind, std::span<const Point> nodes, double tolerance)
      : kind_(kind), tables_(tables_of(kind)), tolerance_(tolerance) {
    for (std::size_t k = 0; k < node_count(kind); ++k) at_[k] = minus(nodes[k], nodes[0]);
    values_.resize(tables_.domain.size());
  }

  JacobianSign verdict() {
    for (std::size_t k = 0; k < values_.size(); ++k) {
      values_[k] = tables_.factors[k] * determinant(tables_.gradients[k]);
      size_ = std::max(size_, tables_.factors[k] * box_);
    }
    std::vector<Part> doubtful;
    if (!(size_ > 0)) return std::isfinite(size_) ? JacobianSign::flat : JacobianSign::undecided;
    judge(kWhole, doubtful);
    std::size_t looked_at = 1;
    while (!doubtful.empty() && !(positive_ && negative_)) {
      const Part part = doubtful.back();
      doubtful.pop_back();
      for (const Part& child : tables_.parts) {
        if (++looked_at > kMostParts) return JacobianSign::undecided;
        const Part smaller = part.of(child);
        sample(smaller);
        judge(smaller, doubtful);
      }
    }
    if (positive_ && negative_) return JacobianSign::mixed;
    if (positive_) return JacobianSign::positive;
    return negative_ ? JacobianSign::negative : JacobianSign::flat;
  }

 private:
  // Returns the determinant and leaves the product of the columns' lengths in box_.
  double determinant(const Gradients& gradients) {
    Vector x{}, y{}, z{};
    for (std::size_t k = 1; k < node_count(kind_); ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        x[c] += gradients[k][0] * at_[k][c];
        y[c] += gradients[k][1] * at_[k][c];
        z[c] += gradients[k][2] * at_[k][c];
      }
    box_ = std::sqrt(dot(x, x) * dot(y, y) * dot(z, z));
    return dot(x, cross(y, z));
  }

  void sample(const Part& part) {
    Gradients gradients;
    for (std::size_t k = 0; k < values_.size(); ++k) {
      const auto [xi, factor] =
          reference_point(shape_of(kind_), part.at(tables_.domain.points()[k]));
      shape_gradients<double>(kind_, xi, gradients);
      values_[k] = factor * determinant(gradients);
    }
  }

  // Decides on a part from the values sampled there, and adds it to `doubtful` if it must be
  // divided.
  void judge(const Part& part, std::vector<Part>& doubtful) {
    const double zero = tolerance_ * size_;
    const auto [low, high] = std::ranges::minmax(values_);
    positive_ = positive_ || high > zero;
    negative_ = negative_ || low < -zero;
    tables_.domain.to_coefficients(values_);
    const auto [least, most] = std::ranges::minmax(values_);
    if (least < -zero && most > zero)
      doubtful.push_back(part);
    else if (least < -zero)
      negative_ = true;
    else if (most > zero)
      positive_ = true;
  }

  CellKind kind_;
  const KindTables& tables_;
  double tolerance_;
  std::array<Vector, kMaxNodesPerCell> at_;
  std::vector<double> values_;
  double size_ = 0, box_ = 0;
  bool positive_ = false, negative_ = false;
};

}  // namespace

JacobianSign jacobian_sign(CellKind kind, std::span<const Point> nodes, double tolerance) {
  return Judge(kind, nodes, tolerance).verdict();
}

}  // namespace hiac
