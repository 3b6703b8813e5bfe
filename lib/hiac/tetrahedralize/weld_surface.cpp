#include "hiac/tetrahedralize/weld_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace hiac {
namespace {

using Point = std::array<double, 3>;

double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Points that stay, found by where they are: in a grid whose cubes are as large as the tolerance,
// near ones are in a cube or in those around it. With no tolerance, a cube is a place.
class Places {
 public:
  explicit Places(double tolerance) : tolerance_(tolerance) {}

  // The nearest one within the tolerance; its number among `points`, or none.
  [[nodiscard]] std::uint32_t nearest(const Point& p, const std::vector<Point>& points) const {
    std::uint32_t best = kNone;
    double least = std::numeric_limits<double>::infinity();
    const Cube centre = cube_of(p);
    const int reach = tolerance_ > 0 ? 1 : 0;
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j)
        for (int k = -reach; k <= reach; ++k) {
          const auto cube = cubes_.find({centre[0] + i, centre[1] + j, centre[2] + k});
          if (cube == cubes_.end()) continue;
          for (const std::uint32_t candidate : cube->second) {
            const double d = distance(points[candidate], p);
            if (d > tolerance_ || d > least || (d == least && candidate > best)) continue;
            least = d;
            best = candidate;
          }
        }
    return best;
  }

  void add(std::uint32_t number, const Point& p) { cubes_[cube_of(p)].push_back(number); }

  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

 private:
  using Cube = std::array<double, 3>;
  struct Hash {
    std::size_t operator()(const Cube& cube) const {
      std::size_t hash = 0;
      for (const double x : cube)
        hash = hash * 0x9e3779b97f4a7c15U + std::hash<double>()(x) + (hash >> 29U);
      return hash;
    }
  };

  // whole numbers as doubles: they cannot run over; + 0.0 makes -0 the same as 0
  [[nodiscard]] Cube cube_of(const Point& p) const {
    Cube cube = p;
    for (double& x : cube) x = (tolerance_ > 0 ? std::floor(x / tolerance_) : x) + 0.0;
    return cube;
  }

  double tolerance_;
  std::unordered_map<Cube, std::vector<std::uint32_t>, Hash> cubes_;
};

// The polygon with its corners renumbered, those that follow one another once.
std::vector<std::uint32_t> renumbered(const std::vector<std::uint32_t>& polygon,
                                      const std::vector<std::uint32_t>& numbers) {
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t corner : polygon)
    if (corners.empty() || corners.back() != numbers[corner]) corners.push_back(numbers[corner]);
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  return corners;
}

}  // namespace

WeldCounts weld_surface(Surface& surface, double tolerance) {
  WeldCounts counts;
  Places places(tolerance);
  std::vector<Point> kept;
  std::vector<std::uint32_t> numbers;
  for (const Point& p : surface.points) {
    const std::uint32_t same = places.nearest(p, kept);
    if (same != Places::kNone) {
      ++counts.points;
      counts.farthest = std::max(counts.farthest, distance(kept[same], p));
      numbers.push_back(same);
      continue;
    }
    numbers.push_back(static_cast<std::uint32_t>(kept.size()));
    places.add(numbers.back(), p);
    kept.push_back(p);
  }
  surface.points = std::move(kept);
  for (Facet& facet : surface.facets)
    for (auto& polygon : facet.polygons) polygon = renumbered(polygon, numbers);
  counts.facets = std::erase_if(surface.facets, [](const Facet& facet) {
    return facet.polygons.size() == 1 && facet.polygons[0].size() < 3;
  });
  return counts;
}

}  // namespace hiac
