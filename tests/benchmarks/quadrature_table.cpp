// Gaussian quadrature or power series for bounded error? The paper leaves it open (section 2): both
// behind one interface, to the same proven bound, on what integrand a piece of a ray has,
//
//     integral of p(y) exp(-A(y)) over [-1, 1],   p = kappa tau, A' = tau (length / 2),
//
// with kappa and tau polynomials of the field's degree. Prints for each degree and optical depth
// the nodes or terms that either takes, the nanoseconds to choose their number and to integrate,
// and the largest error over what was allowed.
//
// The power series are those of K. Novins and J. Arvo, "Controlled Precision Volume Integration",
// 1992: E = exp(-A) solves E' = -A' E, which gives its Taylor coefficients by a recurrence without
// an exponential but the first. Their remainder bounds the highest derivative step by step; here it
// is Cauchy's estimate on the best of several discs, which is sharper.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <limits>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/gauss_legendre.hpp"

namespace {

constexpr std::size_t kMostDegree = 10;  // of p, for fields of degree 5
constexpr std::size_t kMostTerms = 160;

// Monomial coefficients about the middle of the piece.
struct Integrand {
  std::size_t degree_p = 0, degree_a = 0;
  std::array<double, kMostDegree + 1> p{}, a{};
};

// How many nodes or terms (0: too many), and the bound of the error with them.
struct Choice {
  std::size_t count = 0;
  double bound = 0;
};

double horner(const std::array<double, kMostDegree + 1>& c, std::size_t degree, double y) {
  double value = c[degree];
  for (std::size_t k = degree; k-- > 0;) value = value * y + c[k];
  return value;
}

// A bound of |p exp(-A)| where |y| <= radius.
double largest(const Integrand& f, double radius) {
  double p = 0, a = -f.a[0], power = 1;
  for (std::size_t k = 0; k <= kMostDegree; ++k, power *= radius) {
    if (k <= f.degree_p) p += std::abs(f.p[k]) * power;
    if (k > 0 && k <= f.degree_a) a += std::abs(f.a[k]) * power;
  }
  return p * std::exp(a);
}

// The fewest of some numbers of nodes or terms that keep front rho^(-rate count) <= allowed.
class Fewest {
 public:
  Fewest(double allowed, double rate, std::size_t most)
      : allowed_(allowed), rate_(rate), most_(static_cast<double>(most)), fewest_(most_ + 1) {}

  void consider(double rho, double front) {
    const double needed =
        std::max(1.0, std::ceil(std::log(front / allowed_) / (rate_ * std::log(rho))));
    if (!(needed < fewest_)) return;
    fewest_ = needed;
    bound_ = front * std::pow(rho, -rate_ * needed);
  }
  [[nodiscard]] Choice choice() const {
    return fewest_ > most_ ? Choice{} : Choice{static_cast<std::size_t>(fewest_), bound_};
  }

