#include "hiac/preview/regions/screen_predicates.hpp"

#include <cmath>
#include <initializer_list>

#include "hiac/base/rounding.hpp"
#include "hiac/preview/regions/exact_screen.hpp"

namespace hiac::preview {
namespace {

// Products below this may have lost digits to underflow, and their remainders too.
constexpr double kLeastProduct = 0x1p-900;
// Shewchuk's bound A for a 2 x 2 determinant of rounded differences ("Adaptive Precision
// Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997, section 4.2).
constexpr double kErrorBound = (3.0 + 16.0 * kUnit) * kUnit;

// A number with a bound of its error.
struct Rounded {
  double value, error;
};

// Whether a - b is `difference` exactly (Knuth's two-sum).
bool is_exact(double a, double b, double difference) {
  const double b_virtual = a - difference;
  const double a_virtual = difference + b_virtual;
  return (a - a_virtual) + (b_virtual - b) == 0;
}

// Whether the product of two factors has no rounding error, which `rest` would be.
bool is_sound(double product, double rest, double factor1, double factor2) {
  return rest == 0 && (std::abs(product) > kLeastProduct || factor1 == 0 || factor2 == 0);
}

// (b - a) x (d - c) with a bound that is 0 where nothing was rounded, which is asked only where it
// matters: where the sign is in doubt, or always.
enum class Ask { in_doubt, always };
Rounded cross(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c,
              const ScreenPoint& d, Ask ask = Ask::in_doubt) {
  const double ux = b.x - a.x, uy = b.y - a.y, vx = d.x - c.x, vy = d.y - c.y;
  const double left = ux * vy, right = uy * vx;
  const double value = left - right;
  const double error = kErrorBound * (std::abs(left) + std::abs(right)) + kLeastProduct;
  if (ask == Ask::in_doubt && std::abs(value) > error) return {value, error};
  const bool exact = is_exact(b.x, a.x, ux) && is_exact(b.y, a.y, uy) && is_exact(d.x, c.x, vx) &&
                     is_exact(d.y, c.y, vy) && is_sound(left, std::fma(ux, vy, -left), ux, vy) &&
                     is_sound(right, std::fma(uy, vx, -right), uy, vx) &&
                     is_exact(left, right, value);
  return {value, exact ? 0 : error};
}

}  // namespace

int side(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c) {
  const Rounded area = cross(a, b, a, c);
  if (std::abs(area.value) > area.error || area.error == 0) return sign_of(area.value);
  return exact_side(a, b, c);
}

int turn(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c, const ScreenPoint& d) {
  const Rounded area = cross(a, b, c, d);
  if (std::abs(area.value) > area.error || area.error == 0) return sign_of(area.value);
  return exact_turn(a, b, c, d);
}

// The point is c + N / (N - M) (d - c) with N and M the areas that c and d make with ef; the area
// that it makes with ab is linear on cd.
int side_of_crossing(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c,
                     const ScreenPoint& d, const ScreenPoint& e, const ScreenPoint& f) {
  for (const Ask ask : {Ask::in_doubt, Ask::always}) {
    const Rounded of_c = cross(a, b, a, c, ask), of_d = cross(a, b, a, d, ask);
    const Rounded n = cross(e, f, e, c, ask), m = cross(e, f, e, d, ask);
    const double p = n.value * of_d.value, q = m.value * of_c.value;
    const double difference = p - q;
    const double error = 4 * kUnit * (std::abs(p) + std::abs(q)) +
                         1.01 * (std::abs(n.value) * of_d.error + std::abs(of_d.value) * n.error +
                                 std::abs(m.value) * of_c.error + std::abs(of_c.value) * m.error +
                                 n.error * of_d.error + m.error * of_c.error) +
                         kLeastProduct;
    const bool exact = n.error == 0 && m.error == 0 && of_c.error == 0 && of_d.error == 0 &&
                       is_sound(p, std::fma(n.value, of_d.value, -p), n.value, of_d.value) &&
                       is_sound(q, std::fma(m.value, of_c.value, -q), m.value, of_c.value);
    if (exact || std::abs(difference) > error) return -sign_of(difference) * turn(e, f, c, d);
  }
  return exact_side_of_crossing(a, b, c, d, e, f);
}

double doubtful_twice_area(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c) {
  const Rounded area = cross(a, b, a, c);
  if (area.error == 0) return area.value;
  return exact_twice_area(a, b, c);
}

}  // namespace hiac::preview
