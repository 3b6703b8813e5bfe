// Points and weights of MFEM's spaces: Gauss-Lobatto points in closed form, and polynomials that
// the weights have to give back.
#include <cmath>

#include <gmock/gmock.h>

#include "formats/mfem/interpolation.hpp"

namespace hiac::formats {
namespace {

using mfem::Geometry;
using mfem::LatticePoint;
using mfem::Space;
using Place3 = std::array<double, 3>;

TEST(MfemInterpolation, GaussLobattoPointsInClosedForm) {
  const auto expect = [](int order, const std::vector<double>& inner) {
    const std::vector<double> points = mfem::gauss_lobatto_points(order);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(order) + 1);
    EXPECT_EQ(points.front(), 0);
    EXPECT_EQ(points.back(), 1);
    for (std::size_t i = 0; i < inner.size(); ++i)
      EXPECT_NEAR(points[i + 1], (1 + inner[i]) / 2, 1e-15) << order << " " << i;
  };
  const double a = std::sqrt((7 + 2 * std::sqrt(7.0)) / 21);
  const double b = std::sqrt((7 - 2 * std::sqrt(7.0)) / 21);
  const double c = std::sqrt((15 + 2 * std::sqrt(15.0)) / 33);
  const double d = std::sqrt((15 - 2 * std::sqrt(15.0)) / 33);
  expect(1, {});
  expect(2, {0});
  expect(3, {-std::sqrt(0.2), std::sqrt(0.2)});
  expect(4, {-std::sqrt(3.0 / 7), 0, std::sqrt(3.0 / 7)});
  expect(5, {-a, -b, b, a});
  expect(6, {-c, -d, 0, d, c});
}

/// Where the degree of freedom of a space is; of cubes and the edges of others also for
/// Gauss-Lobatto points.
Place3 place_of_dof(Geometry geometry, const LatticePoint& point, const Space& space) {
  Place3 place = mfem::position_of(point, space.order);
  if (!space.lobatto) return place;
  const std::vector<double> line = mfem::gauss_lobatto_points(space.order);
  if (geometry == Geometry::cube || point.part == LatticePoint::Part::edge)
    for (std::size_t c = 0; c < 3; ++c) place[c] = line[static_cast<std::size_t>(point.place[c])];
  return place;
}

/// That the values of f at the space's degrees of freedom give those at the cells' points.
template <typename Function>
void expect_reproduced(Geometry geometry, const Space& space, int order, const Function& f) {
  const Space cells{order, false};
  const auto rows = mfem::interpolation(geometry, space, cells);
  const auto targets = mfem::lattice_points(geometry, cells);
  const auto dofs = mfem::lattice_points(geometry, space);
  ASSERT_EQ(rows.size(), targets.size());
  for (std::size_t t = 0; t < targets.size(); ++t) {
    ASSERT_EQ(rows[t].size(), dofs.size());
    double sum = 0;
    for (std::size_t i = 0; i < dofs.size(); ++i)
      sum += rows[t][i] * f(place_of_dof(geometry, dofs[i], space));
    EXPECT_NEAR(sum, f(mfem::position_of(targets[t], order)), 1e-12)
        << mfem::geometry_name(geometry) << " " << space.order << " to " << order << ", " << t;
  }
}

constexpr auto kLinear = [](const Place3& x) { return 1 + x[0] - 2 * x[1] + 0.5 * x[2]; };
/// Of degree 1, 2 or 3.
auto of_degree(int degree) {
  return [degree](const Place3& x) {
    const double s = kLinear(x);
    const double r = 0.25 - x[0] + x[1] - x[2];
    return degree == 1 ? s : degree == 2 ? s * r - x[2] * x[2] : s * r * r + s * s - x[0] * x[1];
  };
}

TEST(MfemInterpolation, PolynomialsOfTheSpaceComeBack) {
  for (const Geometry geometry : {Geometry::tetrahedron, Geometry::prism, Geometry::cube})
    for (int from = 1; from <= 3; ++from)
      for (int to = 1; to <= 3; ++to) {
        expect_reproduced(geometry, {from, false}, to, of_degree(from));
        // the coefficients of a linear function are its values at evenly spaced places
        expect_reproduced(geometry, {from, false, false, true}, to, kLinear);
      }
  for (int order = 3; order <= 6; ++order)
    expect_reproduced(Geometry::cube, {order, true}, order, of_degree(3));
  // by edges, and in the middle of faces by the node there
  expect_reproduced(Geometry::tetrahedron, {3, true}, 3, of_degree(3));
}

TEST(MfemInterpolation, OfPyramids) {
  const auto bilinear = [](const Place3& x) {
    const double under = 1 - x[2];
    return kLinear(x) + (under > 0 ? x[0] * x[1] / under : 0);
  };
  expect_reproduced(Geometry::pyramid, {1, false}, 2, kLinear);
  expect_reproduced(Geometry::pyramid, {1, false}, 2, bilinear);
  expect_reproduced(Geometry::pyramid, {2, false}, 2, of_degree(2));
}

}  // namespace
}  // namespace hiac::formats
