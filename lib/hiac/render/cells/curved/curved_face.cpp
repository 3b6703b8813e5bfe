#include "hiac/render/cells/curved/curved_face.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/base/special_values.hpp"
#include "hiac/render/cells/curved/patch_curvature.hpp"

namespace hiac {
namespace {}  // namespace

PatchZeros CurvedFace::crossings(double center, int winding) {
  PatchNet<double> aside;
  for (std::size_t k = 0; k < shape.control_count(); ++k) aside[k] = x[k] - center * w[k];
  const PatchZeros zeros = patch_zeros({.shape = shape,
                                        .a = aside,
                                        .b = height,
                                        .depth = t,
                                        .winding = winding,
                                        .one_way = turns != 0,
                                        .rounding = rounding,
                                        .guess = guess});
  if (zeros.size() == 1) guess = {zeros[0].u, zeros[0].v};
  return zeros;
}

double CurvedFace::parameter(const PatchZero& zero) const {
  const std::size_t n = shape.degree;
  return evaluate_patch(n, t, BernsteinValues(n, zero.u), BernsteinValues(n, zero.v)).value;
}

double CurvedFace::moved_along(double u, double v, double center, double moved) const {
  const std::size_t n = shape.degree, count = shape.control_count();
  PatchNet<double> aside;
  for (std::size_t k = 0; k < count; ++k) aside[k] = x[k] - center * w[k];
  const BernsteinValues bu(n, u), bv(n, v);
  const PatchValue a = evaluate_patch(n, aside, bu, bv), b = evaluate_patch(n, height, bu, bv),
                   along_ray = evaluate_patch(n, t, bu, bv);
  const double determinant = a.by_u * b.by_v - a.by_v * b.by_u;
  // bounds of |a| and |b| with the displacement, in their units
  const double off_a = std::abs(a.value) + moved, off_b = std::abs(b.value) + moved;
  // the rows of J^-1
  const double u_a = b.by_v / determinant, u_b = -a.by_v / determinant;
  const double v_a = -b.by_u / determinant, v_b = a.by_u / determinant;
  const double step_u = std::abs(u_a) * off_a + std::abs(u_b) * off_b;
  const double step_v = std::abs(v_a) * off_a + std::abs(v_b) * off_b;
  const double side_u = 2 * step_u, side_v = 2 * step_v;
  if (!(std::max(side_u, side_v) <= PatchCurvature::kBorder)) return kInfinity;
  PatchNet<double> p, q;
  for (std::size_t k = 0; k < count; ++k) {
    p[k] = u_a * aside[k] + u_b * height[k];
    q[k] = v_a * aside[k] + v_b * height[k];
  }
  const double bent_u = PatchCurvature(n, p).within(side_u, side_v),
               bent_v = PatchCurvature(n, q).within(side_u, side_v);
  // 0.9 leaves a tenth for the rounding of J^-1
  if (!(bent_u <= 0.9 * step_u && bent_v <= 0.9 * step_v)) return kInfinity;
  const double by_a = std::abs(along_ray.by_u * u_a + along_ray.by_v * v_a) * off_a,
               by_b = std::abs(along_ray.by_u * u_b + along_ray.by_v * v_b) * off_b;
  const double bent_t = std::abs(along_ray.by_u) * bent_u + std::abs(along_ray.by_v) * bent_v +
                        PatchCurvature(n, t).within(side_u, side_v);
  return 1.01 * (by_a + by_b) + bent_t;
}

std::array<double, 3> CurvedFace::reference_at(double u, double v) const {
  const auto& at = reference;
  std::array<double, 3> point;
  for (std::size_t c = 0; c < 3; ++c)
    point[c] = shape.triangle ? at[0][c] + u * (at[1][c] - at[0][c]) + v * (at[2][c] - at[0][c])
                              : (1 - v) * (at[0][c] + u * (at[1][c] - at[0][c])) +
                                    v * (at[3][c] + u * (at[2][c] - at[3][c]));
  return point;
}

}  // namespace hiac
