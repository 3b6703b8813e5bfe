#pragma once

#include <array>
#include <cstddef>

#include "hiac/optics/bernstein.hpp"

namespace hiac {

/// Most nodes of the Gauss-Legendre rules that integrals of many segments at a time are made with.
inline constexpr std::size_t kMostLaneNodes = 12;

/// A Gauss-Legendre rule on [0, 1], applied to polynomials in Bernstein form: what coefficient i
/// has of the value, of the derivative, and of the integral from 0, at node k.
struct BernsteinRule {
  using Row = std::array<double, kMaxFieldDegree + 1>;
  std::array<double, kMostLaneNodes> weight{};
  std::array<Row, kMostLaneNodes> value{}, derivative{}, integral{};
};

/// degree <= kMaxFieldDegree, 1 <= nodes <= kMostLaneNodes.
const BernsteinRule& bernstein_rule(std::size_t degree, std::size_t nodes);

/// Matrices between bases of one degree, [to][from], on [0, 1].
struct BernsteinBases {
  using Matrix = std::array<std::array<double, kMaxFieldDegree + 1>, kMaxFieldDegree + 1>;
  Matrix from_chebyshev{}, to_chebyshev{};
};
const BernsteinBases& bernstein_bases(std::size_t degree);

/// What the bound of an integral's error needs of Bernstein ellipses (polynomial_piece.hpp), for
/// functions of t in [0, 1] with their Chebyshev coefficients.
struct EllipseTable {
  static constexpr std::size_t kCount = 6;
  using Row = std::array<double, kMaxFieldDegree + 2>;
  std::array<double, kCount> log_factor{};  ///< log(32/15 / (1 - rho^-2))
  std::array<double, kCount> rate{};        ///< 1 / (2 log rho)
  std::array<Row, kCount> value{};          ///< not less than |T_k|
  std::array<Row, kCount> derivative{};     ///< not less than |dT_k / dt|
};
const EllipseTable& ellipse_table();

}  // namespace hiac
