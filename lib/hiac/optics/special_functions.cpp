#include "hiac/optics/special_functions.hpp"

#include <algorithm>

#include "hiac/optics/special_functions_table.hpp"

namespace hiac {
namespace {

using special_functions_table::kDegree;
using special_functions_table::kIntervals;

/// The place of x in the tables: s = 2 / (x + 2), the interval of t = 1 - s, and y in [-1, 1]
/// there.
struct Place {
  double s;
  int interval;
  double y;
};

Place place_of(double x) {
  const double s = 2 / (x + 2);
  // x s / 2 instead of 1 - s: also exact to an ulp near x = 0
  const double v = (0.5 * kIntervals) * (x * s);
  const int interval = std::min(static_cast<int>(v), kIntervals - 1);
  return {s, interval, 2 * (v - interval) - 1};
}

double polynomial(const double (&table)[kIntervals][kDegree + 1], const Place& place) {
  const double* c = table[place.interval];
  double p = c[kDegree];
  for (int k = kDegree - 1; k >= 0; --k) p = p * place.y + c[k];
  return p;
}

}  // namespace

double erfcx(double x) {
  const Place place = place_of(x);
  return place.s * polynomial(special_functions_table::kErfcx, place);
}

double ierfcx(double x) {
  const Place place = place_of(x);
  return place.s * place.s * polynomial(special_functions_table::kIerfcx, place);
}

double dawson(double x) {
  const Place place = place_of(x);
  return x * place.s * (place.s * polynomial(special_functions_table::kDawson, place));
}

double dawson_derivative(double x) {
  const Place place = place_of(x);
  return place.s * place.s * polynomial(special_functions_table::kDawsonDerivative, place);
}

}  // namespace hiac
