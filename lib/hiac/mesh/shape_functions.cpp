// Every kind is built in the same three steps:
//
//   1. The linear functions n_c of the corners: barycentric, trilinear, or rational (Bedrosian 1992
//      for the pyramid; the wedge is the trilinear brick in collapsed coordinates).
//   2. For every edge e = (a, b) a bubble B_e and a difference D_e along it. B_e vanishes on every
//      face without e; on a triangle it is L_a L_b, on a quadrilateral u(1-u)(1-v); D_e is L_a -
//      L_b and 1 - 2u there. The edge's nodes get
//          4 B_e                                       (quadratic)
//          9/4 B_e (1 + 3 D_e),  9/4 B_e (1 - 3 D_e)   (cubic: the node nearer to a, to b).
//   3. A corner's function is n_c minus its edges' functions, each times n_c at that edge's node.
//
// A function has the nodal property if it vanishes on the faces without its edge and has the right
// traces on those with it; by step 3, the functions inherit from the n_c that they sum to 1 and
// reproduce linear fields.
// For the brick these are the serendipity functions, for the tetrahedron and the prism those of
// Zienkiewicz and Taylor, The Finite Element Method, vol. 1, ch. 8, for the quadratic pyramid
// Bedrosian's; (15) of Williams, Max, Stein 1998 is the cubic tetrahedron's space, written below
// without these steps. The squares in the wedge's edges (2,3) and (4,5) are what Newton 1973
// (Int. J. Num. Meth. Eng. 6) and Bathe (Finite Element Procedures, 5.3.2) add to a collapsed
// quadratic brick so that a collapsed face carries a triangle's functions.
//
// Based on: G. Bedrosian, "Shape functions and integration formulas for three-dimensional finite
// element analysis", Int. J. Num. Meth. Eng. 35 (1992) 95-108.

#include "hiac/mesh/shape_functions.hpp"

#include <algorithm>
#include <type_traits>

namespace hiac {
namespace {

/// A number with its gradient, for forward differentiation.
template <typename Real>
struct Dual {
  Real value;
  std::array<Real, 3> gradient;

  Dual() = default;  // uninitialized, as arrays of these are filled at once
  Dual(Real v, const std::array<Real, 3>& g) : value(v), gradient(g) {}

  friend Dual operator+(const Dual& a, const Dual& b) {
    return {a.value + b.value, combine(1, a.gradient, 1, b.gradient)};
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return {a.value - b.value, combine(1, a.gradient, -1, b.gradient)};
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, combine(b.value, a.gradient, a.value, b.gradient)};
  }
  friend Dual operator-(const Dual& a) { return Real(-1) * a; }
  friend Dual operator-(Real a, const Dual& b) {
    return {a - b.value, {-b.gradient[0], -b.gradient[1], -b.gradient[2]}};
  }
  friend Dual operator-(const Dual& a, Real b) { return {a.value - b, a.gradient}; }
  friend Dual operator*(Real a, const Dual& b) {
    return {a * b.value, {a * b.gradient[0], a * b.gradient[1], a * b.gradient[2]}};
  }

  static std::array<Real, 3> combine(Real s, const std::array<Real, 3>& a, Real t,
                                     const std::array<Real, 3>& b) {
    return {s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]};
  }
};

/// The type of a number's constants.
template <typename T>
struct ConstantsOf {
  using Type = T;
};
template <typename Real>
struct ConstantsOf<Dual<Real>> {
  using Type = Real;
};
template <typename T>
using Constant = typename ConstantsOf<T>::Type;

/// The gradient of a function of three numbers, by its three partial derivatives.
template <typename Real>
Dual<Real> chain(Real value, const Dual<Real>& a, Real by_a, const Dual<Real>& b, Real by_b,
                 const Dual<Real>& c, Real by_c) {
  const auto ab = Dual<Real>::combine(by_a, a.gradient, by_b, b.gradient);
  return {value, Dual<Real>::combine(1, ab, by_c, c.gradient)};
}

/// Returns numerator / denominator, or a half if both are zero: the middle of the range 0 ... 1 of
/// a collapsed coordinate's quotient there.
template <typename Real>
Real collapsed_quotient(Real numerator, Real denominator) {
  return denominator == 0 ? Real(0.5) : numerator / denominator;
}

