#pragma once

#include <cstdint>

#include "hiac/geometry/view.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/visibility_order.hpp"

namespace hiac::test {

struct RayCheck {
  std::uint64_t pairs = 0;       ///< consecutive cells on a ray that were compared
  std::uint64_t misordered = 0;  ///< of those, the ones that the order has the wrong way round
};

/// Follows random rays through a mesh of linear tetrahedra by brute force, in extended precision,
/// and compares the sequence of cells on each with the order. Cells of one group are in any order.
/// Ray segments shorter than 1e-12 of the mesh are left out: rounding decides about them.
RayCheck check_along_rays(const ZooMesh& mesh, const VisibilityOrder& order, const View& view,
                          std::size_t rays, std::uint64_t seed);

}  // namespace hiac::test
