// Which coefficients the fields of a shape have, in the coordinates of CellPolynomials.

#include <hwy/highway.h>
// must come after highway.h
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/element/lanes/cube_polynomial-inl.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

TEST(CubePolynomials, HaveTheTermsOfShapeFunctionsAlone) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const CellShape shape : {CellShape::tetrahedron, CellShape::pyramid, CellShape::prism,
                                CellShape::wedge, CellShape::brick})
    for (const CellOrder order : {CellOrder::linear, CellOrder::quadratic, CellOrder::cubic}) {
      const CellKind kind = kind_of(shape, order);
      std::array<CellMap::Point, CellMap::kMostNodes> nodes{};
      std::ranges::copy(reference_nodes(kind), nodes.begin());
      const CellMap map(kind, nodes, 1e-10);
      CellField field{};
      for (std::size_t k = 0; k < node_count(kind); ++k) field.values[k] = number(random);
      const CellPolynomials cell(kind, nodes, map, std::span(&field, 1));
      const CubePolynomial& f = cell.fields[0].f;
      const std::size_t n = f.degree + 1;
      double left_out = 0;
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t j = 0; j < n; ++j)
          for (std::size_t i = HWY_NAMESPACE::terms_of_u(shape, f.degree, j, k); i < n; ++i)
            left_out = std::max(left_out, std::abs(f.c[(k * n + j) * n + i]));
      EXPECT_LE(left_out, 1e-13) << kind_name(kind);
      // at some points, with those terms alone
      for (int trial = 0; trial < 20; ++trial) {
        const double y = 0.9 * std::abs(number(random)),
                     z = (1 - y) * 0.9 * std::abs(number(random));
        const std::array<double, 3> xi{(1 - y - z) * std::abs(number(random)), y, z};
        std::array<double, kMaxNodesPerCell> weights;
        shape_functions<double>(kind, xi, weights);
        double expected = -field.values[0];
        for (std::size_t k = 0; k < node_count(kind); ++k) expected += weights[k] * field.values[k];
        const auto [u, v, w] = collapsed(shape, xi);
        double sum = 0;
        for (std::size_t k = 0; k < n; ++k)
          for (std::size_t j = 0; j < n; ++j)
            for (std::size_t i = 0; i < HWY_NAMESPACE::terms_of_u(shape, f.degree, j, k); ++i)
              sum += f.c[(k * n + j) * n + i] * std::pow(u, i) * std::pow(v, j) * std::pow(w, k);
        EXPECT_NEAR(sum, expected, 1e-13) << kind_name(kind);
      }
    }
}

}  // namespace
}  // namespace hiac
