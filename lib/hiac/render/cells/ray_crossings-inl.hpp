// Where rays cross the surface of a cell, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_RAY_CROSSINGS_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_RAY_CROSSINGS_INL
#    undef HIAC_RENDER_RAY_CROSSINGS_INL
#  else
#    define HIAC_RENDER_RAY_CROSSINGS_INL
#  endif

#  include <array>
#  include <cstdint>
#  include <limits>
#  include <vector>

#  include <hwy/highway.h>

#  include "hiac/element/cell_surface.hpp"
#  include "hiac/render/cells/cell_scan.hpp"
#  include "hiac/render/cells/curved/curved_faces.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A triangle that a row crosses, and the two edges that the row crosses.
struct CrossedTriangle {
  std::size_t triangle, e, f;
};

// The triangles that one row crosses.
struct RowSection {
  std::array<CrossedTriangle, CellSurface::kMostTriangles> triangles;
  std::size_t triangle_count;

  // `crossed`: the edges that the row crosses, one bit each. Triangles of curved faces are left
  // out.
  HWY_INLINE RowSection(const CellSurface& surface, const CurvedFaces* curved,
                        std::uint32_t crossed)
      : triangle_count(0) {
    const auto is_crossed = [&](std::uint8_t e) { return (crossed >> e & 1U) != 0; };
    for (std::size_t k = 0; k < surface.triangle_count; ++k) {
      if (curved != nullptr && curved->holds(surface.triangles[k].face)) continue;
      // a row crosses two edges of a triangle, or none
      const auto& [a, b, c] = surface.triangles[k].edges;
      if (!is_crossed(a) && !is_crossed(b)) continue;
      triangles[triangle_count++] = {k, is_crossed(a) ? a : b,
                                     is_crossed(a) && is_crossed(b) ? b : c};
    }
  }
};

// Where one ray crosses a cell's surface.
class RayCrossings {
 public:
  // Inserts a crossing in ascending order of t. `u`, `v`: its parameters on a curved face.
  HWY_INLINE void add(double t, std::uint8_t face, double u = 0, double v = 0) {
    std::size_t at = count_++;
    for (; at > 0 && places_[at - 1].t > t; --at) places_[at] = places_[at - 1];
    places_[at] = {t, u, v, face};
  }

  // Appends the cell crossings: the ray enters and leaves in turn, once each in a convex cell,
  // unless it runs along a surface that rounding has roughened.
  HWY_INLINE void append_to(std::vector<CellCrossing>& crossings, const CurvedFaces* curved, int x,
                            int y) const {
    for (std::size_t k = 0; k + 1 < count_; k += 2) {
      const Place &front = places_[k], &back = places_[k + 1];
      crossings.push_back({x, y, front.t, back.t, front.face, back.face, reference(curved, front),
                           reference(curved, back), doubt(curved, front, x),
                           doubt(curved, back, x)});
    }
  }

 private:
  struct Place {
    double t, u, v;
    std::uint8_t face;
  };

  static HWY_INLINE std::array<double, 3> reference(const CurvedFaces* curved, const Place& place) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    if (curved == nullptr || !curved->holds(place.face)) return {kNone, kNone, kNone};
    return curved->reference(place.face, place.u, place.v);
  }

  static HWY_INLINE double doubt(const CurvedFaces* curved, const Place& place, int x) {
    if (curved == nullptr || !curved->with_doubts() || !curved->holds(place.face))
      return std::numeric_limits<double>::quiet_NaN();
    return curved->doubt(place.face, place.u, place.v, x, curved->displaced());
  }

  std::array<Place, CellSurface::kMostTriangles + CurvedFaces::kMostZeros> places_;
  std::size_t count_ = 0;
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