/// Returns x y / w, where x and y vanish with w.
template <typename Real>
Real product_over(Real x, Real y, Real w) {
  return collapsed_quotient(x, w) * y;
}
template <typename Real>
Dual<Real> product_over(const Dual<Real>& x, const Dual<Real>& y, const Dual<Real>& w) {
  const Real u = collapsed_quotient(x.value, w.value);
  const Real v = collapsed_quotient(y.value, w.value);
  return chain<Real>(u * y.value, x, v, y, u, w, -u * v);
}

/// Returns x p / (p + q), where x vanishes with p + q.
template <typename Real>
Real share_of(Real x, Real p, Real q) {
  return x * collapsed_quotient(p, p + q);
}
template <typename Real>
Dual<Real> share_of(const Dual<Real>& x, const Dual<Real>& p, const Dual<Real>& q) {
  const Real w = p.value + q.value;
  const Real xi = collapsed_quotient(x.value, w);
  const Real alpha = collapsed_quotient(p.value, w);
  return chain<Real>(x.value * alpha, x, alpha, p, xi * (1 - alpha), q, -xi * alpha);
}

/// B_e and D_e of one edge.
template <typename T>
struct EdgeBubble {
  T bubble;
  T difference;
};

/// The result of steps 1 and 2 for a shape, edges in the shape's order. The edges are uninitialized
/// unless they are requested.
template <typename T, std::size_t Corners, std::size_t Edges>
struct Basis {
  std::array<T, Corners> corners;
  std::array<EdgeBubble<T>, Edges> edges;
};

template <typename T>
using Point = std::array<T, 3>;

template <typename T>
Basis<T, 4, 6> tetrahedron_basis(const Point<T>& r, bool with_edges) {
  const std::array<T, 4> n{Constant<T>(1) - r[0] - r[1] - r[2], r[0], r[1], r[2]};
  Basis<T, 4, 6> basis;
  basis.corners = n;
  if (!with_edges) return basis;
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [a, b] = shape_tables::kTetrahedronEdges[e];
    basis.edges[e] = {n[a] * n[b], n[a] - n[b]};
  }
  return basis;
}

template <typename T>
Basis<T, 5, 8> pyramid_basis(const Point<T>& r, bool with_edges) {
  const auto& [x, y, z] = r;
  const T w = Constant<T>(1) - z;
  const T q = product_over(x, y, w);
  Basis<T, 5, 8> basis;
  basis.corners = {w - x - y + q, x - q, q, y - q, z};
  if (!with_edges) return basis;
  const auto& n = basis.corners;
  const T along_x = w - x - x;  // difference from x = 0 to x = w
  const T along_y = w - y - y;
  basis.edges = {{{x * n[0], along_x},
                  {y * n[1], along_y},
                  {x * n[3], -along_x},
                  {y * n[0], -along_y},
                  {z * n[0], n[0] - z},
                  {z * n[1], n[1] - z},
                  {z * n[2], n[2] - z},
                  {z * n[3], n[3] - z}}};
  return basis;
}

template <typename T>
Basis<T, 6, 9> prism_basis(const Point<T>& r, bool with_edges) {
  const std::array<T, 3> l{Constant<T>(1) - r[0] - r[1], r[1], r[0]};
  const T& top = r[2];
  const T bottom = Constant<T>(1) - top;
  Basis<T, 6, 9> basis;
  for (std::size_t i = 0; i < 3; ++i) {
    basis.corners[i] = l[i] * bottom;
    basis.corners[i + 3] = l[i] * top;
  }
  if (!with_edges) return basis;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const T bubble = l[i] * l[j];
    const T difference = l[i] - l[j];
    basis.edges[i] = {bubble * bottom, difference};
    basis.edges[i + 3] = {bubble * top, difference};
    basis.edges[i + 6] = {l[i] * bottom * top, bottom - top};
  }
  return basis;
}

