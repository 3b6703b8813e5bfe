#include "hiac/element/least_interpolant.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

constexpr std::size_t kMost = LeastInterpolant::kMostPoints;
constexpr std::size_t kTerms = LeastInterpolant::kMostTerms;
constexpr std::size_t kDegree = LeastInterpolant::kMostDegree;

constexpr double kLeastPivot = 1e-10;
constexpr double kLeastSeen = 0.25;

// Rows have size 1: products below this are rounding.
constexpr double kOrthogonal = 1e-15;
constexpr int kMostSweeps = 30;

// How many monomials are of less than a degree.
constexpr std::size_t below(std::size_t degree) { return degree * (degree + 1) * (degree + 2) / 6; }
static_assert(below(kDegree + 1) == kTerms);

constexpr std::array<Exponents, kTerms> kMonomials = [] {
  std::array<Exponents, kTerms> all{};
  std::size_t next = 0;
  for (std::size_t degree = 0; degree <= kDegree; ++degree)
    for (std::size_t z = 0; z <= degree; ++z)
      for (std::size_t y = 0; y + z <= degree; ++y)
        all[next++] = {static_cast<std::uint8_t>(degree - y - z), static_cast<std::uint8_t>(y),
                       static_cast<std::uint8_t>(z)};
  return all;
}();

// 1 / sqrt(a!) of every monomial.
const std::array<double, kTerms>& scales() {
  static const std::array<double, kTerms> all = [] {
    constexpr std::array<double, kDegree + 1> kFactorial{1, 1, 2, 6, 24, 120};
    std::array<double, kTerms> scale;
    for (std::size_t i = 0; i < kTerms; ++i) {
      const auto& [x, y, z] = kMonomials[i];
      scale[i] = 1 / std::sqrt(kFactorial[x] * kFactorial[y] * kFactorial[z]);
    }
    return scale;
  }();
  return all;
}

// What a functional makes of the scaled monomials, and, last, of the values.
using Row = std::array<double, kTerms + 1>;

double product(const Row& a, const Row& b, std::size_t from = 0, std::size_t to = kTerms) {
  double sum = 0;
  for (std::size_t i = from; i < to; ++i) sum += a[i] * b[i];
  return sum;
}

void add(Row& to, double factor, const Row& row) {
  for (std::size_t i = 0; i < row.size(); ++i) to[i] += factor * row[i];
}

// The coordinates of mean 0 and covariance 1, by Gram and Schmidt, twice.
bool normalise(std::span<const Vector> points, LeastInterpolant& result) {
  const auto n = static_cast<double>(points.size());
  for (const Vector& p : points)
    for (std::size_t i = 0; i < 3; ++i) result.mean[i] += p[i] / n;
  std::array<std::array<double, kMost>, 3> y{};
  const auto mean_product = [&](std::size_t i, std::size_t j) {
    double sum = 0;
    for (std::size_t k = 0; k < points.size(); ++k) sum += y[i][k] * y[j][k];
    return sum / n;
  };
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < points.size(); ++k) y[i][k] = points[k][i] - result.mean[i];
    largest = std::max(largest, std::sqrt(mean_product(i, i)));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    result.rows[i][i] = 1;
    for (std::size_t step = 0; step < 2 * i; ++step) {
      const std::size_t j = step % i;
      const double part = mean_product(i, j);
      for (std::size_t k = 0; k < points.size(); ++k) y[i][k] -= part * y[j][k];
      for (std::size_t a = 0; a < 3; ++a) result.rows[i][a] -= part * result.rows[j][a];
    }
    const double size = std::sqrt(mean_product(i, i));
    if (!(size > kLeastPivot * largest)) return false;
    for (std::size_t k = 0; k < points.size(); ++k) y[i][k] /= size;
    for (double& entry : result.rows[i]) entry /= size;
  }
  return true;
}

class Elimination {
 public:
  Elimination(std::span<const Vector> points, std::span<const double> values,
              const LeastInterpolant& frame)
      : count_(points.size()), rows_(points.size()) {
    for (std::size_t k = 0; k < count_; ++k) {
      std::array<std::array<double, kDegree + 1>, 3> power;
      for (std::size_t i = 0; i < 3; ++i) {
        const double y = dot(frame.rows[i], minus(points[k], frame.mean));
        power[i][0] = 1;
        for (std::size_t e = 1; e <= kDegree; ++e) power[i][e] = power[i][e - 1] * y;
      }
      for (std::size_t a = 0; a < kTerms; ++a) {
        const auto& [ex, ey, ez] = kMonomials[a];
        rows_[k][a] = scales()[a] * power[0][ex] * power[1][ey] * power[2][ez];
      }
      rows_[k][kTerms] = values[k];
    }
  }

  // False where the rows depend on each other.
  bool orthonormalise() {
    for (std::size_t k = 0; k < count_; ++k) {
      Row& row = rows_[k];
      const double before = std::sqrt(product(row, row));
      for (std::size_t step = 0; step < 2 * k; ++step) {
        const Row& other = rows_[step % k];
        add(row, -product(row, other), other);
      }
      const double size = std::sqrt(product(row, row));
      if (!(size > kLeastPivot * before)) return false;
      for (double& entry : row) entry /= size;
    }
    return true;
  }

