#include "hiac/preview/regions/projected_tetrahedron.hpp"

#include <utility>

namespace hiac::preview {
namespace {

double length2(const ScreenPoint& a, const ScreenPoint& b) {
  return (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
}

}  // namespace

ProjectedTetrahedron project_tetrahedron(std::span<const ScreenPoint, 4> points,
                                         std::span<const double, 4> depths) {
  const std::array<double, 4> relation{
      twice_area(points[1], points[2], points[3]), -twice_area(points[0], points[2], points[3]),
      twice_area(points[0], points[1], points[3]), -twice_area(points[0], points[1], points[2])};
  ProjectedTetrahedron result{};
  std::array<std::uint8_t, 4> plus{}, minus{};
  unsigned plus_count = 0, minus_count = 0;
  double plus_sum = 0, minus_sum = 0;
  for (std::uint8_t k = 0; k < 4; ++k) {
    if (relation[k] > 0) {
      plus[plus_count++] = k;
      plus_sum += relation[k];
    } else if (relation[k] < 0) {
      minus[minus_count++] = k;
      minus_sum += relation[k];
    }
  }
  if (plus_count == 0 || minus_count == 0) return result;
  result.count = plus_count * minus_count;
  // exactly at the corner where there is one
  const bool by_plus = plus_count <= minus_count;
  for (unsigned i = 0; i < plus_count; ++i) {
    const std::uint8_t k = plus[i];
    result.front[k] = plus_count == 1 ? 1 : relation[k] / plus_sum;
    result.front_depth += result.front[k] * depths[k];
    if (!by_plus) continue;
    result.at.x += result.front[k] * points[k].x;
    result.at.y += result.front[k] * points[k].y;
  }
  for (unsigned j = 0; j < minus_count; ++j) {
    const std::uint8_t k = minus[j];
    result.back[k] = minus_count == 1 ? 1 : relation[k] / minus_sum;
    result.back_depth += result.back[k] * depths[k];
    if (by_plus) continue;
    result.at.x += result.back[k] * points[k].x;
    result.at.y += result.back[k] * points[k].y;
  }
  // The corners of the outline are those of the larger side, and those of neither. Of two equal
  // sides those of the shorter diagonal: blocks of pixels along it are drawn with both of its
  // triangles.
  const bool two_outlines = plus_count == 2 && minus_count == 2;
  const bool of_plus = two_outlines ? length2(points[plus[0]], points[plus[1]]) <
                                          length2(points[minus[0]], points[minus[1]])
                                    : plus_count > minus_count;
  std::array<std::uint8_t, 4> corners = of_plus ? plus : minus;
  unsigned count = of_plus ? plus_count : minus_count;
  for (std::uint8_t k = 0; k < 4; ++k)
    if (relation[k] == 0) corners[count++] = k;
  if (two_outlines) {
    result.outlines = 2;
    const std::array<std::uint8_t, 4>& others = of_plus ? minus : plus;
    for (unsigned i = 0; i < 2; ++i) result.outline[i] = {corners[0], corners[1], others[i]};
  } else {
    result.outlines = 1;
    result.outline[0] = {corners[0], corners[1], corners[2]};
  }
  result.outline_is_front = of_plus;
  if (result.front_depth > result.back_depth) {
    result.outline_is_front = !of_plus;
    std::swap(result.front, result.back);
    std::swap(result.front_depth, result.back_depth);
  }
  return result;
}

}  // namespace hiac::preview
