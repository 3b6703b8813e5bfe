#include "hiac/check/lifted_orientation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <CGAL/Mpzf.h>

#include "hiac/base/rounding.hpp"

// CGAL's kernel and number types are LGPL; nothing of its GPL parts is used here.

namespace hiac {
namespace {

using Exact = CGAL::Mpzf;  // a ring: sums, differences and products of doubles without rounding

template <typename Number>
using Row = std::array<Number, 4>;  // x, y, z, height
template <typename Number>
using Rows = std::array<Row<Number>, 4>;

template <typename Number>
Number minor_of(const Row<Number>& u, const Row<Number>& v) {
  return u[0] * v[1] - v[0] * u[1];
}

// Returns det[u, v, w] of the first three columns, expanded along the third.
template <typename Number>
Number determinant3(const Row<Number>& u, const Row<Number>& v, const Row<Number>& w) {
  return u[2] * minor_of(v, w) - v[2] * minor_of(u, w) + w[2] * minor_of(u, v);
}

template <typename Number>
Number determinant4(const Rows<Number>& r) {
  return r[3][3] * determinant3(r[0], r[1], r[2]) - r[2][3] * determinant3(r[0], r[1], r[3]) +
         r[1][3] * determinant3(r[0], r[2], r[3]) - r[0][3] * determinant3(r[1], r[2], r[3]);
}

// The same sums with absolute values.
double permanent3(const Row<double>& u, const Row<double>& v, const Row<double>& w) {
  const auto pair = [](const Row<double>& a, const Row<double>& b) {
    return std::abs(a[0] * b[1]) + std::abs(b[0] * a[1]);
  };
  return std::abs(u[2]) * pair(v, w) + std::abs(v[2]) * pair(u, w) + std::abs(w[2]) * pair(u, v);
}

double permanent4(const Rows<double>& r) {
  return std::abs(r[3][3]) * permanent3(r[0], r[1], r[2]) +
         std::abs(r[2][3]) * permanent3(r[0], r[1], r[3]) +
         std::abs(r[1][3]) * permanent3(r[0], r[2], r[3]) +
         std::abs(r[0][3]) * permanent3(r[1], r[2], r[3]);
}

// Returns the sign, or 2 if rounding, underflow or overflow leaves it open.
int filtered_sign(const Rows<double>& r) {
  constexpr double kEpsilon = kUnit;
  constexpr double kErrorBound = (16 + 224 * kEpsilon) * kEpsilon;
  double size = 1, height = 1;
  for (const Row<double>& row : r) {
    for (std::size_t c = 0; c < 3; ++c) size = std::max(size, std::abs(row[c]));
    height = std::max(height, std::abs(row[3]));
  }
  const double determinant = determinant4(r);
  const double underflow = 64 * std::numeric_limits<double>::min() * size * size * size * height;
  const double bound = kErrorBound * permanent4(r) + underflow;
  if (std::isfinite(bound) && std::abs(determinant) > bound) return determinant > 0 ? 1 : -1;
  return 2;
}

int exact_sign(const Rows<Exact>& rows) { return static_cast<int>(CGAL::sign(determinant4(rows))); }

}  // namespace

int outside_sphere(Point3 a, Point3 b, Point3 c, Point3 d, Point3 e) {
  const std::array<Point3, 4> others{b, c, d, e};
  Rows<double> rows;
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = others[i][0] - a[0], y = others[i][1] - a[1], z = others[i][2] - a[2];
    rows[i] = {x, y, z, x * x + y * y + z * z};
  }
  const int sign = filtered_sign(rows);
  if (sign != 2) return sign;
  Rows<Exact> exact;
  for (std::size_t i = 0; i < 4; ++i) {
    const Exact x = Exact(others[i][0]) - Exact(a[0]), y = Exact(others[i][1]) - Exact(a[1]),
                z = Exact(others[i][2]) - Exact(a[2]);
    exact[i] = {x, y, z, x * x + y * y + z * z};
  }
  return exact_sign(exact);
}

int lifted_orientation(const std::array<Point3, 5>& points, const std::array<double, 5>& heights) {
  Rows<double> rows;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t c = 0; c < 3; ++c) rows[i][c] = points[i + 1][c] - points[0][c];
    rows[i][3] = heights[i + 1] - heights[0];
  }
  const int sign = filtered_sign(rows);
  if (sign != 2) return sign;
  Rows<Exact> exact;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t c = 0; c < 3; ++c) exact[i][c] = Exact(points[i + 1][c]) - Exact(points[0][c]);
    exact[i][3] = Exact(heights[i + 1]) - Exact(heights[0]);
  }
  return exact_sign(exact);
}

}  // namespace hiac
