#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "hiac/geometry/view.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A cell as the convex hull of its corners, shrunk towards its middle by the fraction `shrink`, as
/// met_first takes it. It is only valid for the view for which it was made.
struct HullCell {
  std::vector<std::array<double, 3>> corners;  ///< as given
  std::array<double, 3> middle;                ///< their mean
  double shrink;                               ///< in [0, 1)
  double deviation;  ///< largest deviation of a face from its plane, relative to the cell's size
  /// Pairs and triples of corners, which include every edge of the hull and, for each of its
  /// planes, three corners that span it.
  std::vector<std::array<std::uint8_t, 2>> edges;
  std::vector<std::array<std::uint8_t, 3>> planes;
  /// The shrunk corners relative to the eye (in a parallel view to the coordinates' origin),
  /// rounded.
  std::vector<std::array<double, 3>> seen;
  /// A ball that contains them: the direction of its centre (of length 1), its nearest and farthest
  /// depth, and half the angle that it subtends. In a parallel view: its centre, its depths along
  /// the direction, and its radius.
  std::array<double, 3> towards;
  double nearest, farthest, half_angle;
};

/// Returns the cell for met_first. With `inset` > 0 it is shrunk so that each of its faces moves
/// inwards by at least inset times the cell's size plus twice the face's deviation from a plane. A
/// result about two cells then holds for all points farther than that from a face, and cells that
/// share a face that is planar except for rounding do not overlap. The shrunk hull of a cell with
/// curved faces lies inside the cell.
///
/// Returns nothing for a cell that has no inside left or is not convex to within that distance and,
/// without an inset, for a cell with curved faces.
std::optional<HullCell> hull_cell(const ZooMesh& mesh, CellId cell, const View& view, double inset);

/// Returns whether some viewing ray meets the inside of `p` before the inside of `q`; exact for the
/// shrunk hulls.
///
/// Such a ray exists if the inside of q meets the inside of p's shadow, the set of points in p or
/// behind it: conv(p_i) + cone(p_i - eye). Two convex polyhedra have no inner point in common
/// exactly if a plane parallel to a facet of their Minkowski difference separates them: a plane
/// parallel to a facet of either, or to an edge of each (the separating axis theorem; S.
/// Gottschalk, M. Lin, D. Manocha, "OBBTree", 1996, section 5, has it for boxes). All of these are
/// tried; floating-point numbers decide where their error bound allows it, exact ones elsewhere. No
/// code is shared with exact_order and its relation.
bool met_first(const HullCell& p, const HullCell& q, const View& view);

}  // namespace hiac
