#include "hiac/render/walk/screen_side.hpp"

#include <array>

#include "hiac/geometry/predicates.hpp"

namespace hiac {

bool is_left_exactly(const RayNode& a, NodeId id_a, const RayNode& b, NodeId id_b, double x,
                     double y) {
  const std::array<double, 3> p{x, y, 0}, q{a.x, a.y, 0}, r{b.x, b.y, 0}, out{0, 0, 1};
  const int side = orientation_towards(p, q, r, out);
  if (side != 0) return side > 0;
  // the derivatives of (a - p) x (b - p) by p.x and p.y
  if (a.y != b.y) return a.y > b.y;
  if (a.x != b.x) return b.x > a.x;
  // and by b.y - a.y
  return (a.x > x) == (id_b < id_a);
}

}  // namespace hiac
