#include "hiac/preview/methods/triangle_buffer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "hiac/preview/regions/screen_predicates.hpp"

namespace hiac::preview {
namespace {

using Place = std::array<double, 2>;

double on_grid(double x) { return std::nearbyint(x * (1 / kFine)) * kFine; }
// The rest is at least -2^15 and less than 2^15 of kFine.
double coarse(double x) { return std::floor(x * (1 / kCoarse) + 0.5) * kCoarse; }

// A triangle around the rectangle that contains a narrow one along its longest side.
std::array<Place, 3> around_narrow(const std::array<Place, 3>& p,
                                   const std::array<double, 3>& lengths) {
  const auto k = static_cast<std::size_t>(std::ranges::max_element(lengths) - lengths.begin());
  const Place &a = p[(k + 1) % 3], &b = p[(k + 2) % 3], &c = p[k];
  const double length = lengths[k];
  const Place along{(b[0] - a[0]) / length, (b[1] - a[1]) / length}, up{-along[1], along[0]};
  const double height = (c[0] - a[0]) * up[0] + (c[1] - a[1]) * up[1];
  const double wide = length + 2 * kGrowth, high = std::max(height, 0.0) + 2 * kGrowth;
  const auto at = [&](double u, double v) {
    return Place{a[0] + u * along[0] + v * up[0], a[1] + u * along[1] + v * up[1]};
  };
  return {at(-kGrowth - wide / 2, -kGrowth), at(length + kGrowth + wide / 2, -kGrowth),
          at(length / 2, 2 * high - kGrowth)};
}

// The first whole number from x on, for the coordinates that there are (RegionFiller clips others).
int first_from(double x) {
  constexpr double kShift = 1 << 20;
  return (1 << 20) - static_cast<int>(kShift - x);
}

// More pixels than this are not looked at one by one.
constexpr int kFewPixels = 6;
// A triangle is left out only where no rounding of the shader's can give it the pixel.
constexpr double kRounding = 1e-5;

// Whether a pixel's centre lies in a triangle, or nearly so.
bool has_pixel(const std::array<ScreenPoint, 3>& at) {
  const auto [left, right] = std::minmax({at[0].x, at[1].x, at[2].x});
  const auto [top, bottom] = std::minmax({at[0].y, at[1].y, at[2].y});
  const int x0 = first_from(left - 0.5), x1 = -first_from(0.5 - right);
  const int y0 = first_from(top - 0.5), y1 = -first_from(0.5 - bottom);
  if (x0 > x1 || y0 > y1) return false;
  if ((x1 - x0 + 1) * (y1 - y0 + 1) > kFewPixels) return true;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const ScreenPoint &p = at[k], &q = at[(k + 1) % 3];
        const double one = (p.x - (x + 0.5)) * (q.y - (y + 0.5)),
                     two = (p.y - (y + 0.5)) * (q.x - (x + 0.5));
        inside = inside && one - two >= -kRounding * (std::abs(one) + std::abs(two));
      }
      if (inside) return true;
    }
  return false;
}

}  // namespace

std::array<Place, 3> grown(const std::array<Place, 3>& p) {
  std::array<double, 3> lengths;  // of the sides opposite the corners
  for (std::size_t k = 0; k < 3; ++k) {
    const Place &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
    lengths[k] = std::sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]));
  }
  const double around = lengths[0] + lengths[1] + lengths[2];
  const double area =
      (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
  // the circle inside has the radius area / around; seen from its centre, all sides move alike
  if (!(area > kGrowth * around)) return around_narrow(p, lengths);
  const double more = kGrowth * around / area;
  std::array<Place, 3> result;
  for (std::size_t c = 0; c < 2; ++c) {
    const double center =
        (lengths[0] * p[0][c] + lengths[1] * p[1][c] + lengths[2] * p[2][c]) / around;
    for (std::size_t k = 0; k < 3; ++k) result[k][c] = p[k][c] + more * (p[k][c] - center);
  }
  return result;
}

void TriangleBuffer::add(const Corner& a, const Corner& b, const Corner& c) {
  std::array<ScreenPoint, 3> at;
  std::array<const Corner*, 3> corners{&a, &b, &c};
  for (std::size_t k = 0; k < 3; ++k) at[k] = {on_grid(corners[k]->x), on_grid(corners[k]->y)};
  const double area = twice_area(at[0], at[1], at[2]);
  if (area == 0) return;
  if (area < 0) {
    std::swap(corners[1], corners[2]);
    std::swap(at[1], at[2]);
  }
  if (!has_pixel(at)) return;
  const auto places = grown({{{at[0].x, at[0].y}, {at[1].x, at[1].y}, {at[2].x, at[2].y}}});
  const std::size_t start = floats_.size(), stride = floats_per_vertex();
  floats_.resize(start + 3 * stride);
  float* to = floats_.data() + start;
  for (std::size_t k = 0; k < 3; ++k, to += stride) {
    const double x = coarse(at[k].x), y = coarse(at[k].y);
    to[0] = static_cast<float>(places[k][0]);
    to[1] = static_cast<float>(places[k][1]);
    to[2] = static_cast<float>(x);
    to[3] = static_cast<float>(y);
    to[4] = std::bit_cast<float>(
        std::array<std::int16_t, 2>{static_cast<std::int16_t>((at[k].x - x) / kFine),
                                    static_cast<std::int16_t>((at[k].y - y) / kFine)});
    std::copy_n(corners[k]->values.begin(), values_, to + kFirstValue);
  }
}

}  // namespace hiac::preview
