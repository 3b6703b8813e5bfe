#pragma once

#include <utility>
#include <vector>

#include "hiac/geometry/view.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "tests/order/brute_force_order.hpp"

namespace hiac::test {

/// What rays do between the cells of a mesh, pair by pair.
struct ExactRelation {
  Arrows arrows;       ///< some ray meets the inner of the first cell before that of the second
  Arrows overlapping;  ///< cells whose inners some ray meets and which have points in common
  std::vector<CellId> flat;  ///< cells without volume
};

/// The truth about a mesh of convex cells, by brute force: every cell is the convex hull of its
/// corners, every pair of cells is asked, and nobody asks for faces, neighbours or gaps.
///
/// Two convex bodies are apart exactly when a plane through some of their corners separates them;
/// seen from the eye they are apart exactly when such a plane through the eye does. All planes are
/// tried, each by integer determinants of the coordinates as given: in 128 bits where the
/// coordinates are short binary fractions, else in GMP's integers. Cells without volume have no
/// inner and take part in nothing.
ExactRelation exact_relation(const ZooMesh& mesh, const View& view);

/// The same in GMP's integers whatever the coordinates.
ExactRelation exact_relation_in_gmp(const ZooMesh& mesh, const View& view);

}  // namespace hiac::test
