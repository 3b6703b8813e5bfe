#pragma once

#include <array>
#include <optional>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A point inside two cells.
struct InteriorPoint {
  std::array<double, 3> at;  ///< world coordinates
  /// The least distance of its reference coordinates from the faces of the two reference cells.
  double depth;
};

/// Searches for a point inside both of two cells of any kind, curved as they are, by the inverses
/// of their maps (Newton's iteration): among points of each cell that are spread over it and, from
/// the most promising ones, by steps that shrink (R. Hooke, T. A. Jeeves, "'Direct Search' Solution
/// of Numerical and Statistical Problems", 1961). Returns none if it finds none that is deeper than
/// 1e-5: that proves nothing.
///
/// Such a point proves that cells whose Jacobians keep their signs overlap: their maps then cover a
/// neighbourhood of it. The maps are inverted to 1e-9 of the cells' sizes.
std::optional<InteriorPoint> common_interior_point(const ZooMesh& mesh, CellId a, CellId b);

}  // namespace hiac