 private:
  double allowed_, rate_, most_, fewest_, bound_ = 0;
};

struct Gauss {
  // On the Bernstein ellipse of parameter rho |y| is at most (rho + 1 / rho) / 2.
  static Choice choose(const Integrand& f, double allowed) {
    Fewest fewest(allowed, 2, hiac::kMaxGaussNodes);
    for (const double rho : {2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0})
      fewest.consider(rho, 64.0 / 15 / (1 - 1 / (rho * rho)) * largest(f, (rho + 1 / rho) / 2));
    return fewest.choice();
  }
  static double integrate(const Integrand& f, std::size_t nodes) {
    const hiac::GaussRule rule = hiac::gauss_legendre(nodes);
    double sum = 0;
    for (std::size_t k = 0; k < nodes; ++k)
      sum += rule.weights[k] * horner(f.p, f.degree_p, rule.nodes[k]) *
             std::exp(-horner(f.a, f.degree_a, rule.nodes[k]));
    return sum;
  }
};

struct PowerSeries {
  // The coefficients of p exp(-A) are at most M rho^-k, so that what is left out of the integral is
  // at most 2 M rho^-N / (1 - 1 / rho).
  static Choice choose(const Integrand& f, double allowed) {
    Fewest fewest(allowed, 1, kMostTerms);
    for (const double rho : {1.5, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0})
      fewest.consider(rho, 2 / (1 - 1 / rho) * largest(f, rho));
    return fewest.choice();
  }
  static double integrate(const Integrand& f, std::size_t terms) {
    std::array<double, kMostTerms> e;
    e[0] = std::exp(-f.a[0]);
    for (std::size_t k = 1; k < terms; ++k) {
      double sum = 0;
      for (std::size_t j = 1; j <= std::min(k, f.degree_a); ++j)
        sum += static_cast<double>(j) * f.a[j] * e[k - j];
      e[k] = -sum / static_cast<double>(k);
    }
    double value = 0;
    for (std::size_t k = 0; k < terms; k += 2) {
      double term = 0;
      for (std::size_t j = 0; j <= std::min(k, f.degree_p); ++j) term += f.p[j] * e[k - j];
      value += 2 * term / static_cast<double>(k + 1);
    }
    return value;
  }
};

// A piece of random fields of one degree, with kappa <= 1 and some optical depth.
Integrand piece(std::size_t degree, double depth, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::array<double, 6> tau{}, kappa{};
  // mostly straight, as on a short way through a cell
  for (std::size_t k = 0; k <= degree; ++k) {
    const double size = k == 0 ? 1 : 0.7 * std::pow(0.3, static_cast<double>(k - 1));
    tau[k] = k == 0 ? 1 : size * (unit(random) - 0.5);
    kappa[k] = k == 0 ? 0.5 : 0.5 * size * (unit(random) - 0.5);
  }
  Integrand f;
  f.degree_p = 2 * degree;
  f.degree_a = degree + 1;
  for (std::size_t i = 0; i <= degree; ++i)
    for (std::size_t j = 0; j <= degree; ++j) f.p[i + j] += depth / 2 * tau[i] * kappa[j];
  double at_front = 0;
  for (std::size_t k = 0; k <= degree; ++k) {
    f.a[k + 1] = depth / 2 * tau[k] / static_cast<double>(k + 1);
    at_front += (k % 2 == 0 ? -1 : 1) * f.a[k + 1];
  }
  f.a[0] = -at_front;
  return f;
}

struct Measured {
  double choosing = 0, integrating = 0;  // ns
  double count = 0, largest_error = 0;   // the latter over what is allowed
};

// Processor time of some work on a piece, the least of several runs.
template <typename Work>
double nanoseconds(const std::vector<Integrand>& pieces, const Work& work) {
  constexpr int kRuns = 15, kRepetitions = 20;
  double least = std::numeric_limits<double>::infinity(), sum = 0;
  for (int run = 0; run < kRuns; ++run) {
    const std::clock_t start = std::clock();
    for (int r = 0; r < kRepetitions; ++r)
      for (std::size_t i = 0; i < pieces.size(); ++i) sum += work(i);
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  if (!std::isfinite(sum)) fmt::print("not finite\n");
  return 1e9 * least / kRepetitions / static_cast<double>(pieces.size());
}

template <typename Rule>
Measured measure(const std::vector<Integrand>& pieces, double allowed) {
  Measured m;
  std::vector<std::size_t> counts;
  for (const Integrand& f : pieces) counts.push_back(Rule::choose(f, allowed).count);
  m.choosing =
      nanoseconds(pieces, [&](std::size_t i) { return Rule::choose(pieces[i], allowed).bound; });
  m.integrating =
      nanoseconds(pieces, [&](std::size_t i) { return Rule::integrate(pieces[i], counts[i]); });
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    m.count += static_cast<double>(counts[i]) / static_cast<double>(pieces.size());
    const double exact = Gauss::integrate(pieces[i], hiac::kMaxGaussNodes);
    m.largest_error = std::max(m.largest_error,
                               std::abs(Rule::integrate(pieces[i], counts[i]) - exact) / allowed);
  }
  return m;
}

}  // namespace

int main() {
  fmt::print(
      "                       | Gauss                              | power series\n"
      "degree  depth  allowed | nodes  choice  integral  error     | terms  choice  integral  "
      "error\n");
  std::mt19937_64 random(1);
  for (const std::size_t degree : {1U, 2U, 3U, 5U})
    for (const double depth : {0.03, 0.3, 3.0})
      for (const double allowed : {1e-6, 1e-10, 1e-14}) {
        std::vector<Integrand> pieces;
        for (int k = 0; k < 200; ++k) pieces.push_back(piece(degree, depth, random));
        const Measured g = measure<Gauss>(pieces, allowed);
        const Measured s = measure<PowerSeries>(pieces, allowed);
        fmt::print("{:6} {:6} {:8.0e}", degree, depth, allowed);
        for (const Measured& m : {g, s})
          fmt::print(" | {:5.1f} {:7.0f} {:9.0f}  {:9.1e}", m.count, m.choosing, m.integrating,
                     m.largest_error);
        fmt::print("\n");
      }
}
