#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/base/error.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// The mesh has cells that cannot be drawn (invalid_cells).
class InvalidCellError : public InputError {
 public:
  using InputError::InputError;
};

/// Throws InputError, naming what it is and where it is first met, when the scene or the mesh holds
/// something that the engine does not draw: nothing is approximated or left out in silence.
///
/// Of the mesh: invalid_cells, where they are refused (InvalidCellError); with polynomial
/// interpolation, cells that have no such function (world_polynomial.hpp); values that are not
/// finite in a field that is used, at a place that some cell uses, or above kLargestNumber. Of the
/// scene: isosurfaces or emission that may make a pixel brighter than kLargestColor. UsageError, as
/// from scalar_field, when a field does not exist.
enum class InvalidCells : std::uint8_t { refused, skipped };
void check_renderable(const ZooMesh& mesh, const Scene& scene,
                      InvalidCells invalid = InvalidCells::refused);

/// The cells that cannot be drawn, ascending: turned inside out in part. With planar faces (to
/// `planarity` of their size, quadrilateral_deviation) and straight edges: corners of the cell or
/// of a face turn different ways, so that it is not convex. Else the Jacobian determinant is not
/// proven to be of one sign (jacobian_sign; `planarity` of its size counts as zero).
std::vector<CellId> invalid_cells(const ZooMesh& mesh, double planarity);

/// The order of all cells but these (ascending).
VisibilityOrder without_cells(const VisibilityOrder& order, std::span<const CellId> cells);

}  // namespace hiac
