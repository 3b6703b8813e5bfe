#include "hiac/element/gradient/gradient_direction.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

// Divides a vector by a number: its largest component or, for vectors that belong together, the
// largest of all. Products of such vectors neither overflow nor underflow to 0.
Vector scaled(const Vector& v, double by) { return {v[0] / by, v[1] / by, v[2] / by}; }

}  // namespace

Vector gradient_direction(const std::array<Vector, 3>& columns, const Vector& reference_gradient) {
  const double size = std::max({largest(columns[0]), largest(columns[1]), largest(columns[2])});
  const double steepest = largest(reference_gradient);
  if (!(size > 0) || !(steepest > 0)) return {0, 0, 1};
  const Vector a = scaled(columns[0], size), b = scaled(columns[1], size);
  const Vector c = scaled(columns[2], size), g = scaled(reference_gradient, steepest);
  const Vector bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  Vector n;
  for (std::size_t k = 0; k < 3; ++k) n[k] = g[0] * bc[k] + g[1] * ca[k] + g[2] * ab[k];
  const double most = largest(n);
  if (!(most > 0)) return {0, 0, 1};
  n = scaled(n, most);
  return scaled(n, std::hypot(n[0], n[1], n[2]));
}

}  // namespace hiac
