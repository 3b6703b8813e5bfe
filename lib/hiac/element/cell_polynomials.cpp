#include "hiac/element/cell_polynomials.hpp"

#include <algorithm>
#include <vector>

#include "hiac/element/field_along_ray.hpp"
#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

// Converts Bernstein coefficients to those of powers along one coordinate: binomial(p, k) times the
// k-th difference.
void to_powers(CubePolynomial& f, std::size_t stride) {
  constexpr std::array<std::array<double, 4>, 4> kBinomial{{{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}}};
  const std::size_t p = f.degree, n = p + 1;
  for (std::size_t layer = 0; layer < n * n * n; layer += n * stride)
    for (std::size_t first = layer; first < layer + stride; ++first) {
      double* c = f.c.data() + first;
      for (std::size_t r = 1; r <= p; ++r)
        for (std::size_t i = p; i >= r; --i) c[i * stride] -= c[(i - 1) * stride];
      for (std::size_t k = 1; k < p; ++k) c[k * stride] *= kBinomial[p][k];
    }
}

// Whether v, or w, is counted from where the cell tapers.
bool is_width_v(CellShape shape) {
  return shape == CellShape::tetrahedron || shape == CellShape::prism || shape == CellShape::wedge;
}
bool is_width_w(CellShape shape) {
  return shape == CellShape::tetrahedron || shape == CellShape::pyramid ||
         shape == CellShape::wedge;
}

CubePolynomial from_coefficients(CellKind kind, const InterpolantCoefficients& b) {
  CubePolynomial f;
  f.degree = static_cast<std::size_t>(order_of(kind));
  const std::size_t n = f.degree + 1;
  const bool turn_v = is_width_v(shape_of(kind)), turn_w = is_width_w(shape_of(kind));
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t row = (turn_w ? f.degree - k : k) * n + (turn_v ? f.degree - j : j);
      std::copy_n(b.c.begin() + static_cast<std::ptrdiff_t>(row * n), n,
                  f.c.begin() + static_cast<std::ptrdiff_t>((k * n + j) * n));
    }
  for (const std::size_t stride : {std::size_t{1}, f.degree + 1, (f.degree + 1) * (f.degree + 1)})
    to_powers(f, stride);
  return f;
}

// The shape functions of a kind, except that of the first node.
std::vector<CubePolynomial> shape_polynomials(CellKind kind) {
  std::vector<CubePolynomial> of_node(node_count(kind));
  std::array<double, kMaxNodesPerCell> values{};
  for (std::size_t k = 1; k < of_node.size(); ++k) {
    values[k] = 1;
    of_node[k] = from_coefficients(kind, interpolant_coefficients(kind, values));
    values[k] = 0;
  }
  return of_node;
}

// The polynomial of values that are zero at the first node.
CubePolynomial cube_polynomial(CellKind kind, std::span<const double> values) {
  static const auto kShapes = [] {
    std::vector<std::vector<CubePolynomial>> shapes;
    for (std::size_t k = 0; k < kKindCount; ++k)
      shapes.push_back(shape_polynomials(static_cast<CellKind>(k)));
    return shapes;
  }();
  const auto& of_node = kShapes[static_cast<std::size_t>(kind)];
  CubePolynomial f;
  f.degree = static_cast<std::size_t>(order_of(kind));
  add_shares(
      of_node.size(), (f.degree + 1) * (f.degree + 1) * (f.degree + 1),
      [&](std::size_t k) { return of_node[k].c.data(); }, values, f.c);
  return f;
}

CellPolynomials::Field field_polynomial(CellKind kind, const CellField& field) {
  std::array<double, kMaxNodesPerCell> values;
  for (std::size_t k = 0; k < node_count(kind); ++k) values[k] = field.values[k] - field.values[0];
  return {cube_polynomial(kind, values), field.values[0], field.least, field.most, field.allowed};
}

