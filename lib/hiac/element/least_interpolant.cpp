#include "hiac/element/least_interpolant.hpp"

#include <cmath>

#include <Eigen/QR>
#include <Eigen/SVD>

#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

constexpr std::size_t kMost = LeastInterpolant::kMostPoints;
constexpr std::size_t kTerms = LeastInterpolant::kMostTerms;
constexpr std::size_t kDegree = LeastInterpolant::kMostDegree;

constexpr double kLeastPivot = 1e-10;
constexpr double kLeastSeen = 0.25;

// The number of monomials below a degree.
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

// Computes the coordinates of mean 0 and covariance 1: with the QR factorisation P = Q R of the
// points minus their mean, y = sqrt(n) R^-T p. Returns false if the points lie in a plane to within
// kLeastPivot.
bool normalise(std::span<const Vector> points, LeastInterpolant& result) {
  const auto n = static_cast<double>(points.size());
  for (const Vector& p : points)
    for (std::size_t i = 0; i < 3; ++i) result.mean[i] += p[i] / n;
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kMost, 3> from_mean(points.size(), 3);
  for (Eigen::Index k = 0; k < from_mean.rows(); ++k)
    for (Eigen::Index i = 0; i < 3; ++i)
      from_mean(k, i) = points[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)] -
                        result.mean[static_cast<std::size_t>(i)];
  const double largest = from_mean.colwise().norm().maxCoeff();
  const Eigen::Matrix3d r =
      from_mean.householderQr().matrixQR().topRows<3>().triangularView<Eigen::Upper>();
  if (!(r.diagonal().cwiseAbs().minCoeff() > kLeastPivot * largest)) return false;
  const Eigen::Matrix3d rows = r.transpose().triangularView<Eigen::Lower>().solve(
      std::sqrt(n) * Eigen::Matrix3d::Identity());
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t a = 0; a < 3; ++a)
      result.rows[i][a] = rows(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a));
  return true;
}

// The functionals: for each a row, its values on the scaled monomials, and its result on the given
// values.
class Functionals {
 public:
  // Starts with one functional per point: the value there.
  Functionals(std::span<const Vector> points, std::span<const double> values,
              const LeastInterpolant& frame)
      : rows_(points.size(), kTerms),
        values_(Eigen::Map<const Eigen::VectorXd>(values.data(), rows_.rows())) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      std::array<std::array<double, kDegree + 1>, 3> power;
      for (std::size_t i = 0; i < 3; ++i) {
        const double y = dot(frame.rows[i], minus(points[k], frame.mean));
        power[i][0] = 1;
        for (std::size_t e = 1; e <= kDegree; ++e) power[i][e] = power[i][e - 1] * y;
      }
      for (std::size_t a = 0; a < kTerms; ++a) {
        const auto& [ex, ey, ez] = kMonomials[a];
        rows_(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(a)) =
            scales()[a] * power[0][ex] * power[1][ey] * power[2][ez];
      }
    }
  }

  // Replaces the functionals by an orthonormal basis: the rows V = R^T Q^T by those of Q^T. Returns
  // false if the rows are linearly dependent.
  bool orthonormalise() {
    const Eigen::MatrixXd transposed = rows_.transpose();
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(transposed);
    const Eigen::Index n = rows_.rows();
    const Eigen::MatrixXd r = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
    for (Eigen::Index k = 0; k < n; ++k)
      if (!(std::abs(r(k, k)) > kLeastPivot * transposed.col(k).norm())) return false;
    rows_ = (qr.householderQ() * Eigen::MatrixXd::Identity(transposed.rows(), n)).transpose();
    values_ = r.transpose().triangularView<Eigen::Lower>().solve(values_);
    return true;
  }

  // Rotates the remaining functionals to the left singular vectors of their rows in a degree, and
  // selects those with singular values above a threshold: each of them sees a form.
  void see(std::size_t degree, double threshold) {
    const Eigen::Index left = rows_.rows() - seen_;
    if (left == 0) return;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(
        rows_.block(seen_, first_of(degree), left, first_of(degree + 1) - first_of(degree)),
        Eigen::ComputeFullU);
    rows_.bottomRows(left) = (svd.matrixU().transpose() * rows_.bottomRows(left)).eval();
    values_.tail(left) = (svd.matrixU().transpose() * values_.tail(left)).eval();
    for (const double size : svd.singularValues()) {
      if (!(size > threshold)) break;
      degrees_[static_cast<std::size_t>(seen_++)] = degree;
    }
  }

  // Computes the sum of forms on which every functional has the same result as on the values.
  void solve(LeastInterpolant& result) const {
    Eigen::VectorXd c = Eigen::VectorXd::Zero(kTerms);
    for (Eigen::Index k = seen_; k-- > 0;) {
      // rows of higher degrees vanish on forms of lower degrees
      const std::size_t degree = degrees_[static_cast<std::size_t>(k)];
      const Eigen::Index from = first_of(degree), to = first_of(degree + 1);
      const double rest =
          values_[k] - rows_.row(k).tail(c.size() - from).dot(c.tail(c.size() - from));
      const auto form = rows_.row(k).segment(from, to - from);
      c.segment(from, to - from) += rest / form.squaredNorm() * form.transpose();
    }
    for (std::size_t a = 0; a < kTerms; ++a)
      result.c[a] = scales()[a] * c[static_cast<Eigen::Index>(a)];
    result.degree = degrees_[static_cast<std::size_t>(seen_ - 1)];
  }

 private:
  static Eigen::Index first_of(std::size_t degree) {
    return static_cast<Eigen::Index>(below(degree));
  }

  Eigen::MatrixXd rows_;
  Eigen::VectorXd values_;
  Eigen::Index seen_ = 0;
  std::array<std::size_t, kMost> degrees_{};
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
  Functionals functionals(points, values, result);
  if (!functionals.orthonormalise()) return std::nullopt;
  for (std::size_t degree = 0; degree < kDegree; ++degree)
    functionals.see(degree, degree <= complete ? kLeastPivot : kLeastSeen);
  // nearly all of the remaining rows lies in degree 5
  functionals.see(kDegree, 0);
  functionals.solve(result);
  return result;
}

}  // namespace hiac
