#pragma once

#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/order/visibility_order.hpp"

namespace hiac::test {

/// The exact order of a mesh from its coordinates alone.
inline OrderResult sorted(const ZooMesh& mesh, const View& view, double planarity = 1e-10) {
  return exact_order(mesh, build_face_adjacency(mesh), view, planarity);
}

}  // namespace hiac::test
