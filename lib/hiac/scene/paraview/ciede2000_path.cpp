#include "hiac/scene/paraview/ciede2000_path.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "hiac/scene/colormaps/color_space.hpp"

namespace hiac::paraview {
namespace {

using color_space::Triple;
using std::numbers::pi;

constexpr int kSide = 17;  // colours along an edge of the cube
constexpr double kDegree = pi / 180;

using GridColor = std::array<int, 3>;

std::size_t index_of(const GridColor& c) {
  return static_cast<std::size_t>(c[0] + kSide * (c[1] + kSide * c[2]));
}

GridColor nearest(const Triple& rgb) {
  GridColor color{};
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = static_cast<int>(std::clamp(rgb[c], 0.0, 1.0) * (kSide - 1) + 0.5);
  return color;
}

Triple rgb_of(const GridColor& color) {
  Triple rgb;
  for (std::size_t c = 0; c < 3; ++c) rgb[c] = color[c] / double{kSide - 1};
  return rgb;
}

/// The hue angle of a colour in [0, 2 pi); 0 for a grey.
double hue(double a, double b) {
  if (a == 0 && b == 0) return 0;
  const double angle = std::atan2(b, a);
  return angle < 0 ? angle + 2 * pi : angle;
}

/// 7th powers, as CIEDE2000's formulas for chroma have them: 0 for greys, 1 for strong colours.
double strength(double chroma) {
  const double power = std::pow(chroma, 7);
  return std::sqrt(power / (power + std::pow(25.0, 7)));
}

double mean_hue(double h1, double h2) {
  if (std::fabs(h1 - h2) <= pi) return 0.5 * (h1 + h2);
  return h1 + h2 < 2 * pi ? 0.5 * (h1 + h2 + 2 * pi) : 0.5 * (h1 + h2 - 2 * pi);
}

double squared(double x) { return x * x; }

/// Calls `visit` for every neighbour of a colour in the grid.
template <typename Visit>
void for_neighbours(const GridColor& at, const Visit& visit) {
  const auto low = [&](std::size_t c) { return std::max(at[c] - 1, 0); };
  const auto high = [&](std::size_t c) { return std::min(at[c] + 1, kSide - 1); };
  for (int b = low(2); b <= high(2); ++b)
    for (int g = low(1); g <= high(1); ++g)
      for (int r = low(0); r <= high(0); ++r)
        if (const GridColor next{r, g, b}; next != at) visit(next);
}

/// For every colour of the grid its distance to one, and the next colour on the way there.
struct DistanceMap {
  std::vector<double> distance;
  std::vector<GridColor> next;
};

/// E. Dijkstra's algorithm; of colours at the same distance the lexicographically least goes first.
DistanceMap distances_to(const GridColor& target) {
  constexpr std::size_t kColors = std::size_t{kSide} * kSide * kSide;
  DistanceMap map{std::vector<double>(kColors, std::numeric_limits<double>::infinity()),
                  std::vector<GridColor>(kColors)};
  using Entry = std::pair<double, GridColor>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  map.distance[index_of(target)] = 0;
  front.emplace(0, target);
  while (!front.empty()) {
    const auto [distance, color] = front.top();
    front.pop();
    if (distance > map.distance[index_of(color)]) continue;
    const Triple lab = color_space::rgb_to_lab(rgb_of(color));
    for_neighbours(color, [&, d = distance, c = color](const GridColor& neighbour) {
      const double found = d + ciede2000(lab, color_space::rgb_to_lab(rgb_of(neighbour)));
      if (!(found < map.distance[index_of(neighbour)])) return;
      map.distance[index_of(neighbour)] = found;
      map.next[index_of(neighbour)] = c;
      front.emplace(found, neighbour);
    });
  }
  return map;
}

}  // namespace

double ciede2000(const std::array<double, 3>& lab1, const std::array<double, 3>& lab2) {
  const double mean_chroma = 0.5 * (std::hypot(lab1[1], lab1[2]) + std::hypot(lab2[1], lab2[2]));
  const double stretch = 1 + 0.5 * (1 - strength(mean_chroma));
  const double a1 = stretch * lab1[1], a2 = stretch * lab2[1];
  const double c1 = std::hypot(a1, lab1[2]), c2 = std::hypot(a2, lab2[2]);
  const double h1 = hue(a1, lab1[2]), h2 = hue(a2, lab2[2]);
  const bool is_grey = c1 * c2 == 0;
  double turn = is_grey ? 0 : h2 - h1;
  if (turn < -pi) turn += 2 * pi;
  if (turn > pi) turn -= 2 * pi;
  const double chroma = 0.5 * (c1 + c2);
  const double angle = is_grey ? h1 + h2 : mean_hue(h1, h2);
  const double t = 1 - 0.17 * std::cos(angle - 30 * kDegree) + 0.24 * std::cos(2 * angle) +
                   0.32 * std::cos(3 * angle + 6 * kDegree) -
                   0.2 * std::cos(4 * angle - 63 * kDegree);
  const double lightness = squared(0.5 * (lab1[0] + lab2[0]) - 50);
  const double l = (lab2[0] - lab1[0]) / (1 + 0.015 * lightness / std::sqrt(20 + lightness));
  const double c = (c2 - c1) / (1 + 0.045 * chroma);
  const double h = 2 * std::sqrt(c1 * c2) * std::sin(0.5 * turn) / (1 + 0.015 * chroma * t);
  const double theta = 30 * kDegree * std::exp(-squared((angle / kDegree - 275) / 25));
  const double rotation = -std::sin(2 * theta) * 2 * strength(chroma);
  return std::sqrt(squared(l) + squared(c) + squared(h) + rotation * c * h);
}

std::vector<PathColor> ciede2000_path(const std::array<double, 3>& from,
                                      const std::array<double, 3>& to) {
  const GridColor first = nearest(from), last = nearest(to);
  const DistanceMap map = distances_to(last);
  const double length = map.distance[index_of(first)];
  std::vector<PathColor> path;
  for (GridColor at = first;; at = map.next[index_of(at)]) {
    const double gone = length - map.distance[index_of(at)];
    path.push_back({length > 0 ? gone / length : 0, rgb_of(at)});
    if (at == last) return path;
  }
}

}  // namespace hiac::paraview
