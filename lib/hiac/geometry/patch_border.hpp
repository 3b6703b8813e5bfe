#pragma once

#include "hiac/geometry/bezier_patch.hpp"

namespace hiac {

/// The coordinates of a patch relative to a ray: a and b are its distances from the ray, sideways
/// and upwards; `depth` is the distance along the ray. `rounding` bounds the rounding errors of a
/// and b, with a margin.
struct PatchAndRay {
  const PatchShape& shape;
  const PatchNet<double>&a, &b, &depth;
  double rounding;
};

struct BorderPlace {
  double u, v;
  double off;  ///< distance from the ray: the larger of |a| and |b|
};

/// Returns the least deep of the points of a patch's border that are nearest to the ray to within
/// rounding. All patches around an edge that a ray passes near find the same point, up to the
/// rounding of coordinates, however nearly edge-on they are seen.
///
/// Every edge is searched between its corners: a straight edge in closed form, a curved one by
/// Gauss-Newton iteration from the local minima among evenly spaced points. Where a coordinate is
/// NaN, some corner is returned.
BorderPlace least_deep_on_border(const PatchAndRay& question);

/// Returns the border point nearest to the ray, like least_deep_on_border, for a point (u, v) on
/// the ray that rounding has put outside the domain or on its border. The search on each edge
/// starts at (u, v); of equally near points, the one nearest to (u, v) is returned.
BorderPlace nearest_on_border(const PatchAndRay& question, double u, double v);

/// Returns whether the ray runs along a whole edge to within rounding; `corner` is then the less
/// deep corner of that edge.
bool runs_along_edge(const PatchAndRay& question, BorderPlace& corner);

/// Returns whether the patch is seen edge-on: its control points lie on a line to within rounding.
bool is_edge_on(const PatchAndRay& question);

}  // namespace hiac
