#include "hiac/render/cells/curved/curved_edge.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/frame/screen_rounding.hpp"
#include "hiac/geometry/bezier_patch.hpp"

namespace hiac {
namespace {

double at_place(std::size_t degree, const std::array<double, 4>& controls, double s) {
  const BernsteinValues b(degree, s);
  double sum = 0;
  for (std::size_t k = 0; k <= degree; ++k) sum += b.value[k] * controls[k];
  return sum;
}

double slope_at(std::size_t degree, const std::array<double, 4>& controls, double s) {
  const BernsteinValues b(degree, s);
  double sum = 0;
  for (std::size_t k = 0; k <= degree; ++k) sum += b.derivative[k] * controls[k];
  return sum;
}

// Writes the parameters in (0, 1), ascending, at which a curve's height has an extremum, and
// returns how many there are: at most two.
std::size_t turning_places(std::size_t degree, const std::array<double, 4>& h,
                           std::array<double, 2>& places) {
  const double d0 = h[1] - h[0], d1 = h[2] - h[1], d2 = h[3] - h[2];
  std::size_t count = 0;
  const auto add = [&](double place) {
    if (place > 0 && place < 1) places[count++] = place;
  };
  if (degree == 2) {
    add(d0 / (d0 - d1));
    return count;
  }
  const double discriminant = d1 * d1 - d0 * d2;
  if (discriminant <= 0) return 0;
  const double q = -(d1 + (d1 < 0 ? -1 : 1) * std::sqrt(discriminant));
  add(q / (q + d2));
  add(d0 / (d0 + q));
  if (count == 2 && places[0] > places[1]) std::swap(places[0], places[1]);
  return count;
}

}  // namespace

// Finds where the edge changes sides of the row: between two extrema it does so at most once.
void CurvedEdge::begin_row(double center, const TileRect& tile, bool begins_above,
                           bool ends_above) {
  row_ = center;
  cut_count_ = 0;
  const std::size_t n = degree_;
  for (std::size_t k = 0; k <= n; ++k) height_[k] = center * w_[k] - y_[k];
  std::array<double, 2> turns;
  const std::size_t turn_count = turning_places(n, height_, turns);
  double from = 0;
  bool is_above = begins_above;
  for (std::size_t k = 0; k <= turn_count; ++k) {
    const bool last = k == turn_count;
    const double to = last ? 1 : turns[k];
    const bool then_above = last ? ends_above : at_place(n, height_, to) >= 0;
    if (then_above != is_above) {
      // the sides of both ends are known; two steps of regula falsi alternate with one bisection
      double low = from, high = to;
      double h_low = at_place(n, height_, low), h_high = at_place(n, height_, high);
      for (int step = 0; step < 100 && low < high; ++step) {
        const double secant = low - h_low * ((high - low) / (h_high - h_low));
        const double middle = 0.5 * (low + high);
        const double s = step % 3 != 2 && secant > low && secant < high ? secant : middle;
        if (s <= low || s >= high) break;
        const double h = at_place(n, height_, s);
        ((h >= 0) == is_above ? low : high) = s;
        ((h >= 0) == is_above ? h_low : h_high) = h;
        if (h == 0) low = high = s;
      }
      add_cut(tile, std::abs(h_low) < std::abs(h_high) ? low : high, then_above);
    }
    from = to;
    is_above = then_above;
  }
}

// How far right of a pixel centre a point of the edge still counts as on it (on_crossing). The
// edge's direction matters only for a point that is nearly on a pixel centre.
double CurvedEdge::slack_at(double s, double x) const {
  const double right = x - 0.5 - std::floor(x - 0.5);
  if (right > kMostOnCrossing) return 0;
  // slopes of x W - X and y W - Y, which both vanish at s
  const std::size_t n = degree_;
  const double w = slope_at(n, w_, s);
  return on_crossing((slope_at(n, x_, s) - x * w) / (slope_at(n, y_, s) - row_ * w));
}

// A point lies left of the ray of pixel x if X - x W <= 0, in front of the eye and behind it.
void CurvedEdge::add_cut(const TileRect& tile, double s, bool comes_up) {
  const double x = at_place(degree_, x_, s), w = at_place(degree_, w_, s);
  Cut& cut = cuts_[cut_count_++];
  cut.sign = comes_up ? 1 : -1;
  cut.from_column_on = w > 0 || (w == 0 && x <= 0);
  if (w == 0)
    cut.column = tile.x0;
  else
    cut.column = first_center(x / w, tile.x0, tile.x1, slack_at(s, x / w));
}

}  // namespace hiac