/// Let w = 2 - y - z, and let xi = x / w be the coordinate of the brick. With t = xi (1-y) and
/// s = xi (1-z), everything is a polynomial of x, y, z and t.
template <typename T>
Basis<T, 7, 11> wedge_basis(const Point<T>& r, bool with_edges) {
  const auto& [x, y, z] = r;
  const T p = Constant<T>(1) - y;
  const T q = Constant<T>(1) - z;
  const T t = share_of(x, p, q);
  const T s = x - t;
  const T t0 = p - t;  // (1 - xi) (1 - y)
  const T s0 = q - s;  // (1 - xi) (1 - z)
  const T yz = y * z;
  Basis<T, 7, 11> basis;
  basis.corners = {t0 * q, t * q, y * s, y * s0, z * t0, z * t, yz};
  if (!with_edges) return basis;
  const auto& n = basis.corners;
  const T along_y = p - y;
  const T along_z = q - z;
  // (1 - 2 xi) (p + q - p q), which is 1 - 2 xi on both faces of edge (0,1) and smooth at node 6
  const T along_x = p + q - p * q - Constant<T>(2) * (x - t * q);
  basis.edges = {{{t * s0, along_x},
                  {y * n[1], along_y},
                  {y * s * s0, s - s0},
                  {y * n[0], -along_y},
                  {z * t * t0, t0 - t},
                  {yz * t, t - y},
                  {yz * t0, y - t0},
                  {z * n[0], along_z},
                  {z * n[1], along_z},
                  {yz * s, s - z},
                  {yz * s0, s0 - z}}};
  return basis;
}

template <typename T>
Basis<T, 8, 12> brick_basis(const Point<T>& r, bool with_edges) {
  // the reference coordinates of the corners are 0 or 1: factor[axis][coordinate]
  const std::array<std::array<T, 2>, 3> factor{{{Constant<T>(1) - r[0], r[0]},
                                                {Constant<T>(1) - r[1], r[1]},
                                                {Constant<T>(1) - r[2], r[2]}}};
  static constexpr std::array<std::array<std::uint8_t, 3>, 8> kCorners{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  Basis<T, 8, 12> basis;
  for (std::size_t c = 0; c < 4; ++c) {
    const T column = factor[0][kCorners[c][0]] * factor[1][kCorners[c][1]];
    basis.corners[c] = column * factor[2][0];
    basis.corners[c + 4] = column * factor[2][1];
  }
  if (!with_edges) return basis;
  for (std::size_t e = 0; e < 12; ++e) {
    const auto [a, b] = shape_tables::kBrickEdges[e];
    std::size_t axis = 0;
    while (kCorners[a][axis] == kCorners[b][axis]) ++axis;
    const T& at_a = factor[axis][kCorners[a][axis]];
    const T& at_b = factor[axis][kCorners[b][axis]];
    basis.edges[e] = {basis.corners[a] * at_b, at_a - at_b};
  }
  return basis;
}

/// Step 3.
template <typename T, std::size_t Corners, std::size_t Edges>
void assemble(const Basis<T, Corners, Edges>& basis, CellOrder order,
              const std::array<ShapeEdge, Edges>& edges, std::span<T> values) {
  std::ranges::copy(basis.corners, values.begin());
  if (order == CellOrder::linear) return;
  for (std::size_t e = 0; e < Edges; ++e) {
    const auto& [bubble, difference] = basis.edges[e];
    T& a = values[edges[e][0]];
    T& b = values[edges[e][1]];
    if (order == CellOrder::quadratic) {
      const T half = Constant<T>(2) * bubble;
      a = a - half;
      b = b - half;
      values[Corners + e] = half + half;
    } else {
      // 9/4 B (1 +- 3 D); two thirds of one plus one third of the other: 9/4 B (1 +- D)
      const T even = Constant<T>(2.25) * bubble;
      const T odd = even * difference;
      a = a - even - odd;
      b = b - even + odd;
      const T triple = Constant<T>(3) * odd;
      values[Corners + 2 * e] = even + triple;
      values[Corners + 2 * e + 1] = even - triple;
    }
  }
}

/// All of P3, (15): Lagrange's functions in barycentric coordinates.
template <typename T>
void cubic_tetrahedron(const Point<T>& r, std::span<T> values) {
  const std::array<T, 4> l{Constant<T>(1) - r[0] - r[1] - r[2], r[0], r[1], r[2]};
  for (std::size_t c = 0; c < 4; ++c)
    values[c] = Constant<T>(0.5) * l[c] * (Constant<T>(3) * l[c] - Constant<T>(1)) *
                (Constant<T>(3) * l[c] - Constant<T>(2));
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [a, b] = shape_tables::kTetrahedronEdges[e];
    const T bubble = Constant<T>(4.5) * l[a] * l[b];
    values[4 + 2 * e] = bubble * (Constant<T>(3) * l[a] - Constant<T>(1));
    values[5 + 2 * e] = bubble * (Constant<T>(3) * l[b] - Constant<T>(1));
  }
  for (std::size_t f = 0; f < 4; ++f) {
    const auto& corners = shape_tables::kTetrahedronFaces[f].corners;
    values[16 + f] = Constant<T>(27) * l[corners[0]] * l[corners[1]] * l[corners[2]];
  }
}

