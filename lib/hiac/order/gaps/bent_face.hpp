#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hiac/geometry/vector.hpp"
#include "hiac/geometry/view.hpp"
#include "hiac/order/order_basis.hpp"

namespace hiac {

/// An unmatched face that is not planar: a bilinear patch, or one with curved edges.
struct BentFace {
  std::vector<Vector> hull;  ///< points whose convex hull contains it; empty: the face is planar
  int eye = 0;               ///< the side that the eye is on: +1, -1, kBothSides, or 0 (none)
};

/// Returns the face as a view sees it; with an empty hull if it is planar to within `planarity`.
BentFace bent_face(const ZooMesh& mesh, const UnmatchedFace& face, const View& view,
                   double planarity);

/// Returns false only if it is certain that no viewing ray meets the hull of `f`, an exit, and
/// there or farther on that of `g`, an entry: because a plane through the eye and an edge of either
/// separates them, or because a plane through corners of either has g and the eye on one side and f
/// on the other. `slack`: the distance, in world units, by which they may overlap and still count
/// as separated. Hulls that both lie within `slack` of one plane touch: a ray that leaves a cell
/// through one of them enters the other's cell there.
bool may_be_met_first(std::span<const Vector> f, std::span<const Vector> g, const View& view,
                      double slack);

}  // namespace hiac
