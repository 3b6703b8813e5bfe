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

/// The form of a kind's fields along lines through the reference cell: polynomials of `degree`,
/// divided by the power `pole_order` of the cell's width, which is 1 - z in pyramids and 2 - y - z
/// in wedges.
struct LineQuotient {
  std::size_t degree, pole_order;
};
LineQuotient quotient_along_lines(CellKind kind);

/// A cell's map and fields as polynomials of the collapsed coordinates u, v, w of
/// interpolant_range.hpp, with v and w counted from the end to which the cell tapers: v stands for
/// 1 - v in tetrahedra, prisms and wedges, and w for 1 - w in tetrahedra, pyramids and wedges. In
/// these coordinates the fields of all kinds, also of the rational ones, are polynomials with few
/// coefficients: the narrower the cell, the fewer powers of u, and of a pyramid's v, occur.
struct CellPolynomials {
  struct Field {
    CubePolynomial f;  ///< relative to the base
    double base;
    double least, most;  ///< bounds of the field
    double allowed;      ///< CellField::allowed
  };

  CellShape shape;
  LineQuotient along_lines;      ///< for fields along rays; 0 if not affine
  std::array<double, 3> origin;  ///< positions are relative to it
  bool affine;                   ///< the map is affine and given by `inverse`, else by `position`
  /// Whether the cell is a pyramid with straight edges whose base is no parallelogram (with a
  /// parallelogram, the map is affine). Its map is A (xi + twist q), q = x y / (1 - z), with
  /// `inverse` that of A: a quadratic equation gives q of a point.
  bool twisted_pyramid;
  std::array<std::array<double, 3>, 3> inverse;  ///< rows; to reference coordinates
  std::array<double, 3> twist;
  /// The map as a function of u, v, w, or of x, v, w with x of the reference cell: in the latter,
  /// too, the maps of prisms with straight edges are trilinear, and they have no singularity at the
  /// narrow end.
  std::array<CubePolynomial, 3> position;
  bool of_reference;             ///< `position` takes x, v, w, else u, v, w
  std::array<double, 3> middle;  ///< of the cell, in the variables of `position`
  double steepness;              ///< CellMap::steepness
  std::size_t field_count;
  std::array<Field, 2> fields;

  /// `nodes`: the positions from which `map` was made; `fields`: one or two.
  CellPolynomials(CellKind kind, std::span<const CellMap::Point> nodes, const CellMap& map,
                  std::span<const CellField> fields);
};

/// The collapsed coordinates of a point of the reference cell, counted as in CellPolynomials.
std::array<double, 3> collapsed(CellShape shape, const std::array<double, 3>& xi);

}  // namespace hiac
