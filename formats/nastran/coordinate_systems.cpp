#include "formats/nastran/coordinate_systems.hpp"

#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace hiac::formats::nastran {
namespace {

Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Point unit(const Point& a, std::int64_t number) {
  const double length = std::sqrt(dot(a, a));
  if (!(length > 0))
    throw std::invalid_argument(
        fmt::format("the points of coordinate system {} lie on a line", number));
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// Cylindrical (r, theta, z) and spherical (r, theta from z, phi) coordinates as x, y, z.
Point rectangular(char kind, const Point& p) {
  constexpr double kDegree = std::numbers::pi / 180;
  if (kind == 'C') return {p[0] * std::cos(p[1] * kDegree), p[0] * std::sin(p[1] * kDegree), p[2]};
  if (kind == 'S')
    return {p[0] * std::sin(p[1] * kDegree) * std::cos(p[2] * kDegree),
            p[0] * std::sin(p[1] * kDegree) * std::sin(p[2] * kDegree),
            p[0] * std::cos(p[1] * kDegree)};
  return p;
}

}  // namespace

const CoordinateSystems::Frame& CoordinateSystems::frame_of(std::int64_t number,
                                                            const GridPosition& position) {
  // the systems without a frame, each in the next; a loop, because they may be many
  std::vector<std::int64_t> chain;
  std::set<std::int64_t> seen;
  for (std::int64_t next = number; !frames_.contains(next);) {
    const auto found = systems_.find(next);
    if (found == systems_.end())
      throw std::invalid_argument(fmt::format("there is no coordinate system {}", next));
    if (!seen.insert(next).second)
      throw std::invalid_argument(fmt::format("coordinate system {} refers to itself", next));
    chain.push_back(next);
    next = found->second.reference;
    if (next == 0) break;
  }
  for (; !chain.empty(); chain.pop_back())
    frames_.emplace(chain.back(), placed(chain.back(), position));
  return frames_.at(number);
}

CoordinateSystems::Frame CoordinateSystems::placed(std::int64_t number,
                                                   const GridPosition& position) const {
  CoordinateSystem system = systems_.at(number);
  for (std::size_t i = 0; i < 3; ++i) {
    if (system.by_grids) {
      system.points[i] = position(system.grids[i]);
    } else if (system.reference != 0) {
      const Frame& frame = frames_.at(system.reference);
      const Point local = rectangular(frame.kind, system.points[i]);
      for (std::size_t c = 0; c < 3; ++c)
        system.points[i][c] = frame.origin[c] + local[0] * frame.axes[0][c] +
                              local[1] * frame.axes[1][c] + local[2] * frame.axes[2][c];
    }
  }
  Frame frame{system.kind, system.points[0], {}};
  frame.axes[2] = unit(difference(system.points[1], system.points[0]), number);
  frame.axes[1] =
      unit(cross(frame.axes[2], difference(system.points[2], system.points[0])), number);
  frame.axes[0] = cross(frame.axes[1], frame.axes[2]);
  return frame;
}

Point CoordinateSystems::basic(std::int64_t number, const Point& coordinates,
                               const GridPosition& position) {
  const Frame& frame = frame_of(number, position);
  const Point local = rectangular(frame.kind, coordinates);
  Point result = frame.origin;
  for (std::size_t c = 0; c < 3; ++c)
    result[c] +=
        local[0] * frame.axes[0][c] + local[1] * frame.axes[1][c] + local[2] * frame.axes[2][c];
  return result;
}

}  // namespace hiac::formats::nastran
