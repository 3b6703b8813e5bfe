#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A figure of one cell's shape. All but the volume are without dimension or in degrees, and do not
/// depend on the cell's size.
///
/// Except for the volume and jacobian_ratio they are figures of the polyhedron of the cell's
/// corners. Sources: P. M. Knupp, "Algebraic mesh quality metrics", SIAM J. Sci. Comput. 23, 2001;
/// C. J. Stimpson et al., "The Verdict Geometric Quality Library", Sandia report SAND2007-1751. The
/// ideal cells are the regular tetrahedron, the pyramid with a square base and equilateral sides,
/// the prism with equilateral triangles and square sides, the cube, and the wedge's reference cell
/// (shape_functions.hpp). "Corners" below are those where three edges meet: all but a pyramid's
/// apex and a wedge's node 6. e1, e2, e3 are the edges that leave a corner, in the order in which
/// det[e1, e2, e3] is positive in a cell of the mesh's handedness.
enum class QualityFigure : std::uint8_t {
  /// The volume of the cell with its curved faces, by the divergence theorem: a third of the sum
  /// over the faces of the integral of x . (x_u x x_v) du dv. The integrand is a polynomial; Gauss'
  /// rule is exact for it. Negative if the cell does not have the mesh's handedness. World units
  /// cubed.
  volume,
  /// The least and the largest angle inside the cell between two faces that meet at an edge, in
  /// degrees. For an edge e and the next edges p and q of the two faces at one of its ends it is
  /// the angle between e x p and e x q. Where a face is not planar an edge has two angles. Angles
  /// above 180 degrees belong to edges that bend inwards; tetrahedra have none.
  least_dihedral,
  largest_dihedral,
  /// The longest edge over the shortest (Verdict: edge ratio). At least 1.
  edge_ratio,
  /// Tetrahedra: longest edge / (2 sqrt(6) r) with the radius r of the inscribed sphere (Verdict:
  /// tet_aspect_ratio). At least 1, the regular tetrahedron's.
  aspect_ratio,
  /// Tetrahedra: R / (3 r) with the radii R of the circumscribed and r of the inscribed sphere
  /// (Verdict: tet_radius_ratio). At least 1, the regular tetrahedron's.
  radius_ratio,
  /// The largest |T| |T^-1| / 3 of the corners, where T maps the ideal cell's edges at the corner
  /// to
  /// the cell's, and |.| is Frobenius' norm (Knupp's condition number; Verdict: tet_condition,
  /// hex_condition). At least 1, the ideal cell's.
  condition,
  /// The least det[e1, e2, e3] / (|e1| |e2| |e3|) of the corners over that of the ideal cell's
  /// corner; in bricks also of the three vectors between the middles of opposite faces (Verdict:
  /// tet_scaled_jacobian, hex_scaled_jacobian, wedge_scaled_jacobian for what is called a prism
  /// here). 1 for the ideal cell; zero or negative where the cell is folded at a corner.
  scaled_jacobian,
  /// All kinds but tetrahedron4: the least Jacobian determinant of the cell's map, curved as it is,
  /// over the largest magnitude of it, of the values at the cell's nodes. 1 where the map is
  /// affine.
  jacobian_ratio
};
inline constexpr std::size_t kFigureCount =
    static_cast<std::size_t>(QualityFigure::jacobian_ratio) + 1;

struct FigureDescription {
  std::string_view key;    ///< for programs: "radius_ratio"
  std::string_view title;  ///< for people: "radius ratio"
  std::string_view unit;   ///< "degrees", or empty
};

/// Returns the description of a figure, from a table; does not throw.
const FigureDescription& description_of(QualityFigure figure);

/// Returns whether cells of the kind have the figure.
bool has_figure(CellKind kind, QualityFigure figure);

/// Returns a figure of a cell of a kind that has it; NaN if it is undefined: where edges that it
/// refers to have no length or no angle, for the ratios of cells without volume, and for the
/// condition where the determinant of some corner is not positive. `hand` is +1 if the mesh is
/// right-handed, -1 if it is left-handed. The node numbers and coordinates must be valid.
double quality_of(const ZooMesh& mesh, CellId cell, QualityFigure figure, int hand);

}  // namespace hiac
