#include "hiac/preview/methods/triangle_buffer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hiac/preview/regions/screen_predicates.hpp"

namespace hiac::preview {
namespace {

using Place = std::array<double, 2>;

// The nearest multiple of a power of 2, and the even one of two: numbers as large as the shift are
// multiples of it. Processors without SSE 4.1 call a function to round.
template <double Step>
double nearest_multiple(double x) {
  constexpr double kShift = 0x1.8p52 * Step;
  return (x + kShift) - kShift;
}
double on_grid(double x) { return nearest_multiple<kFine>(x); }
double coarse(double x) { return nearest_multiple<kCoarse>(x); }

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

// Of a triangle, one of the same form at one of its corners: the smallest that contains all points
// with these shares of the corners at least.
std::array<ScreenPoint, 3> part_with(const std::array<ScreenPoint, 3>& at,
                                     const std::array<double, 3>& least_shares) {
  const auto k =
      static_cast<std::size_t>(std::ranges::max_element(least_shares) - least_shares.begin());
  const double scale = 1 - least_shares[k];
  std::array<ScreenPoint, 3> part = at;
  if (scale < 1)
    for (ScreenPoint& p : part)
      p = {at[k].x + scale * (p.x - at[k].x), at[k].y + scale * (p.y - at[k].y)};
  return part;
}

// A pixel's centre on a side belongs to the triangle that a step right and a much smaller one down
// leads into. The least normal float, which shaders compare edge functions with.
constexpr float kLeastPositive = 1.2e-38F;
// Of a peak that is as good as on a side.
constexpr double kLeastShare = 1e-15;
bool has_side(const Place& from, const Place& to) {
  return to[1] < from[1] || (to[1] == from[1] && to[0] > from[0]);
}

// The shares of a triangle's corners in a peak, 0 of the corner opposite a side that it lies on.
std::array<double, 3> shares_of_peak(const std::array<Place, 3>& at, const Place& peak) {
  std::array<double, 3> shares;
  std::size_t nearest = 0;
  double least = HUGE_VAL;  // of the distances from sides that are kFine or less
  for (std::size_t k = 0; k < 3; ++k) {
    const Place &p = at[(k + 1) % 3], &q = at[(k + 2) % 3];
    if (std::max(std::abs(peak[0] - at[k][0]), std::abs(peak[1] - at[k][1])) <= kFine) {
      shares = {};
      shares[k] = 1;
      return shares;
    }
    const double dx = q[0] - p[0], dy = q[1] - p[1], length2 = dx * dx + dy * dy;
    shares[k] = dx * (peak[1] - p[1]) - dy * (peak[0] - p[0]);
    if (shares[k] > 0 && shares[k] * shares[k] > kFine * kFine * length2) continue;
    const double distance = shares[k] / std::sqrt(length2);
    if (distance >= least) continue;
    least = distance;
    nearest = k;
  }
  for (double& share : shares) share = std::max(share, 0.0);
  if (least < HUGE_VAL) shares[nearest] = 0;
  const double sum = shares[0] + shares[1] + shares[2];
  if (!(sum > 0)) return {1, 0, 0};  // narrower than kFine
  const double one = 1 / sum;
  for (double& share : shares) share *= one;
  return shares;
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

// Grows by doubling and does not shrink, so that a triangle is written once: vectors would first
// fill what it takes with zeros.
void TriangleBuffer::make_room() {
  if (6 * (triangles_ + 1) <= places_.size()) return;
  const std::size_t most = std::max<std::size_t>(2 * triangles_, 64);
  places_.resize(6 * most);
  records_.resize(shape_.floats() * most);
}

void TriangleBuffer::add(const Corner& a, const Corner& b, const Corner& c, const Corner* peak,
                         const SlabLimits& limits) {
  std::array<ScreenPoint, 3> at;
  std::array<const Corner*, 3> corners{&a, &b, &c};
  for (std::size_t k = 0; k < 3; ++k) at[k] = {on_grid(corners[k]->x), on_grid(corners[k]->y)};
  std::array<double, 3> least = limits.least_shares;
  const double area = twice_area(at[0], at[1], at[2]);
  if (area == 0) return;
  if (area < 0) {
    std::swap(corners[0], corners[1]);
    std::swap(at[0], at[1]);
    std::swap(least[0], least[1]);
  }
  const std::array<ScreenPoint, 3> drawn = part_with(at, least);
  if (!has_pixel(drawn)) return;
  Triangle triangle;
  for (std::size_t k = 0; k < 3; ++k) {
    triangle.at[k] = {at[k].x, at[k].y};
    triangle.values[k] = &corners[k]->values;
  }
  make_room();
  float* to = places_.data() + 6 * triangles_;
  for (const Place& place :
       grown({{{drawn[0].x, drawn[0].y}, {drawn[1].x, drawn[1].y}, {drawn[2].x, drawn[2].y}}}))
    for (std::size_t axis = 0; axis < 2; ++axis)
      *to++ = static_cast<float>(place[axis] - origin_[axis]);
  float* const record = records_.data() + shape_.floats() * triangles_;
  set_triangle(record, triangle);
  if (peak != nullptr)
    set_peak(record, triangle, *peak);
  else
    set_flat(record);
  std::ranges::copy(limits.rest, record + kFirstValue + 4 * shape_.values);
  ++triangles_;
}

void TriangleBuffer::set_triangle(float* record, const Triangle& triangle) const {
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t c = 0; c < 2; ++c) {
      const double x = coarse(triangle.at[k][c]);
      float* const to = record + (k < 2 ? 2 * k + c : 8 + c);
      to[0] = static_cast<float>(x - origin_[c]);
      to[k < 2 ? 4 : 2] = static_cast<float>(triangle.at[k][c] - x);
    }
  for (std::size_t k = 0; k < 3; ++k)
    record[kLeast + k] =
        has_side(triangle.at[(k + 1) % 3], triangle.at[(k + 2) % 3]) ? 0 : kLeastPositive;
  float* const to = record + kFirstValue;
  for (std::size_t n = 0; n < shape_.values; ++n) {
    const float of_c = (*triangle.values[2])[n];
    to[n] = (*triangle.values[0])[n] - of_c;
    to[n + shape_.values] = (*triangle.values[1])[n] - of_c;
    to[n + 2 * shape_.values] = of_c;
  }
}

// Values are linear in the whole triangle.
void TriangleBuffer::set_flat(float* record) const {
  std::fill_n(record + kSteep, 3, 0.0F);
  std::fill_n(record + kFirstValue + 3 * shape_.values, shape_.values, 0.0F);
}

void TriangleBuffer::set_peak(float* record, const Triangle& triangle, const Corner& peak) const {
  const std::array<double, 3> shares = shares_of_peak(triangle.at, {peak.x, peak.y});
  for (std::size_t k = 0; k < 3; ++k)
    record[kSteep + k] =
        shares[k] > 0 ? static_cast<float>(1 / std::max(shares[k], kLeastShare)) : kOpen;
  float* const to = record + kFirstValue;
  const auto of_a = static_cast<float>(shares[0]), of_b = static_cast<float>(shares[1]);
  for (std::size_t n = 0; n < shape_.values; ++n)
    to[n + 3 * shape_.values] =
        peak.values[n] - (to[n + 2 * shape_.values] + of_a * to[n] + of_b * to[n + shape_.values]);
}

}  // namespace hiac::preview
