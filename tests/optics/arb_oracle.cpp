#include "arb_oracle.hpp"

#include <array>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include <arb.h>
#include <arb_hypgeom.h>

namespace hiac::test {
namespace {

constexpr slong kFirstPrecision = 128;
constexpr slong kLastPrecision = 1 << 15;
constexpr slong kAccurateBits = 70;

/// A ball that frees itself.
class Ball {
 public:
  Ball() { arb_init(ball_); }
  explicit Ball(double x) : Ball() { arb_set_d(ball_, x); }
  Ball(const Ball& other) : Ball() { arb_set(ball_, other.ball_); }
  Ball& operator=(const Ball& other) {
    arb_set(ball_, other.ball_);
    return *this;
  }
  ~Ball() { arb_clear(ball_); }
  operator arb_ptr() { return ball_; }
  operator arb_srcptr() const { return ball_; }

 private:
  arb_t ball_;
};

/// Arithmetic at one precision.
struct Arithmetic {
  slong precision;

  using Function = void (*)(arb_t, const arb_t, slong);
  Ball apply(Function f, const Ball& x) const {
    Ball r;
    f(r, x, precision);
    return r;
  }
  Ball add(const Ball& x, const Ball& y) const { return binary(arb_add, x, y); }
  Ball sub(const Ball& x, const Ball& y) const { return binary(arb_sub, x, y); }
  Ball mul(const Ball& x, const Ball& y) const { return binary(arb_mul, x, y); }
  Ball div(const Ball& x, const Ball& y) const { return binary(arb_div, x, y); }
  Ball exp(const Ball& x) const { return apply(arb_exp, x); }
  Ball sqrt(const Ball& x) const { return apply(arb_sqrt, x); }
  Ball pi() const {
    Ball r;
    arb_const_pi(r, precision);
    return r;
  }

