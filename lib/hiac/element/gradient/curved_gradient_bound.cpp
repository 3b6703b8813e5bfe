#include "hiac/element/gradient/curved_gradient_bound.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hiac/base/binomial.hpp"
#include "hiac/base/rounding.hpp"
#include "hiac/base/special_values.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/interpolant_range.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

// The number of parts of a cell that are examined before giving up.
constexpr std::size_t kMostParts = 73;
// Rounding of a product of three derivatives, relative to the product of their largest
// coefficients: coefficients are means of at most 343 products of products.
constexpr double kProductRounding = 512 * kUnit;

// The coefficients of four polynomials, side by side: they are multiplied at once.
using Four = std::array<double, 4>;

// Polynomials on the cube, as their Bernstein coefficients times the three binomial coefficients:
// products of polynomials are plain convolutions of these. The first coordinate runs fastest.
struct Polynomials {
  std::array<std::size_t, 3> size{};  // degrees + 1
  std::vector<Four> c;

  explicit Polynomials(const std::array<std::size_t, 3>& sizes)
      : size(sizes), c(sizes[0] * sizes[1] * sizes[2]) {}
};

// Visits all pairs of a coefficient of `a` and a row of `b`, with the place in `sum` where the
// products of the two begin.
template <typename Visit>
void for_rows(const Polynomials& a, const Polynomials& b, Polynomials& sum, const Visit& visit) {
  const Four* of_a = a.c.data();
  for (std::size_t k = 0; k < a.size[2]; ++k)
    for (std::size_t j = 0; j < a.size[1]; ++j)
      for (std::size_t i = 0; i < a.size[0]; ++i, ++of_a) {
        const Four* row = b.c.data();
        for (std::size_t n = 0; n < b.size[2]; ++n)
          for (std::size_t m = 0; m < b.size[1]; ++m, row += b.size[0])
            visit(*of_a, row, &sum.c[((k + n) * sum.size[1] + j + m) * sum.size[0] + i]);
      }
}

// The vector product of the coordinates' derivatives, and its first component again.
Polynomials cofactors(const Polynomials& a, const Polynomials& b) {
  const auto together = [&](std::size_t c) { return a.size[c] + b.size[c] - 1; };
  Polynomials product({together(0), together(1), together(2)});
  for_rows(a, b, product, [&](const Four& p, const Four* row, Four* sum) {
    for (std::size_t i = 0; i < b.size[0]; ++i) {
      const Four& q = row[i];
      const double first = p[1] * q[2] - p[2] * q[1];
      const Four vector{first, p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0], first};
      for (std::size_t c = 0; c < 4; ++c) sum[i][c] += vector[c];
    }
  });
  return product;
}

// Adds one column's part of the determinants, expanded along the row that is not in the cofactors:
// that of the field in the numerators, and that of the first coordinate in the determinant.
void add_expansion(const Polynomials& derivatives, const Polynomials& cofactor, Polynomials& sum) {
  for_rows(derivatives, cofactor, sum, [&](const Four& d, const Four* row, Four* to) {
    const Four factor{d[3], d[3], d[3], d[0]};
    for (std::size_t i = 0; i < cofactor.size[0]; ++i)
      for (std::size_t c = 0; c < 4; ++c) to[i][c] += factor[c] * row[i][c];
  });
}

// The coordinates of a part of a cell and a field on it, in Bernstein form on the cube.
struct Part {
  std::array<std::array<double, InterpolantCoefficients::kMost>, 4> net;
  bool at_v = true, at_w = true;  // whether v, w reach 1
};

class Bound {
 public:
  Bound(CellKind kind, std::span<const Vector> nodes, std::span<const double> values)
      : shape_(shape_of(kind)), side_(static_cast<std::size_t>(order_of(kind)) + 1) {
    for (std::size_t c = 0; c < 4; ++c) {
      std::array<double, kMaxNodesPerCell> relative;
      for (std::size_t k = 0; k < node_count(kind); ++k)
        relative[k] = c < 3 ? nodes[k][c] - nodes[0][c] : values[k] - values[0];
      const InterpolantCoefficients of_cell = interpolant_coefficients(kind, relative);
      whole_.net[c] = of_cell.c;
      rounding_[c] = of_cell.rounding;
    }
    const std::size_t degree = 3 * (side_ - 1) - 1;
    for (std::size_t i = 0; i <= degree; ++i) binomials_[i] = binomial(degree, i);
  }

  double largest() {
    std::vector<Part> doubtful;
    judge(whole_, doubtful);
    for (std::size_t looked_at = 1; !doubtful.empty();) {
      const Part part = doubtful.back();
      doubtful.pop_back();
      for (unsigned which = 0; which < 8; ++which) {
        if (++looked_at > kMostParts) return kInfinity;
        judge(octant(part, which), doubtful);
      }
    }
    return steepest_;
  }

 private:
  [[nodiscard]] std::size_t count() const { return side_ * side_ * side_; }

  // The octant of a part given by the bits of `which`, one half per axis: De Casteljau's algorithm
  // in the middle.
  [[nodiscard]] Part octant(Part part, unsigned which) const {
    std::size_t stride = 1;
    for (unsigned axis = 0; axis < 3; ++axis, stride *= side_) {
      const bool upper = ((which >> axis) & 1U) != 0;
      for (auto& net : part.net)
        for (std::size_t first = 0; first < count(); ++first) {
          if (first / stride % side_ != 0) continue;
          const auto at = [&](std::size_t k) -> double& { return net[first + k * stride]; };
          for (std::size_t level = 1; level < side_; ++level)
            for (std::size_t k = 0; k + level < side_; ++k) {
              const std::size_t i = upper ? k : side_ - 1 - k;
              at(i) = 0.5 * (at(i) + at(upper ? i + 1 : i - 1));
            }
        }
    }
    part.at_v = part.at_v && (which & 2U) != 0;
    part.at_w = part.at_w && (which & 4U) != 0;
    return part;
  }