// Finds the inverse of A and the twist (twisted_pyramid) of a pyramid's map, in which x, y, q and z
// are u w, v w, u v w and 1 - w.
void untwist(const std::array<CubePolynomial, 3>& position, std::array<Vector, 3>& inverse,
             Vector& twist) {
  const auto column = [&](std::size_t k) {
    return Vector{position[0].c[k], position[1].c[k], position[2].c[k]};
  };
  const Vector x = column(5), y = column(6), q = column(7);
  const Vector down = column(4), z{-down[0], -down[1], -down[2]};
  const double determinant = dot(x, cross(y, z));
  inverse = {cross(y, z), cross(z, x), cross(x, y)};
  for (std::size_t i = 0; i < 3; ++i) {
    for (double& entry : inverse[i]) entry /= determinant;
    twist[i] = dot(inverse[i], q);
  }
}

}  // namespace

// Degrees and pole orders by order. The number of factors x y / (1 - z), or
// x (1 - y) / (2 - y - z), in shape functions is that of an edge on a triangle
// (shape_functions.cpp).
LineQuotient quotient_along_lines(CellKind kind) {
  constexpr std::array<LineQuotient, 3> kPyramids{{{2, 1}, {3, 1}, {5, 2}}};
  constexpr std::array<LineQuotient, 3> kWedges{{{3, 1}, {5, 2}, {7, 3}}};
  const auto order = static_cast<std::size_t>(order_of(kind)) - 1;
  if (shape_of(kind) == CellShape::pyramid) return kPyramids[order];
  if (shape_of(kind) == CellShape::wedge) return kWedges[order];
  return {degree_along_lines(kind), 0};
}

std::array<double, 3> collapsed(CellShape shape, const std::array<double, 3>& xi) {
  const auto& [x, y, z] = xi;
  const auto over = [](double a, double b) { return b == 0 ? 0.5 : a / b; };
  switch (shape) {
    case CellShape::tetrahedron:
      return {over(x, 1 - y - z), over(1 - y - z, 1 - z), 1 - z};
    case CellShape::pyramid:
      return {over(x, 1 - z), over(y, 1 - z), 1 - z};
    case CellShape::prism:
      return {over(x, 1 - y), 1 - y, z};
    case CellShape::wedge:
      return {over(x, 2 - y - z), 1 - y, 1 - z};
    case CellShape::brick:
      break;
  }
  return xi;
}

CellPolynomials::CellPolynomials(CellKind kind, std::span<const CellMap::Point> nodes,
                                 const CellMap& map, std::span<const CellField> cell_fields)
    : shape(shape_of(kind)),
      along_lines(map.affine() ? quotient_along_lines(kind) : LineQuotient{0, 0}),
      origin(nodes[0]),
      affine(map.affine()),
      twisted_pyramid(!affine && map.straight() && shape == CellShape::pyramid),
      inverse(map.inverse_in_middle()),
      twist{},
      of_reference(shape == CellShape::prism && map.straight()),
      middle(collapsed(shape, map.middle())),
      steepness(map.steepness()),
      field_count(cell_fields.size()) {
  if (of_reference) middle[0] = map.middle()[0];
  for (std::size_t f = 0; f < field_count; ++f) fields[f] = field_polynomial(kind, cell_fields[f]);
  if (affine) return;
  const CellKind map_kind = map.straight() ? kind_of(shape, CellOrder::linear) : kind;
  for (std::size_t a = 0; a < 3; ++a) {
    std::array<double, kMaxNodesPerCell> coordinate;
    for (std::size_t k = 0; k < node_count(map_kind); ++k) coordinate[k] = nodes[k][a] - origin[a];
    position[a] = cube_polynomial(map_kind, coordinate);
    if (!of_reference) continue;
    // x = u v: coefficients of u v and u v w become those of x and x w
    for (const std::size_t k : {std::size_t{0}, std::size_t{4}}) {
      position[a].c[k + 1] = position[a].c[k + 3];
      position[a].c[k + 3] = 0;
    }
  }
  if (twisted_pyramid) untwist(position, inverse, twist);
}

}  // namespace hiac
