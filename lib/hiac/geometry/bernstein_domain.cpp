#include "hiac/geometry/bernstein_domain.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace hiac {
namespace {

using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Exponents of a simplex's barycentric coordinates in a Bernstein polynomial. They add up to the
// degree; entry 3 belongs to the coordinate that the others leave to 1.
using Exponents = std::array<std::size_t, 4>;

std::vector<Exponents> exponents_of(const BernsteinDomain::Factor& factor) {
  const std::size_t n = factor.degree;
  std::vector<Exponents> all;
  for (std::size_t k = 0; k <= (factor.dimensions > 2 ? n : 0); ++k)
    for (std::size_t j = 0; j + k <= (factor.dimensions > 1 ? n : k); ++j)
      for (std::size_t i = 0; i + j + k <= n; ++i) all.push_back({i, j, k, n - i - j - k});
  return all;
}

long double power(long double x, std::size_t n) {
  long double product = 1;
  for (std::size_t k = 0; k < n; ++k) product *= x;
  return product;
}

long double factorial(std::size_t n) { return n < 2 ? 1 : n * factorial(n - 1); }

// The value of a Bernstein polynomial at the grid point `at` / degree.
long double bernstein(const Exponents& e, const Exponents& at, std::size_t degree) {
  long double value = factorial(degree);
  for (std::size_t c = 0; c < 4; ++c)
    value *= power(static_cast<long double>(at[c]) / static_cast<long double>(degree), e[c]) /
             factorial(e[c]);
  return value;
}

}  // namespace

BernsteinDomain::BernsteinDomain(std::span<const Factor> factors) : points_{{}} {
  std::size_t first = 0;
  for (const Factor& factor : factors) {
    const std::vector<Exponents> exponents = exponents_of(factor);
    const std::size_t n = exponents.size();
    // the Bernstein polynomials at the grid points make a well conditioned matrix
    const auto size = static_cast<Eigen::Index>(n);
    Matrix matrix(size, size);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            factor.degree == 0 ? 1 : bernstein(exponents[j], exponents[i], factor.degree);
    const Matrix inverse = matrix.partialPivLu().inverse();
    Block block{n, {inverse.data(), inverse.data() + inverse.size()}};
    double most = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < n; ++j) sum += std::abs(block.inverse[i * n + j]);
      most = std::max(most, sum);
    }
    condition_ *= most;
    // later factors have the larger stride
    std::vector<std::array<double, 3>> points;
    for (const Exponents& e : exponents)
      for (std::array<double, 3> point : points_) {
        for (std::size_t d = 0; d < factor.dimensions; ++d)
          point[first + d] = factor.degree == 0
                                 ? 0
                                 : static_cast<double>(e[d]) / static_cast<double>(factor.degree);
        points.push_back(point);
      }
    points_ = std::move(points);
    blocks_.push_back(std::move(block));
    first += factor.dimensions;
  }
}

void BernsteinDomain::to_coefficients(std::span<double> values) const {
  std::vector<double> line;
  std::size_t stride = 1;
  for (const Block& block : blocks_) {
    const std::size_t n = block.size, run = stride * n;
    line.resize(n);
    for (std::size_t begin = 0; begin < values.size(); begin += run)
      for (std::size_t at = begin; at < begin + stride; ++at) {
        for (std::size_t i = 0; i < n; ++i) line[i] = values[at + i * stride];
        for (std::size_t i = 0; i < n; ++i) {
          double sum = 0;
          for (std::size_t j = 0; j < n; ++j) sum += block.inverse[i * n + j] * line[j];
          values[at + i * stride] = sum;
        }
      }
    stride = run;
  }
}

}  // namespace hiac