template <typename T>
void evaluate(CellKind kind, const Point<T>& r, std::span<T> values) {
  using namespace shape_tables;
  const CellOrder order = order_of(kind);
  switch (shape_of(kind)) {
    case CellShape::tetrahedron:
      if (order == CellOrder::cubic) return cubic_tetrahedron(r, values);
      return assemble(tetrahedron_basis(r, order != CellOrder::linear), order, kTetrahedronEdges,
                      values);
    case CellShape::pyramid:
      return assemble(pyramid_basis(r, order != CellOrder::linear), order, kPyramidEdges, values);
    case CellShape::prism:
      return assemble(prism_basis(r, order != CellOrder::linear), order, kPrismEdges, values);
    case CellShape::wedge:
      return assemble(wedge_basis(r, order != CellOrder::linear), order, kWedgeEdges, values);
    case CellShape::brick:
      return assemble(brick_basis(r, order != CellOrder::linear), order, kBrickEdges, values);
  }
}

using ReferenceNodes = std::array<std::array<double, 3>, kMaxNodesPerCell>;

constexpr std::array<std::array<std::array<double, 3>, 8>, kShapeCount> kReferenceCorners{
    {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
     {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}},
     {{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}}},
     {{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
     {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}}};

constexpr ReferenceNodes make_reference_nodes(CellKind kind) {
  ReferenceNodes nodes{};
  const auto& corners = kReferenceCorners[static_cast<std::size_t>(shape_of(kind))];
  const ShapeTopology& topology = topology_of(kind);
  std::size_t next = 0;
  for (; next < topology.corner_count; ++next) nodes[next] = corners[next];
  const int order = static_cast<int>(order_of(kind));
  for (const auto& [a, b] : topology.edges)
    for (int k = 1; k < order; ++k, ++next)
      for (std::size_t axis = 0; axis < 3; ++axis)
        nodes[next][axis] = ((order - k) * corners[a][axis] + k * corners[b][axis]) / order;
  if (kind != CellKind::tetrahedron20) return nodes;
  for (const ShapeFace& face : topology.faces) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      nodes[next][axis] = (corners[face.corners[0]][axis] + corners[face.corners[1]][axis] +
                           corners[face.corners[2]][axis]) /
                          3;
    ++next;
  }
  return nodes;
}

constexpr std::array<ReferenceNodes, kKindCount> kReferenceNodes = [] {
  std::array<ReferenceNodes, kKindCount> nodes{};
  for (std::size_t k = 0; k < kKindCount; ++k)
    nodes[k] = make_reference_nodes(static_cast<CellKind>(k));
  return nodes;
}();

}  // namespace

std::span<const std::array<double, 3>> reference_nodes(CellKind kind) {
  return std::span(kReferenceNodes[static_cast<std::size_t>(kind)]).first(node_count(kind));
}

template <typename Real>
void shape_functions(CellKind kind, const std::array<Real, 3>& xi, std::span<Real> values) {
  evaluate<Real>(kind, xi, values);
}

template <typename Real>
void shape_gradients(CellKind kind, const std::array<Real, 3>& xi,
                     std::span<std::array<Real, 3>> gradients) {
  const Point<Dual<Real>> r{Dual<Real>(xi[0], {1, 0, 0}), Dual<Real>(xi[1], {0, 1, 0}),
                            Dual<Real>(xi[2], {0, 0, 1})};
  std::array<Dual<Real>, kMaxNodesPerCell> values;
  evaluate<Dual<Real>>(kind, r, values);
  for (std::size_t i = 0; i < node_count(kind); ++i) gradients[i] = values[i].gradient;
}

template void shape_functions(CellKind, const std::array<double, 3>&, std::span<double>);
template void shape_functions(CellKind, const std::array<long double, 3>&, std::span<long double>);
template void shape_gradients(CellKind, const std::array<double, 3>&,
                              std::span<std::array<double, 3>>);
template void shape_gradients(CellKind, const std::array<long double, 3>&,
                              std::span<std::array<long double, 3>>);

}  // namespace hiac
