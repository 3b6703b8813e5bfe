#pragma once

#include <cstdint>
#include <vector>

#include "hiac/geometry/view.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The roughly sorted list from which the sort of Stein et al. starts: the cells by their rearmost
/// depth, back to front, cells of equal depth by number. A cell's place in it is its rank.
///
/// Depths are distances from the eye, or along the direction of a parallel view: they increase
/// along every ray, wherever the eye is.
struct RoughOrder {
  std::vector<CellId> cells;     ///< by rank
  std::vector<double> rearmost;  ///< by rank, descending
  /// By rank: a lower bound of the depths of the cell's points.
  std::vector<double> frontmost;
};

RoughOrder rough_order(const ZooMesh& mesh, const View& view);

}  // namespace hiac
