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

/// Throws InputError, with the kind and the first place of the problem, if the scene or the mesh
/// contains something that the engine cannot draw: nothing is silently approximated or left out.
///
/// The mesh may not contain invalid_cells, if they are refused (InvalidCellError); with polynomial
/// interpolation, cells without such a function (world_polynomial.hpp); in a field that is used,
/// values that some cell uses and that are not finite or above kLargestNumber. The scene may not
/// contain isosurfaces or emission that may make a pixel brighter than kLargestColor. Throws
/// UsageError, like scalar_field, if a field does not exist.
enum class InvalidCells : std::uint8_t { refused, skipped };
void check_renderable(const ZooMesh& mesh, const Scene& scene,
                      InvalidCells invalid = InvalidCells::refused);

/// The cells that cannot be drawn because they are partly turned inside out, ascending. A cell with
/// planar faces (to `planarity` of their size, quadrilateral_deviation) and straight edges is
/// invalid if corners of the cell or of a face turn different ways, so that it is not convex. Any
/// other cell is invalid if its Jacobian determinant is not proven to be of one sign
/// (jacobian_sign; `planarity` of its size counts as zero).
std::vector<CellId> invalid_cells(const ZooMesh& mesh, double planarity);

/// Throws the InvalidCellError of check_renderable if there are such cells.
void require_valid_cells(const ZooMesh& mesh, double planarity);

/// The order without the given cells (ascending).
VisibilityOrder without_cells(const VisibilityOrder& order, std::span<const CellId> cells);

}  // namespace hiac
