#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "hiac/element/cell_field.hpp"
#include "hiac/geometry/inverse_map.hpp"
#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// A polynomial of three coordinates in [0, 1], of one degree in each: the coefficient of u^i v^j
/// w^k is at (k (degree+1) + j) (degree+1) + i.
struct CubePolynomial {
  std::size_t degree = 0;
  std::array<double, InterpolantCoefficients::kMost> c{};
};

/// Along lines through the reference cell fields of a kind are polynomials of `degree` over a
/// power, the `pole_order`, of the width to which the cell tapers: 1 - z in pyramids, 2 - y - z in
/// wedges.
struct LineQuotient {
  std::size_t degree, pole_order;
};
LineQuotient quotient_along_lines(CellKind kind);

/// A cell's map and fields as polynomials of the collapsed coordinates u, v, w of
/// interpolant_range.hpp, v and w counted from where the cell tapers: 1 - v in tetrahedra, prisms
/// and wedges and 1 - w in tetrahedra, pyramids and wedges. In these all kinds are alike, the
/// rational ones too, and have few coefficients: shape functions have as few powers of u, and of a
/// pyramid's v, as the cell is narrow.
struct CellPolynomials {
  struct Field {
    CubePolynomial f;  ///< less the base
    double base;
    double least, most;  ///< bounds of the field
    double allowed;      ///< CellField::allowed
  };

  CellShape shape;
  LineQuotient along_lines;      ///< of fields along rays; 0 where not affine
  std::array<double, 3> origin;  ///< what positions are from
  bool affine;                   ///< the map: then `inverse` is it, else `position`
  /// Straight edges over a parallelogram make a pyramid affine. Others have the map A (xi + twist
  /// q), q = x y / (1 - z), with `inverse` that of A: a quadratic equation gives q of a point.
  bool twisted_pyramid;
  std::array<std::array<double, 3>, 3> inverse;  ///< rows; to reference coordinates
  std::array<double, 3> twist;
  /// Of u, v, w, or of x, v, w with x of the reference cell: in these, too, are maps of prisms with
  /// straight edges trilinear, and have no singularity where the cell tapers.
  std::array<CubePolynomial, 3> position;
  bool of_reference;             ///< what `position` is of
  std::array<double, 3> middle;  ///< of the cell, what `position` is of
  double steepness;              ///< CellMap::steepness
  std::size_t field_count;
  std::array<Field, 2> fields;

  /// `nodes`: positions, of which `map` is made; `fields`: one or two.
  CellPolynomials(CellKind kind, std::span<const CellMap::Point> nodes, const CellMap& map,
                  std::span<const CellField> fields);
};

/// The collapsed coordinates of a point of the reference cell, counted as in CellPolynomials.
std::array<double, 3> collapsed(CellShape shape, const std::array<double, 3>& xi);

}  // namespace hiac
