#pragma once

#include <array>
#include <optional>

#include "hiac/element/gradient/gradient_bound.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/render/bounds/ray_displacement.hpp"
#include "hiac/render/refine/extended_cell.hpp"

namespace hiac {

/// A field in a cell in extended precision, and its errors.
struct ExtendedCellField {
  ExtendedCell::Field field;
  double error = 0;     ///< inside the cell
  double at_faces = 0;  ///< in addition, at entry and exit points
};

/// The fields of one linear cell in extended precision, and what their errors depend on.
class ExtendedCellFields {
 public:
  explicit ExtendedCellFields(const Frame& frame) : frame_(frame) {}

  /// Selects a cell of the frame's mesh.
  void enter(CellId cell, const ExtendedCell& geometry);

  [[nodiscard]] CellId cell() const { return cell_; }
  /// How rays are displaced in the cell, in extended precision.
  [[nodiscard]] const RayDisplacement& inside() const { return inside_; }
  /// The field minus `level`, and its errors; `nodes`: the same in doubles.
  [[nodiscard]] ExtendedCellField known(const CellField& nodes, const FrameField& field,
                                        double level) const;

 private:
  [[nodiscard]] std::array<double, 8> node_values(const FrameField& field) const;

  const Frame& frame_;
  // of the current cell
  CellId cell_ = 0;
  std::optional<GradientBound> gradient_;
  double steepness_ = 0;         // CellMap::steepness
  double reach_ = 0, bent_ = 0;  // ExtendedCell
  RayDisplacement inside_;
};

}  // namespace hiac
