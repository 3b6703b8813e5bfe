#include "hiac/geometry/bezier_patch.hpp"

namespace hiac {
namespace {

// Lagrange's polynomial of node i among `degree` + 1 evenly spaced nodes on [0, 1].
double lagrange(std::size_t degree, std::size_t i, double u) {
  double product = 1;
  const auto n = static_cast<double>(degree), at = static_cast<double>(i);
  for (std::size_t k = 0; k <= degree; ++k)
    if (k != i) product *= (n * u - static_cast<double>(k)) / (at - static_cast<double>(k));
  return product;
}

// The shape function of a triangle's node, in barycentric coordinates L. Without a centre node, the
// centre's function is distributed over the corners and edge nodes.
double on_triangle(const PatchShape& shape, std::size_t node, double u, double v) {
  const std::array<double, 3> l{1 - u - v, u, v};
  const double centre = shape.degree == 3 ? 27 * l[0] * l[1] * l[2] : 0;
  const double share = shape.centre ? 0 : centre;
  if (node < 3) {
    const double a = l[node];
    if (shape.degree == 1) return a;
    if (shape.degree == 2) return a * (2 * a - 1);
    return 0.5 * a * (3 * a - 1) * (3 * a - 2) - share / 6;
  }
  const std::size_t per_edge = shape.degree - std::size_t{1};
  if (node == 3 + 3 * per_edge) return centre;
  const std::size_t edge = (node - 3) / per_edge, k = (node - 3) % per_edge;
  const double a = l[edge], b = l[(edge + 1) % 3];
  if (shape.degree == 2) return 4 * a * b;
  return 4.5 * a * b * (3 * (k == 0 ? a : b) - 1) + share / 4;
}

// The serendipity functions are those of Coons' patch: linear blends of opposite edges, minus the
// bilinear interpolant of the corners, which both blends contain.
double on_quadrilateral(const PatchShape& shape, std::size_t node, double u, double v) {
  const std::size_t n = shape.degree;
  if (node < 4) {
    const std::size_t i = node == 1 || node == 2 ? n : 0, j = node >= 2 ? n : 0;
    const double x = i == 0 ? 1 - u : u, y = j == 0 ? 1 - v : v;
    return lagrange(n, i, u) * y + lagrange(n, j, v) * x - x * y;
  }
  const std::size_t edge = (node - 4) / (n - 1), k = (node - 4) % (n - 1) + 1;
  switch (edge) {
    case 0:
      return lagrange(n, k, u) * (1 - v);
    case 1:
      return lagrange(n, k, v) * u;
    case 2:
      return lagrange(n, n - k, u) * v;
    default:
      return lagrange(n, n - k, v) * (1 - u);
  }
}

// Matrices that give Bernstein coefficients from values at evenly spaced points, by degree.
constexpr std::array<std::array<std::array<double, 4>, 4>, 3> kCoefficients{
    {{{{1, 0}, {0, 1}}},
     {{{1, 0, 0}, {-0.5, 2, -0.5}, {0, 0, 1}}},
     {{{1, 0, 0, 0}, {-5.0 / 6, 3, -1.5, 1.0 / 3}, {1.0 / 3, -1.5, 3, -5.0 / 6}, {0, 0, 0, 1}}}}};

PatchWeights make_weights(const PatchShape& shape) {
  const std::size_t n = shape.degree, side = n + 1;
  const auto& c = kCoefficients[n - 1];
  PatchWeights weights{};
  for (std::size_t node = 0; node < shape.node_count(); ++node)
    for (std::size_t q = 0; q < side; ++q)
      for (std::size_t p = 0; p < side; ++p) {
        const double u = static_cast<double>(p) / static_cast<double>(n),
                     v = static_cast<double>(q) / static_cast<double>(n);
        const double here =
            shape.triangle ? on_triangle(shape, node, u, v) : on_quadrilateral(shape, node, u, v);
        for (std::size_t j = 0; j < side; ++j)
          for (std::size_t i = 0; i < side; ++i)
            weights[i + side * j][node] += c[i][p] * c[j][q] * here;
      }
  return weights;
}

}  // namespace

const PatchWeights& patch_weights(const PatchShape& shape) {
  static const std::array<PatchWeights, 7> kWeights{
      make_weights({1, false, false}), make_weights({2, false, false}),
      make_weights({3, false, false}), make_weights({1, true, false}),
      make_weights({2, true, false}),  make_weights({3, true, false}),
      make_weights({3, true, true})};
  if (shape.centre) return kWeights[6];
  return kWeights[(shape.triangle ? 3U : 0U) + shape.degree - 1U];
}

}  // namespace hiac
