#include "hiac/render/refine/extended_ray.hpp"

#include <cmath>

#include "hiac/frame/tiles/tile.hpp"

namespace hiac {

ExtendedRay::ExtendedRay(const Projector& projector, int x, int y) {
  const auto [a, b] = projector.extended_slopes(pixel_center(x), pixel_center(y));
  const bool perspective = projector.perspective();
  origin = perspective ? ExtendedVector{0, 0, 0} : ExtendedVector{a, b, 0};
  direction = perspective ? ExtendedVector{a, b, 1} : ExtendedVector{0, 0, 1};
  scale = perspective ? std::sqrt(a * a + b * b + 1) : 1;
}

ExtendedVector ExtendedRay::at(long double t) const {
  return {origin[0] + t * direction[0], origin[1] + t * direction[1], origin[2] + t * direction[2]};
}

ExtendedVector ExtendedRay::along() const {
  return {direction[0] / scale, direction[1] / scale, direction[2] / scale};
}

}  // namespace hiac
