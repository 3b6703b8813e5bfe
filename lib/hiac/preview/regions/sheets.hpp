#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hiac/preview/regions/polyhedron.hpp"
#include "hiac/preview/regions/subdivision.hpp"

namespace hiac::preview {

/// A point of a polyhedron's surface: a mean of up to three of its vertices, with weights that are
/// not negative and add up to 1 on the screen. What is affine on the screen (depths; in
/// perspective, fields divided by t) has that mean there.
struct SurfacePoint {
  double depth;  ///< as ProjectedNode's
  std::array<std::uint16_t, 3> vertices;
  std::array<double, 3> weights;
};

/// Where the ray of a vertex of the subdivision enters and leaves the polyhedron.
struct RayThrough {
  ScreenPoint at;
  SurfacePoint front, back;
};

/// The rays of all vertices of a subdivision, by their numbers. Points are found on the vertices
/// and edges that meet there and, where a vertex has nothing but a face in front of it or behind,
/// on that face, which exact predicates find; nothing is extrapolated, whatever the slope of a
/// face.
class Sheets {
 public:
  void find(const Polyhedron& polyhedron, std::span<const PolyhedronEdge> edges,
            const Subdivision& subdivision, std::vector<RayThrough>& rays);

 private:
  void add_vertices(const Polyhedron& polyhedron, const Subdivision& subdivision);
  void add_edges(const Polyhedron& polyhedron, std::span<const PolyhedronEdge> edges,
                 const Subdivision& subdivision);
  void add_faces(const Polyhedron& polyhedron, const Subdivision& subdivision);

  std::vector<RayThrough>* rays_ = nullptr;
  std::vector<std::uint8_t> on_outline_;
};

}  // namespace hiac::preview
