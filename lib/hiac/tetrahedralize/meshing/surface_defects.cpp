#include "hiac/tetrahedralize/meshing/surface_defects.hpp"

#include <algorithm>
#include <map>

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

namespace hiac {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::array<std::uint32_t, 3>;

class DefectFinder {
 public:
  explicit DefectFinder(const Surface& surface) {
    for (const auto& [x, y, z] : surface.points) points_.emplace_back(x, y, z);
    for (const Facet& facet : surface.facets)
      corners_.push_back({facet.polygons[0][0], facet.polygons[0][1], facet.polygons[0][2]});
  }

  SurfaceDefects find() {
    find_degenerate();
    find_open();
    find_intersecting();
    return std::move(defects_);
  }

 private:
  [[nodiscard]] const Kernel::Point_3& at(std::uint32_t point) const { return points_[point]; }
  [[nodiscard]] Kernel::Triangle_3 triangle(const Corners& c) const {
    return {at(c[0]), at(c[1]), at(c[2])};
  }

  void find_degenerate() {
    for (std::uint32_t t = 0; t < corners_.size(); ++t) {
      const auto& [a, b, c] = corners_[t];
      if (CGAL::collinear(at(a), at(b), at(c))) defects_.degenerate.push_back(t);
    }
  }

  void find_open() {
    std::map<std::array<std::uint32_t, 2>, std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::uint32_t t = 0; t < corners_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = corners_[t][k], b = corners_[t][(k + 1) % 3];
        auto& [count, triangle] = edges[{std::min(a, b), std::max(a, b)}];
        ++count;
        triangle = t;
      }
    for (const auto& [points, met] : edges)
      if (met.first == 1) defects_.open.push_back({points, met.second});
  }

  // Permutes both triangles so that the corners that they share come first; returns their number.
  static std::size_t shared_first(Corners& p, Corners& q) {
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = shared; j < 3; ++j)
        if (p[i] == q[j]) {
          std::swap(p[shared], p[i]);
          std::swap(q[shared], q[j]);
          ++shared;
          break;
        }
    return shared;
  }

  // Neither triangle may be degenerate.
  [[nodiscard]] bool intersect(Corners p, Corners q) const {
    switch (shared_first(p, q)) {
      case 0:
        return CGAL::do_intersect(triangle(p), triangle(q));
      case 1:  // they meet elsewhere if one enters the other across its far edge
        return CGAL::do_intersect(Kernel::Segment_3(at(p[1]), at(p[2])), triangle(q)) ||
               CGAL::do_intersect(Kernel::Segment_3(at(q[1]), at(q[2])), triangle(p));
      case 2:  // they meet elsewhere if one is folded onto the other
        return CGAL::coplanar(at(p[0]), at(p[1]), at(p[2]), at(q[2])) &&
               CGAL::coplanar_orientation(at(p[0]), at(p[1]), at(p[2]), at(q[2])) == CGAL::POSITIVE;
      default:
        return true;
    }
  }

  void find_intersecting() {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
    std::vector<Box> boxes;
    for (std::uint32_t t = 0; t < corners_.size(); ++t)
      if (!std::ranges::binary_search(defects_.degenerate, t))
        boxes.emplace_back(triangle(corners_[t]).bbox(), t);
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
      const std::uint32_t first = std::min(a.info(), b.info()),
                          second = std::max(a.info(), b.info());
      if (intersect(corners_[first], corners_[second]))
        defects_.intersecting.emplace_back(first, second);
    });
    std::ranges::sort(defects_.intersecting);
  }

  std::vector<Kernel::Point_3> points_;
  std::vector<Corners> corners_;
  SurfaceDefects defects_;
};

}  // namespace

SurfaceDefects find_surface_defects(const Surface& surface) { return DefectFinder(surface).find(); }

}  // namespace hiac
