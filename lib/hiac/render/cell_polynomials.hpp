#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "hiac/geometry/inverse_map.hpp"
#include "hiac/mesh/cell_kind.hpp"
#include "hiac/render/cell_field.hpp"

namespace hiac {

/// A polynomial of u, v and w in [0, 1], of one degree in each: the coefficient of u^i v^j w^k is
/// at (k (degree+1) + j) (degree+1) + i.
struct CubePolynomial {
  std::size_t degree = 0;
  std::array<double, InterpolantCoefficients::kMost> c{};
};

/// A cell's map and fields as polynomials of the collapsed coordinates u, v, w of
/// interpolant_range.hpp. In these all kinds are alike, the rational ones too.
struct CellPolynomials {
  struct Field {
    CubePolynomial f;  ///< less the base
    double base;
    double least, most;  ///< bounds of the field
    double allowed;      ///< CellField::allowed
  };

  CellShape shape;
  std::size_t exact_degree;                      ///< of fields along rays; 0: not polynomials
  std::array<double, 3> origin;                  ///< what positions are from
  bool affine;                                   ///< the map: then `inverse` is it, else `position`
  std::array<std::array<double, 3>, 3> inverse;  ///< rows; to reference coordinates
  /// Of u, v, w, or of reference coordinates: in these, too, are maps of prisms with straight edges
  /// trilinear, and have no singularity where the cell tapers.
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

/// The collapsed coordinates of a point of the reference cell.
std::array<double, 3> collapsed(CellShape shape, const std::array<double, 3>& xi);

}  // namespace hiac
