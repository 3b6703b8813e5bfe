#include "hiac/check/quality/shell_volume.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <CGAL/Mpzf.h>

#include "hiac/base/cancellation.hpp"
#include "hiac/base/rounding.hpp"
#include "hiac/geometry/predicates.hpp"

// CGAL's kernel and number types are LGPL; nothing of its GPL parts is used here.

namespace hiac {
namespace {

using Exact = CGAL::Mpzf;  // a ring: sums, differences and products of doubles without rounding

template <typename Number>
using Point = std::array<Number, 3>;

template <typename Number>
Point<Number> from(Point3 origin, Point3 p) {
  return {Number(p[0]) - Number(origin[0]), Number(p[1]) - Number(origin[1]),
          Number(p[2]) - Number(origin[2])};
}

template <typename Number>
Number determinant(const Point<Number>& a, const Point<Number>& b, const Point<Number>& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

double permanent(const Point<double>& a, const Point<double>& b, const Point<double>& c) {
  const auto pair = [&](std::size_t i, std::size_t j) {
    return std::abs(b[i] * c[j]) + std::abs(b[j] * c[i]);
  };
  return std::abs(a[0]) * pair(1, 2) + std::abs(a[1]) * pair(2, 0) + std::abs(a[2]) * pair(0, 1);
}

// Calls visit(a, b, c) for triangles whose determinants add up to twelve volumes under the face: a
// triangle twice, a bilinear face by both its divisions.
template <typename Number, typename Visit>
void for_each_triangle(const ZooMesh& mesh, const FreeFace& face, Point3 origin,
                       const Visit& visit) {
  std::array<Point<Number>, 4> at;
  for (std::size_t k = 0; k < face.corner_count; ++k)
    at[k] = from<Number>(origin, mesh.position(face.nodes[k]));
  if (face.corner_count == 3) {
    visit(at[0], at[1], at[2]);
    visit(at[0], at[1], at[2]);
    return;
  }
  for (std::size_t k = 0; k < 4; ++k) visit(at[k], at[(k + 1) % 4], at[(k + 2) % 4]);
}

// The faces of every shell: faces[begin[s]] ... faces[begin[s + 1] - 1].
struct ShellFaces {
  std::vector<std::size_t> begin;
  std::vector<std::uint32_t> faces;
};

ShellFaces faces_of_shells(std::span<const std::uint32_t> shell_of, std::size_t shells) {
  ShellFaces of{std::vector<std::size_t>(shells + 1), std::vector<std::uint32_t>(shell_of.size())};
  for (const std::uint32_t shell : shell_of) ++of.begin[shell + 1];
  std::partial_sum(of.begin.begin(), of.begin.end(), of.begin.begin());
  std::vector<std::size_t> next(of.begin.begin(), of.begin.end() - 1);
  for (std::uint32_t f = 0; f < shell_of.size(); ++f) of.faces[next[shell_of[f]]++] = f;
  return of;
}

double largest(const Point<double>& a) {
  return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

// Returns the sign, or 2 if rounding, underflow or overflow leaves it open.
int filtered_sign(const ZooMesh& mesh, std::span<const FreeFace> faces,
                  std::span<const std::uint32_t> of_shell, Point3 origin) {
  double sum = 0, magnitude = 0, size = 0, terms = 16;
  for (const std::uint32_t f : of_shell)
    for_each_triangle<double>(mesh, faces[f], origin,
                              [&](const auto& a, const auto& b, const auto& c) {
                                sum += determinant(a, b, c);
                                magnitude += permanent(a, b, c);
                                size = std::max({size, largest(a), largest(b), largest(c)});
                                terms += 1;
                              });
  // each product has 6 roundings at most, each sum as many as there are terms behind it
  const double bound = 2 * kUnit * terms * magnitude;
  // underflow is off by less than 1e-320 times the size of a factor
  const bool no_underflow = bound > 1e-200 && size < 1e90;
  const bool decided = std::isfinite(bound) && no_underflow && std::abs(sum) > bound;
  return decided ? (sum > 0 ? 1 : -1) : 2;
}

int exact_sign(const ZooMesh& mesh, std::span<const FreeFace> faces,
               std::span<const std::uint32_t> of_shell, Point3 origin) {
  Exact sum = 0;
  CancellationCheck cancelled;
  for (const std::uint32_t f : of_shell) {
    cancelled();
    for_each_triangle<Exact>(
        mesh, faces[f], origin,
        [&](const auto& a, const auto& b, const auto& c) { sum = sum + determinant(a, b, c); });
  }
  return static_cast<int>(CGAL::sign(sum));
}

}  // namespace

std::vector<int> shell_volume_signs(const ZooMesh& mesh, std::span<const FreeFace> faces,
                                    std::span<const std::uint32_t> shell_of, std::size_t shells) {
  const ShellFaces of = faces_of_shells(shell_of, shells);
  std::vector<int> signs(shells);
  for (std::size_t s = 0; s < shells; ++s) {
    check_cancelled();
    const auto own = std::span(of.faces).subspan(of.begin[s], of.begin[s + 1] - of.begin[s]);
    const Point3 origin = mesh.position(faces[own[0]].nodes[0]);
    signs[s] = filtered_sign(mesh, faces, own, origin);
    if (signs[s] == 2) signs[s] = exact_sign(mesh, faces, own, origin);
  }
  return signs;
}

}  // namespace hiac
