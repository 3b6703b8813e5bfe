#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>

namespace hiac::formats::nastran {

using Point = std::array<double, 3>;

/// A coordinate system as its entry defines it: three points (the origin, one on the z axis, one in
/// the x-z plane) in system `reference`, or three grid points (CORD1).
struct CoordinateSystem {
  char kind = 'R';  ///< R rectangular, C cylindrical, S spherical
  std::int64_t reference = 0;
  std::array<Point, 3> points{};
  std::array<std::int64_t, 3> grids{};
  bool by_grids = false;
};

/// Transforms coordinates in any of the systems to basic ones (Nastran's Quick Reference Guide,
/// CORD2R, CORD2C, CORD2S: theta and phi in degrees).
class CoordinateSystems {
 public:
  /// The basic position of a grid point, for CORD1 entries.
  using GridPosition = std::function<Point(std::int64_t grid)>;

  void add(std::int64_t number, const CoordinateSystem& system) { systems_[number] = system; }
  /// Throws std::invalid_argument: what is wrong.
  Point basic(std::int64_t number, const Point& coordinates, const GridPosition& position);

 private:
  /// Origin and axes of a system in basic coordinates.
  struct Frame {
    char kind;
    Point origin;
    std::array<Point, 3> axes;
  };
  const Frame& frame_of(std::int64_t number, const GridPosition& position);
  /// The frame of a system whose reference has one.
  [[nodiscard]] Frame placed(std::int64_t number, const GridPosition& position) const;

  std::map<std::int64_t, CoordinateSystem> systems_;
  std::map<std::int64_t, Frame> frames_;
};

}  // namespace hiac::formats::nastran