 private:
  Ball binary(void (*f)(arb_t, const arb_t, const arb_t, slong), const Ball& x,
              const Ball& y) const {
    Ball r;
    f(r, x, y, precision);
    return r;
  }
};

Ball negated(const Ball& x) {
  Ball r;
  arb_neg(r, x);
  return r;
}

bool accurate(const Ball& x) { return arb_is_zero(x) || arb_rel_accuracy_bits(x) >= kAccurateBits; }

double rounded(const Ball& x) {
  return arf_get_d(arb_midref(static_cast<arb_srcptr>(x)), ARF_RND_NEAR);
}

template <class Real>
Real rounded_to(const Ball& x) {
  const double high = rounded(x);
  if constexpr (std::is_same_v<Real, double>) return high;
  Ball rest;
  arb_sub(rest, x, Ball(high), kLastPrecision);
  return static_cast<Real>(high) + rounded(rest);
}

/// exp(x^2) erfc(x) = U(1/2, 1/2, x^2) / sqrt(pi) for large x, where Arb's erfc of an inexact
/// argument gives wide balls; the product elsewhere.
Ball erfcx_ball(const Arithmetic& m, const Ball& x) {
  const Ball x2 = m.mul(x, x);
  constexpr double kLarge = 1000;
  if (!arb_gt(x, Ball(kLarge))) return m.mul(m.exp(x2), m.apply(arb_hypgeom_erfc, x));
  Ball u;
  arb_hypgeom_u(u, Ball(0.5), Ball(0.5), x2, m.precision);
  return m.div(u, m.sqrt(m.pi()));
}

Ball dawson_ball(const Arithmetic& m, const Ball& x) {
  const Ball scale = m.mul(m.sqrt(m.pi()), Ball(0.5));
  return m.mul(m.mul(scale, m.exp(negated(m.mul(x, x)))), m.apply(arb_hypgeom_erfi, x));
}

/// Psi for a != b.
Ball psi_closed_form(const Arithmetic& m, const Ball& b, const Ball& a, const Ball& zeta,
                     bool grows) {
  const Ball q = grows ? m.sub(a, b) : m.sub(b, a);
  const Ball root = m.sqrt(m.add(q, q));
  const Ball x_b = m.div(b, root);
  const Ball x_a = m.div(a, root);
  if (grows)
    return m.mul(m.div(m.sqrt(m.pi()), root),
                 m.sub(erfcx_ball(m, x_b), m.mul(zeta, erfcx_ball(m, x_a))));
  return m.mul(m.div(Ball(2), root), m.sub(dawson_ball(m, x_b), m.mul(zeta, dawson_ball(m, x_a))));
}

/// zeta, 1 - zeta, Psi, 1 - Psi, Psi - zeta, Psi - Psi_1, Psi_1.
std::array<Ball, 7> piece_balls(const Arithmetic& m, double b_value, double a_value) {
  const Ball one(1);
  const Ball half(0.5);
  const Ball b(b_value);
  const Ball a(a_value);
  const Ball zeta = m.exp(negated(m.mul(half, m.add(a, b))));
  const Ball alpha = m.sub(one, zeta);
  Ball psi = one;
  Ball psi1 = half;
  if (a_value != b_value) {
    psi = psi_closed_form(m, b, a, zeta, a_value > b_value);
    psi1 = m.div(m.sub(alpha, m.mul(b, psi)), m.sub(a, b));
  } else if (a_value != 0) {
    psi = m.div(alpha, a);
    psi1 = m.div(m.sub(psi, zeta), a);
  }
  return {zeta, alpha, psi, m.sub(one, psi), m.sub(psi, zeta), m.sub(psi, psi1), psi1};
}

/// f(arithmetic) at a rising precision until the ball is accurate.
template <class F>
double raised(const F& f) {
  for (slong precision = kFirstPrecision; precision <= kLastPrecision; precision *= 2) {
    const Ball x = f(Arithmetic{precision});
    if (accurate(x)) return rounded(x);
  }
  throw std::runtime_error("the oracle ran out of precision");
}

}  // namespace

namespace {

template <class Real>
BasicExactPiece<Real> exact_piece(double b, double a) {
  for (slong precision = kFirstPrecision; precision <= kLastPrecision; precision *= 2) {
    const std::array<Ball, 7> balls = piece_balls(Arithmetic{precision}, b, a);
    bool all_accurate = true;
    for (const Ball& ball : balls) all_accurate = all_accurate && accurate(ball);
    if (!all_accurate) continue;
    return {rounded_to<Real>(balls[0]), rounded_to<Real>(balls[1]), rounded_to<Real>(balls[2]),
            rounded_to<Real>(balls[3]), rounded_to<Real>(balls[4]), rounded_to<Real>(balls[5]),
            rounded_to<Real>(balls[6])};
  }
  throw std::runtime_error("the oracle ran out of precision");
}

}  // namespace

ExactPiece exact_linear_piece(double b, double a) { return exact_piece<double>(b, a); }

ExtendedExactPiece extended_exact_piece(double b, double a) {
  return exact_piece<long double>(b, a);
}

double exact_erfcx(double x) {
  return raised([x](const Arithmetic& m) { return erfcx_ball(m, Ball(x)); });
}

double exact_ierfcx(double x) {
  return raised([x](const Arithmetic& m) {
    return m.sub(m.div(Ball(1), m.sqrt(m.pi())), m.mul(Ball(x), erfcx_ball(m, Ball(x))));
  });
}

double exact_dawson(double x) {
  return raised([x](const Arithmetic& m) { return dawson_ball(m, Ball(x)); });
}

double exact_dawson_derivative(double x) {
  return raised([x](const Arithmetic& m) {
    return m.sub(Ball(1), m.mul(Ball(2 * x), dawson_ball(m, Ball(x))));
  });
}

namespace {

/// f / weight at x = 2 t / (1 - t).
Ball weighted(const Arithmetic& m, WeightedFunction function, const Ball& t) {
  const Ball s = m.sub(Ball(1), t);
  const Ball x = m.div(m.mul(Ball(2), t), s);
  const Ball s2 = m.mul(s, s);
  switch (function) {
    case WeightedFunction::erfcx:
      return m.div(erfcx_ball(m, x), s);
    case WeightedFunction::ierfcx:
      return m.div(m.sub(m.div(Ball(1), m.sqrt(m.pi())), m.mul(x, erfcx_ball(m, x))), s2);
    case WeightedFunction::dawson:
      return m.div(dawson_ball(m, x), m.mul(x, s2));
    case WeightedFunction::dawson_derivative:
      break;
  }
  return m.div(m.sub(Ball(1), m.mul(m.mul(Ball(2), x), dawson_ball(m, x))), s2);
}

}  // namespace

std::vector<double> exact_powers(WeightedFunction function, double low, double high,
                                 std::size_t degree) {
  constexpr std::size_t kPoints = 28;
  const Arithmetic m{512};
  // cos(pi i / (2 kPoints))
  const auto cosine = [&](std::size_t i) {
    return m.apply(arb_cos_pi, m.div(Ball(static_cast<double>(i)), Ball(2.0 * kPoints)));
  };
  std::vector<Ball> values;
  for (std::size_t j = 0; j < kPoints; ++j)
    values.push_back(weighted(m, function,
                              m.add(Ball(0.5 * low + 0.5 * high),
                                    m.mul(cosine(2 * j + 1), Ball(0.5 * high - 0.5 * low)))));
  std::vector<Ball> powers(degree + 1, Ball(0));
  std::vector<double> before, polynomial{1};  // T_(k - 1), T_k
  for (std::size_t k = 0; k <= degree; ++k) {
    Ball c(0);
    for (std::size_t j = 0; j < kPoints; ++j)
      c = m.add(c, m.mul(values[j], cosine(k * (2 * j + 1))));
    c = m.div(m.mul(c, Ball(k == 0 ? 1 : 2)), Ball(kPoints));
    for (std::size_t i = 0; i < polynomial.size(); ++i)
      powers[i] = m.add(powers[i], m.mul(c, Ball(polynomial[i])));
    std::vector<double> next(k + 2, 0.0);  // 2 y T_k - T_(k - 1), and T_1 = y
    for (std::size_t i = 0; i < polynomial.size(); ++i)
      next[i + 1] = (k == 0 ? 1 : 2) * polynomial[i];
    for (std::size_t i = 0; i < before.size(); ++i) next[i] -= before[i];
    before = std::exchange(polynomial, next);
  }
  std::vector<double> result;
  for (const Ball& power : powers) {
    if (!accurate(power)) throw std::runtime_error("the oracle ran out of precision");
    result.push_back(rounded(power));
  }
  return result;
}

}  // namespace hiac::test