  // Brings those of the functionals left that see forms of a degree to the front of them.
  void see(std::size_t degree, double threshold) {
    take_columns(degree);
    make_columns_orthogonal();
    std::ranges::sort(columns_, std::ranges::greater{}, size_squared);
    const std::size_t first = seen_;
    for (std::size_t j = 0; j < columns_.size() && seen_ < count_; ++j) {
      if (!(size_squared(columns_[j]) > threshold * threshold)) break;
      reflect(j, seen_ - first);
      degrees_[seen_++] = degree;
    }
  }

  // The sum of forms that the functionals make of it what they make of the values.
  void solve(LeastInterpolant& result) const {
    Row c{};
    for (std::size_t k = seen_; k-- > 0;) {
      // rows of higher degrees do not see forms of lower ones
      const Row& row = rows_[k];
      const std::size_t from = below(degrees_[k]), to = below(degrees_[k] + 1);
      const double left = row[kTerms] - product(row, c, from);
      const double factor = left / product(row, row, from, to);
      for (std::size_t a = from; a < to; ++a) c[a] += factor * row[a];
    }
    for (std::size_t a = 0; a < kTerms; ++a) result.c[a] = scales()[a] * c[a];
    result.degree = degrees_[seen_ - 1];
  }

 private:
  // A monomial as the functionals left see it.
  using Column = std::array<double, kMost>;

  static double column_product(const Column& a, const Column& b) {
    double sum = 0;
    for (std::size_t k = 0; k < kMost; ++k) sum += a[k] * b[k];
    return sum;
  }
  static double size_squared(const Column& column) { return column_product(column, column); }

  void take_columns(std::size_t degree) {
    columns_.assign(below(degree + 1) - below(degree), {});
    for (std::size_t k = seen_; k < count_; ++k)
      for (std::size_t j = 0; j < columns_.size(); ++j)
        columns_[j][k - seen_] = rows_[k][below(degree) + j];
  }

  // One-sided Jacobi rotations (M. R. Hestenes, "Inversion of matrices by biorthogonalization and
  // related results", Journal of the SIAM 6, 1958): columns become left singular vectors times
  // singular values.
  void make_columns_orthogonal() {
    bool turned = true;
    for (int sweep = 0; turned && sweep < kMostSweeps; ++sweep) {
      turned = false;
      for (std::size_t i = 0; i < columns_.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) turned = turn(columns_[i], columns_[j]) || turned;
    }
  }

  // Whether two columns had to be turned.
  static bool turn(Column& a, Column& b) {
    const double ab = column_product(a, b);
    if (!(std::abs(ab) > kOrthogonal)) return false;
    const double ratio = (size_squared(b) - size_squared(a)) / (2 * ab);
    const double tangent = std::copysign(1 / (std::abs(ratio) + std::hypot(1, ratio)), ratio);
    const double cosine = 1 / std::hypot(1, tangent), sine = cosine * tangent;
    for (std::size_t k = 0; k < kMost; ++k) {
      const double old = a[k];
      a[k] = cosine * old - sine * b[k];
      b[k] = sine * old + cosine * b[k];
    }
    return true;
  }

  // Householder's reflection of the functionals left, from the one at `at` on, that takes a column
  // to that one.
  void reflect(std::size_t j, std::size_t at) {
    Column axis = columns_[j];
    std::fill_n(axis.begin(), at, 0.0);
    axis[at] += std::copysign(std::sqrt(size_squared(axis)), axis[at]);
    const double half = size_squared(axis) / 2;
    const std::size_t left = count_ - seen_;
    Row sum{};
    for (std::size_t k = 0; k < left; ++k) add(sum, axis[at + k] / half, rows_[seen_ + k]);
    for (std::size_t k = 0; k < left; ++k) add(rows_[seen_ + k], -axis[at + k], sum);
    for (std::size_t i = j + 1; i < columns_.size(); ++i) {
      const double part = column_product(axis, columns_[i]) / half;
      for (std::size_t k = 0; k < kMost; ++k) columns_[i][k] -= part * axis[k];
    }
  }

  std::size_t count_, seen_ = 0;
  std::vector<Row> rows_;
  std::array<std::size_t, kMost> degrees_{};
  std::vector<Column> columns_;
};

}  // namespace

std::span<const Exponents> monomials(std::size_t degree) {
  return std::span(kMonomials).first(below(degree + 1));
}

std::optional<LeastInterpolant> least_interpolant(std::span<const Vector> points,
                                                  std::span<const double> values,
                                                  std::size_t complete) {
  LeastInterpolant result;
  if (!normalise(points, result)) return std::nullopt;
  Elimination elimination(points, values, result);
  if (!elimination.orthonormalise()) return std::nullopt;
  for (std::size_t degree = 0; degree < kDegree; ++degree)
    elimination.see(degree, degree <= complete ? kLeastPivot : kLeastSeen);
  // of degree 5 is nearly all of what is left
  elimination.see(kDegree, 0);
  elimination.solve(result);
  return result;
}

}  // namespace hiac
