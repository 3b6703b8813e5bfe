#include "hiac/render/refine/extended_tetrahedron.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "hiac/element/face_interpolant.hpp"
#include "hiac/frame/row_crossing.hpp"
#include "hiac/geometry/extended_vector.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/refine/extended_ray.hpp"

namespace hiac {
namespace {

using Real = long double;
using Vec = ExtendedVector;

// The corners of the face that lacks one corner, ascending.
std::array<std::size_t, 3> corners_of(std::size_t lacking) {
  std::array<std::size_t, 3> c{};
  for (std::size_t k = 0, n = 0; k < 4; ++k)
    if (k != lacking) c[n++] = k;
  return c;
}

}  // namespace

ExtendedTetrahedron::ExtendedTetrahedron(const Frame& frame, CellId cell)
    : frame_(frame),
      cell_(cell),
      perspective_(frame.projector.perspective()),
      on_screen_(frame.kernel_cells[cell] == CellKernel::linear),
      corner_{0, 1, 2, 3} {
  const auto nodes = frame.mesh.cell_nodes(cell);
  std::ranges::sort(corner_, {}, [&](std::size_t k) { return std::pair(nodes[k], k); });
  for (std::size_t k = 0; k < 4; ++k) {
    const NodeId node = nodes[corner_[k]];
    const auto position = frame.mesh.position(node);
    rounded_[k] = frame.nodes[node];
    exact_[k] = on_screen_ ? frame.projector.project_extended(position)
                           : frame.projector.extended_camera_coordinates(position);
  }
}

// Whether a face covers a pixel: scan_faces (scan_conversion-inl.hpp) for one face and one pixel.
bool ExtendedTetrahedron::covered(std::size_t lacking, int x, double center) const {
  const auto c = corners_of(lacking);
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const auto& [a, b] : {std::pair(c[0], c[1]), std::pair(c[0], c[2]), std::pair(c[1], c[2])}) {
    const ProjectedNode &i = rounded_[a], &j = rounded_[b];
    if ((i.y <= center) == (j.y <= center)) continue;
    const double slope = edge_slope(i, j);
    const double column = std::ceil(crossing_x(center, i.x, i.y, slope) - to_first_pixel(slope));
    first = std::min(first, column);
    last = std::max(last, column);
  }
  return first <= x && x < last;
}

// The point where a pixel's ray meets a face, by Gaussian elimination with complete pivoting, as
// for FacePlanes (scan_conversion-inl.hpp).
ExtendedTetrahedron::Place ExtendedTetrahedron::place_on(std::size_t lacking, int x, int y) const {
  const auto [base, one, two] = corners_of(lacking);
  const auto from_base = [&](std::size_t k, std::size_t axis) {
    return exact_[k][axis] - exact_[base][axis];
  };
  const auto reach = [&](std::size_t k) {
    return std::max(std::abs(from_base(k, 0)), std::abs(from_base(k, 1)));
  };
  const bool swapped = reach(one) < reach(two);
  const std::size_t m = swapped ? two : one, s = swapped ? one : two;
  const std::size_t p = std::abs(from_base(m, 0)) < std::abs(from_base(m, 1)) ? 1 : 0, q = 1 - p;
  const std::array<Real, 2> to{pixel_center(x) - exact_[base][0],
                               pixel_center(y) - exact_[base][1]};
  const Real l = from_base(m, q) / from_base(m, p);
  const Real of_s = (to[q] - l * to[p]) / (from_base(s, q) - l * from_base(s, p));
  const Real of_m = (to[p] - from_base(s, p) * of_s) / from_base(m, p);
  Place place{lacking, {}, 0, 0};
  place.weights[m] = of_m;
  place.weights[s] = of_s;
  place.depth = exact_[base][2] + of_m * from_base(m, 2) + of_s * from_base(s, 2);
  place.t = perspective_ ? -1 / place.depth : place.depth;
  return place;
}

ExtendedTetrahedron::Met ExtendedTetrahedron::cross(int x, int y, Crossing& crossing) const {
  if (!on_screen_) return cross_in_world(x, y, crossing);
  std::array<Place, 2> met;
  std::size_t count = 0;
  for (std::size_t lacking = 4; lacking-- > 0 && count < 2;)
    if (covered(lacking, x, pixel_center(y))) met[count++] = place_on(lacking, x, y);
  if (count < 2) return Met::no;
  if (met[1].depth < met[0].depth) std::swap(met[0], met[1]);
  crossing = {met[0], met[1]};
  return Met::once;
}

ExtendedTetrahedron::Met ExtendedTetrahedron::cross_in_world(int x, int y,
                                                             Crossing& crossing) const {
  std::vector<CellCrossing> crossings;
  scan_cell(frame_, cell_, {x, y, x + 1, y + 1}, crossings);
  if (crossings.empty()) return Met::no;
  if (crossings.size() > 1 || !place_in_world(crossings.front().front_face, x, y, crossing.front) ||
      !place_in_world(crossings.front().back_face, x, y, crossing.back))
    return Met::doubtful;
  if (crossing.back.t < crossing.front.t) std::swap(crossing.front, crossing.back);
  return Met::once;
}

// Finds the point where a ray meets a face in the world. Returns false if the ray lies in the face,
// or the cell has no volume.
bool ExtendedTetrahedron::place_in_world(std::uint8_t face, int x, int y, Place& place) const {
  std::size_t lacking = 0;
  while (tetrahedron_face_without(corner_[lacking]) != face) ++lacking;
  const auto [base, one, two] = corners_of(lacking);
  const ExtendedRay ray(frame_.projector, x, y);
  const Vec normal =
      hiac::cross(minus(exact_[one], exact_[base]), minus(exact_[two], exact_[base]));
  const Real along = dot(normal, ray.direction);
  if (along == 0) return false;
  place = {lacking, {}, 0, dot(normal, minus(exact_[base], ray.origin)) / along};
  const auto nearer = [](const Vec& p, const Vec& q) { return p[2] < q[2]; };
  const auto [nearest, farthest] = std::minmax_element(exact_.begin(), exact_.end(), nearer);
  place.t = std::clamp(place.t, (*nearest)[2], (*farthest)[2]);
  const Vec from = minus(ray.at(place.t), exact_[0]);
  const Vec e1 = minus(exact_[1], exact_[0]), e2 = minus(exact_[2], exact_[0]),
            e3 = minus(exact_[3], exact_[0]);
  const Real volume = dot(e1, hiac::cross(e2, e3));
  if (volume == 0) return false;
  place.weights = {0, dot(from, hiac::cross(e2, e3)) / volume,
                   dot(from, hiac::cross(e3, e1)) / volume,
                   dot(from, hiac::cross(e1, e2)) / volume};
  return true;
}

// In perspective, a linear scalar times the depth is affine on the screen; the value at the face's
// first corner is subtracted first.
Real ExtendedTetrahedron::at(const Place& place, const CornerValues& values) const {
  const bool by_depth = on_screen_ && perspective_;
  const std::size_t base = on_screen_ && place.face == 0 ? 1 : 0;
  Real more = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (k == base || (on_screen_ && k == place.face)) continue;
    const Real difference = values[k] - values[base];
    more += place.weights[k] * (by_depth ? difference * exact_[k][2] : difference);
  }
  const Real value = values[base] + (by_depth ? more / place.depth : more);
  const auto [least, most] = std::ranges::minmax(values);
  return std::min(std::max(value, least), most);
}

}  // namespace hiac
