#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "hiac/geometry/view.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A cell as the convex hull of its corners, drawn towards its middle by `shrink` of the way, as
/// met_first asks about it. Views are those that it was made for.
struct HullCell {
  std::vector<std::array<double, 3>> corners;  ///< as given
  std::array<double, 3> middle;                ///< their mean
  double shrink;                               ///< in [0, 1)
  double deviation;  ///< largest of a face from its plane, relative to the cell's size
  /// Pairs and triples of corners: every edge of the hull, and of every one of its planes three
  /// corners that span it, are among them.
  std::vector<std::array<std::uint8_t, 2>> edges;
  std::vector<std::array<std::uint8_t, 3>> planes;
  /// The shrunk corners from the eye (in a parallel view from the coordinates' origin), rounded.
  std::vector<std::array<double, 3>> seen;
  /// A ball around them: its centre's direction (of length 1), its nearest and farthest depth (in
  /// a parallel view along the direction), and the angle that it fills half of (in a parallel view
  /// its radius).
  std::array<double, 3> towards;
  double nearest, farthest, half_angle;
};

/// The cell for met_first. With `inset` > 0 it is shrunk so that each of its faces lies at least
/// inset times the cell's size, and twice what the face deviates from a plane, inside of where it
/// was: what is then found of two cells holds for all that is not within that distance of a face,
/// and cells that meet in a face that is planar but for rounding do not overlap. Of a cell with
/// curved faces the shrunk hull lies inside the cell.
///
/// None for a cell that has no inside left, or is not convex to within that distance; without an
/// inset none for a cell with curved faces.
std::optional<HullCell> hull_cell(const ZooMesh& mesh, CellId cell, const View& view, double inset);

/// True when some viewing ray meets the inside of `p` before the inside of `q`; exactly, for the
/// shrunk hulls.
///
/// Such a ray exists where the inside of q meets that of p's shadow, all that lies in p or behind
/// it: conv(p_i) + cone(p_i - eye). Two convex polyhedra have no inner point in common exactly when
/// a plane parallel to a facet of their Minkowski difference separates them: one that is parallel
/// to a facet of either, or to an edge of each (the separating axis theorem; S. Gottschalk, M. Lin,
/// D. Manocha, "OBBTree", 1996, section 5, has it for boxes). All of these are tried;
/// floating-point numbers decide where their error bound allows it, and exact ones where it does
/// not. Nothing here is shared with exact_order and the relation that it rests on.
bool met_first(const HullCell& p, const HullCell& q, const View& view);

}  // namespace hiac