  // The derivatives of a part's nets by one of the cube's coordinates; `largest`: of each net, the
  // largest coefficient of a derivative so far.
  [[nodiscard]] Polynomials derivatives(const Part& part, std::size_t axis, Four& largest) const {
    std::array<std::size_t, 3> size{side_, side_, side_};
    --size[axis];
    Polynomials result(size);
    const std::size_t stride = axis == 0 ? 1 : axis == 1 ? side_ : side_ * side_;
    std::size_t at = 0;
    for (std::size_t k = 0; k < size[2]; ++k)
      for (std::size_t j = 0; j < size[1]; ++j)
        for (std::size_t i = 0; i < size[0]; ++i, ++at) {
          const std::size_t from = (k * side_ + j) * side_ + i;
          const double scale =
              binomial(size[0] - 1, i) * binomial(size[1] - 1, j) * binomial(size[2] - 1, k);
          for (std::size_t c = 0; c < 4; ++c) {
            const double slope = part.net[c][from + stride] - part.net[c][from];
            largest[c] = std::max(largest[c], std::abs(slope));
            result.c[at][c] = slope * scale;
          }
        }
    return result;
  }

  void judge(const Part& part, std::vector<Part>& doubtful) {
    Four largest{};
    const std::array<Polynomials, 3> d{derivatives(part, 0, largest), derivatives(part, 1, largest),
                                       derivatives(part, 2, largest)};
    const std::size_t all = 3 * (side_ - 1);
    Polynomials sum({all, all, all});
    for (std::size_t a = 0; a < 3; ++a)
      add_expansion(d[a], cofactors(d[(a + 1) % 3], d[(a + 2) % 3]), sum);
    compare(part, sum, largest, doubtful);
  }

  // `sum`: the numerators of the gradient's three components, and the determinant.
  void compare(const Part& part, const Polynomials& sum, const Four& largest,
               std::vector<Part>& doubtful) {
    const double d_rounding = rounding_of({0, 1, 2}, largest);
    const double n_rounding = rounding_of({3, 1, 2}, largest) + rounding_of({0, 3, 2}, largest) +
                              rounding_of({0, 1, 3}, largest);
    const std::size_t all = sum.size[0];
    if (sign_ == 0) sign_ = sum.c[sum.c.size() / 2][3] < 0 ? -1 : 1;
    double steepest = 0;
    const Four* coefficients = sum.c.data();
    for (std::size_t k = 0; k < all; ++k)
      for (std::size_t j = 0; j < all; ++j, coefficients += all) {
        if (vanishes(part, j, k)) continue;
        for (std::size_t i = 0; i < all; ++i) {
          const auto& [x, y, z, determinant] = coefficients[i];
          const double scale = binomials_[i] * binomials_[j] * binomials_[k];
          const double below = sign_ * determinant - scale * d_rounding;
          if (!(below > 0)) return doubtful.push_back(part);
          steepest = std::max(steepest, (length({x, y, z}) + scale * n_rounding) / below);
        }
      }
    steepest_ = std::max(steepest_, (1 + 16 * kUnit) * steepest);
  }

  // The rounding error of a determinant of three rows: six products of differences.
  [[nodiscard]] double rounding_of(const std::array<std::size_t, 3>& rows,
                                   const Four& largest) const {
    const auto [a, b, c] = rows;
    const auto off = [&](std::size_t row) { return 2 * rounding_[row] + 8 * kUnit * largest[row]; };
    return 12 * (off(a) * largest[b] * largest[c] + largest[a] * off(b) * largest[c] +
                 largest[a] * largest[b] * off(c)) +
           6 * kProductRounding * largest[a] * largest[b] * largest[c];
  }

  // Whether the coefficient is 0 in every cell because of the collapse, whose determinant is (1 -
  // v) (1 - w)^2 in tetrahedra, (1 - w)^2 in pyramids, 1 - v in prisms, 2 - v - w in wedges.
  [[nodiscard]] bool vanishes(const Part& part, std::size_t j, std::size_t k) const {
    const std::size_t last = 3 * (side_ - 1) - 1;
    const bool v = part.at_v && j == last, w = part.at_w && k == last;
    const bool w_twice = part.at_w && k + 1 >= last;
    switch (shape_) {
      case CellShape::tetrahedron:
        return v || w_twice;
      case CellShape::pyramid:
        return w_twice;
      case CellShape::prism:
        return v;
      case CellShape::wedge:
        return v && w;
      case CellShape::brick:
        break;
    }
    return false;
  }

  CellShape shape_;
  std::size_t side_;  // of the nets: the order + 1
  Part whole_;
  Four rounding_{};                    // of the coefficients
  std::array<double, 9> binomials_{};  // of the determinants' degree in each coordinate
  double sign_ = 0, steepest_ = 0;
};

}  // namespace

double curved_gradient_bound(CellKind kind, std::span<const Vector> nodes,
                             std::span<const double> values) {
  return Bound(kind, nodes, values).largest();
}

}  // namespace hiac
