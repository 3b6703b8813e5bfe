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

/// Of the places on a patch's border that are as near to the ray as the nearest, to within
/// rounding, the least deep. All patches around an edge near which a ray passes find it there, to
/// rounding of coordinates, however flat they are seen.
///
/// Every edge is searched between corners: in closed form where it is straight, else by Gauss and
/// Newton's iteration from where it comes near between evenly spaced points. Where a coordinate is
/// not a number, some corner.
BorderPlace least_deep_on_border(const PatchAndRay& question);

/// The same for a place (u, v) on the ray that is outside the domain, or on its border, to within
/// rounding: searched from there on every edge, and the one nearest to it in place of the least
/// deep.
BorderPlace nearest_on_border(const PatchAndRay& question, double u, double v);

/// Whether the ray runs along a whole edge to within rounding: that edge's less deep corner.
bool runs_along_edge(const PatchAndRay& question, BorderPlace& corner);

/// Whether the patch is seen edge-on: its control points lie on a line to within rounding.
bool is_edge_on(const PatchAndRay& question);

}  // namespace hiac
